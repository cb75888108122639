#pragma once
/// \file
/// Errors of the operating system about files, in words.

#include <filesystem>
#include <string>

#include "roam/error.h"

namespace roam::files {

/// A file that cannot be used.
class FileError : public Error {
 public:
  FileError(const Error& error, int code) : Error(error), number(code) {}
  int number;  ///< errno
};

/// Throws FileError: "cannot <what> <file>: <why>; <what to do>". `what` is a verb, such as "read" or "write".
[[noreturn]] void fail(const char* what, const std::filesystem::path& file, int error);

}  // namespace roam::files
