#pragma once
/// \file
/// Exceptions: bad input and cancelled work.

#include <stdexcept>

namespace roam {

/// Unusable input: a setting out of range, an unreadable file, a coordinate that is not a number. what() is text for
/// the user: what is wrong, where, and what to do. A function that throws it has changed nothing.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Thrown by work that its progress callback cancelled. Not an Error.
class Cancelled : public std::runtime_error {
 public:
  Cancelled() : std::runtime_error("cancelled") {}
};

}  // namespace roam
