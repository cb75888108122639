#include "draw/panel.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <set>

#include "draw/lines.h"

namespace roam::draw {
namespace {

constexpr double way_width = 4.0;
constexpr double least_outline = 4.0;          ///< pixels; bodies of a smaller radius are drawn as a dot
constexpr double touch_distance = 8.0;         ///< pixels between two drawn touches, roughly
constexpr double largest_wall_normal_z = 0.7;  ///< of a normal's z: surfaces with a larger one are floor or ceiling

/// A capsule from the side, with corners fine enough for any scale; metres, around its centre.
Polyline capsule(double radius, double height) {
  Polyline line;
  const double half = std::max(0.0, 0.5 * height - radius);
  constexpr int parts = 24;
  for (const double side : {1.0, -1.0}) {
    for (int k = 0; k <= parts; ++k) {
      const double angle = std::numbers::pi * (static_cast<double>(k) / parts) + (side > 0.0 ? 0.0 : std::numbers::pi);
      line.emplace_back(radius * std::cos(angle), side * half + radius * std::sin(angle));
    }
  }
  return line;
}

}  // namespace

GapScale::GapScale(double radius) {
  limits[0] = round_length(radius / 6.0 * 1.01);
  for (std::size_t k = 1; k < limits.size(); ++k) limits[k] = round_length(2.6 * limits[k - 1]);
}

std::size_t GapScale::index(double gap) const {
  return static_cast<std::size_t>(std::upper_bound(limits.begin(), limits.end(), gap) - limits.begin());
}

Colour mark_colour(MarkKind kind) {
  switch (kind) {
    case MarkKind::start:
      return {0.08, 0.47, 0.25};
    case MarkKind::end:
      return {0.11, 0.13, 0.17};
    case MarkKind::narrowest:
    case MarkKind::nearest:
      return {0.55, 0.10, 0.50};
    case MarkKind::blocked:
    case MarkKind::fell:
      return {0.78, 0.06, 0.10};
  }
  return ink;
}

Polyline outline(const Rect& r) { return {r.lower, {r.upper.x, r.lower.y}, r.upper, {r.lower.x, r.upper.y}}; }

PanelPainter::PanelPainter(const Contents& contents, Sheet& sheet, Labels& labels)
    : c_(contents), sheet_(sheet), labels_(labels), gaps_(contents.report.settings.radius) {}

void PanelPainter::segments(const std::string& what, const Map& map, std::span<const Segment> segments, double width,
                            const Colour& colour) {
  std::vector<Segment> seen;
  for (Segment s : segments) {
    if (clip(s, map.frame.view)) seen.push_back(s);
  }
  auto lines = joined(seen, map, c_.most_segments);
  labels_.avoid(lines, 0.5);
  if (!lines.empty()) {
    sheet_.items.emplace_back(
        Lines{.what = what, .lines = std::move(lines), .width = width, .stroke = colour, .clip = map.panel()});
  }
}

void PanelPainter::way(const std::string& prefix, const Map& map, const std::function<Point(const Station&)>& at) {
  const bool is_ghost = c_.report.mode == Mode::ghost;
  // One line for each run of one colour.
  std::array<std::vector<Polyline>, GapScale::colours.size()> runs;
  const Rect seen = map.frame.view.grown(2.0 * c_.report.settings.radius);
  std::vector<Polyline> all;
  std::size_t last_colour = GapScale::colours.size();
  const auto& stations = c_.survey.stations;
  for (std::size_t i = 1; i < stations.size(); ++i) {
    const Station &a = stations[i - 1], &b = stations[i];
    Segment piece{at(a), at(b)};
    if (b.jump || !clip(piece, seen)) {
      last_colour = GapScale::colours.size();
      continue;
    }
    const bool level = a.heading != Vec3(0.0);
    const std::size_t colour = is_ghost ? 0 : gaps_.index(level ? std::min(a.left, a.right) : c_.survey.reach);
    if (colour != last_colour) runs[colour].push_back({map(piece.a)});
    runs[colour].back().push_back(map(piece.b));
    last_colour = colour;
  }
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k].empty()) continue;
    for (Polyline& line : runs[k]) line = simplified(line, 0.2);
    all.insert(all.end(), runs[k].begin(), runs[k].end());
    sheet_.items.emplace_back(Lines{.what = prefix + "way",
                                    .lines = std::move(runs[k]),
                                    .width = way_width,
                                    .stroke = is_ghost ? ghost_ink : GapScale::colours[k],
                                    .clip = map.panel()});
  }
  labels_.avoid(all, 3.0);
}

