#pragma once
/// \file
/// One framed drawing of a sheet: a plan or a section, of the whole way or of a detail.

#include "draw/compose.h"
#include "draw/labels.h"

namespace roam::draw {

/// The gaps beside the body, metres, at which the colour of the way changes, and the colours from tight to wide.
struct GapScale {
  std::array<double, 4> limits{};
  static constexpr std::array<Colour, 5> colours{
      {{0.70, 0.05, 0.15}, {0.93, 0.42, 0.10}, {0.92, 0.70, 0.05}, {0.15, 0.62, 0.45}, {0.10, 0.38, 0.72}}};
  /// From a sixth of the radius upward in round lengths.
  explicit GapScale(double radius);
  [[nodiscard]] std::size_t index(double gap) const;
};

inline constexpr Colour wall_ink{0.13, 0.15, 0.20};
inline constexpr Colour below_ink{0.66, 0.70, 0.76};
inline constexpr Colour frame_ink{0.78, 0.80, 0.84};
inline constexpr Colour body_ink{0.10, 0.38, 0.72};
inline constexpr Colour body_fill{0.10, 0.38, 0.72, 0.16};
inline constexpr Colour ghost_ink{0.45, 0.25, 0.65};
inline constexpr Colour touch_ink{0.86, 0.10, 0.32};
/// A mark's colour: success, attention or failure.
[[nodiscard]] Colour mark_colour(MarkKind kind);

/// The position of a frame on the sheet.
struct Map {
  Frame frame;
  Point corner{0.0};  ///< upper left, pixels

  [[nodiscard]] Point operator()(const Point& p) const {
    return {corner.x + (p.x - frame.view.lower.x) * frame.scale_x,
            corner.y + (frame.view.upper.y - p.y) * frame.scale_y};
  }
  [[nodiscard]] Rect panel() const { return {corner, corner + Point(frame.width(), frame.height())}; }
};

/// Draws panels of one picture on a sheet.
class PanelPainter {
 public:
  PanelPainter(const Contents& contents, Sheet& sheet, Labels& labels);

  /// Draws walls, way, touches, bodies and marks; `prefix` begins the names of the items.
  void plan(const std::string& prefix, const Map& map, const PlanCut& cut);
  void section(const std::string& prefix, const Map& map);

  /// Writes a label for each mark in the panel; `text` returns its lines.
  void label_marks(const std::string& prefix, const Map& map, bool is_plan,
                   const std::function<std::vector<std::string>(std::size_t)>& text);

 private:
  void segments(const std::string& what, const Map& map, std::span<const Segment> segments, double width,
                const Colour& colour);
  /// Draws the way through `at` (maps a station to a place in the map's metres), in the colours of the gaps.
  void way(const std::string& prefix, const Map& map, const std::function<Point(const Station&)>& at);
  void touches(const std::string& prefix, const Map& map, bool is_plan);
  void mark(const std::string& prefix, const Map& map, bool is_plan, const Mark& mark);
  void body_outline(const std::string& prefix, const Map& map, bool is_plan, const Mark& mark);
  [[nodiscard]] Point at(const Mark& mark, bool is_plan) const;
  /// A point near the body, in the section: ahead of the body's centre or behind it, along the body's heading.
  [[nodiscard]] Point unrolled(const Vec3& point, const Vec3& centre, double along) const;

  const Contents& c_;
  Sheet& sheet_;
  Labels& labels_;
  GapScale gaps_;
};

/// A rectangle as a closed line.
[[nodiscard]] Polyline outline(const Rect& r);

}  // namespace roam::draw
