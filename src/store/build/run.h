#pragma once
/// \file
/// Runs: up to 2^19 triangles of a part, sorted along the curve, in a file of the scratch folder.
///
/// A run is a sequence of blocks of about a thousand neighbours on the curve, each with its vertices. An index gives
/// the first key of each block, so a range of the curve can be read without the rest. The format is private to one
/// build; scratch of another version is not read.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "roam/mesh.h"
#include "store/folder.h"
#include "store/part.h"

namespace roam::store {

inline constexpr std::uint32_t run_triangles = 1u << 19;
inline constexpr std::uint32_t block_triangles = 1024;

/// Triangles in their original order.
struct RunContent : Mesh {
  std::uint64_t first = 0;  ///< number, in the part, of the first one
};

/// A triangle of a run that is being sorted.
struct RunItem {
  CurveKey key;
  std::uint32_t triangle;
};

/// Items by key, then in their original order. Uses all threads of the calling arena.
[[nodiscard]] std::vector<RunItem> sort_run(const RunContent& run);

/// Publishes the file of a store. `items`: of sort_run. Returns the hash of all its bytes.
std::uint64_t write_run(const Folder& store, const std::string& name, const RunContent& run,
                        std::span<const RunItem> items);
/// Whether the file is there, has the right size, and ends as a run with this hash does. Reads only its end. Throws
/// FileError where something else is in its place.
[[nodiscard]] bool is_run(const Folder& store, const std::string& name, std::uint64_t hash);

/// Triangles of a block, and their numbers in the part.
struct RunBlock {
  std::vector<Triangle> triangles;
  std::vector<std::uint64_t> numbers;
  std::vector<Vec3> vertices;    ///< space to decode in
  std::vector<std::byte> bytes;  ///< the same
};

/// A run, open for reading by any number of threads. Throws roam::Error for a file that has changed since it was
/// written. It opens and reads a damaged file a second time. If that is damaged too, and no other file has taken its
/// place, it removes the file, so that the next plan reads that part of the scene again.
class RunReader {
 public:
  /// `hash`: of write_run.
  RunReader(const Folder& store, const std::string& name, std::uint64_t hash);

  struct Range {
    std::size_t begin = 0, end = 0;
  };
  /// The blocks that may hold keys in [first, last].
  [[nodiscard]] Range blocks(CurveKey first, CurveKey last) const;
  void read(std::size_t block, RunBlock& out) const;

 private:
  struct Entry {
    CurveKey first;
    std::uint64_t offset;
    std::uint64_t hash;
    std::uint32_t bytes;
    std::uint32_t zero[3];
  };
  static_assert(sizeof(Entry) == 48);
  struct Footer;
  friend std::uint64_t write_run(const Folder&, const std::string&, const RunContent&, std::span<const RunItem>);
  friend bool is_run(const Folder&, const std::string&, std::uint64_t);

  RunReader(const Folder& store, const std::string& name, std::uint64_t hash, Descriptor&& descriptor)
      : store_(store), name_(name), hash_(hash), descriptor_(std::move(descriptor)) {}
  /// Reads all but the blocks. Returns what is damaged, or null.
  [[nodiscard]] const char* load();
  /// False: it is damaged.
  [[nodiscard]] bool decode(std::size_t block, RunBlock& out) const;
  [[nodiscard]] bool get(std::uint64_t offset, std::span<std::byte> out) const;
  [[nodiscard]] bool is_still_damaged() const;
  [[noreturn]] void refuse(const char* why) const;

  [[noreturn]] void fail_to_read() const;

  Folder store_;
  std::string name_;
  std::uint64_t hash_;
  Descriptor descriptor_;
  std::pair<std::uint64_t, std::uint64_t> number_;  ///< device and inode
  std::uint64_t first_number_ = 0;
  std::vector<Entry> index_;
};

}  // namespace roam::store
