#pragma once
/// \file
/// Numbers in the headers of binary files.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace roam::reader {

/// The little-endian number at byte `at`; 0 if the bytes end before it does.
[[nodiscard]] inline std::uint32_t u32_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  if (at <= bytes.size() && bytes.size() - at >= sizeof(value)) std::memcpy(&value, bytes.data() + at, sizeof(value));
  return value;
}

}  // namespace roam::reader
