#pragma once
/// \file
/// Files that a verb writes besides its result. Bad ones are refused before any work, and a failed write never loses
/// the result.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/mark.h"
#include "files/place.h"
#include "roam/error.h"

namespace roam::app {

/// The reason why a file cannot be written ("there is no folder a/b"), and advice.
struct Obstacle {
  std::string what, advice;
};
/// None if nothing prevents writing `file`, which must have a name and is no link to follow.
[[nodiscard]] std::optional<Obstacle> obstacle(const std::filesystem::path& file);

/// Throws UsageError, naming the option, for the address of a web server.
void demand_no_address(const std::string& option, const std::filesystem::path& output);

using files::beginning_with;
using files::FileKind;
using files::marked;
/// Paths, whoever made them, empty files, and recordings that ended before their first place.
[[nodiscard]] FileKind paths();

/// A file, and its name in a sentence ("the path") or the option that names it. Empty: not given.
struct NamedFile {
  std::string name;
  std::filesystem::path file;
  FileKind kind{};  ///< an output replaces only files of this kind
};

/// The scenes, each named "the scene".
[[nodiscard]] std::vector<NamedFile> named_scenes(std::span<const std::filesystem::path> scenes);

/// Throws UsageError if an output is the same file as an input or another output, a file in a folder that is an input,
/// a file that is not of its kind: somebody else made that, and the scene may refer to it; or behind a link that
/// files::is_link() refuses. A files::WholeFile looks at kind and links again when it is written.
void demand_no_overwriting(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs);

/// Throws UsageError, naming the option, for a file that cannot be written: an address, a folder, a pipe, or one in a
/// folder that does not exist or is not writable. A link stands for the file that it leads to.
void check_output(const std::string& option, const std::filesystem::path& file);

/// Half a sentence for a message that `file` is not written: that an earlier one stays. Empty if there is none.
[[nodiscard]] std::string earlier_stays(const std::filesystem::path& file);

/// Keeps the error of a failed write until the result has been printed.
class Unwritten {
 public:
  template <class Write>
  void attempt(Write&& write) {
    try {
      write();
    } catch (const Error& error) {
      errors_.push_back(error);
    }
  }
  [[nodiscard]] bool any() const { return !errors_.empty(); }
  /// Call it after the result has been printed. Throws the first error, after a signal as Stopped, and tells the others
  /// before.
  void raise() const;

 private:
  std::vector<Error> errors_;
};

}  // namespace roam::app
