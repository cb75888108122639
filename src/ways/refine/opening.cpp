#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "ways/lattice/walk_place.h"
#include "ways/refine/refine.h"

namespace roam::ways {
namespace {

/// Metres: surfaces this near to the body that just fits are its sides.
constexpr double side_reach = 2e-3;
constexpr std::size_t sides_looked_at = 64;
/// If the direction between the sides is steeper than this, the height is the limit.
constexpr double lintel_cosine = 0.7;

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
  std::array<Contact, sides_looked_at> sides;
  const double reach = side_reach + survey.world().largest_error();
  const std::size_t count = survey.world().contacts(body_of(measure, radius), centre, Vec3(0.0), reach, sides);
  if (count == 0) return opening;
  // The two sides that face each other most. Among equals the nearest: contacts come in that order.
  constexpr double rounding = 1e-6;
  double least = 2.0;
  std::size_t one = 0, other = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = i; k < count; ++k) {
      const double facing = glm::dot(sides[i].normal, sides[k].normal);
      if (facing >= least - rounding) continue;
      least = facing;
      one = i;
      other = k;
    }
  }
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

}  // namespace roam::ways
