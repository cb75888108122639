#include "world/unknown.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "math/largest.h"
#include "sweep/bracket.h"

namespace roam::unknown {
namespace {

/// Unit roundoffs charged to each metre of the distance at the start, the motion, the half height and the radius. Let d
/// be the distance and w the motion. The components of the distance carry at most 3 roundings of d + w and one of the
/// half height. Their length carries 3 of itself, the slope 4 of w, and their sum with the radius 3; sqrt(3) for three
/// axes.
constexpr double roundings = 32.0;

/// Metres. A body this near has arrived. It is the rest of the 2 mm by which a hit may be early, after the margin.
constexpr double arrival = 2e-6;

/// Metres. Tightness of the least distance during the motion.
constexpr double tightness = 1e-6;

/// Each advance at least halves the way to a grazing touch, and so quarters the gap: from 1e6 m down to `arrival`, 20
/// are enough. A sweep that reached the limit would stop too early, never too late.
constexpr int advance_limit = 128;

/// Signed distance at one time, and its growth over the whole motion according to the plane that bounds it from below.
struct Sample {
  double time;
  double distance;
  double slope;
  Vec3 normal;  ///< unit, pointing out of the box
  int side;
  Feature feature;
};

class Approach {
 public:
  Approach(const Box& box, double margin, const Body& body, const Vec3& from, const Vec3& motion)
      : motion_(motion), lower_(box.lower - from), upper_(box.upper - from), kept_(body.radius + margin) {
    lower_.z -= body.half_height;
    upper_.z += body.half_height;
    const double length = std::abs(motion.x) + std::abs(motion.y) + std::abs(motion.z);
    error_ = roundings * 0x1p-53 * (std::abs(at(0.0).distance) + length + body.half_height + kept_);
  }

  [[nodiscard]] Sample at(double time) const {
    const Vec3 place = time * motion_;
    Vec3 apart(0.0);
    double deepest = 0.0, squared = 0.0;
    int side = -1, outside = 0;
    for (int k = 0; k < 3; ++k) {
      const double below = lower_[k] - place[k], above = place[k] - upper_[k];
      const double beyond = std::max(below, above);
      if (side < 0 || beyond > deepest) {
        deepest = beyond;
        side = 2 * k + (above >= below ? 1 : 0);
      }
      if (!(beyond > 0.0)) continue;
      ++outside;
      apart[k] = above >= below ? beyond : -beyond;
      squared += beyond * beyond;
    }
    Sample s{time, deepest, 0.0, Vec3(0.0), side, Feature::face};
    // One side decides if the point is inside, if it is beside one side, and if the squares are lost to underflow.
    if (outside > 1 && squared > shortest_squared) {
      s.distance = std::sqrt(squared);
      s.normal = apart / s.distance;
      s.feature = outside == 2 ? Feature::edge : Feature::vertex;
    } else {
      s.normal[side / 2] = side % 2 == 1 ? 1.0 : -1.0;
    }
    s.slope = glm::dot(s.normal, motion_);
    return s;
  }

  /// Certified gap between the body's surface, with the margin, and the box.
  [[nodiscard]] double gap(double distance) const { return distance - kept_ - error_; }
  [[nodiscard]] double error() const { return error_; }

 private:
  /// Square metres. The square of a shorter vector has lost digits.
  static constexpr double shortest_squared = 1e-260;

  Vec3 motion_, lower_, upper_;  // the box relative to the start of the motion
  double kept_, error_ = 0.0;
};

Vec3 point_on(const Box& box, const Sample& s, const Vec3& centre) {
  Vec3 point = glm::clamp(centre, box.lower, box.upper);
  if (s.feature == Feature::face) point[s.side / 2] = (s.side % 2 == 1 ? box.upper : box.lower)[s.side / 2];
  return point;
}

}  // namespace

// At each time the plane's bound, distance + (t - time) * slope, holds for all t; error_ covers its rounding. Before
// its root the body is free. The distance is convex, so a body that does not approach now never will.
Impact sweep(const Box& box, double margin, const Body& body, const Vec3& from, const Vec3& motion) {
  const Approach way(box, margin, body, from, motion);
  Impact miss;
  double time = 0.0;
  Sample s = way.at(time);
  for (int advance = 0; advance < advance_limit; ++advance) {
    const double gap = way.gap(s.distance);
    if (time == 0.0 && gap <= 0.0) break;
    if (s.slope >= 0.0) return miss;
    if (gap <= arrival) break;
    const double next = time + gap / -s.slope;
    if (next >= 1.0) return miss;
    if (!(next > time)) break;
    time = next;
    s = way.at(time);
  }
  Impact hit;
  hit.hit = hit.unknown = true;
  hit.time = time;
  hit.point = point_on(box, s, from + time * motion);
  hit.normal = s.normal;
  hit.feature = s.feature;
  hit.distance = time == 0.0 ? way.gap(s.distance) : std::max(0.0, way.gap(s.distance));
  hit.triangle = static_cast<TriangleId>(s.side);
  return hit;
}

Contact nearest(const Box& box, double margin, const Body& body, const Vec3& from, const Vec3& motion) {
  const Approach way(box, margin, body, from, motion);
  const auto contact_of = [&](const Sample& s, double gap) {
    Contact c;
    c.point = point_on(box, s, from + s.time * motion);
    c.normal = s.normal;
    c.feature = s.feature;
    c.distance = gap;
    c.triangle = static_cast<TriangleId>(s.side);
    c.unknown = true;
    return c;
  };
  Sample left = way.at(0.0);
  if (left.slope >= 0.0) return contact_of(left, way.gap(left.distance));
  Sample right = way.at(1.0);
  if (right.slope <= 0.0) return contact_of(right, way.gap(right.distance));
  const certified::Crossing lower = certified::narrow(
      left, right, advance_limit, [&](double time) { return way.at(time); },
      // The midpoint ensures that neither side of the bracket stands still for long.
      [&](int step, const certified::Crossing& c) { return step % 2 == 0 ? c.time : 0.5 * (left.time + right.time); },
      [&](const certified::Crossing& c) { return std::min(left.distance, right.distance) - c.distance <= tightness; });
  const Sample& least = left.distance <= right.distance ? left : right;
  // One bound for the planes, one for the arithmetic between them.
  return contact_of(least, way.gap(std::min(lower.distance, least.distance)) - way.error());
}

}  // namespace roam::unknown
