#pragma once
/// \file
/// The JSON object of a command that failed.

#include <span>
#include <string>

#include "cli/report.h"
#include "roam/error.h"

namespace roam::app {

/// {"error": {"message", "what", "where"}}: what(), reason() and where() of the error; null if it has no place;
/// without the secrets of addresses.
[[nodiscard]] Json failure_report(const Error& error);

/// Prints that object if the arguments, which may be wrong otherwise, want JSON and no report was printed.
void print_failure(const Error& error, std::span<const std::string> arguments);

}  // namespace roam::app
