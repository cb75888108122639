#pragma once
/// \file
/// Texts on a sheet, without overlaps.

#include <string>
#include <vector>

#include "draw/sheet.h"

namespace roam::draw {

/// The printable text in lines no wider than `width`, broken at spaces, or inside words that are too long.
[[nodiscard]] std::vector<std::string> wrapped(const std::string& text, double width, const Font& font);

/// Writes texts on a sheet. Remembers the places of texts and of other things that must stay clear.
class Labels {
 public:
  explicit Labels(Sheet& sheet) : sheet_(sheet) {}

  enum class Align : std::uint8_t { left, centre, right };
  /// Writes a line with its baseline at `at`, without looking for a free place. Returns its box.
  Rect write(const std::string& what, const std::string& text, const Point& at, const Font& font, const Colour& colour,
             Align align = Align::left);

  /// Keeps placed texts away from a rectangle.
  void block(const Rect& r) { taken_.push_back(r); }
  /// Keeps placed texts off lines if there is room beside them; a greater `weight` does so more strictly.
  void avoid(const std::vector<Polyline>& lines, double weight);

  /// Writes a label, its first line bold, as near to `anchor` as possible inside `panel`, without covering texts or
  /// blocked rectangles. It has a pale ground, and a thin line to the anchor if it is not beside it. If the panel is
  /// full, writes nothing and returns false.
  bool place(const std::string& what, const std::vector<std::string>& lines, const Colour& colour, double size,
             const Point& anchor, const Rect& panel);

 private:
  [[nodiscard]] bool is_free(const Rect& r) const;
  [[nodiscard]] double covered(const Rect& r) const;

  Sheet& sheet_;
  std::vector<Rect> taken_;
  std::vector<std::pair<Point, double>> avoided_;
};

}  // namespace roam::draw
