#pragma once
/// \file
/// The painter of plans, sections and charts: takes shapes in metres and puts them on a sheet, framed and to scale.

#include <span>
#include <string>
#include <vector>

#include "draw/labels.h"
#include "draw/lines.h"
#include "draw/sheet.h"

namespace roam::draw {

/// A frame at its place on a sheet. What it draws is cut off at the frame. Names of items begin with the panel's.
/// Labels come last: they keep off what was drawn before.
class Panel {
 public:
  /// `corner`: upper left, pixels. The sheet and the labels must outlive it.
  Panel(Sheet& sheet, Labels& labels, std::string name, const Frame& frame, const Point& corner)
      : sheet_(sheet), labels_(labels), name_(std::move(name) + " "), frame_(frame), corner_(corner) {}

  /// The position on the sheet, in pixels, of a point in metres.
  [[nodiscard]] Point operator()(const Point& p) const {
    return corner_ + Point(frame_.scale_x * (p.x - frame_.view.lower.x), frame_.scale_y * (frame_.view.upper.y - p.y));
  }
  [[nodiscard]] const Frame& frame() const { return frame_; }
  [[nodiscard]] double scale() const { return frame_.scale_x; }  ///< pixels per metre
  /// The covered rectangle, pixels.
  [[nodiscard]] Rect area() const { return {corner_, corner_ + Point(frame_.width(), frame_.height())}; }
  [[nodiscard]] bool shows(const Point& p) const { return frame_.view.contains(p); }

  // Shapes in metres.

  /// Loose segments, joined into at most about `most` lines. `grid`: metres that their ends were rounded to before; 0:
  /// they were not. Sheet::coarsest says if they are less exact than `usual_exactness`.
  void segments(const std::string& what, std::span<const Segment> segments, const Style& style,
                std::size_t most = usual_segments, double grid = 0.0);
  void lines(const std::string& what, std::vector<Polyline> lines, const Style& style, bool closed = false);
  void areas(const std::string& what, std::vector<Polyline> areas, const Style& style) {
    lines(what, std::move(areas), style, true);
  }
  void disc(const std::string& what, const Point& centre, double radius, const Style& style);
  /// An upright capsule from the side; `foot` is its lowest point.
  void capsule(const std::string& what, const Point& foot, double radius, double height, const Style& style);
  /// A line with a stroke across each of its ends. Nothing if it is shorter than a pixel.
  void measure(const std::string& what, const Point& from, const Point& to);

  // Signs at a point in metres, with a size in pixels. They may stand out of the frame a little.

  /// Lines around the point.
  void sign(const std::string& what, const Point& at, std::vector<Polyline> lines, const Style& style,
            bool closed = false);
  void dot(const std::string& what, const Point& at, double radius, const Style& style);
  /// A text whose baseline begins, is centred or ends `beside` the point.
  void text(const std::string& what, const Point& at, const Point& beside, const std::string& text, const Font& font,
            const Colour& colour, Labels::Align align = Labels::Align::centre);
  /// Keeps labels off a rectangle around the point.
  void block(const Point& at, double width, double height);
  /// Writes a label near the point, if there is room within the frame: its lines, the first one bold.
  void label(const std::string& what, const Point& at, const std::vector<std::string>& lines, const Colour& colour,
             double letters = label_size);

  /// A letter in the upper left corner, which labels keep off.
  void badge(const std::string& letter);
  /// Draws the frame.
  void border();

 private:
  void put(const std::string& what, std::vector<Polyline> pixels, const Style& style, bool closed, const Rect& clip);

  Sheet& sheet_;
  Labels& labels_;
  std::string name_;
  Frame frame_;
  Point corner_;
};

}  // namespace roam::draw
