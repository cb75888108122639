#pragma once
/// \file
/// Streams of letters as one Zstandard frame, and the numbers of variable length before it.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace roam::store {

/// Appends a number: seven bits a byte, lowest first. The eighth bit is set where more bytes follow.
template <class Number>
void append_number(std::vector<std::byte>& coded, Number number) {
  for (; number > 127; number >>= 7U) coded.push_back(static_cast<std::byte>((number & 127U) | 128U));
  coded.push_back(static_cast<std::byte>(number));
}

/// Reads a number of at most `bits` bits and removes it from the front. False if there is no such number.
[[nodiscard]] bool read_number(std::span<const std::byte>& coded, int bits, std::uint64_t& number);

/// Appends a frame of the streams in order, each with codes of its own. Any thread.
void append_frame(std::vector<std::byte>& coded, std::span<const std::vector<std::byte>> streams);

/// Whether these bytes are one whole frame in the format that the library decodes without allocating.
[[nodiscard]] bool is_one_frame(std::span<const std::byte> coded);

}  // namespace roam::store
