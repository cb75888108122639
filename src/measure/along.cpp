#include "measure/along.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <utility>

#include "math/floating_point.h"

namespace roam::measure {
namespace {

constexpr double stations_a_step = 20'000.0;
constexpr double dense = 0.05;  ///< m between positions where places are listed
/// The narrowest place is looked for again on either side, so many times as densely.
constexpr int refinement = 24;
/// A way that crosses a passage aslant has its least width aslant too.
constexpr int widest_turn = 45, turn = 3;  ///< degrees
/// A way that is steeper than some 84 degrees has no left and right.
constexpr double least_level = 0.1;
constexpr double worth_refining = 1e-3;  ///< m

}  // namespace

Along::Along(const Space& space, const WalkerSettings& settings, Mode mode, double least_reach)
    : room_(space, settings, mode, least_reach), mode_(mode), between_(0.5 * settings.radius) {}

void Along::list_narrower(double width) {
  narrower_ = width;
  between_ = std::min(between_, dense);
}

void Along::put(const Vec3& centre) {
  close_group();
  last_ = centre;
  until_next_ = 0.0;
}

void Along::go(const Vec3& centre, const Body& body) {
  const DefaultFloatingPoint guard;
  const Vec3 from = std::exchange(last_, centre).value_or(centre);
  const Vec3 way = centre - from, level(way.x, way.y, 0.0);
  const double length = glm::length(way), across = glm::length(level), begin = length_;
  if (mode_ != Mode::ghost && across > least_level * std::abs(way.z)) {
    double at = until_next_;
    for (; at <= across; at += between_) {
      length_ = begin + length * at / across;
      measure(from + way * (at / across), body, level / across);
    }
    until_next_ = at - across;
  }
  length_ = begin + length;
}

void Along::add(const StepReport& report) {
  if (!last_) put(report.from);
  for (const Event& e : report.events) ducked_ += e.kind == EventKind::crouched ? 1 : 0;
  const double usual = between_;
  between_ = std::max(usual, report.length() / stations_a_step);
  for (const Segment& s : report.segments) {
    if (s.teleport)
      put(s.position);
    else
      go(s.position, Body::capsule(s.radius, s.height));
  }
  between_ = usual;
}

void Along::finish() { close_group(); }

std::optional<NarrowPlace> Along::width_at(const Vec3& centre, const Body& body, const Vec3& heading,
                                           double angle) const {
  const Vec3 left(-heading.y, heading.x, 0.0);
  const Vec3 across = std::cos(angle) * left + std::sin(angle) * heading;
  const Free to_left = room_.beside(body, centre, across), to_right = room_.beside(body, centre, -across);
  if (!to_left.bounded || !to_right.bounded) return std::nullopt;
  NarrowPlace place;
  place.centre = centre;
  place.body = body;
  place.along = place.from = place.to = length_;
  place.width = to_left.distance + to_right.distance + 2.0 * body.radius;
  place.left = centre + (to_left.distance + body.radius) * across;
  place.right = centre - (to_right.distance + body.radius) * across;
  place.left_triangle = to_left.triangle;
  place.right_triangle = to_right.triangle;
  return place;
}

NarrowPlace Along::refined(const NarrowPlace& place, const Vec3& heading) const {
  NarrowPlace best = place;
  const auto improve = [&](const Vec3& centre, double angle) {
    auto found = width_at(centre, place.body, heading, angle);
    if (!found || !(found->width < best.width) || !room_.is_passage(place.body, centre, heading)) return;
    found->along = std::max(0.0, place.along + glm::dot(centre - place.centre, heading));
    best = *found;
  };
  for (int k = -refinement; k <= refinement; ++k) improve(place.centre + between_ * k / refinement * heading, 0.0);
  const Vec3 centre = best.centre;
  for (int degrees = -widest_turn; degrees <= widest_turn; degrees += turn)
    improve(centre, glm::radians(static_cast<double>(degrees)));
  best.from = place.from;
  best.to = place.to;
  return best;
}

void Along::measure(const Vec3& centre, const Body& body, const Vec3& heading) {
  ++measured_;
  const Free up = room_.headroom(body, centre);
  if (up.bounded && (!lowest_ || up.distance < lowest_->height)) lowest_ = {centre, length_, up.distance, up.triangle};
  const auto found = width_at(centre, body, heading, 0.0);
  const double least = narrowest_ ? narrowest_->width - worth_refining : std::numeric_limits<double>::infinity();
  const bool is_listed = found && found->width < narrower_;
  if (found && (found->width < least || is_listed) && room_.is_passage(body, centre, heading)) {
    if (found->width < least) narrowest_ = refined(*found, heading);
    if (is_listed) {
      if (!group_) group_ = found;
      group_->to = length_;
      if (found->width < group_->width - worth_refining || group_->along == length_) {
        const double from = group_->from;
        group_ = refined(*found, heading);
        group_->from = from;
      }
      return;
    }
  }
  close_group();
}

void Along::close_group() {
  if (!group_) return;
  const NarrowPlace place = *std::exchange(group_, std::nullopt);
  if (narrow_.empty() || place.from - narrow_.back().to > 2.0 * place.body.radius) {
    narrow_.push_back(place);
    return;
  }
  NarrowPlace& before = narrow_.back();
  const double from = before.from;
  if (place.width < before.width) before = place;
  before.from = from;
  before.to = place.to;
}

}  // namespace roam::measure
