#pragma once
/// \file
/// From exceptions to a roam_status and the text of roam_error().

#include <new>
#include <string>

#include "roam/error.h"
#include "roam/roam.h"

namespace roam::c {

/// An argument of the caller that cannot be used.
class Invalid : public Error {
 public:
  using Error::Error;
};

/// Status and text of the exception being handled. `path`: the file that the work reads or writes, or null.
roam_status caught(const char* path) noexcept;

/// Runs `work`. No exception leaves it.
template <class Work>
roam_status guarded(const char* path, const Work& work) noexcept {
  try {
    work();
    return ROAM_OK;
  } catch (...) {
    return caught(path);
  }
}
template <class Work>
roam_status guarded(const Work& work) noexcept {
  return guarded(nullptr, work);
}

/// Runs a part of the work on a file whose errors are about other arguments than the file.
template <class Work>
auto about_arguments(const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Invalid(error.what());
  }
}

inline void needed(const void* pointer, const char* name) {
  if (pointer == nullptr) throw Invalid(std::string(name) + " is NULL; it is needed");
}
template <class T>
T& needed(T* pointer, const char* name) {
  needed(static_cast<const void*>(pointer), name);
  return *pointer;
}

}  // namespace roam::c
