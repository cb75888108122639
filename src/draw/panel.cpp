#include "draw/panel.h"

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <tuple>

namespace roam::draw {
namespace {

// Pixels.
constexpr double stroke_across = 10.0;  ///< at the ends of a measure, to each side
constexpr double over_frame = 12.0;     ///< by which signs may stand out of the frame
constexpr double label_margin = 5.0;    ///< between a label and the frame

/// A capsule from the side around its upright axis, from 0 upward, with corners fine enough for any scale.
Polyline outline(double radius, double height) {
  Polyline line;
  constexpr int parts = 24;
  for (const double side : {1.0, -1.0}) {
    const double centre = 0.5 * height + side * std::max(0.0, 0.5 * height - radius);
    for (int k = 0; k <= parts; ++k) {
      const double angle = std::numbers::pi * (static_cast<double>(k) / parts + (side > 0.0 ? 0.0 : 1.0));
      line.emplace_back(radius * std::cos(angle), centre + radius * std::sin(angle));
    }
  }
  line.push_back(line.front());
  return line;
}

}  // namespace

void Panel::put(const std::string& what, std::vector<Polyline> pixels, const Style& style, bool closed,
                const Rect& clip) {
  if (pixels.empty()) return;
  if (style.keep_off > 0.0) labels_.avoid(pixels, style.keep_off);
  sheet_.items.emplace_back(Lines{name_ + what, std::move(pixels), style, closed, clip});
}

void Panel::segments(const std::string& what, std::span<const Segment> segments, const Style& style, std::size_t most,
                     double grid) {
  std::vector<Segment> seen;
  for (Segment s : segments) {
    if (clip(s, frame_.view)) seen.push_back(s);
  }
  Coarsened coarsened;
  put(what, joined(seen, std::cref(*this), most, coarsened), style, false, area());
  const double pixels = std::max(coarsened.grid, grid * scale());
  CoarseLines& coarsest = sheet_.coarsest;
  if (pixels <= usual_exactness || std::tie(pixels, coarsened.left_out) <= std::tie(coarsest.pixels, coarsest.left_out))
    return;
  coarsest = {name_ + what, pixels, pixels / scale(), coarsened.left_out};
}

void Panel::lines(const std::string& what, std::vector<Polyline> lines, const Style& style, bool closed) {
  for (Polyline& line : lines) {
    for (Point& p : line) p = (*this)(p);
    line = simplified(line, straight);
  }
  put(what, std::move(lines), style, closed, area());
}

void Panel::disc(const std::string& what, const Point& centre, double radius, const Style& style) {
  const Point at = (*this)(centre);
  const double pixels = radius * scale();
  Polyline edge = outline(pixels, 2.0 * pixels);
  for (Point& p : edge) p += at - Point(0.0, pixels);
  if (style.keep_off > 0.0) labels_.avoid({edge}, style.keep_off);
  sheet_.items.emplace_back(Disc{name_ + what, at, pixels, style, area()});
}

void Panel::capsule(const std::string& what, const Point& foot, double radius, double height, const Style& style) {
  Polyline line = outline(radius, height);
  for (Point& p : line) p += foot;
  areas(what, {std::move(line)}, style);
}

void Panel::measure(const std::string& what, const Point& from, const Point& to) {
  const Point a = (*this)(from), b = (*this)(to);
  const double length = glm::distance(a, b);
  if (length < 1.0) return;
  const Point across = stroke_across / length * Point(a.y - b.y, b.x - a.x);
  put(what, {{a, b}, {a - across, a + across}, {b - across, b + across}}, measure_style, false,
      area().grown(over_frame));
}

void Panel::sign(const std::string& what, const Point& at, std::vector<Polyline> lines, const Style& style,
                 bool closed) {
  for (Polyline& line : lines) {
    for (Point& p : line) p += (*this)(at);
  }
  put(what, std::move(lines), style, closed, area().grown(over_frame));
}

void Panel::dot(const std::string& what, const Point& at, double radius, const Style& style) {
  sheet_.items.emplace_back(Disc{name_ + what, (*this)(at), radius, style, area().grown(over_frame)});
}

void Panel::text(const std::string& what, const Point& at, const Point& beside, const std::string& text,
                 const Font& font, const Colour& colour, Labels::Align align) {
  labels_.write(name_ + what, text, (*this)(at) + beside, font, colour, align);
}

void Panel::block(const Point& at, double width, double height) {
  labels_.block(Rect::around((*this)(at), width, height));
}

void Panel::label(const std::string& what, const Point& at, const std::vector<std::string>& lines, const Colour& colour,
                  double letters) {
  if (!lines.empty()) labels_.place(name_ + what, lines, colour, letters, (*this)(at), area().grown(-label_margin));
}

void Panel::badge(const std::string& letter) {
  const Rect ground{corner_ + Point(1.0), corner_ + Point(46.0)};
  put("letter ground", {ground.outline()}, ground_style, true, {});
  labels_.write(name_ + "letter", letter, corner_ + Point(13.0, 34.0), heading_font, ink);
  labels_.block(ground);
}

void Panel::border() { put("frame", {area().outline()}, frame_style, true, {}); }

}  // namespace roam::draw
