#pragma once
/// \file
/// What is known of a part of the scene after it was read: parts/<SHA-256>.part.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
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

  /// The name of the object of a triangle of the part.
  [[nodiscard]] const std::string& object(std::uint64_t triangle) const;
};

/// Of cells of a part at most.
inline constexpr std::uint64_t most_cells = 1U << 18;

[[nodiscard]] std::vector<std::byte> encode_part(const PartFile& part);

/// What a part file says of itself.
struct PartCounts {
  std::uint64_t triangles = 0, objects = 0, cells = 0;
  int cell_bits = 0;
};

/// Takes what a part file holds, in its order.
struct PartVisitor {
  /// Before all others; may be empty, as the others.
  std::function<void(const PartCounts&)> counts{};
  /// The number of the first triangle, and the name: the first `longest_name` bytes of it.
  std::function<void(std::uint64_t, std::string_view)> object{};
  std::function<void(const Cell&)> cell{};
};
inline constexpr std::size_t longest_name = 1U << 16;

/// Reads a part file piece by piece, in some 500 KiB and what its zstd frame looks back, whatever it holds and claims.
/// `more` fills what it is given with the next bytes and returns how many that were; 0 at the end. Throws roam::Error
/// naming `file` for anything that encode_part does not write: what was visited by then is void.
void visit_part(const std::function<std::size_t(std::span<std::byte>)>& more, const std::string& file,
                const PartVisitor& visitor);

/// All of it at once, for bytes that are known to be small.
[[nodiscard]] PartFile decode_part(std::span<const std::byte> bytes, const std::string& file);

}  // namespace roam::store
