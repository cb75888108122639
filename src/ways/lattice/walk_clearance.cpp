#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "math/level_distance.h"
#include "math/nested_ball.h"
#include "ways/lattice/walk_place.h"

namespace roam::ways {
namespace {

/// Metres. Queries use the radius less this, so that touching surfaces do not count.
constexpr double slack = 2e-5;
/// Metres. Each query that finds contact takes at least this off the radius.
constexpr double least_cut = 1e-5;
/// Metres. A sphere is lifted by at least this, so that the floor below it does not limit it.
constexpr double least_lift = 5e-5;
/// Queries of one search at most. Most searches end after three.
constexpr std::size_t most_cuts = 48;

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The height of the knee over the feet. With a step of 0 the knee still keeps the body off its own floor.
double knee(const Measure& measure) {
  constexpr double least = 5e-3;  // m
  return std::max(measure.step, least);
}

/// The largest radius of a capsule between two fixed heights that does not contain a point. The point lies `aside` of
/// the axis, `above` the bottom and `below` the top.
double capsule_limit(double aside, double above, double below) {
  const double end = std::min(above, below);
  if (!(end > 0.0)) return unlimited;
  return aside <= end ? aside : (aside * aside + end * end) / (2.0 * end);
}

std::optional<Stand> capsule_at(const Survey& survey, const Measure& measure, const Vec3& place, double largest,
                                double least) {
  const Vec3 centre = centre_of(measure, place, {});
  double radius = largest;
  for (std::size_t i = 0; i < most_cuts && radius >= least; ++i) {
    // Bodies of growing radius contain each other, so a contact of a larger one bounds every free one.
    const Clearance c = survey.world().clearance(body_of(measure, std::max(radius - slack, 0.0)), centre, 0.0);
    if (!c.found) return Stand{radius, 0.0};
    const double limit = capsule_limit(level_distance(c.point, centre), c.point.z - (place.z + knee(measure)),
                                       place.z + measure.height - c.point.z);
    radius = std::min(limit, radius - std::max(least_cut, -c.distance));
  }
  return std::nullopt;
}

/// The largest sphere at one lift, and the contact that limits it: `aside` from its axis and `height` above the place.
struct Held {
  double lift = 0.0, radius = 0.0;
  double aside = 0.0, height = 0.0;
  /// The upward part of the unit vector from the contact to the centre; 0 if there is no contact.
  [[nodiscard]] double upward() const {
    return radius > 0.0 && height != 0.0 ? (lift + radius - height) / radius : 0.0;
  }
};

/// The largest sphere that does not contain a point `aside` from its axis and `above` its lowest point.
double sphere_limit(double aside, double above) { return nested_ball(aside * aside, above); }

/// Spheres over a place.
class Spheres {
 public:
  Spheres(const Survey& survey, const Measure& measure, const Vec3& place, double largest)
      : survey_(survey), measure_(measure), place_(place), largest_(largest) {}

  /// The largest sphere at one lift. Ends as soon as its radius is less than `least`.
  [[nodiscard]] Held lifted(double lift, double least) {
    Held held = bound(lift);
    const double lowest = place_.z + lift;
    for (std::size_t i = 0; i < most_cuts && held.radius >= least; ++i) {
      const Vec3 centre(place_.x, place_.y, lowest + held.radius);
      const Clearance c = survey_.world().clearance(body_of(measure_, std::max(held.radius - slack, 0.0)), centre, 0.0);
      if (!c.found) {
        // The contact of another lift limits this sphere, unless that bound was a little too large.
        if (i == 0 && held.radius < largest_) held.radius = sphere_limit(held.aside, held.height - lift);
        return held;
      }
      held.aside = level_distance(c.point, place_);
      held.height = c.point.z - place_.z;
      met_[count_++ % met_.size()] = held;
      // If stored triangles are coarser than the slack, the contact may lie outside the sphere.
      const double limit = sphere_limit(held.aside, held.height - lift);
      held.radius = std::min(limit, held.radius - (limit < held.radius ? least_cut : std::max(least_cut, -c.distance)));
    }
    if (held.radius >= least) held.radius = 0.0;
    return held;
  }