void PanelPainter::touches(const std::string& prefix, const Map& map, bool is_plan) {
  // A walk along a wall leaves many touches: one for each cell of a grid is drawn.
  std::set<std::pair<int, int>> drawn;
  for (const Touch& touch : c_.record.touches) {
    if (c_.report.mode == Mode::walk && std::abs(touch.normal.z) > largest_wall_normal_z) continue;
    const Vec3& centre = c_.record.places[touch.place].position;
    const Point place =
        is_plan ? c_.frames.turn.plan(touch.point) : unrolled(touch.point, centre, c_.way.along[touch.place]);
    if (!map.frame.view.contains(place)) continue;
    const Point p = map(place);
    const auto cell = [](double at) { return static_cast<int>(at / touch_distance); };
    if (!drawn.emplace(cell(p.x), cell(p.y)).second) continue;
    sheet_.items.emplace_back(Disc{.what = prefix + "touch",
                                   .centre = p,
                                   .radius = 3.6,
                                   .width = 1.0,
                                   .stroke = paper,
                                   .fill = touch_ink,
                                   .clip = map.panel()});
  }
}

Point PanelPainter::at(const Mark& mark, bool is_plan) const {
  return is_plan ? c_.frames.turn.plan(mark.point) : unrolled(mark.point, mark.centre, mark.along);
}

Point PanelPainter::unrolled(const Vec3& point, const Vec3& centre, double along) const {
  const auto& stations = c_.survey.stations;
  // If the body stands still or falls, it keeps its last heading.
  auto station = std::upper_bound(stations.begin(), stations.end(), along,
                                  [](double value, const Station& s) { return value < s.along; });
  while (station != stations.begin() && (station == stations.end() || station->heading == Vec3(0.0))) --station;
  return {along + glm::dot(point - centre, station->heading), point.z};
}

void PanelPainter::body_outline(const std::string& prefix, const Map& map, bool is_plan, const Mark& mark) {
  const double radius = c_.report.settings.radius;
  if (radius * map.frame.scale_x < least_outline) return;
  Polyline line = is_plan ? capsule(radius, 2.0 * radius) : capsule(radius, mark.height);
  const Point centre = is_plan ? c_.frames.turn.plan(mark.centre) : Point(mark.along, mark.centre.z);
  for (Point& p : line) p = map(p + centre);
  labels_.avoid({line}, 1.0);
  if (is_plan) {
    sheet_.items.emplace_back(Disc{.what = prefix + "body",
                                   .centre = map(centre),
                                   .radius = radius * map.frame.scale_x,
                                   .width = 1.6,
                                   .stroke = body_ink,
                                   .fill = body_fill,
                                   .clip = map.panel()});
    return;
  }
  sheet_.items.emplace_back(Lines{.what = prefix + "body",
                                  .lines = {std::move(line)},
                                  .width = 1.6,
                                  .stroke = body_ink,
                                  .fill = body_fill,
                                  .closed = true,
                                  .clip = map.panel()});
}

void PanelPainter::mark(const std::string& prefix, const Map& map, bool is_plan, const Mark& mark) {
  const Point p = map(at(mark, is_plan));
  const Colour colour = mark_colour(mark.kind);
  const std::string what = prefix + mark.name;
  const auto lines = [&](std::vector<Polyline> drawn, double width) {
    sheet_.items.emplace_back(Lines{
        .what = what, .lines = std::move(drawn), .width = width, .stroke = colour, .clip = map.panel().grown(12.0)});
  };
  double covers = 12.0;
  switch (mark.kind) {
    case MarkKind::start:
    case MarkKind::end:
      sheet_.items.emplace_back(
          Disc{.what = what, .centre = p, .radius = 7.5, .width = 2.5, .stroke = paper, .fill = colour});
      if (mark.kind == MarkKind::end) {
        sheet_.items.emplace_back(Disc{.what = what + " eye", .centre = p, .radius = 2.6, .fill = paper});
      }
      break;
    case MarkKind::narrowest: {
      const Narrowest& n = *c_.survey.narrowest;
      if (is_plan && n.width * map.frame.scale_x > 14.0) {
        const Point a = map(c_.frames.turn.plan(n.left)), b = map(c_.frames.turn.plan(n.right));
        const Point along = (b - a) / glm::distance(a, b), across(-along.y, along.x);
        labels_.avoid({{a, b}}, 6.0);
        lines({{a, b}, {a - 9.0 * across, a + 9.0 * across}, {b - 9.0 * across, b + 9.0 * across}}, 2.6);
        break;
      }
      [[fallthrough]];
    }
    case MarkKind::nearest:
      sheet_.items.emplace_back(Lines{.what = what,
                                      .lines = {{p + Point(0, -9), p + Point(9, 0), p + Point(0, 9), p + Point(-9, 0)}},
                                      .width = 2.0,
                                      .stroke = paper,
                                      .fill = colour,
                                      .closed = true});
      break;
    case MarkKind::blocked:
      lines({{p + Point(-10, -10), p + Point(10, 10)}, {p + Point(-10, 10), p + Point(10, -10)}}, 4.5);
      covers = 15.0;
      break;
    case MarkKind::fell:
      lines({{p + Point(0, -16), p + Point(0, 14)}, {p + Point(-9, 4), p + Point(0, 15), p + Point(9, 4)}}, 4.0);
      covers = 18.0;
      break;
  }
  labels_.block(Rect::around(p, 2.0 * covers, 2.0 * covers));
}

