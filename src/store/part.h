#pragma once
/// \file
/// Facts about a part of the scene, kept after it was read: parts/<SHA-256>.part.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "roam/error.h"

namespace roam::store {

/// A position on the Morton curve, independent of the scene. The top 4 bits hold the size class of a triangle. Below
/// them are 41 interleaved bits per axis of the centre of its box, in steps of 2^-10 m from (-2^30, -2^30, -2^30) m.
__extension__ typedef unsigned __int128 CurveKey;

/// The number of triangles of a part whose keys equal `key` in all but the lowest `PartFile::cell_bits` bits.
struct Cell {
  CurveKey key = 0;
  std::uint64_t triangles = 0;
};

struct PartFile {
  struct Object {
    std::uint64_t first = 0;  ///< number of its first triangle in the part
    std::string name;
  };
  std::uint64_t triangles = 0;
  std::vector<Object> objects;  ///< ascending by first
  int cell_bits = 0;
  std::vector<Cell> cells;  ///< ascending by key

  /// The name of the object of a triangle of the part.
  [[nodiscard]] const std::string& object(std::uint64_t triangle) const;
};

/// Greatest number of cells of a part.
inline constexpr std::uint64_t most_cells = 1U << 18;

[[nodiscard]] std::vector<std::byte> encode_part(const PartFile& part);

/// The header of a part file.
struct PartCounts {
  std::uint64_t triangles = 0, objects = 0, cells = 0;
  int cell_bits = 0;
};

/// Receives the contents of a part file in order. Each function may be empty.
struct PartVisitor {
  /// Called before all others.
  std::function<void(const PartCounts&)> counts{};
  /// Called with the number of the first triangle and the first `longest_part_name` bytes of the name.
  std::function<void(std::uint64_t, std::string_view)> object{};
  std::function<void(const Cell&)> cell{};
  /// Called before each piece of content is unpacked, some 128 KiB. True ends the visit; an exception leaves it.
  std::function<bool()> enough{};
};
inline constexpr std::size_t longest_part_name = 1U << 16;

/// Thrown for a part file that no builder writes.
class PartDamage : public Error {
 public:
  PartDamage(const std::string& file, const char* why);
};

/// Reads a part file of `bytes` bytes piece by piece, in some 500 KiB plus the window of its zstd frame, and in time in
/// proportion to its bytes, whatever the file claims to hold. `more` fills its argument with the next bytes and returns
/// their number; 0 at the end. Throws PartDamage naming `file` for anything that encode_part does not write; the visits
/// until then are void.
void visit_part(const std::function<std::size_t(std::span<std::byte>)>& more, std::uint64_t bytes,
                const std::string& file, const PartVisitor& visitor);

}  // namespace roam::store
