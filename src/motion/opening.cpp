#include "motion/opening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace roam::motion {
namespace {

constexpr std::size_t contacts_looked_at = 48;

/// The ray between two points of contact passes through an opening as deep as this part of the radius: a door in a
/// wall, not a groove.
constexpr double depth_part = 0.5;

/// A contact is ahead when its normal leans against the way by more than this (cosine): not the wall walked along.
constexpr double against_the_way = 0.05;

/// The opening between two contacts across the way, measured along `across`.
std::optional<double> between(const World& world, const Body& body, const Contact& a, const Contact& b,
                              const Vec3& place, const Vec3& ahead, const Vec3& across) {
  const double side_a = glm::dot(a.point - place, across), side_b = glm::dot(b.point - place, across);
  if (!(side_a * side_b < 0.0)) return std::nullopt;
  // Points of contact anywhere along a post or a lintel: only what lies across the way and across the post counts.
  const Vec3 apart = b.point - a.point;
  const Vec3 along = glm::cross(ahead, across);
  const Vec3 width = apart - along * glm::dot(apart, along);
  const double depth = depth_part * body.radius;
  const Vec3 middle = 0.5 * (a.point + b.point);
  if (world.ray(middle - ahead * depth, ahead * (2.0 * depth)).hit) return std::nullopt;
  return glm::length(width);
}

}  // namespace

std::optional<double> measure_opening(const World& world, const Body& body, const Vec3& place, const Vec3& ahead,
                                      double reach) {
  std::array<Contact, contacts_looked_at> contacts;
  const std::size_t found = world.contacts(body, place, Vec3(0.0), reach, contacts);
  const Vec3 flat(ahead.x, ahead.y, 0.0);
  const double length = glm::length(flat);
  if (!(length > 0.0)) return std::nullopt;
  const Vec3 sideways = Vec3(-flat.y, flat.x, 0.0) / length;
  std::optional<double> least;
  for (const Vec3& across : {sideways, glm::cross(ahead, sideways)}) {
    for (std::size_t i = 0; i < found; ++i) {
      for (std::size_t j = i + 1; j < found; ++j) {
        const Contact &a = contacts[i], &b = contacts[j];
        if (std::min(glm::dot(a.normal, ahead), glm::dot(b.normal, ahead)) > -against_the_way) continue;
        const std::optional<double> width = between(world, body, a, b, place, ahead, across);
        if (width && (!least || *width < *least)) least = width;
      }
    }
  }
  return least;
}

}  // namespace roam::motion
