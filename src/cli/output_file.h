#pragma once
/// \file
/// Files that a verb writes besides its answer: refused before any work, and never at the answer's cost.

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "roam/error.h"

namespace roam::app {

/// Why a file could only fail to be written: "there is no folder a/b", and what to do.
struct Obstacle {
  std::string what, advice;
};
/// None where nothing is in the way of `file`, which has a name.
[[nodiscard]] std::optional<Obstacle> obstacle(const std::filesystem::path& file);

/// Throws UsageError, naming the option, for a file that could only fail later: without a name, a folder, one of the
/// scenes, or in a folder that is not there or may not be written.
void check_output(std::span<const std::filesystem::path> scenes, const std::string& option,
                  const std::filesystem::path& file);

/// Writing that may fail before the answer is told, and is not to keep it from being told.
class Unwritten {
 public:
  template <class Write>
  void attempt(Write&& write) {
    try {
      write();
    } catch (const Error& error) {
      if (why_.empty()) why_ = error.what();
    }
  }
  [[nodiscard]] bool any() const { return !why_.empty(); }
  /// When the answer has been told. Throws Error with the first reason.
  void raise() const {
    if (any()) throw Error(why_);
  }

 private:
  std::string why_;
};

}  // namespace roam::app
