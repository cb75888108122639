#include "draw/overview.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "draw/cut.h"
#include "draw/levels.h"
#include "draw/opening_drawing.h"

namespace roam::draw {
namespace {

// Pixels.
constexpr double overview_most_height = 760.0;
constexpr double overview_least_height = 240.0;
constexpr double dot = 8.0;         ///< least radius of an end
constexpr double least_cell = 5.0;  ///< of the reached places

/// Metres around the contents, and parts of their size.
constexpr double margin = 1.5;
constexpr double margin_part = 0.08;

/// The heights of the body's centre for the plan's levels.
std::vector<Station> stations_of(const Overview& o) {
  std::vector<Station> stations;
  const double up = o.mode == Mode::walk ? 0.5 * o.height : 0.0;
  const auto add = [&](const std::vector<Vec3>& places, bool jumps) {
    for (const Vec3& place : places) {
      Station s;
      s.centre = place + Vec3(0.0, 0.0, up);
      s.height = o.height;
      s.jump = jumps || stations.empty();
      if (!s.jump) {
        const Vec3 run = s.centre - stations.back().centre;
        s.along = stations.back().along + std::hypot(run.x, run.y);
      }
      stations.push_back(s);
    }
  };
  add(o.way, false);
  if (o.way.empty()) {
    add({o.start, o.target}, true);
    add(o.from_start, true);
    add(o.from_target, true);
  }
  return stations;
}

Rect shown(const Overview& o, const Turn& turn) {
  Rect box;
  for (const Vec3& place : o.way) box.include(turn.plan(place));
  for (const Vec3& place : {o.start, o.target}) box.include(turn.plan(place));
  for (const Overview::Mark& mark : o.marks) box.include(turn.plan(mark.place));
  return box.grown(std::max(margin, 3.0 * o.radius) + margin_part * std::max(box.width(), box.height()));
}

/// The cells that hold one of the places, each once. `share`: of a cell's side that is drawn.
std::vector<Polyline> cells_of(const std::vector<Vec3>& places, const Turn& turn, const Panel& panel, double spacing,
                               double share) {
  const double side = std::max(spacing, least_cell / panel.scale());
  std::set<std::pair<long, long>> cells;
  // Counted from one of the places, to match the lattice.
  const Point origin = places.empty() ? Point(0.0) : turn.plan(places.front());
  for (const Vec3& place : places) {
    const Point p = turn.plan(place), cell = (p - origin) / side;
    if (panel.shows(p)) cells.emplace(std::lround(cell.x), std::lround(cell.y));
  }
  std::vector<Polyline> areas;
  for (const auto& [x, y] : cells) {
    areas.push_back(Rect::around(origin + side * Point(x, y), share * side, share * side).outline());
  }
  return areas;
}

void paint(Panel& panel, const Overview& o, const Turn& turn, const PlanCut& cut) {
  panel.areas("reached from the start", cells_of(o.from_start, turn, panel, o.spacing, 1.0), from_start_style);
  panel.areas("reached from the target", cells_of(o.from_target, turn, panel, o.spacing, 0.6), from_target_style);
  panel.segments("below", cut.below, below_style);
  panel.segments("walls", cut.walls, wall_style);
  panel.border();
  Polyline way;
  for (const Vec3& place : o.way) way.push_back(turn.plan(place));
  if (way.size() > 1) panel.lines("way", {std::move(way)}, way_style);

  /// A circle of at least `least` pixels, with a label.
  struct Circle {
    std::string what, text;
    Vec3 place;
    double radius, least;
    Style style;
  };
  std::vector<Circle> circles;
  for (const Overview::Mark& mark : o.marks) {
    circles.push_back({"mark", mark.text, mark.place, 1.3 * o.radius, 2.0 * dot, {3.0, mark.good ? blue : red}});
  }
  circles.push_back({"start", "A", o.start, o.radius, dot, {2.5, green, green.at(0.55)}});
  circles.push_back({"target", "B", o.target, o.radius, dot, {2.5, orange, orange.at(0.55)}});
  for (Circle& c : circles) {
    c.radius = std::max(c.radius, c.least / panel.scale());
    const double size = 2.0 * c.radius * panel.scale();
    panel.disc(c.what, turn.plan(c.place), c.radius, c.style);
    panel.block(turn.plan(c.place), size, size);
  }
  for (const Circle& c : circles) {
    panel.label("label", turn.plan(c.place) + Point(0.0, c.radius), {c.text}, c.style.stroke);
  }
}

}  // namespace

void add_overview(Page& page, const Overview& o, std::span<const Mesh> meshes) {
  const Vec3 middle = 0.5 * o.start + 0.5 * o.target;
  Turn turn{{middle.x, middle.y, 0.0}, 1.0, 0.0};
  Rect view = shown(o, turn);
  if (view.height() > 1.5 * view.width()) {
    turn = {turn.origin, 0.0, 1.0};  // y points to the left
    view = shown(o, turn);
  }
  const Frame frame = Frame::fitted(view, content_width, overview_least_height, overview_most_height);
  const std::vector<Station> stations = stations_of(o);
  const Levels levels = find_levels(stations, o.height);
  const double below = 0.5 * o.height - o.step - 0.02 * o.height;
  const PlanView plan{LevelMap(frame.view, levels, stations, turn, o.height), levels.cuts,
                      o.mode == Mode::walk && below > 0.0 ? std::vector{below} : std::vector<double>{},
                      o.mode == Mode::walk ? usual_ground : 1.0};
  const Cuts cuts = cut_out("the plan", meshes, turn, {&plan, 1}, {});
  page.heading("overview", {"Plan", cut_text(levels), frame.scale_x, &turn});
  Panel panel = page.panel("overview", frame, sheet_margin, &turn);
  paint(panel, o, turn, cuts.plans[0]);
  page.below(panel);
  page.legend(std::array<LegendEntry, 5>{{{"cut by the plane", wall_style, 0.0, true},
                                          {o.mode == Mode::walk ? "lower, and still a wall" : "lower", below_style},
                                          {"way", way_style},
                                          {"reached from the start", from_start_style},
                                          {"reached from the target", from_target_style}}});
}

}  // namespace roam::draw