 private:
  /// Contacts of other lifts bound the sphere at this lift too. The bound is rounded up by the error.
  [[nodiscard]] Held bound(double lift) const {
    const double error = slack + 2.0 * survey_.world().largest_error();
    Held held{lift, largest_, 0.0, 0.0};
    for (std::size_t i = 0; i < std::min(count_, met_.size()); ++i) {
      const double aside = met_[i].aside + error, above = met_[i].height - lift;
      const double limit = std::max(sphere_limit(aside, above - error), sphere_limit(aside, above + error));
      if (limit < held.radius) held = {lift, limit, met_[i].aside, met_[i].height};
    }
    return held;
  }

  const Survey& survey_;
  const Measure& measure_;
  const Vec3 place_;
  const double largest_;
  std::array<Held, 8> met_;  ///< the last ones
  std::size_t count_ = 0;
};

/// The lift at which two contacts allow the same radius: `below` limits the sphere from below, `above` from above.
double balanced(const Held& below, const Held& above) {
  double low = below.lift, high = above.lift;
  for (int i = 0; i < 40; ++i) {
    const double lift = 0.5 * (low + high);
    const bool raise = sphere_limit(below.aside, below.height - lift) < sphere_limit(above.aside, above.height - lift);
    (raise ? low : high) = lift;
  }
  return 0.5 * (low + high);
}

/// Raises the sphere from contacts below and lowers it from contacts above. Also tries lifts that are far apart: at the
/// sphere's middle height, a wall that ends above or below it looks endless.
std::optional<Stand> sphere_at(const Survey& survey, const Measure& measure, const Vec3& place, double largest,
                               double least) {
  constexpr double level = 0.01;      // smaller upward parts mean walls, which no lift avoids
  constexpr double fine_lift = 1e-5;  // m
  constexpr int most_turns = 12;
  const double clear = least_lift + 2.0 * survey.world().largest_error();
  Spheres spheres(survey, measure, place, largest);
  std::optional<Held> best;
  for (const double share : {0.5, 0.0, 0.125, 1.0}) {
    const Held held = spheres.lifted(std::max(share * measure.step, clear), best ? best->radius + least_cut : least);
    if (!best ? held.radius >= least : held.radius > best->radius) best = held;
    if (best && best->radius >= largest) return Stand{best->radius, best->lift};
  }
  if (!best) return std::nullopt;
  Held below = *best, above = *best;
  (best->upward() > 0.0 ? above : below) = {best->upward() > 0.0 ? measure.step : clear, 0.0, 0.0, 0.0};
  for (int i = 0; i < most_turns && std::abs(best->upward()) >= level && above.lift - below.lift > fine_lift; ++i) {
    const bool known = below.height != 0.0 && above.height != 0.0;
    const double lift = known ? balanced(below, above) : 0.5 * (below.lift + above.lift);
    if (!(lift - below.lift > 0.1 * fine_lift && above.lift - lift > 0.1 * fine_lift)) break;
    const Held held = spheres.lifted(lift, least);
    (held.upward() > 0.0 ? below : above) = held;
    if (held.radius > best->radius) best = held;
    if (held.radius >= largest || std::abs(held.upward()) < level) break;
  }
  return Stand{best->radius, best->lift};
}

}  // namespace

double largest_radius(const Measure& measure) {
  if (measure.mode == Mode::fly || measure.height == 0.0) return measure.widest;
  return std::min(measure.widest, 0.5 * (measure.height - knee(measure)));
}

Body body_of(const Measure& measure, double radius) {
  if (measure.mode == Mode::fly || measure.height == 0.0) return {radius, 0.0};
  return {radius, std::max(0.0, 0.5 * (measure.height - knee(measure)) - radius)};
}

Vec3 centre_of(const Measure& measure, const Vec3& place, const Stand& stand) {
  if (measure.mode == Mode::fly) return place;
  if (measure.height == 0.0) return place + Vec3(0.0, 0.0, stand.lift + stand.radius);
  return place + Vec3(0.0, 0.0, 0.5 * (measure.height + knee(measure)));
}

std::optional<Stand> stand_at(const Survey& survey, const Measure& measure, const Vec3& place, double largest,
                              double least) {
  return measure.height == 0.0 ? sphere_at(survey, measure, place, largest, least)
                               : capsule_at(survey, measure, place, largest, least);
}

}  // namespace roam::ways
