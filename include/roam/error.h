#pragma once
/// \file
/// The one exception type for bad input.

#include <stdexcept>

namespace roam {

/// Input that cannot be used: a setting out of range, a file that cannot be read, a coordinate that is not a number.
/// what() is one sentence, or a few, for the person who caused it: what is wrong, where, and what to do about it.
/// Nothing has been changed when it is thrown.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Work that its own progress callback asked to stop. Not an Error: nobody did anything wrong.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace roam
