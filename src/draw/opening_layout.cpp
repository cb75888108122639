#include "draw/opening_layout.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace roam::draw {
namespace {

// Pixels.
constexpr double most_height = 760.0;
constexpr double least_height = 360.0;

/// Metres. A surface above a plan is cut this far above its lower side. Walls are shown this far beyond an opening's
/// depth.
constexpr double over = 0.01;
constexpr double face_beyond = 0.02;
constexpr std::size_t most_faces = 40'000;

constexpr std::size_t most_floor = 40'000;  ///< triangles of floor in one plan
constexpr double least_level = 0.6;         ///< of a normal's z, for floor
/// If the level part of a direction is shorter than this, the direction counts as upright, and the level part as
/// unknown.
constexpr double upright = 0.3;

}  // namespace

OpeningLayout lay_out(const OpeningView& o, double panel_width) {
  OpeningLayout l;
  glm::dvec2 across(o.direction.x, o.direction.y);
  l.is_level = glm::length(across) > upright;
  if (!l.is_level) across = {o.heading_to.x, o.heading_to.y};
  across = glm::length(across) > 0.0 ? glm::normalize(across) : glm::dvec2(1.0, 0.0);
  // North in the upper half of the sheet.
  if (across.x < 0.0) across = -across;
  l.turn = {{o.point.x, o.point.y, 0.0}, across.x, across.y};

  if (o.body) l.body = l.turn.plan(*o.body);

  const bool crack = o.kind == OpeningView::Kind::crack, flies = o.mode == Mode::fly;
  const double upright_half = 0.5 * o.width * std::abs(o.direction.z);
  double low = std::min(o.floor, o.point.z - upright_half),
         high = std::max(o.floor + o.height, o.point.z + upright_half);
  const double margin = flies ? 1.5 * o.radius : 0.2 * o.height;
  low -= crack ? std::clamp(o.width, margin, 0.8 * o.height) : margin;
  high += margin;
  const double level_width = l.is_level ? o.width : 0.0;
  const double wide = std::max({(crack ? 3.0 : 4.0) * level_width, 8.0 * o.radius, 3.0 * o.support_radius});
  const double scale = std::min(panel_width / wide, most_height / (high - low));
  const double missing = least_height / scale - (high - low);
  if (missing > 0.0) {
    low -= 0.5 * missing;
    high += 0.5 * missing;
  }
  const double width = panel_width / scale, height = high - low;
  l.section = {{{-0.5 * width, low}, {0.5 * width, high}}, scale, scale};
  l.plan = {Rect::around({0.0, 0.0}, width, height), scale, scale};
  const double knee = o.floor + o.step + 0.02 * o.height;
  // At the middle of the body if no level width was measured.
  const bool no_height = o.kind == OpeningView::Kind::apart || o.kind == OpeningView::Kind::step;
  l.cut = crack ? knee : no_height ? o.floor + 0.5 * o.height : o.point.z;
  if (!l.is_level && o.kind == OpeningView::Kind::passage) l.above = o.point.z + upright_half + over;
  // For a crack its own walls; else the lower obstacles that still are walls.
  l.below = crack ? o.floor - 0.05 * o.height : flies ? l.cut : std::min(l.cut, knee);
  return l;
}

std::vector<Polyline> floor_around(std::span<const Mesh> meshes, const OpeningView& o, const OpeningLayout& l,
                                   const Map& map) {
  std::vector<Polyline> areas;
  if (o.mode == Mode::fly) return areas;
  for (const Mesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const Triangle t = mesh.triangle(i);
      const auto [lowest, highest] = std::minmax({t[0].z, t[1].z, t[2].z});
      if (lowest > o.floor + o.step || highest < o.floor - o.step) continue;
      Rect box;
      for (const Vec3& corner : t) box.include(l.turn.plan(corner));
      if (!box.overlaps(l.plan.view)) continue;
      const Vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
      if (!(std::abs(normal.z) >= least_level * glm::length(normal)) || normal.z == 0.0) continue;
      // All areas turn one way. Otherwise the areas of faces on each other's back would cancel.
      const bool turns_back = normal.z < 0.0;
      areas.push_back(
          {map(l.turn.plan(t[0])), map(l.turn.plan(t[turns_back ? 2 : 1])), map(l.turn.plan(t[turns_back ? 1 : 2]))});
      if (areas.size() > most_floor) return {};
    }
  }
  return areas;
}

namespace {

/// The part of a polygon on one side of the plane `depth` metres along the way.
void keep_side(std::vector<Vec3>& polygon, double depth, double side) {
  std::vector<Vec3> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double from = side * (depth - a.y), to = side * (depth - b.y);
    if (from >= 0.0) kept.push_back(a);
    if ((from < 0.0) != (to < 0.0)) kept.push_back(a + from / (from - to) * (b - a));
  }
  polygon = std::move(kept);
}

}  // namespace

std::vector<Polyline> faces_beside(std::span<const Mesh> meshes, const OpeningView& o, const OpeningLayout& l,
                                   const Map& map) {
  std::vector<Polyline> areas;
  if (!l.is_level || o.depth <= 0.0) return areas;
  const double half = 0.5 * o.depth + face_beyond;
  std::vector<Vec3> part;
  for (const Mesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      part.clear();
      for (const Vec3& corner : mesh.triangle(i)) part.push_back(l.turn(corner));
      const auto [nearest, farthest] = std::minmax({part[0].y, part[1].y, part[2].y});
      if (nearest > half || farthest < -half) continue;
      keep_side(part, half, 1.0);
      keep_side(part, -half, -1.0);
      Rect box;
      Polyline area;
      double turns = 0.0;
      for (std::size_t k = 0; k < part.size(); ++k) {
        const Vec3& a = part[k];
        const Vec3& b = part[(k + 1) % part.size()];
        turns += a.x * b.z - b.x * a.z;
        box.include({a.x, a.z});
        area.push_back(map({a.x, a.z}));
      }
      if (turns == 0.0 || !box.overlaps(map.frame.view)) continue;
      if (turns < 0.0) std::reverse(area.begin(), area.end());
      areas.push_back(std::move(area));
      if (areas.size() > most_faces) return {};
    }
  }
  return areas;
}

double sunk(const OpeningView& o) {
  const double half = 0.5 * o.width;
  if (o.kind != OpeningView::Kind::crack || o.support_radius > half || o.radius <= half) return 0.0;
  return o.radius - std::sqrt(o.radius * o.radius - half * half);
}

Polyline upright_capsule(double radius, double bottom, double height) {
  Polyline line;
  constexpr int parts = 24;
  for (const double side : {1.0, -1.0}) {
    const double centre = bottom + 0.5 * height + side * std::max(0.0, 0.5 * height - radius);
    for (int k = 0; k <= parts; ++k) {
      const double angle = std::numbers::pi * (static_cast<double>(k) / parts + (side > 0.0 ? 0.0 : 1.0));
      line.emplace_back(radius * std::cos(angle), centre + radius * std::sin(angle));
    }
  }
  return line;
}

}  // namespace roam::draw
