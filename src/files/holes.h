#pragma once
/// \file
/// Holes: ranges of a file that take no space on its disk. They cost nothing, but reading them takes time.

#include <cstdint>

namespace roam::files {

/// Bytes of holes that a file may have, in total and for each byte of data.
inline constexpr std::uint64_t most_holes = 16u << 20, holes_per_byte = 16;

/// Whether an open file has more holes than that. False if its file system does not list holes. Moves the descriptor's
/// position to the beginning.
[[nodiscard]] bool is_mostly_holes(int descriptor) noexcept;

/// The data of a file, a range of bytes between two holes.
struct DataRange {
  std::int64_t begin = 0;
  std::int64_t end = 0;  ///< equal to begin: none up to the end of the file
};
/// The first data at or after a position in an open file of `size` bytes. A file system that does not list holes
/// reports everything as data. Moves the descriptor's position.
[[nodiscard]] DataRange next_data(int descriptor, std::int64_t from, std::int64_t size) noexcept;

}  // namespace roam::files
