#include "ways/flight/cells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace roam::ways {
namespace {

/// Times `widest`: the cubes end this far outside a box of all triangles and both ends.
constexpr double outside_reach = 2.0;
/// m: queries from a cube's middle reach no farther.
constexpr double farthest_look = 0.5 * Space::reach_limit;

float rounded_down(double value) {
  const auto near = static_cast<float>(value);
  return near > value ? std::nextafter(near, 0.0F) : near;
}
float rounded_up(double value) {
  const auto near = static_cast<float>(value);
  return near < value ? std::nextafter(near, std::numeric_limits<float>::infinity()) : near;
}

}  // namespace

FlyCells::FlyCells(const Survey& survey, const Measure& measure, double spacing, const Vec3& from, const Vec3& to)
    : survey_(survey), measure_(measure), within_(survey.world().bounds()) {
  // A way outside the box of all triangles and both ends gains nothing over one along the box's sides.
  within_.include(from);
  within_.include(to);
  within_ = within_.grown(outside_reach * measure.widest);
  const Vec3 size = within_.size();
  const double most = std::max({size.x, size.y, size.z});
  double side = spacing;
  while (side < most) side *= 2.0;
  unit_ = side / static_cast<double>(std::int32_t{1} << deepest);
  lower_ = 0.5 * (within_.lower + within_.upper) - Vec3(0.5 * side);
  cells_.push_back(measured(0, 0, 0, 0));
}

Vec3 FlyCells::middle(const Cell& cell) const {
  const double half = 0.5 * static_cast<double>(std::int32_t{1} << (deepest - cell.depth));
  return lower_ + unit_ * Vec3(cell.x + half, cell.y + half, cell.z + half);
}
Vec3 FlyCells::centre(CellId id) const { return middle(cells_[id]); }
double FlyCells::half_diagonal(CellId id) const { return 0.5 * std::sqrt(3.0) * side(id); }

/// The distance from a point to the cube's farthest corner.
double FlyCells::farthest(const Cell& cell, const Vec3& from) const {
  const double half = 0.5 * unit_ * static_cast<double>(std::int32_t{1} << (deepest - cell.depth));
  return glm::length(glm::abs(middle(cell) - from) + Vec3(half));
}

FlyCells::Cell FlyCells::measured(std::int32_t x, std::int32_t y, std::int32_t z, int depth) const {
  Cell cell;
  cell.x = x;
  cell.y = y;
  cell.z = z;
  cell.depth = static_cast<std::uint8_t>(depth);
  const double side = unit_ * static_cast<double>(std::int32_t{1} << (deepest - depth));
  const Vec3 place = middle(cell);
  const Vec3 beyond = glm::max(within_.lower - place, place - within_.upper);
  if (std::max({beyond.x, beyond.y, beyond.z}) > 0.5 * side) return cell;  // outside the searched air
  const double reach = std::min(measure_.widest + std::sqrt(3.0) * side, farthest_look);
  const Clearance near = survey_.world().clearance({0.0, 0.0}, place, reach);
  cell.free = rounded_down(std::max(0.0, near.distance));
  cell.most = near.found ? rounded_up(farthest(cell, near.point) + survey_.world().largest_error())
                         : std::numeric_limits<float>::infinity();
  return cell;
}

CellId FlyCells::part_at(CellId id, std::int32_t x, std::int32_t y, std::int32_t z) const {
  const std::int32_t half = size_of(id) / 2;
  const Cell& cell = cells_[id];
  return cell.parts + static_cast<CellId>((x >= cell.x + half ? 1 : 0) + (y >= cell.y + half ? 2 : 0) +
                                          (z >= cell.z + half ? 4 : 0));
}

CellId FlyCells::at(const Vec3& place) const {
  const Vec3 steps = (place - lower_) / unit_;
  const auto whole = static_cast<double>(std::int32_t{1} << deepest);
  for (int k = 0; k < 3; ++k)
    if (!(steps[k] >= 0.0 && steps[k] < whole)) return no_cell;
  const auto x = static_cast<std::int32_t>(steps.x), y = static_cast<std::int32_t>(steps.y),
             z = static_cast<std::int32_t>(steps.z);
  CellId id = 0;
  while (is_split(id)) id = part_at(id, x, y, z);
  return id;
}

