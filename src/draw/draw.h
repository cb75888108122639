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

/// Whether the extension says .svg or .png, in either case.
[[nodiscard]] bool is_picture(const std::filesystem::path& file);

/// A picture that appears under its name only when it is complete.
class PictureFile {
 public:
  /// Makes sure that the file can be written: begins it. `file` must be a picture. Throws roam::Error.
  explicit PictureFile(const std::filesystem::path& file);

  /// Draws the sheet, as SVG or, a pixel of the sheet a pixel of the image, as PNG; and puts it in its place. Once.
  /// Throws roam::Error; what was there before then stays.
  void write(const Sheet& sheet);

 private:
  std::filesystem::path path_;
  files::WholeFile file_;
};

}  // namespace roam::draw
