#include "motion/planes.h"

#include <glm/geometric.hpp>

namespace roam::walking {
namespace {

/// Sine. Two planes whose normals differ by a smaller angle have no usable common line.
constexpr double same_plane_sine = 1e-6;

bool leads_into_none(const Vec3& v, const PlaneSet& planes, double tolerance) {
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (glm::dot(planes[i], v) < -tolerance) return false;
  }
  return true;
}

}  // namespace

Vec3 along_planes(const Vec3& wish, const PlaneSet& planes) {
  const double tolerance = parallel_tolerance * glm::length(wish);
  if (leads_into_none(wish, planes, tolerance)) return wish;
  // Among projections onto subspaces the longest is the nearest to the wish.
  Vec3 best(0.0);
  double best_length = 0.0;
  const auto consider = [&](const Vec3& v) {
    const double length = glm::dot(v, v);
    if (length > best_length && leads_into_none(v, planes, tolerance)) {
      best = v;
      best_length = length;
    }
  };
  for (std::size_t i = 0; i < planes.size(); ++i) consider(wish - planes[i] * glm::dot(planes[i], wish));
  if (best_length > 0.0) return best;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      const Vec3 line = glm::cross(planes[i], planes[j]);
      const double squared = glm::dot(line, line);
      if (squared > same_plane_sine * same_plane_sine) consider(line * (glm::dot(line, wish) / squared));
    }
  }
  return best;
}

}  // namespace roam::walking
