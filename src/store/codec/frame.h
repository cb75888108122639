#pragma once
/// \file
/// Streams of letters as one Zstandard frame, and numbers of variable length before it.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace roam::store {

/// Appends a number, seven bits a byte, the lowest first, the eighth bit where more follow.
void append_number(std::vector<std::byte>& coded, std::uint64_t number);

/// Takes a number of at most `bits` bits from the front; false where there is none.
[[nodiscard]] bool read_number(std::span<const std::byte>& coded, int bits, std::uint64_t& number);

/// Appends a frame that holds the streams one after the other, each with a code of its own. Any thread.
void append_frame(std::vector<std::byte>& coded, std::span<const std::vector<std::byte>> streams);

/// Whether these bytes are one whole frame of the format that the library decodes without allocating.
[[nodiscard]] bool is_one_frame(std::span<const std::byte> coded);

}  // namespace roam::store
