#include "draw/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw/picture_file.h"

namespace roam::draw {
namespace {

// Pixels.
constexpr double longest_scale_bar = 240.0;
constexpr double axes_beside = 80.0;  ///< their centre, from the scale bar or the right end
constexpr double legend_row = 36.0;
constexpr double sample_width = 40.0;
constexpr double sample_gap = 12.0;
constexpr double entry_gap = 34.0;

}  // namespace

std::string scale_text(double metres) {
  if (metres >= 1000.0) return fmt::format("{:g} km", metres * 1e-3);
  return metres >= 0.1 || metres == 0.0 ? fmt::format("{:g} m", metres) : fmt::format("{:g} mm", metres * 1e3);
}

void Page::paragraph(const std::string& what, const std::string& text, const Font& font, const Colour& colour) {
  for (const std::string& line : wrapped(text, sheet_.width - 2.0 * sheet_margin, font)) {
    y_ += 1.25 * font.size;
    labels_.write(what, line, {sheet_margin, y_}, font, colour);
  }
}

void Page::heading(const std::string& what, const Heading& h, double left, double right) {
  const Rect name = labels_.write(what + " heading", h.name, {left, y_}, h.font, ink);
  labels_.write(what + " explanation", h.explanation, {name.upper.x + 18.0, y_}, small_font, pale_ink);
  if (h.scale > 0.0) {
    const double metres = round_length(longest_scale_bar / h.scale), begin = right - metres * h.scale;
    sheet_.items.emplace_back(
        Lines{what + " scale bar", {{{begin, y_ - 12.0}, {begin, y_}, {right, y_}, {right, y_ - 12.0}}}, scale_style});
    labels_.write(what + " scale length", scale_text(metres), {0.5 * (begin + right), y_ - 9.0}, small_font, ink,
                  Labels::Align::centre);
    right = begin;
  }
  if (h.turn != nullptr) axes(what, *h.turn, {right - axes_beside, y_ - 44.0});
}

void Page::axes(const std::string& what, const Turn& turn, const Point& centre) {
  // The sheet's own y points down.
  const std::array<std::pair<const char*, Point>, 2> directions{
      {{"x", {turn.cosine, turn.sine}}, {"y", {turn.sine, -turn.cosine}}}};
  for (const auto& [name, way] : directions) {
    const Point tip = centre + 32.0 * way, side(-way.y, way.x);
    sheet_.items.emplace_back(Lines{what + " axis " + name,
                                    {{centre, tip}, {tip - 9.0 * way + 5.0 * side, tip, tip - 9.0 * way - 5.0 * side}},
                                    {.width = 2.2, .stroke = ink}});
    labels_.write(what + " axis name", name, tip + 13.0 * way + Point(0.0, 6.0), small_font, ink,
                  Labels::Align::centre);
  }
}

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

Sheet Page::finish() {
  sheet_.height = std::ceil(y_ + 0.6 * sheet_margin);
  return std::move(sheet_);
}

}  // namespace roam::draw
