#pragma once
/// \file
/// A collision store: a scene of any size on disk, made once by store_build.h, walked in fixed memory by pager.h.
///
///     const auto store = roam::Store::open("dam.roam");
///     std::cout << store->info().triangles << " triangles in " << store->info().bounds.size().x << " m\n";
///     roam::Pager pager(store, {.memory = 64 << 20});
///
/// Library target roam::store. docs/format.md describes the files byte by byte.
///
/// A store is a folder. What is in it never changes once it is written: packs and part files are named by the SHA-256
/// of what they hold, and the file CURRENT, which is replaced by rename, names the manifest that is in force. Whoever
/// has opened a store holds a lock on its manifest, and so reads that store to its end, whatever is built in its place.
/// Every tile and every page of the index carries its XXH3, which is checked before a byte of it is decoded.
///
/// A store is not changed by reading it and may be read by any number of threads and processes.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/mesh.h"
#include "roam/space.h"

namespace roam {

/// A secret of the user, by which the stores that were built with it are told from all others: a store whose manifest
/// has an authentication code of the key was built, or adopted, by somebody who holds the key. The program keeps its
/// user's key in a file; a program of your own keeps 32 bytes of a cryptographic generator where only its user can read
/// them.
struct StoreKey {
  std::array<std::byte, 32> bytes{};
};

/// What a store holds and what it costs.
struct StoreInfo {
  std::uint32_t format = 0;  ///< version of the format that it is written in
  std::uint64_t triangles = 0;
  std::uint64_t objects = 0;
  std::uint64_t tiles = 0;
  std::uint64_t pages = 0;  ///< of the index
  std::uint64_t packs = 0;
  std::uint64_t bytes = 0;           ///< of all files that the manifest names, and of itself
  std::uint64_t geometry_bytes = 0;  ///< of the tiles alone: vertices, triangles and the tree in each
  std::uint64_t number_bytes = 0;    ///< of what says which triangle of the source each stored one is
  std::uint64_t resident_bytes = 0;  ///< of all tiles in memory, if all were
  Box bounds;                        ///< of the source triangles
  double largest_error_m = 0.0;      ///< the farthest that any stored vertex lies from where the source put it
  bool lossless = false;
  std::string hash;           ///< SHA-256 of the manifest, 64 hexadecimal digits: names everything in the store
  std::string geometry_hash;  ///< 16 hexadecimal digits; of the quantized triangles, whatever their order
};

/// Where a stored triangle comes from.
struct SourceTriangle {
  std::string part;          ///< name of the part of the scene: a file, or a tile of a folder of photogrammetry
  std::uint64_t number = 0;  ///< in that part, in the order of the file
  TriangleId scene = 0;      ///< in the whole scene, as World::build numbers what import_scene reads
  std::string object;        ///< its name; may be empty
};

/// What reads the bytes of a store: files by default. A program may give its own, to read from elsewhere or to see what
/// happens when reading fails. All functions may be called from any thread at any time.
class StoreBytes {
 public:
  virtual ~StoreBytes() = default;
  /// The whole of a small file, e.g. "CURRENT". Throws roam::Error when it cannot be read or is larger than `limit`.
  [[nodiscard]] virtual std::vector<std::byte> whole(const std::string& file, std::uint64_t limit) = 0;
  /// Fills `out` with the bytes from `offset` on of a file, e.g. "packs/<64 digits>.pack". Answers null, or why that
  /// cannot be had, as text that lives for ever. Never throws and never allocates once a file has been read from
  /// before. A pager takes an exception for an answer why not.
  [[nodiscard]] virtual const char* read(const std::string& file, std::uint64_t offset, std::span<std::byte> out) = 0;
};

/// A store that is open for reading. Holds the manifest; tiles and pages are read when somebody asks.
class Store {
 public:
  /// Bytes. Enough for the manifest of 10^10 triangles, or of 200,000 parts.
  static constexpr std::uint64_t usual_memory = 256ull << 20;
  /// `memory`: what the manifest may take, whatever it holds. Throws roam::Error when there is no store, it is of a
  /// newer format (the message says so), or its manifest is damaged or takes more than that.
  [[nodiscard]] static std::shared_ptr<const Store> open(const std::filesystem::path& folder,
                                                         std::uint64_t memory = usual_memory);
  [[nodiscard]] static std::shared_ptr<const Store> open(std::shared_ptr<StoreBytes> bytes, const std::string& name,
                                                         std::uint64_t memory = usual_memory);
  /// Whether the folder is a store, or means to be one: it holds CURRENT.
  [[nodiscard]] static bool is_store(const std::filesystem::path& folder);
  ~Store();

