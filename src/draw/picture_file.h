#pragma once
/// \file
/// Sheets as SVG, PNG and DXF files. No other file uses Cairo.

#include <filesystem>
#include <functional>
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
  /// neither .svg nor .png, nor .dxf if `views` says that the sheet has views in metres, in either case, or if a file
  /// is there that roam did not make, and roam::Error.
  enum class Views { none, in_metres };
  explicit PictureFile(const std::filesystem::path& file, Views views = Views::none);

  /// Draws the sheet and puts the file in its place. Call it once. SVG; DXF, see dxf.h; or PNG with one pixel per pixel
  /// of the sheet. Throws roam::Error; an earlier file then stays.
  void write(const Sheet& sheet);
  /// Makes a sheet and writes it. Notes on standard error say what it leaves out, or that Ctrl-C ended the making. Call
  /// it last: it gives the program app::longest_drawing after Ctrl-C.
  void draw(const std::function<Sheet()>& make);

 private:
  std::filesystem::path path_;
  files::WholeFile file_;
};

}  // namespace roam::draw
