#pragma once
/// \file
/// The exit status of the program.

#include <stdexcept>

#include "roam/error.h"

namespace roam::app {

enum ExitStatus : int {
  done = 0,
  failed = 1,     ///< the message says what, where and what to do; after a signal, 128 + its number instead
  bad_usage = 2,  ///< the command line is wrong
  answer_no = 3,  ///< the answer is no: blocked, left the scene, fell, held
};

/// A command line that parses but makes no sense: ends with ExitStatus::bad_usage.
class UsageError : public Error {
 public:
  using Error::Error;
  explicit UsageError(const Error& error) : Error(error) {}
};

/// Work that a signal ended, and what is kept of it, or could not be kept.
class Stopped : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Standard output has been closed by its reader.
class BrokenPipe : public std::runtime_error {
 public:
  BrokenPipe() : std::runtime_error("standard output was closed") {}
};

}  // namespace roam::app
