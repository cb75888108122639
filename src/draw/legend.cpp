// The legend of a page.
#include <algorithm>
#include <variant>

#include "draw/page.h"
#include "draw/picture_file.h"

namespace roam::draw {
namespace {

// Pixels.
constexpr double legend_row = 36.0;
constexpr double sample_width = 40.0;
constexpr double sample_gap = 12.0;
constexpr double entry_gap = 34.0;

}  // namespace

void Page::legend(std::span<const LegendEntry> entries) {
  const std::size_t drawn = sheet_.items.size();
  const auto is_drawn = [&](const Style& style) {
    return std::any_of(sheet_.items.begin() + static_cast<std::ptrdiff_t>(explained_),
                       sheet_.items.begin() + static_cast<std::ptrdiff_t>(drawn), [&](const auto& item) {
                         const auto* lines = std::get_if<Lines>(&item);
                         const auto* disc = std::get_if<Disc>(&item);
                         return (lines != nullptr && lines->style == style) ||
                                (disc != nullptr && disc->style == style);
                       });
  };
  Point at(sheet_margin, y_ + 40.0);
  for (const LegendEntry& entry : entries) {
    if (!entry.always && !is_drawn(entry.style)) continue;
    const double width = entry.disc > 0.0 ? 2.0 * entry.disc + 4.0 : sample_width;
    const double needed = width + sample_gap + measure_text(entry.text, small_font).width();
    if (at.x > sheet_margin && at.x + needed > sheet_.width - sheet_margin) at = {sheet_margin, at.y + legend_row};
    const Point middle = at + Point(0.5 * width, -0.32 * small_font.size), half(0.5 * width, 9.0);
    if (entry.disc > 0.0) {
      sheet_.items.emplace_back(Disc{"legend sample", middle, entry.disc, entry.style});
    } else if (entry.style.fill) {
      sheet_.items.emplace_back(
          Lines{"legend sample", {Rect{middle - half, middle + half}.outline()}, entry.style, true});
    } else {
      const Point aside(half.x, 0.0);
      sheet_.items.emplace_back(Lines{"legend sample", {{middle - aside, middle + aside}}, entry.style});
    }
    labels_.write("legend", entry.text, at + Point(width + sample_gap, 0.0), small_font, ink);
    at.x += needed + entry_gap;
  }
  y_ = at.y;
  explained_ = sheet_.items.size();
}

}  // namespace roam::draw
