#pragma once
/// \file
/// Sheets as SVG and PNG files. No other file uses Cairo.

#include <filesystem>
#include <string>

#include "draw/sheet.h"
#include "files/whole_file.h"

namespace roam::draw {

/// The rectangle covered by a text whose baseline begins at (0, 0). All lines of one font are equally high.
[[nodiscard]] Rect measure_text(const std::string& text, const Font& font);

/// A picture file that appears under its name only when it is complete.
class PictureFile {
 public:
  /// Begins the file of a --picture, to make sure that it can be written. Throws app::UsageError if its extension is
  /// neither .svg nor .png, in either case, and roam::Error.
  explicit PictureFile(const std::filesystem::path& file);

  /// Draws the sheet and puts the file in its place. Call it once. SVG, or PNG with one pixel per pixel of the sheet.
  /// Throws roam::Error; an earlier file then stays.
  void write(const Sheet& sheet);

 private:
  std::filesystem::path path_;
  files::WholeFile file_;
};

}  // namespace roam::draw
