#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "training/places/inside.h"

namespace roam::training {

namespace {

constexpr int rays = 48;
/// Least z of a ray that counts as upwards: within 60 degrees of straight up.
constexpr double upwards = 0.5;
/// m: the longest ray.
constexpr double longest_ray = 1e5;

/// Directions spread evenly over the sphere: a Fibonacci lattice (Gonzalez, "Measurement of areas on a sphere using
/// Fibonacci and latitude-longitude lattices", 2010).
std::array<Vec3, rays> directions() {
  std::array<Vec3, rays> all;
  const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < rays; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / rays, level = std::sqrt(1.0 - z * z);
    all[static_cast<std::size_t>(i)] = {level * std::cos(turn * i), level * std::sin(turn * i), z};
  }
  return all;
}

}  // namespace

Vec3 eye_over(const ways::Measure& measure, const ways::Node& node) {
  if (measure.mode != Mode::walk) return node.place;
  const double up = measure.height > 0.0 ? 0.5 * (measure.step + measure.height) : double(node.clearance);
  return node.place + Vec3(0.0, 0.0, up);
}

Surroundings look_around(const Survey& survey, const Vec3& eye) {
  static const std::array<Vec3, rays> all = directions();
  const double length = std::clamp(glm::length(survey.world().bounds().size()), 1.0, longest_ray);
  int hits = 0, backs = 0, up = 0, misses = 0;
  for (const Vec3& direction : all) {
    const FirstImpact hit = survey.world().first_impact({0.0, 0.0}, eye, length * direction);
    if (direction.z > upwards) {
      ++up;
      if (!hit.hit) ++misses;
    }
    if (!hit.hit) continue;
    ++hits;
    const Triangle t = survey.triangle(hit.triangle);
    if (glm::dot(glm::cross(t[1] - t[0], t[2] - t[0]), direction) > 0.0) ++backs;
  }
  return {.backs = 2 * backs > hits, .open = 2 * misses > up};
}

}  // namespace roam::training
