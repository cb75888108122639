#pragma once
/// \file
/// Sheets to files, with Cairo. The only file of the picture that knows Cairo.

#include <filesystem>
#include <string>

#include "files/unfinished.h"
#include "sheet.h"

namespace roam::app::picture {

/// Measures with the font that write() draws with.
[[nodiscard]] Rect measure_text(const std::string& text, double size, bool bold);

/// Whether the extension says .svg or .png, in either case.
[[nodiscard]] bool is_picture(const std::filesystem::path& file);

/// A picture that appears under its name only when it is complete.
class PictureFile {
 public:
  /// Makes sure that the file can be written: begins it under a temporary name beside it, which goes away with this
  /// object. `file` must be a picture. Throws roam::Error.
  explicit PictureFile(std::filesystem::path file);
  PictureFile(const PictureFile&) = delete;
  PictureFile& operator=(const PictureFile&) = delete;
  ~PictureFile();

  /// Draws the sheet, as SVG or, a pixel of the sheet a pixel of the image, as PNG; and puts it in its place. Throws
  /// roam::Error; what was there before then stays.
  void write(const Sheet& sheet);

 private:
  [[noreturn]] void fail(const char* why) const;

  std::filesystem::path file_;
  std::string temporary_;
  files::Unfinished listed_;
};

}  // namespace roam::app::picture
