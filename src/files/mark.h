#pragma once
/// \file
/// The mark of roam in meshes, pictures and films that it makes: it replaces no others.

#include <string>
#include <string_view>

#include "files/whole_file.h"

namespace roam::files {

/// These words stand where other programs skip them: in a comment, or in a part of the file that only roam knows. Each
/// format has one place for them; in an MP4 or WebM it is anywhere in the first 4 MiB. An editor that keeps comments
/// may keep the mark, and then roam takes what a person edited for its own.
inline constexpr std::string_view mark = "made by roam";

/// Adds the mark to the bytes of a picture: PNG, JPEG or SVG. Others stay as they are. In a PNG it is a chunk that is
/// unsafe to copy: an editor that changes the picture drops it.
void add_mark(std::string& picture);
/// Adds the mark to a complete film that is not committed yet: GIF or WebP. Others stay as they are. Throws FileError.
void add_mark(WholeFile& film);

/// Meshes, pictures and films with the mark at the place of their format, and empty files. None that cannot be read.
[[nodiscard]] FileKind marked(const std::string& noun);

}  // namespace roam::files
