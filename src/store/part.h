#pragma once
/// \file
/// What is known of a part of the scene after it was read: parts/<SHA-256>.part.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace roam::store {

/// A place on the Morton curve: the size class of a triangle in the top 4 bits, 41 interleaved bits an axis below, of
/// the centre of its box in steps of 2^-10 m from (-2^30, -2^30, -2^30) m. It does not depend on the scene.
__extension__ typedef unsigned __int128 CurveKey;

/// How many triangles of a part have keys that begin like `key`: in all but the lowest `PartFile::cell_bits` bits.
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
  std::vector<Object> objects;  ///< first ascending
  int cell_bits = 0;
  std::vector<Cell> cells;  ///< key ascending

  /// The object of a triangle of the part.
  [[nodiscard]] const std::string& object(std::uint64_t triangle) const;
};

[[nodiscard]] std::vector<std::byte> encode_part(const PartFile& part);
/// Throws roam::Error naming `file` for anything that encode_part does not write.
[[nodiscard]] PartFile decode_part(std::span<const std::byte> bytes, const std::string& file);

}  // namespace roam::store
