#pragma once
/// \file
/// What a data structure costs, asked of the allocator.

#include <cstddef>

namespace roam::bench {

/// Bytes that the program holds from malloc right now, all threads and mapped blocks included; 0 where the C library
/// cannot tell. Allocators that go past malloc are not seen.
[[nodiscard]] std::size_t allocated_bytes();

}  // namespace roam::bench
