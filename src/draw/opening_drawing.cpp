#include "draw/opening_drawing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "cli/progress.h"

namespace roam::draw {
namespace {

// Pixels.
constexpr double opening_most_height = 760.0;
constexpr double opening_least_height = 360.0;

/// Metres. A surface above a plan is cut this far above its lower side. Walls are shown this far beyond an opening's
/// depth.
constexpr double over = 0.01;
constexpr double face_beyond = 0.02;
constexpr std::size_t most_areas = 40'000;  ///< of floor in one plan, or of faces in one section
constexpr double least_level = 0.6;         ///< of a normal's z, for floor
/// If the level part of a direction is shorter than this, the direction counts as upright, and the level part as
/// unknown.
constexpr double upright = 0.3;

Turn turn_of(const OpeningView& o, bool is_level) {
  const Vec3& way = is_level ? o.direction : o.heading_to;
  glm::dvec2 across(way.x, way.y);
  across = glm::length(across) > 0.0 ? glm::normalize(across) : glm::dvec2(1.0, 0.0);
  // The scene's y points to the upper half of the sheet.
  if (across.x < 0.0) across = -across;
  return {{o.point.x, o.point.y, 0.0}, across.x, across.y};
}

Frame section_frame(const OpeningView& o, bool is_level, double width) {
  const bool crack = o.kind == OpeningView::Kind::crack;
  const double upright_half = 0.5 * o.width * std::abs(o.direction.z);
  const double margin = o.mode == Mode::fly ? 1.5 * o.radius : 0.2 * o.height;
  const double low =
      std::min(o.floor, o.point.z - upright_half) - (crack ? std::clamp(o.width, margin, 0.8 * o.height) : margin);
  const double high = std::max(o.floor + o.height, o.point.z + upright_half) + margin;
  const double level_width = is_level ? o.width : 0.0;
  const double wide = std::max({(crack ? 3.0 : 4.0) * level_width, 8.0 * o.radius, 3.0 * o.support_radius});
  return Frame::fitted({{-0.5 * wide, low}, {0.5 * wide, high}}, width, opening_least_height, opening_most_height);
}

/// Adds `make(triangle)` for each triangle where that is not empty. Clears `areas` if they are too many for a drawing.
template <class Make>
void add_areas(std::span<const Mesh> meshes, const Make& make, std::vector<Polyline>& areas) {
  for (const Mesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Polyline area = make(mesh.triangle(i));
      if (area.empty()) continue;
      areas.push_back(std::move(area));
      if (areas.size() > most_areas) return areas.clear();
    }
  }
}

/// The polygon if it can be seen, turned counterclockwise. Otherwise the areas of faces on each other's back would
/// cancel.
Polyline area_of(Polyline polygon, const Rect& view) {
  Rect box;
  double turns = 0.0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Point &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    turns += a.x * b.y - b.x * a.y;
    box.include(a);
  }
  if (turns == 0.0 || !box.overlaps(view)) return {};
  if (turns < 0.0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

Polyline floor_area(const Triangle& t, const OpeningView& o, const OpeningDrawing& d) {
  const auto [lowest, highest] = std::minmax({t[0].z, t[1].z, t[2].z});
  if (lowest > o.floor + o.step || highest < o.floor - o.step) return {};
  const Vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  if (!(std::abs(normal.z) >= least_level * glm::length(normal))) return {};
  return area_of({d.turn.plan(t[0]), d.turn.plan(t[1]), d.turn.plan(t[2])}, d.plan.view);
}

Polyline face_area(const Triangle& t, const OpeningView& o, const OpeningDrawing& d) {
  const double half = 0.5 * o.depth + face_beyond;
  std::vector<Vec3> part{d.turn(t[0]), d.turn(t[1]), d.turn(t[2])};
  const auto [nearest, farthest] = std::minmax({part[0].y, part[1].y, part[2].y});
  if (nearest > half || farthest < -half) return {};
  keep_side(part, 1, half, 1.0);
  keep_side(part, 1, -half, -1.0);
  Polyline polygon;
  for (const Vec3& corner : part) polygon.emplace_back(corner.x, corner.z);
  return area_of(std::move(polygon), d.section.view);
}

}  // namespace

Cuts cut_out(const std::string& what, std::span<const Mesh> meshes, const Turn& turn, std::span<const PlanView> views,
             std::span<const Stretch> section) {
  std::uint64_t all = 0;
  for (const Mesh& mesh : meshes) all += mesh.triangles.size();
  app::Progress progress("drawing " + what, "triangles");
  return cut(meshes, turn, views, section, [&](std::uint64_t done) { progress.at(done, all); });
}

OpeningDrawing drawing_of(const OpeningView& o, std::span<const Mesh> meshes, double width) {
  OpeningDrawing d;
  const double level = std::hypot(o.direction.x, o.direction.y);
  d.is_level = level > upright;
  d.turn = turn_of(o, d.is_level);
  if (o.body) d.body = d.turn.plan(*o.body);
  d.section = section_frame(o, d.is_level, width);
  const Rect& shown = d.section.view;
  d.plan = {Rect::around({0.0, 0.0}, shown.width(), shown.height()), d.section.scale_x, d.section.scale_y};
  const bool points_right = o.direction.x * d.turn.cosine + o.direction.y * d.turn.sine >= 0.0;
  d.half_width =
      0.5 * o.width *
      (d.is_level ? Point(level, points_right ? o.direction.z : -o.direction.z) : Point(0.0, std::abs(o.direction.z)));

  const bool crack = o.kind == OpeningView::Kind::crack, flies = o.mode == Mode::fly;
  const double knee = o.floor + o.step + 0.02 * o.height;
  // At the middle of the body if no level width was measured.
  const bool no_height = o.kind == OpeningView::Kind::apart || o.kind == OpeningView::Kind::step;
  d.cut = crack ? knee : no_height ? o.floor + 0.5 * o.height : o.point.z;
  // For a crack its own walls; else the lower obstacles that still are walls.
  const double below = crack ? o.floor - 0.05 * o.height : knee;
  PlanView plan{LevelMap(d.plan.view, 0), {d.cut}, {}, flies ? 1.0 : usual_ground};
  if (!flies && below < d.cut) plan.below.push_back(d.cut - below);
  std::vector<PlanView> views{plan};
  if (!d.is_level && o.kind == OpeningView::Kind::passage) {
    views.push_back({LevelMap(d.plan.view, 0), {o.point.z + d.half_width.y + over}, {}, 1.0});
  }
  const Stretch across{{shown.lower.x, 0.0}, {shown.upper.x, 0.0}, shown.lower.x, shown.lower.y, shown.upper.y};
  Cuts cuts = cut_out(o.heading, meshes, d.turn, views, {&across, 1});
  d.plan_cut = std::move(cuts.plans[0]);
  if (views.size() > 1) d.above = std::move(cuts.plans[1].walls);
  d.section_cut = std::move(cuts.sections[0]);
  if (!flies)
    add_areas(
        meshes, [&](const Triangle& t) { return floor_area(t, o, d); }, d.floor);
  if (d.is_level && o.depth > 0.0) {
    add_areas(
        meshes, [&](const Triangle& t) { return face_area(t, o, d); }, d.faces);
  }
  return d;
}

}  // namespace roam::draw
