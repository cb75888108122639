#include "motion/opening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace roam::walking {
namespace {

constexpr std::size_t contacts_looked_at = 48;

/// The ray between two points of contact goes on for this part of the radius behind the farther one: a door in a wall,
/// not a groove.
constexpr double depth_part = 0.5;

/// A contact is ahead when its normal leans against the way by more than this (cosine): not the wall walked along.
constexpr double against_the_way = 0.05;

/// The unit vectors of a blocked way.
struct Frame {
  Vec3 ahead, sideways, upward;
};

/// Whether a ray along the way passes between two points of contact.
bool open_between(const Space& space, const Vec3& a, const Vec3& b, const Vec3& place, double depth, const Frame& f) {
  const Vec3 middle = 0.5 * (a + b);
  const Vec3 from = middle - f.ahead * glm::dot(middle - place, f.ahead);
  const double farther = std::max(glm::dot(a - place, f.ahead), glm::dot(b - place, f.ahead));
  return !space.ray(from, f.ahead * (std::max(farther, 0.0) + depth)).hit;
}

bool on_either_side(const Vec3& a, const Vec3& b, const Vec3& place, const Vec3& across) {
  return glm::dot(a - place, across) * glm::dot(b - place, across) < 0.0;
}

}  // namespace

std::optional<double> measure_opening(const Space& space, const Body& body, const Vec3& place, const Vec3& ahead,
                                      double reach) {
  std::array<Contact, contacts_looked_at> contacts;
  const std::size_t found = space.contacts(body, place, Vec3(0.0), reach, contacts);
  const Vec3 flat(ahead.x, ahead.y, 0.0);
  const double length = glm::length(flat);
  if (!(length > 0.0)) return std::nullopt;
  const Vec3 sideways = Vec3(-flat.y, flat.x, 0.0) / length;
  const Frame frame{ahead, sideways, glm::cross(ahead, sideways)};
  std::optional<double> least;
  const auto consider = [&](const Contact& a, const Contact& b, double width) {
    if (least && width >= *least) return;
    if (open_between(space, a.point, b.point, place, depth_part * body.radius, frame)) least = width;
  };
  for (std::size_t i = 0; i < found; ++i) {
    for (std::size_t j = i + 1; j < found; ++j) {
      const Contact &a = contacts[i], &b = contacts[j];
      if (std::min(glm::dot(a.normal, ahead), glm::dot(b.normal, ahead)) > -against_the_way) continue;
      const Vec3 apart = b.point - a.point;
      // Two posts are touched anywhere along their height; they need not stand side by side.
      if (on_either_side(a.point, b.point, place, frame.sideways)) {
        consider(a, b, glm::length(apart - frame.upward * glm::dot(apart, frame.upward)));
      }
      // The floor is touched below the body, and what hangs too low ahead of it.
      if (on_either_side(a.point, b.point, place, frame.upward)) {
        consider(a, b, std::abs(glm::dot(apart, frame.upward)));
      }
    }
  }
  return least;
}

}  // namespace roam::walking
