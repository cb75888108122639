#include "roam/sweep.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "math/floating_point.h"
#include "roam/error.h"
#include "sweep/error_bound.h"
#include "sweep/seen_from.h"
#include "text/names.h"
#include "text/number.h"

namespace roam {
namespace {

/// Written so that NaN fails.
bool within_limit(double length) { return length <= certified::length_limit; }

bool within_limit(const Vec3& x) {
  return within_limit(std::abs(x.x)) && within_limit(std::abs(x.y)) && within_limit(std::abs(x.z));
}

[[noreturn]] void refuse(const char* what) {
  throw Error(std::string(what) + " must be finite and at most 1e12 m in each coordinate");
}

void check(const Body& body, const Vec3& from, const Vec3& motion, const Triangle& triangle) {
  if (!(body.radius >= 0.0) || !within_limit(body.radius)) {
    throw Error("the body's radius is " + number_text(body.radius) + " m; it must be 0 or more, and at most 1e12 m");
  }
  if (!(body.half_height >= 0.0) || !within_limit(body.half_height)) {
    throw Error("the body's half height is " + number_text(body.half_height) +
                " m; it must be 0 or more, and at most 1e12 m: a capsule's height is at least twice its radius");
  }
  if (!within_limit(from)) refuse("the body's position");
  if (!within_limit(motion)) refuse("the body's motion");
  for (const Vec3& corner : triangle) {
    if (!within_limit(corner)) refuse("the triangle's corners");
  }
}

}  // namespace

const char* to_string(Feature feature) { return name_in({"face", "edge", "vertex"}, feature); }

SweepResult sweep(const Body& body, const Vec3& from, const Vec3& motion, const Triangle& triangle) {
  const DefaultFloatingPoint guard;
  check(body, from, motion, triangle);
  const certified::LocalTriangle local = certified::seen_from(from, triangle);
  SweepResult result = certified::sweep(body, motion, local, 0.0, 1.0, 0.0);
  if (result.hit) {
    result.point += from;
  } else {
    result.distance = std::max(result.distance, certified::approach(body, motion, local, 0.0, 1.0).proximity.distance);
  }
  return result;
}

SweepResult sweep(const Body& body, const Vec3& from, const Vec3& motion, const Triangle& triangle, double until) {
  const DefaultFloatingPoint guard;
  check(body, from, motion, triangle);
  if (!(until >= 0.0 && until <= 1.0)) throw Error("the end of a sweep must be a time in [0, 1]");
  const certified::LocalTriangle local = certified::seen_from(from, triangle);
  if (certified::plane_separates(body, motion, local)) return {.time = until};
  SweepResult result = certified::sweep(body, motion, local, 0.0, until, 0.0);
  if (!result.hit) return {.time = until};
  result.point += from;
  return result;
}

Proximity proximity(const Body& body, const Vec3& place, const Triangle& triangle) {
  const DefaultFloatingPoint guard;
  check(body, place, Vec3(0.0), triangle);
  Proximity result = certified::proximity(body, certified::seen_from(place, triangle));
  result.point += place;
  return result;
}

}  // namespace roam
