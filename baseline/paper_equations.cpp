#include "paper_equations.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace paper {
namespace {

using glm::dot;
using roam::Vec3;

/// First root of a t^2 + b t + c = 0 in [0, 1].
std::optional<double> first_root(double a, double b, double c) {
  const double t = (-b - std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
  if (!(t >= 0.0 && t <= 1.0)) return std::nullopt;
  return t;
}

bool inside(const Vec3& p, const Vec3& p1, const Vec3& p2, const Vec3& p3, const Vec3& normal) {
  return dot(glm::cross(p2 - p1, p - p1), normal) >= 0.0 && dot(glm::cross(p3 - p2, p - p2), normal) >= 0.0 &&
         dot(glm::cross(p1 - p3, p - p3), normal) >= 0.0;
}

void keep_first(std::optional<Collision>& best, const Collision& c) {
  if (!best || c.time < best->time) best = c;
}

void try_edge(const Vec3& p0, const Vec3& v, const Vec3& p1, const Vec3& p2, std::optional<Collision>& best) {
  const Vec3 e1 = p1 - p2, ep = p1 - p0;
  const double ee = dot(e1, e1), ev = dot(e1, v), eep = dot(e1, ep);
  // |p0 + t v - p1|^2 |e1|^2 - ((p0 + t v - p1) . e1)^2 = |e1|^2
  const auto t =
      first_root(dot(v, v) * ee - ev * ev, 2.0 * (ev * eep - dot(v, ep) * ee), (dot(ep, ep) - 1.0) * ee - eep * eep);
  if (!t) return;
  const double f0 = (ev * *t - eep) / ee;  // (6)
  if (f0 >= -1.0 && f0 <= 0.0) keep_first(best, {*t, p1 + f0 * e1, roam::Feature::edge});
}

void try_vertex(const Vec3& p0, const Vec3& v, const Vec3& p1, std::optional<Collision>& best) {
  const Vec3 ep = p1 - p0;
  if (const auto t = first_root(dot(v, v), -2.0 * dot(v, ep), dot(ep, ep) - 1.0)) {
    keep_first(best, {*t, p1, roam::Feature::vertex});
  }
}

}  // namespace

bool beyond_box(double radius, const Vec3& from, const Vec3& motion, const roam::Triangle& triangle) {
  for (int k = 0; k < 3; ++k) {
    const double low = std::fmin(from[k], from[k] + motion[k]) - radius;
    const double high = std::fmax(from[k], from[k] + motion[k]) + radius;
    if (triangle[0][k] < low && triangle[1][k] < low && triangle[2][k] < low) return true;
    if (triangle[0][k] > high && triangle[1][k] > high && triangle[2][k] > high) return true;
  }
  return false;
}

std::optional<Collision> collide(double radius, const Vec3& from, const Vec3& motion, const roam::Triangle& triangle) {
  if (beyond_box(radius, from, motion, triangle)) return std::nullopt;
  // Unit-sphere space.
  const Vec3 p0 = from / radius, v = motion / radius;
  const Vec3 p1 = triangle[0] / radius, p2 = triangle[1] / radius, p3 = triangle[2] / radius;
  const Vec3 normal = glm::normalize(glm::cross(p2 - p1, p3 - p1));
  const double cp = -dot(normal, p1);
  const double d0 = dot(normal, p0) + cp;                                      // (2)
  double t0 = (1.0 - d0) / dot(normal, v), t1 = (-1.0 - d0) / dot(normal, v);  // (3), (4)
  if (!(t0 <= t1 && t0 <= 1.0 && t1 >= 0.0)) return std::nullopt;
  t0 = std::fmax(t0, 0.0);
  std::optional<Collision> best;
  const Vec3 p = p0 - normal + t0 * v;  // (5)
  if (inside(p, p1, p2, p3, normal)) {
    best = Collision{t0, p, roam::Feature::face};
  } else {
    try_edge(p0, v, p1, p2, best);
    try_edge(p0, v, p2, p3, best);
    try_edge(p0, v, p3, p1, best);
    try_vertex(p0, v, p1, best);
    try_vertex(p0, v, p2, best);
    try_vertex(p0, v, p3, best);
  }
  if (best) best->point *= radius;
  return best;
}

}  // namespace paper
