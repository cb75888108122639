#include "opening_layout.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace roam::app::picture {
namespace {

// Pixels.
constexpr double most_height = 760.0;
constexpr double least_height = 360.0;

constexpr std::size_t most_floor = 40'000;  ///< triangles of floor in one plan
constexpr double least_level = 0.6;         ///< of a normal's z: what is drawn as floor
/// A direction counts as upright, and its level part as unknown, below this length of that part.
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

  const bool crack = o.kind == OpeningView::Kind::crack, flies = o.mode == Mode::fly;
  const double upright_half = 0.5 * o.width * std::abs(o.direction.z);
  double low = std::min(o.floor, o.point.z - upright_half),
         high = std::max(o.floor + o.height, o.point.z + upright_half);
  const double margin = flies ? 1.5 * o.radius : 0.2 * o.height;
  low -= crack ? std::clamp(o.width, margin, 0.8 * o.height) : margin;
  high += margin;
  const double wide = std::max({(crack ? 3.0 : 4.0) * o.width, 8.0 * o.radius, 3.0 * o.support_radius});
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
  l.cut = crack ? knee : o.point.z;
  // Of a crack its own walls, else what stands lower than the cut and is still a wall.
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
      // All turn one way: where a face lies on the back of another, areas would cancel each other.
      const bool turns_back = normal.z < 0.0;
      areas.push_back(
          {map(l.turn.plan(t[0])), map(l.turn.plan(t[turns_back ? 2 : 1])), map(l.turn.plan(t[turns_back ? 1 : 2]))});
      if (areas.size() > most_floor) return {};
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

}  // namespace roam::app::picture
