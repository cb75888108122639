#pragma once
/// \file
/// Where an output is written, and what it may replace there.

#include <filesystem>
#include <functional>
#include <string>

#include "files/descriptor.h"

namespace roam::files {

/// Files that an output may replace: a noun in the singular, and whether an open file is one; -1 never is. Without a
/// function: any.
struct FileKind {
  std::string noun{};
  std::function<bool(int file)> has{};
};
/// Files that begin with a text, or are empty. A byte order mark before it does not count. None that cannot be read.
[[nodiscard]] FileKind beginning_with(std::string start, std::string noun);

/// A name in a folder that is held open: whatever happens to the path, what is written stays in that folder.
struct Place {
  std::filesystem::path folder_path;  ///< for messages
  std::string name;
  Descriptor folder{};  ///< not open if it cannot be
  int error = 0;        ///< why, as errno

  [[nodiscard]] std::filesystem::path path() const { return folder_path / name; }
  /// Whether a file of this kind may be put there. Only a file of another kind is in the way; a link does not count.
  [[nodiscard]] bool may_get(const FileKind& kind) const;
};

/// Whether a name in an open folder is a link. Throws FileError for one that belongs neither to this user nor to the
/// owner of the folder, if that is shared and sticky, as /tmp: it may lead to any file of this user. Linux does the
/// same if fs.protected_symlinks is 1. The path is for messages.
[[nodiscard]] bool is_link(int folder, const std::string& name, const std::filesystem::path& path);

/// Opens a folder in an open folder. A link is followed if is_link() lets it. Not open, and errno set, if that cannot
/// be. `flags`: of open(2). The path is for messages.
[[nodiscard]] Descriptor open_folder(int folder, const std::string& name, int flags, const std::filesystem::path& path);

/// The same of a path, only to be passed through (O_PATH).
[[nodiscard]] Descriptor open_folders(const std::filesystem::path& path);

/// The folder and the name of a path, whose folders may be links as above.
[[nodiscard]] Place place_of(const std::filesystem::path& file);
/// The same of the file that a link leads to, though nothing is there. A link to anything but a file stays. Throws
/// FileError for links in a circle.
[[nodiscard]] Place place_behind_links(const std::filesystem::path& file);

}  // namespace roam::files
