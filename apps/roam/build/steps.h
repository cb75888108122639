#pragma once
/// \file
/// Progress of a build.

#include <optional>
#include <string>

#include "cli/progress.h"
#include "roam/store_build.h"

namespace roam::app {

/// For people a line per step, for programs a JSON object per line, several times a second.
class Steps {
 public:
  Steps(std::string output, bool json_lines) : output_(std::move(output)), json_lines_(json_lines) {}

  /// Returns false after an interrupt.
  bool show(const StoreBuildProgress& p);

 private:
  std::string output_;
  bool json_lines_;
  StoreBuildProgress::Step step_ = StoreBuildProgress::Step::read;
  std::optional<Progress> line_;
};

}  // namespace roam::app