  [[nodiscard]] const StoreInfo& info() const;
  /// The folder as it was passed, for people.
  [[nodiscard]] const std::string& name() const;
  /// Whether the manifest has an authentication code of this key. All else in the store has its SHA-256 in the
  /// manifest; only verify_store compares it. Reads a small file; false where that is damaged or cannot be read.
  [[nodiscard]] bool is_authentic(const StoreKey& key) const;

  // What follows reads from disk and allocates: for reports, not for a thread that moves a body.

  /// Calls f with the triangles as stored (up to a tile at a time) whose tile's box meets `box`, and their numbers.
  /// Throws roam::Error for what cannot be read or is damaged, naming tile and place.
  void for_each_triangle(const Box& box,
                         const std::function<void(std::span<const Triangle>, std::span<const TriangleId>)>& f) const;
  /// The same, but what cannot be read or is damaged is passed over: `missing` is told of each such page and tile, by a
  /// sentence with its name and place.
  void for_each_triangle(const Box& box,
                         const std::function<void(std::span<const Triangle>, std::span<const TriangleId>)>& f,
                         const std::function<void(const std::string&)>& missing) const;
  /// The middles of up to `count` tiles, spread evenly over all: where triangles are many, places are many.
  [[nodiscard]] std::vector<Vec3> sample(std::uint64_t count) const;
  /// Throws roam::Error as above, or when `triangle` is not of this store.
  [[nodiscard]] SourceTriangle source(TriangleId triangle) const;
  /// Just SourceTriangle::scene, which is known sooner.
  [[nodiscard]] TriangleId scene_triangle(TriangleId triangle) const;

  struct State;
  [[nodiscard]] const State& state() const { return *state_; }

 private:
  explicit Store(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// A part of a store that is not as it was written.
struct StoreDamage {
  std::string what;  ///< "tile 17 of page 3 (its box)", "page 3 (its box)", "packs/0123abcd....pack",
                     ///< "parts/0123abcd....part (its name)", "CURRENT", "the manifest"
  std::string why;
  Box where;  ///< that is solid because of it; empty where unknown
};

struct StoreVerification {
  bool complete = true;     ///< false: the first build of it has not ended, and nothing else was looked at
  std::uint64_t bytes = 0;  ///< that were read and hashed
  std::uint64_t tiles = 0;  ///< that were decoded and checked against their entries
  std::vector<StoreDamage> damage;

  [[nodiscard]] bool whole() const { return complete && damage.empty(); }
};

/// Reads every byte of a store: SHA-256 of every file, XXH3 of every tile and page, decodes every tile, and compares
/// counts, boxes and the geometry hash with what the manifest says. Takes Store::usual_memory and some 20 MiB a core at
/// most, whatever the store says. `progress` is called with bytes done and bytes in
/// all; false cancels (roam::Cancelled). Where CURRENT or the manifest is not there or damaged, that is the only damage
/// that is found. Throws roam::Error for what is no store, of a newer format, or may not be read.
[[nodiscard]] StoreVerification verify_store(const std::filesystem::path& folder,
                                             const std::function<bool(std::uint64_t, std::uint64_t)>& progress = {});

}  // namespace roam
