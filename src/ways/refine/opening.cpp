#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "ways/lattice/walk_place.h"
#include "ways/refine/refine.h"

namespace roam::ways {
namespace {

/// Metres: surfaces this near to the body that just fits are its sides.
constexpr double side_reach = 2e-3;
constexpr std::size_t sides_looked_at = 64;
/// Surfaces whose normals differ by less than 60 degrees are one side.
constexpr double one_side_cosine = 0.5;
/// A surface is on the side of an opening to which it faces by more than this part of its normal's length.
constexpr double between_cosine = 0.3;
/// If the direction between the sides is steeper than this, the height is the limit.
constexpr double lintel_cosine = 0.7;

/// Two of several surfaces.
struct Pair {
  std::size_t one = 0, other = 0;
  double facing = 2.0;  ///< scalar product of the normals
};

/// The two sides that face each other most. Among equals the nearest: contacts come in that order.
Pair most_facing(const std::vector<Contact>& sides) {
  constexpr double rounding = 1e-6;
  Pair most;
  const std::size_t count = std::min(sides.size(), sides_looked_at);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = i; k < count; ++k) {
      const double facing = glm::dot(sides[i].normal, sides[k].normal);
      if (facing < most.facing - rounding) most = {i, k, facing};
    }
  }
  return most;
}

}  // namespace

Opening opening_at(const Survey& survey, const Measure& measure, const Vec3& place, double radius) {
  Stand stand{radius, 0.0};
  if (measure.mode == Mode::walk)
    stand = stand_at(survey, measure, place, radius, 0.99 * radius).value_or(Stand{radius, 0.0});
  const Vec3 centre = centre_of(measure, place, stand);
  Opening opening;
  opening.width = 2.0 * radius;
  opening.point = centre;
  opening.kind = measure.mode == Mode::fly ? Opening::Kind::gap : Opening::Kind::door;
  const double reach = side_reach + survey.world().largest_error();
  std::vector<Contact> sides = surfaces_at(survey, measure, place, radius, stand, reach);
  Pair pair = most_facing(sides);
  if (pair.facing > one_side_cosine) {
    std::vector<Contact> lower = sides_of(survey, measure, place, radius, stand, reach);
    const Pair lower_pair = most_facing(lower);
    if (lower_pair.facing < pair.facing) {
      sides = std::move(lower);
      pair = lower_pair;
    }
  }
  if (sides.empty()) return opening;
  const std::size_t one = pair.one, other = pair.facing > one_side_cosine ? one : pair.other;
  // The sides as seen from the axis, because a contact may lie anywhere along it. A single side, as at the end of a way
  // beside a wall, faces nothing.
  const Vec3 to_one = -sides[one].normal, to_other = one == other ? Vec3(0.0) : -sides[other].normal;
  const Vec3 chord = to_other - to_one;
  const Vec3 middle = centre + 0.5 * radius * (to_one + to_other);
  opening.point = Vec3(middle.x, middle.y, 0.5 * (sides[one].point.z + sides[other].point.z));
  opening.direction = chord / glm::length(chord);
  if (measure.mode == Mode::walk && std::abs(opening.direction.z) >= lintel_cosine)
    opening.kind = Opening::Kind::lintel;
  return opening;
}

bool is_between(const Survey& survey, const Measure& measure, const Vec3& place, const Opening& opening, double reach) {
  const double radius = 0.5 * opening.width;
  Stand stand{radius, 0.0};
  if (measure.mode == Mode::walk) stand = stand_at(survey, measure, place, radius, 0.9 * radius).value_or(stand);
  // The floor is the lower side of a lintel.
  bool ahead = opening.kind == Opening::Kind::lintel && opening.direction.z < 0.0;
  bool behind = opening.kind == Opening::Kind::lintel && opening.direction.z > 0.0;
  for (const Contact& side : sides_of(survey, measure, place, radius, stand, reach)) {
    const double facing = glm::dot(side.normal, opening.direction);
    ahead = ahead || facing < -between_cosine;
    behind = behind || facing > between_cosine;
  }
  return ahead && behind;
}

}  // namespace roam::ways
