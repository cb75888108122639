#pragma once
/// \file
/// Structs of programs that were compiled with an earlier or a later roam.h.

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>

#include "c/error.h"
#include "roam/math.h"
#include "roam/roam.h"
#include "roam/space.h"

namespace roam::c {

[[nodiscard]] inline Vec3 cpp_of(const roam_vec3& v) { return {v.x, v.y, v.z}; }
[[nodiscard]] inline roam_vec3 c_of(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Throws Invalid for a size that no roam.h has.
inline void check_size(std::size_t size, std::size_t least, const char* name) {
  if (size >= least) return;
  throw Invalid(std::string(name) + " has the size " + std::to_string(size) + "; set its member `size` to sizeof (" +
                std::to_string(least) + ")");
}

/// The size of a struct in the interface in which it was new. Members that came later are zero in older programs.
template <class T>
inline constexpr std::size_t first_size = sizeof(T);
template <>
inline constexpr std::size_t first_size<roam_store_options> = offsetof(roam_store_options, cache);

/// A struct of the caller, with zeros in the members that it does not have. Throws Invalid for null, for a wrong size,
/// and for members that this library does not know, unless they are zero.
template <class T>
T given(const T* from, const char* name) {
  static_assert(std::is_trivially_copyable_v<T>);
  const std::size_t size = needed(from, name).size;
  check_size(size, first_size<T>, name);
  const auto* bytes = reinterpret_cast<const unsigned char*>(from);
  if (size > sizeof(T) && !std::all_of(bytes + sizeof(T), bytes + size, [](unsigned char byte) { return byte == 0; })) {
    throw Invalid(std::string(name) + " uses members that this libroam.so does not have; install a later one");
  }
  T known{};
  std::memcpy(&known, from, std::min(size, sizeof(T)));
  return known;
}

template <class T>
T given_or_default(const T* from, const char* name) {
  return from == nullptr ? T{} : given(from, name);
}

/// Throws Invalid if `to` cannot take a result.
template <class T>
void check_room(T* to, const char* name) {
  check_size(needed(to, name).size, sizeof(T), name);
}

/// Writes a result, and leaves `size` as it is.
template <class T>
void put(T& to, T result) {
  result.size = to.size;
  std::memcpy(&to, &result, sizeof(T));
}

/// Elements of the caller's array of structs.
template <class T>
const T* at(const T* first, std::size_t i) {
  return reinterpret_cast<const T*>(reinterpret_cast<const char*>(first) + i * first->size);
}
template <class T>
T* at(T* first, std::size_t i) {
  return reinterpret_cast<T*>(reinterpret_cast<char*>(first) + i * first->size);
}

}  // namespace roam::c
