#pragma once
/// \file
/// Names of enumerators.

#include <cstddef>

namespace roam {

/// The name of an enumerator, from a list of all of them in order.
template <class Enumeration, std::size_t count>
[[nodiscard]] constexpr const char* name_in(const char* const (&names)[count], Enumeration value) {
  const auto i = static_cast<std::size_t>(value);
  return i < count ? names[i] : "unknown";
}

}  // namespace roam
