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

}  // namespace roam::files
