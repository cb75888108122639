#include "train/floor_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace roam::training {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

double squared(double x, double y) { return x * x + y * y; }

/// A triangle clipped by two planes.
struct Polygon {
  std::array<Vec3, 5> corners;
  int size = 0;
  void add(const Vec3& corner) { corners[static_cast<std::size_t>(size++)] = corner; }
};

/// What of a polygon has sign * z <= limit (Sutherland & Hodgman, 1974).
Polygon clipped(const Polygon& whole, double sign, double limit) {
  Polygon part;
  for (int i = 0; i < whole.size; ++i) {
    const Vec3& a = whole.corners[static_cast<std::size_t>(i)];
    const Vec3& b = whole.corners[static_cast<std::size_t>((i + 1) % whole.size)];
    const double above_a = sign * a.z - limit, above_b = sign * b.z - limit;
    if (above_a <= 0.0) part.add(a);
    if ((above_a < 0.0 && above_b > 0.0) || (above_a > 0.0 && above_b < 0.0))
      part.add(a + (above_a / (above_a - above_b)) * (b - a));
  }
  return part;
}

/// The place of the segment that is nearest to the origin in the plan.
Vec3 nearest_of_segment(const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length = squared(ab.x, ab.y);
  if (length == 0.0) return a;
  return a + std::clamp(-(a.x * ab.x + a.y * ab.y) / length, 0.0, 1.0) * ab;
}

/// The place of a convex polygon that is nearest to the origin in the plan; of one that lies over it, the origin.
std::optional<Vec3> nearest_of(const Polygon& polygon) {
  if (polygon.size == 0) return std::nullopt;
  bool left = false, right = false;
  Vec3 best = polygon.corners[0];
  double least = kInfinite;
  for (int i = 0; i < polygon.size; ++i) {
    const Vec3& a = polygon.corners[static_cast<std::size_t>(i)];
    const Vec3& b = polygon.corners[static_cast<std::size_t>((i + 1) % polygon.size)];
    const double side = a.x * b.y - a.y * b.x;
    left = left || side > 0.0;
    right = right || side < 0.0;
    const Vec3 at = nearest_of_segment(a, b);
    if (const double d = squared(at.x, at.y); d < least) {
      least = d;
      best = at;
    }
  }
  if (left != right) return Vec3(0.0, 0.0, best.z);
  return best;
}

}  // namespace

FloorPlan::FloorPlan(const Survey& survey, double band)
    // Twice: a query's own bound is off as much as what it is about; and the tenth of a micrometre that roundings take.
    : survey_(&survey), band_(band), error_(2.0 * survey.floor().largest_error() + 1e-7) {}

NearFloor FloorPlan::of(TriangleId floor, const Vec3& place) const {
  const Triangle t = survey_->triangle(survey_->floor_triangles()[floor]);
  Polygon polygon;
  for (const Vec3& corner : t) polygon.add(corner - place);
  const auto [lowest, highest] = std::minmax({polygon.corners[0].z, polygon.corners[1].z, polygon.corners[2].z});
  if (highest > band_) polygon = clipped(polygon, 1.0, band_);
  if (lowest < -band_) polygon = clipped(polygon, -1.0, band_);
  const std::optional<Vec3> at = nearest_of(polygon);
  if (!at) return {kInfinite, place};
  return {std::sqrt(squared(at->x, at->y)), place + *at};
}

void FloorPlan::within(const Vec3& place, double reach, std::vector<NearFloor>& near) const {
  std::vector<Contact> contacts(32);
  std::size_t count = 0;
  while ((count = survey_->floor().contacts({0.0, band_}, place, Vec3(0.0), reach, contacts)) == contacts.size())
    contacts.resize(4 * contacts.size());
  near.clear();
  for (std::size_t i = 0; i < count; ++i) near.push_back(of(contacts[i].triangle, place));
  std::sort(near.begin(), near.end(), [](const NearFloor& a, const NearFloor& b) {
    if (a.distance != b.distance) return a.distance < b.distance;
    return a.point.x != b.point.x ? a.point.x < b.point.x : a.point.y < b.point.y;
  });
}

