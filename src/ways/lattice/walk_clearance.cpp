#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "math/level_distance.h"
#include "math/nested_ball.h"
#include "math/slope.h"
#include "motion/carrying.h"
#include "ways/lattice/walk_place.h"

namespace roam::ways {
namespace {

/// Metres. Queries use the radius less this, so that touching surfaces do not count.
constexpr double slack = 2e-5;
/// Metres. Each query that finds contact takes at least this off the radius.
constexpr double least_cut = 1e-5;
/// Metres. A sphere is lifted by at least this, so that the floor below it does not limit it.
constexpr double least_lift = 5e-5;
/// Metres. Levels that differ by less are equal.
constexpr double touch = 1e-3;
/// Queries of one search at most. Most searches end after three.
constexpr std::size_t most_cuts = 48;

constexpr double unlimited = std::numeric_limits<double>::infinity();

bool is_capsule(const Measure& measure) { return measure.mode == Mode::walk && measure.height > 0.0; }

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

/// A body is lifted by at least this (m), so that the floor below it does not limit it.
double least_lift_in(const Survey& survey, const Measure& measure) {
  return std::min(least_lift + 2.0 * survey.world().largest_error(), knee(measure));
}

/// The height (m) of the highest obstacle that a walker steps on from `level`: it grants two of its skins, each twice
/// the error of stored triangles and 0.1 mm.
double climbable_height(const Survey& survey, const Measure& measure, double level) {
  return level + knee(measure) + std::max(touch, 4.0 * survey.world().largest_error() + 2e-4);
}

/// Whether an edge that a body of `radius` meets belongs to a step of stairs: where the body, standing at the height
/// `level`, begins to meet it, it already stands on something else, at most a step lower.
bool is_next_step(const Survey& survey, const Measure& measure, double level, double radius, const Vec3& edge,
                  const Vec3& towards_axis) {
  const double deep = std::max(radius - (edge.z - level), 0.0), aside = std::sqrt(radius * radius - deep * deep);
  const Vec3 axis = edge + (aside + touch) * towards_axis;
  const Vec3 centre = centre_of(measure, {axis.x, axis.y, level}, {radius, knee(measure)});
  const double down = knee(measure) - least_lift_in(survey, measure);
  const Impact met = survey.world().sweep(body_of(measure, radius), centre, Vec3(0.0, 0.0, -down));
  return met.hit && met.time > 0.0 && met.point.z <= climbable_height(survey, measure, level) &&
         met.point.z >= edge.z - measure.step - touch;
}

/// Whether an obstacle that a body of `radius` meets is too high for a walker that stands at the height `level`: above
/// the knee, and neither floor nor a step after another one.
bool is_too_high(const Survey& survey, const Measure& measure, double level, double radius, const Impact& met) {
  constexpr double in_front = 0.05;  // m
  if (met.point.z <= climbable_height(survey, measure, level)) return false;
  if (met.normal.z < rim_cosine) return true;
  const double upright = least_upright(survey.slope_degrees());
  if (met.feature == Feature::face) return met.normal.z < upright;
  const Vec3 flat(met.normal.x, met.normal.y, 0.0);
  const double length = glm::length(flat);
  if (!(length > 0.0)) return false;
  const Vec3 towards_axis = flat / length;
  // An edge of floor that goes on towards the axis is floor.
  const double falls = in_front * std::sqrt(1.0 - upright * upright) / upright + touch;
  const Vec3 above = met.point + in_front * towards_axis + Vec3(0.0, 0.0, falls);
  if (survey.floor().first_impact({0.0, 0.0}, above, Vec3(0.0, 0.0, -2.0 * falls)).hit) return false;
  return !is_next_step(survey, measure, level, radius, met.point, towards_axis);
}

std::vector<Contact> contacts_of(const Survey& survey, const Query& query, double reach) {
  constexpr std::size_t first_looked_at = 64, most_looked_at = 16'384;
  std::vector<Contact> contacts(first_looked_at);
  std::size_t count = 0;
  while ((count = survey.world().contacts(query, reach, contacts)) == contacts.size() && count < most_looked_at)
    contacts.resize(4 * contacts.size());
  contacts.resize(count);
  return contacts;
}

std::optional<Stand> capsule_at(const Survey& survey, const Measure& measure, const Vec3& place, double largest,
                                double least) {
  const Vec3 centre = centre_of(measure, place, {});
  const double top = place.z + measure.height;
  double radius = largest;
  for (std::size_t i = 0; i < most_cuts && radius >= least; ++i) {
    // Bodies of growing radius contain each other, so a contact of a larger one bounds every free one.
    const Body body = body_of(measure, std::max(radius - slack, 0.0));
    const Clearance c = survey.world().clearance(body, centre, 0.0);
    if (c.found) {
      const double limit =
          capsule_limit(level_distance(c.point, centre), c.point.z - (place.z + knee(measure)), top - c.point.z);
      radius = std::min(limit, radius - std::max(least_cut, -c.distance));
      continue;
    }
    const double down = knee(measure) - least_lift_in(survey, measure);
    const Impact met = survey.world().sweep(body, centre, Vec3(0.0, 0.0, -down));
    if (!met.hit || !is_too_high(survey, measure, place.z, body.radius, met))
      return Stand{radius, knee(measure) - met.time * down};
    // Where a wall leans, the first impact is far from the deepest contact.
    const Clearance deepest = survey.world().clearance(body, centre, Vec3(0.0, 0.0, -down), 0.0);
    const bool is_high = deepest.found && deepest.point.z > climbable_height(survey, measure, place.z);
    const Vec3& point = is_high ? deepest.point : met.point;
    radius = std::min(capsule_limit(level_distance(point, centre), point.z - place.z, top - point.z),
                      radius - std::max(least_cut, is_high ? -deepest.distance : 0.0));
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

std::vector<Contact> surfaces_at(const Survey& survey, const Measure& measure, const Vec3& place, double radius,
                                 const Stand& stand, double reach) {
  return contacts_of(survey, {body_of(measure, radius), centre_of(measure, place, stand), Vec3(0.0)}, reach);
}

std::vector<Contact> sides_of(const Survey& survey, const Measure& measure, const Vec3& place, double radius,
                              const Stand& stand, double reach) {
  if (measure.mode == Mode::fly) return surfaces_at(survey, measure, place, radius, stand, reach);
  const double down = is_capsule(measure) ? std::max(knee(measure) - stand.lift, 0.0) : stand.lift;
  const Query lowered{body_of(measure, radius), centre_of(measure, place, stand), Vec3(0.0, 0.0, -down)};
  std::vector<Contact> sides = contacts_of(survey, lowered, reach);
  std::erase_if(sides, [&](const Contact& side) { return side.point.z <= place.z + knee(measure); });
  return sides;
}

bool meets_high_obstacle(const Survey& survey, const Measure& measure, const Vec3& from, const Vec3& to,
                         double radius) {
  constexpr double bumps = 0.02;  // m, above the floor: they hide no obstacle behind them
  // A body may touch an upright edge anywhere above its lower half ball, so that begins at the highest step.
  const double uneven = std::max(bumps, climbable_height(survey, measure, 0.0) + touch - radius);
  const auto meets = [&](double lift) {
    const Vec3 down(0.0, 0.0, knee(measure) - lift);
    const Impact met = survey.world().sweep(body_of(measure, radius), centre_of(measure, from, {}) - down, to - from);
    return met.hit && met.time > 0.0 && is_too_high(survey, measure, std::max(from.z, to.z), radius, met);
  };
  if (!is_capsule(measure) || knee(measure) <= uneven || !meets(uneven)) return false;
  // The body stands higher where it steps on something at one end.
  double lift = 0.0;
  for (const Vec3& end : {from, to}) {
    const auto stand = stand_at(survey, measure, end, radius, 0.99 * radius);
    if (stand) lift = std::max(lift, stand->lift);
  }
  return !(lift > uneven) || meets(lift);
}

std::optional<Stand> stand_at(const Survey& survey, const Measure& measure, const Vec3& place, double largest,
                              double least) {
  if (is_capsule(measure)) return capsule_at(survey, measure, place, largest, least);
  for (std::size_t i = 0; i < most_cuts; ++i) {
    const std::optional<Stand> stand = sphere_at(survey, measure, place, largest, least);
    const double down = stand ? stand->lift - least_lift_in(survey, measure) : 0.0;
    if (!(down > 0.0)) return stand;
    const Body body = body_of(measure, std::max(stand->radius - slack, 0.0));
    const Impact met = survey.world().sweep(body, centre_of(measure, place, *stand), Vec3(0.0, 0.0, -down));
    if (!met.hit || !is_too_high(survey, measure, place.z, body.radius, met)) return stand;
    const double limit = sphere_limit(std::hypot(met.point.x - place.x, met.point.y - place.y), met.point.z - place.z);
    largest = std::min(limit, stand->radius - least_cut);
    if (largest < least) break;
  }
  return std::nullopt;
}

}  // namespace roam::ways
