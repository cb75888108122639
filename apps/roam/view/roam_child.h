#pragma once
/// \file
/// The running program as a child of the viewer, for work that must not stop a frame.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/report.h"
#include "process/child.h"
#include "roam/error.h"

namespace roam::app {

/// The end of a verb that ran as a child.
struct VerbEnd {
  process::Ending ending;
  std::string last_words;
};

/// Runs a verb of `program` (empty: the running one) until it ends. Calls `take` with each line that it prints. Throws
/// Cancelled, after ending the child, once `wanted` returns false; roam::Error if it cannot be started.
VerbEnd run_verb(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                 const std::function<bool()>& wanted, const std::function<void(const std::string&)>& take);

/// The error that a verb printed with --json, from its member "error".
[[nodiscard]] Error printed_error(const Json& error);
/// The error of a verb that ended without a report and without an error.
[[nodiscard]] Error silent_end(const std::string& verb, const VerbEnd& end);

}  // namespace roam::app
