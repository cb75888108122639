#pragma once
/// \file
/// Whole numbers as a class, which an entropy coder takes as a letter, and bits that no coder would shorten.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace roam::store {

/// Numbers below own_class are classes of their own. Each power of two above is divided into four classes, and the
/// remaining bits follow uncoded: within a class all numbers are about equally frequent.
inline constexpr std::uint32_t own_class = 8;
inline constexpr std::uint32_t class_count = own_class + (32 - 3) * 4;

[[nodiscard]] inline std::uint32_t class_of(std::uint32_t number) {
  if (number < own_class) return number;
  const auto top = static_cast<std::uint32_t>(std::bit_width(number)) - 1;
  return own_class + (top - 3) * 4 + (number >> (top - 2) & 3U);
}
/// The number of bits that follow a class.
[[nodiscard]] constexpr std::uint32_t bits_of(std::uint32_t c) { return c < own_class ? 0 : (c - own_class) / 4 + 1; }
/// The least number of a class.
[[nodiscard]] constexpr std::uint32_t base_of(std::uint32_t c) {
  return c < own_class ? c : (4 + (c & 3U)) << ((c - own_class) / 4 + 1);
}

/// Signed differences of small magnitude as small numbers. Extend differences of 16 bits to 32 first.
[[nodiscard]] inline std::uint32_t zigzag(std::uint32_t difference) {
  return difference << 1U ^ (0U - (difference >> 31U));
}
[[nodiscard]] inline std::uint32_t unzigzag(std::uint32_t number) { return number >> 1U ^ (0U - (number & 1U)); }

/// Bits one after the other, the lowest of a byte first.
class BitWriter {
 public:
  void put(std::uint32_t value, std::uint32_t bits) {
    pending_ |= std::uint64_t{value} << count_;
    for (count_ += bits; count_ >= 8; count_ -= 8, pending_ >>= 8U) bytes_.push_back(std::byte(pending_ & 255U));
  }
  [[nodiscard]] std::vector<std::byte> finish() {
    if (count_ > 0) bytes_.push_back(std::byte(pending_));
    return std::move(bytes_);
  }

 private:
  std::vector<std::byte> bytes_;
  std::uint64_t pending_ = 0;
  std::uint32_t count_ = 0;
};

/// Reads the bits back. It does not check for the end: the caller leaves room behind the bytes and calls within() in
/// time.
class BitReader {
 public:
  BitReader(const std::byte* bytes, std::size_t size) : bytes_(bytes), end_(8 * size) {}
  /// At least the next 57 bits, the first one lowest.
  [[nodiscard]] std::uint64_t peek() const {
    std::uint64_t word;
    std::memcpy(&word, bytes_ + at_ / 8, sizeof(word));
    return word >> (at_ % 8);
  }
  void skip(std::uint32_t bits) { at_ += bits; }
  [[nodiscard]] bool within() const { return at_ <= end_; }
  /// Whether nothing is left except the bits that fill the last byte.
  [[nodiscard]] bool finished() const { return (at_ + 7) / 8 == end_ / 8; }

 private:
  const std::byte* bytes_;
  std::size_t at_ = 0, end_;
};

}  // namespace roam::store