void PanelPainter::plan(const std::string& prefix, const Map& map, const PlanCut& cut) {
  segments(prefix + "below", map, cut.below, 1.4, below_ink);
  segments(prefix + "walls", map, cut.walls, 2.0, wall_ink);
  const auto visible = [&](const Mark& m) { return map.frame.view.contains(at(m, true)); };
  for (const Mark& m : c_.marks) {
    if (visible(m)) body_outline(prefix, map, true, m);
  }
  way(prefix, map, [&](const Station& s) { return c_.frames.turn.plan(s.centre); });
  touches(prefix, map, true);
  for (const Mark& m : c_.marks) {
    if (visible(m)) mark(prefix, map, true, m);
  }
}

void PanelPainter::section(const std::string& prefix, const Map& map) {
  segments(prefix + "walls", map, c_.cuts.section, 2.0, wall_ink);
  // The space of the body: between the heights of its head and its feet.
  std::vector<Polyline> band;
  const auto& stations = c_.survey.stations;
  const Rect seen = map.frame.view.grown(2.0 * c_.report.settings.radius);
  Polyline top, bottom;
  const auto close = [&] {
    if (top.size() > 1) {
      Polyline area = simplified(top, 0.2);
      const Polyline feet = simplified(bottom, 0.2);
      area.insert(area.end(), feet.rbegin(), feet.rend());
      band.push_back(std::move(area));
    }
    top.clear();
    bottom.clear();
  };
  const auto visible_at = [&](const Station& s) { return s.along >= seen.lower.x && s.along <= seen.upper.x; };
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    const Station &from = stations[i], &to = stations[i + 1];
    if (to.jump || !visible_at(from) || !visible_at(to)) {
      close();
      continue;
    }
    // A body keeps its height between stations. After crouching, the next piece begins with another height.
    for (const Station* s : {&from, &to}) {
      top.push_back(map({s->along, s->centre.z + 0.5 * from.height}));
      bottom.push_back(map({s->along, s->centre.z - 0.5 * from.height}));
    }
  }
  close();
  if (!band.empty()) {
    sheet_.items.emplace_back(Lines{
        .what = prefix + "band", .lines = std::move(band), .fill = body_fill, .closed = true, .clip = map.panel()});
  }
  const auto visible = [&](const Mark& m) { return map.frame.view.contains({m.along, m.centre.z}); };
  for (const Mark& m : c_.marks) {
    if (visible(m)) body_outline(prefix, map, false, m);
  }
  way(prefix, map, [](const Station& s) { return Point(s.along, s.centre.z); });
  touches(prefix, map, false);
  for (const Mark& m : c_.marks) {
    if (visible(m)) mark(prefix, map, false, m);
  }
}

void PanelPainter::label_marks(const std::string& prefix, const Map& map, bool is_plan,
                               const std::function<std::vector<std::string>(std::size_t)>& text) {
  for (std::size_t i = 0; i < c_.marks.size(); ++i) {
    const Mark& m = c_.marks[i];
    const auto lines = text(i);
    if (lines.empty() || !map.frame.view.contains(at(m, is_plan))) continue;
    labels_.place({prefix + m.name + " label", lines, label_size, mark_colour(m.kind)}, map(at(m, is_plan)),
                  map.panel().grown(-4.0));
  }
}

}  // namespace roam::draw
