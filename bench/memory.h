#pragma once
/// \file
/// The memory of a data structure, by the allocator's count.

#include <cstddef>

namespace roam::bench {

/// Bytes that the program holds from malloc now, including all threads and mapped blocks. 0 if the C library cannot
/// count them. Allocators that bypass malloc are not counted.
[[nodiscard]] std::size_t allocated_bytes();

}  // namespace roam::bench
