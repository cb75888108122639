#pragma once
/// \file
/// Failures that are no fault of the scene.

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include "roam/error.h"

namespace roam::reader {

/// The disk is full or cannot be read, or there is no folder for temporary files. Not a roam::Error: code that leaves
/// out a damaged file must not catch it, because the file is whole and another reader would read it. Like
/// std::bad_alloc, it ends the reading.
class MachineFailure : public std::runtime_error {
 public:
  explicit MachineFailure(Error error) : std::runtime_error(error.what()), error_(std::move(error)) {}
  /// The message for the user.
  [[nodiscard]] const Error& error() const { return error_; }

 private:
  Error error_;
};

/// Throws MachineFailure unless `reason` (errno of a call on `path`; 0: none) says that the file is not there or may
/// not be read.
inline void fail_unless_missing(int reason, const std::filesystem::path& path) {
  for (const int missing : {0, ENOENT, ENOTDIR, EACCES, EPERM, ELOOP, ENAMETOOLONG, ENXIO, EISDIR, EINVAL, EILSEQ}) {
    if (reason == missing) return;
  }
  throw MachineFailure(
      Error(path.string(), std::string("this file cannot be read: ") + std::strerror(reason) + ". Try again."));
}

}  // namespace roam::reader
