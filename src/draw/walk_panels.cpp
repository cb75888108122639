#include "draw/walk_panels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "math/round_length.h"

namespace roam::draw {
namespace {

// Pixels.
constexpr double least_outline = 4.0;   ///< radius of a drawn body; a smaller one is only a mark
constexpr double least_measure = 14.0;  ///< length of a drawn width; a shorter one is only a mark
constexpr double touch_distance = 8.0;  ///< between two drawn touches, roughly

constexpr double largest_wall_normal_z = 0.7;  ///< of a normal's z: surfaces with a larger one are floor or ceiling

/// Paints one panel. Plan and section differ in the points that show places of the scene.
class WalkPainter {
 public:
  WalkPainter(Panel& panel, const WalkDrawing& walk, bool is_plan)
      : panel_(panel), walk_(walk), is_plan_(is_plan), seen_(panel.frame().view.grown(2.0 * walk.radius)) {}

  /// All but the walls and the labels.
  void paint() const {
    if (!is_plan_) band();
    for (const Mark& m : walk_.marks) {
      if (is_visible(m)) body(m);
    }
    way();
    touches();
    for (const Mark& m : walk_.marks) {
      if (is_visible(m)) mark(m);
    }
  }

  [[nodiscard]] bool is_visible(const Mark& m) const { return panel_.shows(point(m.centre, m.along)); }
  [[nodiscard]] Point at(const Mark& m) const { return near(m.point, m.centre, m.along); }

 private:
  /// A place of the body's centre.
  [[nodiscard]] Point point(const Vec3& centre, double along) const {
    return is_plan_ ? walk_.frames.turn.plan(centre) : Point(along, centre.z);
  }

  /// A place near the body. In the section, it is ahead of the body's centre or behind it, along the body's heading.
  [[nodiscard]] Point near(const Vec3& place, const Vec3& centre, double along) const {
    if (is_plan_) return walk_.frames.turn.plan(place);
    const auto& stations = walk_.survey.stations;
    // If the body stands still or falls, it keeps its last heading.
    auto station = std::upper_bound(stations.begin(), stations.end(), along,
                                    [](double value, const Station& s) { return value < s.along; });
    while (station != stations.begin() && (station == stations.end() || station->heading == Vec3(0.0))) --station;
    return {along + glm::dot(place - centre, station->heading), place.z};
  }

  /// The space of the body in a section: between the heights of its head and its feet.
  void band() const {
    std::vector<Polyline> areas;
    Polyline top, bottom;
    const auto close = [&] {
      top.insert(top.end(), bottom.rbegin(), bottom.rend());
      if (!top.empty()) areas.push_back(std::move(top));
      top.clear();
      bottom.clear();
    };
    const auto& stations = walk_.survey.stations;
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
      const Station &from = stations[i], &to = stations[i + 1];
      if (to.jump || to.along < seen_.lower.x || from.along > seen_.upper.x) {
        close();
        continue;
      }
      // A body keeps its height between stations. After crouching, the next piece begins with another height.
      for (const Station* s : {&from, &to}) {
        top.emplace_back(s->along, s->centre.z + 0.5 * from.height);
        bottom.emplace_back(s->along, s->centre.z - 0.5 * from.height);
      }
    }
    close();
    panel_.areas("band", std::move(areas), band_style);
  }

  void body(const Mark& m) const {
    if (walk_.radius * panel_.scale() < least_outline) return;
    const Point centre = point(m.centre, m.along);
    if (is_plan_) {
      panel_.disc("body", centre, walk_.radius, body_style);
    } else {
      panel_.capsule("body", centre - Point(0.0, 0.5 * m.height), walk_.radius, m.height, body_style);
    }
  }

  /// One line for each run of one colour.
  void way() const {
    const GapScale gaps(walk_.radius);
    const bool is_ghost = walk_.mode == Mode::ghost;
    std::array<std::vector<Polyline>, gap_styles.size()> runs;
    std::size_t last = runs.size();
    const auto& stations = walk_.survey.stations;
    for (std::size_t i = 1; i < stations.size(); ++i) {
      const Station &a = stations[i - 1], &b = stations[i];
      Segment piece{point(a.centre, a.along), point(b.centre, b.along)};
      if (b.jump || !clip(piece, seen_)) {
        last = runs.size();
        continue;
      }
      const bool level = a.heading != Vec3(0.0);
      const std::size_t run = is_ghost ? 0 : gaps.index(level ? std::min(a.left, a.right) : walk_.survey.reach);
      if (run != last) runs[run].push_back({piece.a});
      runs[run].back().push_back(piece.b);
      last = run;
    }
    for (std::size_t k = 0; k < runs.size(); ++k) {
      panel_.lines("way", std::move(runs[k]), is_ghost ? ghost_style : gap_styles[k]);
    }
  }