void FlyCells::split(CellId id) {
  const Cell whole = cells_[id];
  const std::int32_t half = size_of(id) / 2;
  cells_[id].parts = static_cast<CellId>(cells_.size());
  for (int part = 0; part < 8; ++part) {
    cells_.push_back(measured(whole.x + (part & 1 ? half : 0), whole.y + (part & 2 ? half : 0),
                              whole.z + (part & 4 ? half : 0), whole.depth + 1));
    cells_.back().most = std::min(cells_.back().most, whole.most);
  }
}

void FlyCells::tighten(CellId id) {
  Cell& cell = cells_[id];
  if (cell.tight) return;
  cell.tight = true;
  const World& world = survey_.world();
  const Vec3 place = middle(cell);
  const double reach = std::min(measure_.widest + side(id), farthest_look);
  std::array<Vec3, 4> points;
  std::size_t count = 0;
  const auto look = [&](const Vec3& from) {
    const Clearance near = world.clearance({0.0, 0.0}, from, reach);
    if (near.found) points[count++] = near.point;
    return near.found;
  };
  if (!look(place)) return;
  const Vec3 off = place - points[0];
  const double length = glm::length(off);
  if (!(length > 0.0)) return;
  // Adds the nearest surface on the opposite side, and the surfaces nearest to the middle between the two.
  const Impact across = world.ray(place, (2.0 * reach / length) * off);
  if (across.hit) {
    points[count++] = across.point;
    const Vec3 between = 0.5 * (points[0] + points[1]);
    constexpr double beyond = 0.25;
    if (look(between)) look(between + beyond * (points[1] - between));
  }
  // The nearer of two points is at most as far away as the root mean square of both distances.
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = a + 1; b < count; ++b) {
      const Vec3 between = 0.5 * (points[a] + points[b]);
      const double apart = 0.5 * glm::distance(points[a], points[b]);
      const double most = std::hypot(apart, farthest(cell, between)) + world.largest_error();
      cell.most = std::min(cell.most, rounded_up(most));
    }
  }
}

void FlyCells::on_face(CellId id, int axis, bool upper, const Cell& of, const std::function<bool(CellId)>& is_fine,
                       const std::function<void(CellId)>& found) {
  if (!is_split(id) && is_fine(id)) {
    found(id);
    return;
  }
  if (!is_split(id)) split(id);
  const std::int32_t size = std::int32_t{1} << (deepest - of.depth);
  const std::int32_t half = size_of(id) / 2;
  const CellId parts = cells_[id].parts;
  for (int part = 0; part < 8; ++part) {
    // The upper face of the given cube touches lower parts, and the lower face upper parts.
    if (((part >> axis) & 1) == (upper ? 1 : 0)) continue;
    const Cell& p = cells_[parts + static_cast<CellId>(part)];
    const auto overlaps = [&](std::int32_t a, std::int32_t b) { return a < b + size && b < a + half; };
    const bool shares =
        (axis == 0 || overlaps(p.x, of.x)) && (axis == 1 || overlaps(p.y, of.y)) && (axis == 2 || overlaps(p.z, of.z));
    if (shares) on_face(parts + static_cast<CellId>(part), axis, upper, of, is_fine, found);
  }
}

void FlyCells::beside(CellId id, const std::function<bool(CellId)>& is_fine, const std::function<void(CellId)>& found) {
  const Cell of = cells_[id];
  const std::int32_t size = size_of(id);
  const std::int32_t whole = std::int32_t{1} << deepest;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      std::array<std::int32_t, 3> at{of.x, of.y, of.z};
      std::int32_t& along = at[static_cast<std::size_t>(axis)];
      along += upper ? size : -size;
      if (along < 0 || along >= whole) continue;
      // The smallest cube there that is at least as large as the given one.
      CellId there = 0;
      while (is_split(there) && size_of(there) > size) there = part_at(there, at[0], at[1], at[2]);
      on_face(there, axis, upper, of, is_fine, found);
    }
  }
}

Vec3 FlyCells::portal(CellId a, CellId b) const {
  const Cell &one = cells_[a], &other = cells_[b];
  const std::array<std::int32_t, 3> one_at{one.x, one.y, one.z}, other_at{other.x, other.y, other.z};
  Vec3 place(0.0);
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const std::int32_t lower = std::max(one_at[i], other_at[i]);
    const std::int32_t upper = std::min(one_at[i] + size_of(a), other_at[i] + size_of(b));
    place[k] = lower_[k] + unit_ * 0.5 * (static_cast<double>(lower) + static_cast<double>(upper));
  }
  return place;
}

}  // namespace roam::ways
