#pragma once
/// \file
/// Failures that are no fault of the scene.

#include <stdexcept>
#include <utility>

#include "roam/error.h"

namespace roam::reader {

/// The disk is full or cannot be read, or there is no folder for temporary files. Not a roam::Error: code that leaves
/// out a damaged file must not catch it, because the file is whole and another reader would read it. Like
/// std::bad_alloc, it ends the reading.
class MachineFailure : public std::runtime_error {
 public:
  explicit MachineFailure(Error error) : std::runtime_error(error.what()), error_(std::move(error)) {}
  /// What the user reads.
  [[nodiscard]] const Error& error() const { return error_; }

 private:
  Error error_;
};

}  // namespace roam::reader
