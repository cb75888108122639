#include "draw/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "draw/picture_file.h"
#include "math/round_length.h"
#include "text/printable.h"

namespace roam::draw {
namespace {

// Pixels.
constexpr double longest_scale_bar = 240.0;
constexpr double axes_beside = 80.0;  ///< their centre, from the scale bar or the right end

constexpr std::size_t longest_title = 200;  ///< characters

}  // namespace

std::string scale_text(double metres) {
  if (metres >= 1000.0) return fmt::format("{:g} km", metres * 1e-3);
  return metres >= 0.1 || metres == 0.0 ? fmt::format("{:g} m", metres) : fmt::format("{:g} mm", metres * 1e3);
}

void Page::title(const std::string& text) {
  paragraph("title", printable(text, longest_title), title_font, ink);
  down(8.0);
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

Panel Page::panel(const std::string& name, const Frame& frame, double left, const Turn* turn) {
  const Point corner(left, y_ + 18.0);
  sheet_.views.push_back({name,
                          {corner, corner + Point(frame.width(), frame.height())},
                          frame,
                          turn != nullptr ? std::optional(*turn) : std::nullopt});
  return {sheet_, labels_, name, frame, corner};
}

Sheet Page::finish() {
  sheet_.height = std::ceil(y_ + 0.6 * sheet_margin);
  return std::move(sheet_);
}

}  // namespace roam::draw
