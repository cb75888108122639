#pragma once
/// \file
/// The JSON object of a command that failed.

#include <span>
#include <string>

#include "cli/report.h"

namespace roam::app {

/// {"error": {"message", "what", "where"}}: the whole sentence, what is wrong, and the file or option of `arguments`
/// (or the place in it) that the sentence names; null if it names none.
[[nodiscard]] Json failure_report(const std::string& message, std::span<const std::string> arguments);

/// Whether the arguments want JSON, though they may be wrong otherwise.
[[nodiscard]] bool wants_json(std::span<const std::string> arguments);

}  // namespace roam::app
