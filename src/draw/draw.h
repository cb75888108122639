#pragma once
/// \file
/// Sheets to files, with Cairo. The only file of the picture that knows Cairo.

#include <filesystem>
#include <string>

#include "draw/sheet.h"
#include "files/whole_file.h"

namespace roam::draw {

/// Measures with the font that write() draws with.
[[nodiscard]] Rect measure_text(const std::string& text, double size, bool bold);

/// Throws app::UsageError for a --picture whose extension is not .svg or .png, in either case.
void check_picture(const std::filesystem::path& file);

/// A picture that appears under its name only when it is complete.
class PictureFile {
 public:
  /// Makes sure that the file can be written: begins it. check_picture must let `file` pass. Throws roam::Error.
  explicit PictureFile(const std::filesystem::path& file);

  /// Draws the sheet, as SVG or, a pixel of the sheet a pixel of the image, as PNG; and puts it in its place. Once.
  /// Throws roam::Error; what was there before then stays.
  void write(const Sheet& sheet);

 private:
  std::filesystem::path path_;
  files::WholeFile file_;
};

}  // namespace roam::draw