  /// A walk along a wall leaves many: one for each cell of a grid is drawn.
  void touches() const {
    std::set<std::pair<int, int>> drawn;
    for (const Touch& touch : walk_.record.touches) {
      if (walk_.mode == Mode::walk && std::abs(touch.normal.z) > largest_wall_normal_z) continue;
      const Point p = near(touch.point, walk_.record.places[touch.place].position, walk_.way.along[touch.place]);
      if (!panel_.shows(p)) continue;
      const Point cell = panel_(p) / touch_distance;
      if (drawn.emplace(static_cast<int>(cell.x), static_cast<int>(cell.y)).second) {
        panel_.dot("touch", p, 3.6, touch_style);
      }
    }
  }

  void mark(const Mark& m) const {
    const Point p = at(m);
    const Colour colour = colour_of(m.kind);
    const std::string& what = m.label[0];
    double covers = 12.0;
    switch (m.kind) {
      case MarkKind::start:
      case MarkKind::end:
        panel_.dot(what, p, 7.5, {2.5, paper, colour});
        if (m.kind == MarkKind::end) panel_.dot(what + " eye", p, 2.6, {0.0, {}, paper});
        break;
      case MarkKind::narrowest: {
        const measure::NarrowPlace& n = *walk_.survey.narrowest;
        if (is_plan_ && n.width * panel_.scale() > least_measure) {
          panel_.measure(what, walk_.frames.turn.plan(n.left), walk_.frames.turn.plan(n.right));
          break;
        }
        [[fallthrough]];
      }
      case MarkKind::nearest:
        panel_.sign(what, p, {{{0, -9}, {9, 0}, {0, 9}, {-9, 0}}}, {2.0, paper, colour}, true);
        break;
      case MarkKind::blocked:
        panel_.sign(what, p, {{{-10, -10}, {10, 10}}, {{-10, 10}, {10, -10}}}, {4.5, colour});
        covers = 15.0;
        break;
      case MarkKind::fell:
        panel_.sign(what, p, {{{0, -16}, {0, 14}}, {{-9, 4}, {0, 15}, {9, 4}}}, {4.0, colour});
        covers = 18.0;
        break;
    }
    panel_.block(p, 2.0 * covers, 2.0 * covers);
  }

  Panel& panel_;
  const WalkDrawing& walk_;
  bool is_plan_;
  Rect seen_;
};

}  // namespace

GapScale::GapScale(double radius) {
  limits[0] = round_length(radius / 6.0 * 1.01);
  for (std::size_t k = 1; k < limits.size(); ++k) limits[k] = round_length(2.6 * limits[k - 1]);
}

std::size_t GapScale::index(double gap) const {
  return static_cast<std::size_t>(std::upper_bound(limits.begin(), limits.end(), gap) - limits.begin());
}

Colour colour_of(MarkKind kind) {
  switch (kind) {
    case MarkKind::start:
      return green;
    case MarkKind::narrowest:
    case MarkKind::nearest:
      return purple;
    case MarkKind::blocked:
    case MarkKind::fell:
      return red;
    case MarkKind::end:
      break;
  }
  return ink;
}

void paint_plan(Panel& panel, const WalkDrawing& walk, const PlanCut& cut) {
  panel.segments("below", cut.below, below_style, walk.most_segments, cut.grid);
  panel.segments("walls", cut.walls, wall_style, walk.most_segments, cut.grid);
  panel.border();
  WalkPainter(panel, walk, true).paint();
}

void paint_section(Panel& panel, const WalkDrawing& walk, std::span<const Segment> cut, double grid) {
  panel.segments("walls", cut, wall_style, walk.most_segments, grid);
  panel.border();
  WalkPainter(panel, walk, false).paint();
}

void label_marks(Panel& panel, const WalkDrawing& walk, bool is_plan,
                 const std::function<std::vector<std::string>(std::size_t)>& label) {
  const WalkPainter painter(panel, walk, is_plan);
  for (std::size_t i = 0; i < walk.marks.size(); ++i) {
    const Mark& m = walk.marks[i];
    if (painter.is_visible(m)) panel.label(m.label[0] + " label", painter.at(m), label(i), colour_of(m.kind));
  }
}

}  // namespace roam::draw