NearFloor FloorPlan::nearest(const Vec3& place, double reach) const {
  const Clearance beside = survey_->floor().clearance({0.0, band_}, place, reach);
  if (!beside.found) return {reach, place};
  const NearFloor first = of(beside.triangle, place);
  if (first.distance <= std::max(beside.distance, 0.0) + error_) return first;
  // What is nearest to the upright axis lies above or below its ends: look farther for what is beside it.
  std::vector<NearFloor> near;
  for (double radius = std::max(2.0 * beside.distance, 0.1);; radius *= 2.0) {
    within(place, std::min(radius, reach), near);
    if (!near.empty() && near.front().distance <= std::min(radius, reach)) return near.front();
    if (radius >= reach) return {reach, place};
  }
}

void FloorPlan::touching(const Vec3& place, double reach, double slack, std::vector<NearFloor>& near) const {
  const NearFloor first = nearest(place, reach);
  within(place, std::min(first.distance + slack, reach) + error_, near);
  if (near.empty()) near.push_back(first);
  const double least = near.front().distance;
  std::erase_if(near, [&](const NearFloor& n) { return n.distance > least + slack; });
}

namespace {

/// The way in which a disc grows fastest while all that it touches stays behind: of the shortest arc that holds the
/// directions away from what it touches, the middle; and how much radius a metre gives. None where they surround it.
struct Climb {
  double x = 0.0, y = 0.0;
  double rate = 0.0;
};

std::optional<Climb> steepest(const Vec3& centre, const std::vector<NearFloor>& near) {
  std::vector<double> angles;
  for (const NearFloor& n : near) {
    if (n.distance > 0.0) angles.push_back(std::atan2(centre.y - n.point.y, centre.x - n.point.x));
  }
  if (angles.empty()) return std::nullopt;
  std::sort(angles.begin(), angles.end());
  constexpr double turn = 2.0 * std::numbers::pi;
  double gap = turn - angles.back() + angles.front(), begin = angles.front();
  for (std::size_t i = 1; i < angles.size(); ++i) {
    if (angles[i] - angles[i - 1] > gap) {
      gap = angles[i] - angles[i - 1];
      begin = angles[i];
    }
  }
  const double arc = turn - gap;
  if (arc >= std::numbers::pi) return std::nullopt;
  const double middle = begin + 0.5 * arc;
  return Climb{std::cos(middle), std::sin(middle), std::cos(0.5 * arc)};
}

}  // namespace

Disc grow(const FloorPlan& plan, const Vec3& start, double enough, double precision, const MayMove& may_move) {
  // Rims that part by less than this a metre are taken for parallel: 0.04 mm over the 4 m that are looked at.
  constexpr double least_rate = 1e-5;
  constexpr double fair_share = 0.3;  // of the growth that the rate promises, for a step to be taken
  constexpr int most_steps = 400;     // rims that never let go: not met
  std::vector<NearFloor> near;
  Disc disc{start, 0.0};
  double slack = kInfinite;
  for (int i = 0; i < most_steps; ++i) {
    plan.touching(disc.centre, enough, std::min(slack, 0.25 * enough), near);
    disc.radius = near.front().distance;
    if (disc.radius >= enough) break;
    if (slack == kInfinite) slack = 0.25 * disc.radius;
    std::erase_if(near, [&](const NearFloor& n) { return n.distance > disc.radius + slack; });
    const std::optional<Climb> climb = steepest(disc.centre, near);
    bool moved = false;
    if (climb && climb->rate > least_rate) {
      for (double way = std::max(disc.radius, 2.0 * slack); !moved && way > 0.5 * slack; way *= 0.5) {
        const Vec3 next = disc.centre + Vec3(way * climb->x, way * climb->y, 0.0);
        moved = plan.nearest(next, enough).distance >= std::min(disc.radius + fair_share * climb->rate * way, enough) &&
                may_move(disc.centre, next);
        if (moved) disc.centre = next;
      }
    }
    if (moved) continue;
    if (slack <= precision) break;
    slack = std::max(0.25 * slack, precision);
  }
  return disc;
}

}  // namespace roam::training
