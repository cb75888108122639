#include "sweep/paged.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "cli/interrupt.h"
#include "roam/error.h"
#include "scenes/arrivals.h"

namespace roam::app {
namespace {

/// m: surroundings of so short a part fit into the least memory
constexpr double least_part = 0.5;
/// Seconds of waiting for unreadable tiles.
constexpr double broken_after = 3.0;

}  // namespace

/// Whether nothing has come since a wait for it was given up.
bool PagedSweep::is_stuck() const { return scene_.pager()->stats().loads == stuck_at_; }

/// Nothing if memory cannot hold the surroundings and `may_part` allows shorter parts. Tiles of an unknown hit are
/// unreadable.
std::optional<Impact> PagedSweep::sweep(const SweepQuery& part, bool may_part) {
  Arrivals arrivals(*scene_.pager());
  for (;;) {
    stop_if_interrupted();
    const Impact answer = scene_.space().sweep(part.body, part.from, part.motion);
    if (!answer.unknown || is_stuck()) return answer;
    const bool more = arrivals.wait(part.body, part.from, part.motion);
    if (arrivals.settled()) {
      const std::string why = scene_.space().object_name(answer.triangle);
      if (arrivals.silence() < broken_after && !given_up_.contains(why)) continue;
      if (!why.empty()) given_up_.insert(why);
      return answer;
    }
    if (arrivals.stuck()) {
      stuck_at_ = scene_.pager()->stats().loads;
      return answer;
    }
    if (may_part && !more) return std::nullopt;
  }
}

double PagedSweep::gap(const SweepQuery& part) {
  double distance = 0.0;
  const double length = glm::length(part.motion);
  const Vec3 ahead = length > 0.0 ? part.motion / length : Vec3(1.0, 0.0, 0.0);
  for (const double reach : gap_reaches) {
    Arrivals arrivals(*scene_.pager());
    Clearance nearest = scene_.space().clearance(part.body, part.from, part.motion, reach);
    for (bool more = !is_stuck(); nearest.unknown && more;) {
      more = arrivals.wait(part.body, part.from, ahead * (length + reach));
      stop_if_interrupted();
      nearest = scene_.space().clearance(part.body, part.from, part.motion, reach);
    }
    if (arrivals.stuck()) stuck_at_ = scene_.pager()->stats().loads;
    // The sweep has certified at least 0, even if the grid subtracts more here. Unknown space only makes the gap
    // smaller.
    distance = std::max(distance, nearest.distance);
    if (nearest.found) break;
  }
  return distance;
}

SweepAnswer PagedSweep::operator()(const SweepQuery& query) {
  const double length = glm::length(query.motion);
  double least = std::numeric_limits<double>::infinity();
  Impact answer;
  for (double begin = 0.0; begin < 1.0;) {
    const bool whole = length <= fits_;
    const double end = whole ? 1.0 : std::min(1.0, begin + fits_ / length);
    const SweepQuery part{query.from + begin * query.motion, (end - begin) * query.motion, query.body};
    const auto found = sweep(part, fits_ > least_part);
    if (!found) {
      fits_ = std::max(least_part, 0.5 * std::min(fits_, length));
      continue;
    }
    answer = *found;
    if (answer.hit) {
      answer.time = begin + answer.time * (end - begin);
      if (answer.unknown && is_stuck()) {
        return {answer, fmt::format("nothing has come from {} for {:g} s; give --memory more, or sweep again when the "
                                    "disk or the server answers",
                                    scene_.pager()->store().name(), Arrivals::stuck_after)};
      }
      if (answer.unknown) return {answer, scene_.space().object_name(answer.triangle)};
      try {
        answer.triangle = scene_.scene_triangle(answer.triangle);
      } catch (const Error& error) {
        answer.triangle = no_triangle;
        return {answer, error.what()};
      }
      return {answer, {}};
    }
    least = std::min(least, gap(part));
    begin = end;
  }
  answer.distance = least;
  return {answer, {}};
}

}  // namespace roam::app
