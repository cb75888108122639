#pragma once
/// \file
/// Files that a verb writes besides its result. Bad ones are refused before any work, and a failed write never loses
/// the result.

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "roam/error.h"

namespace roam::app {

/// The reason why a file cannot be written ("there is no folder a/b"), and advice.
struct Obstacle {
  std::string what, advice;
};
/// None if nothing prevents writing `file`, which must have a name.
[[nodiscard]] std::optional<Obstacle> obstacle(const std::filesystem::path& file);

/// Throws UsageError, naming the option, for the address of a web server.
void demand_no_address(const std::string& option, const std::filesystem::path& output);

/// A file, and its name in a sentence ("the path") or the option that names it. Empty: not given.
struct NamedFile {
  std::string name;
  std::filesystem::path file;
  std::function<bool(const std::filesystem::path&)> is_like{};  ///< whether an output may replace this file; empty: any
};
/// Whether a file begins with a text, or is empty. A byte order mark before it does not count.
[[nodiscard]] std::function<bool(const std::filesystem::path&)> begins_with(std::string_view start);
/// Whether a file is a path, or is empty, or a recording that ended before its first place.
[[nodiscard]] bool is_path(const std::filesystem::path& file);

/// The scenes, each named "the scene".
[[nodiscard]] std::vector<NamedFile> named_scenes(std::span<const std::filesystem::path> scenes);

/// Throws UsageError if an output is the same file as an input or another output, a file in a folder that is an input,
/// or a file that it is not `is_like`: the scene may refer to that.
void demand_no_overwriting(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs);

/// Throws UsageError, naming the option, for a file that cannot be written: an address, a folder, a pipe, or one in a
/// folder that does not exist or is not writable.
void check_output(const std::string& option, const std::filesystem::path& file);

/// Keeps the error of a failed write until the result has been printed.
class Unwritten {
 public:
  template <class Write>
  void attempt(Write&& write) {
    try {
      write();
    } catch (const Error& error) {
      if (!first_) first_ = error;
    }
  }
  [[nodiscard]] bool any() const { return first_.has_value(); }
  /// Call it after the result has been printed. Throws the first error.
  void raise() const {
    if (first_) throw Error(*first_);
  }

 private:
  std::optional<Error> first_;
};

}  // namespace roam::app
