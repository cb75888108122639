#pragma once
/// \file
/// Writes sheets to files, with Cairo. The only file of the picture that uses Cairo.

#include <filesystem>
#include <string>

#include "draw/sheet.h"
#include "files/whole_file.h"

namespace roam::draw {

/// Measures with the font of PictureFile::write.
[[nodiscard]] Rect measure_text(const std::string& text, double size, bool bold);

/// Throws app::UsageError if the extension of a --picture is neither .svg nor .png, in either case.
void check_picture(const std::filesystem::path& file);

/// A picture file that appears under its name only when it is complete.
class PictureFile {
 public:
  /// Begins the file, to make sure that it can be written. `file` must pass check_picture. Throws roam::Error.
  explicit PictureFile(const std::filesystem::path& file);

  /// Draws the sheet and puts the file in its place. Call it once. SVG, or PNG with one pixel per pixel of the sheet.
  /// Throws roam::Error; an earlier file then stays.
  void write(const Sheet& sheet);

 private:
  std::filesystem::path path_;
  files::WholeFile file_;
};

}  // namespace roam::draw
