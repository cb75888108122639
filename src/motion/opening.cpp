#include "roam/opening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "math/floating_point.h"
#include "roam/walker.h"
#include "text/names.h"

namespace roam {
namespace {

constexpr std::size_t contacts_looked_at = 48;

/// In skins: a triangle this near counts as touched.
constexpr double touched_skins = 4.0;

/// The ray between two points of contact extends by this part of the radius behind the farther one, so that a groove
/// does not count as a door.
constexpr double depth_part = 0.5;

/// Cosine. A contact is ahead if its normal leans against the way by more than this; a wall beside the way does not
/// count.
constexpr double against_the_way = 0.05;

/// Cosine. A contact bounds a gap if its normal leans into the gap by more than this.
constexpr double facing = 0.05;

/// Sine. A contact is a post if its normal leans up or down by less than this; otherwise it is a floor or a ceiling.
constexpr double post = 0.7;

/// The unit vectors of a blocked way.
struct Frame {
  Vec3 ahead, sideways, upward;
};

/// Whether a ray along the way passes between two points of contact.
bool open_between(const Space& space, const Vec3& a, const Vec3& b, const Vec3& place, double depth, const Frame& f) {
  const Vec3 middle = 0.5 * (a + b);
  const Vec3 from = middle - f.ahead * glm::dot(middle - place, f.ahead);
  const double farther = std::max(glm::dot(a - place, f.ahead), glm::dot(b - place, f.ahead));
  return !space.first_impact({0.0, 0.0}, from, f.ahead * (std::max(farther, 0.0) + depth)).hit;
}

/// Whether two contacts bound a gap along `across`: they lie on either side of the body and face each other. Two
/// heights of one post may also lie on either side, but they face the same way.
bool face_each_other(const Contact& a, const Contact& b, const Vec3& place, const Vec3& across) {
  const double side_of_a = glm::dot(a.point - place, across);
  const double side_of_b = glm::dot(b.point - place, across);
  if (side_of_a * side_of_b >= 0.0) return false;
  const double towards_b = side_of_b > side_of_a ? 1.0 : -1.0;
  return towards_b * glm::dot(a.normal, across) > facing && -towards_b * glm::dot(b.normal, across) > facing;
}

}  // namespace

const Contact* most_against(const StepReport& report, const Vec3& way) {
  const DefaultFloatingPoint guard;
  const Contact* most = nullptr;
  for (const Contact& c : report.contacts) {
    if (most == nullptr || glm::dot(c.normal, way) < glm::dot(most->normal, way)) most = &c;
  }
  return most;
}

const char* to_string(Opening::Kind kind) { return name_in({"door", "lintel", "gap"}, kind); }

std::optional<Opening> measure_opening(const Walker& walker, const Vec3& ahead) {
  const DefaultFloatingPoint guard;
  const Space& space = walker.space();
  const Body body = walker.body();
  const Vec3& place = walker.position();
  std::array<Contact, contacts_looked_at> contacts;
  const std::size_t found = space.contacts(body, place, Vec3(0.0), touched_skins * walker.skin(), contacts);
  const Vec3 flat(ahead.x, ahead.y, 0.0);
  const double length = glm::length(flat);
  if (!(length > 0.0)) return std::nullopt;
  const Vec3 sideways = Vec3(-flat.y, flat.x, 0.0) / length;
  const Frame frame{ahead, sideways, glm::cross(ahead, sideways)};
  std::optional<Opening> least;
  const auto consider = [&](const Contact& a, const Contact& b, const Opening& opening) {
    if (least && opening.width >= least->width) return;
    if (open_between(space, a.point, b.point, place, depth_part * body.radius, frame)) least = opening;
  };
  for (std::size_t i = 0; i < found; ++i) {
    for (std::size_t j = i + 1; j < found; ++j) {
      const Contact &a = contacts[i], &b = contacts[j];
      if (std::min(glm::dot(a.normal, ahead), glm::dot(b.normal, ahead)) > -against_the_way) continue;
      const Vec3 apart = b.point - a.point;
      // Two posts may be touched at any height; they need not stand side by side.
      const double lean =
          std::max(std::abs(glm::dot(a.normal, frame.upward)), std::abs(glm::dot(b.normal, frame.upward)));
      if (lean < post && face_each_other(a, b, place, frame.sideways)) {
        const Vec3 level = apart - frame.upward * glm::dot(apart, frame.upward);
        const double width = glm::length(level);
        consider(a, b, {Opening::Kind::door, 0.5 * (a.point + b.point), width, level / width});
      }
      // The floor is touched below the body, and a low obstacle ahead of it. One must be above the other, to exclude
      // two posts whose contacts lean a little up and down.
      const double height = std::abs(glm::dot(apart, frame.upward));
      if (height > std::abs(glm::dot(apart, frame.sideways)) && face_each_other(a, b, place, frame.upward)) {
        consider(a, b, {Opening::Kind::lintel, 0.5 * (a.point + b.point), height, frame.upward});
      }
    }
  }
  return least;
}

}  // namespace roam
