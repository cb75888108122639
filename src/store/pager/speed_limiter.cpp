#include "store/pager/speed_limiter.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

#include "store/pager/paged_scene.h"
#include "world/scene_queries.h"

namespace roam::paging {
namespace {

/// Metres. The least and greatest distance of a search.
constexpr double least_reach = 16.0, greatest_reach = 500.0;

/// Seconds for two updates, assuming 60 a second: an incoming item waits for one update, and the eviction before it for
/// another.
constexpr double two_updates = 2.0 / 60.0;

/// Part of the gap found last that a body may move before the next search.
constexpr double trusted_part = 0.25;

/// The gap between the body's surface and the nearest item still to come; `reach` if that is farther.
double gap(const Residents& residents, const TrackedBody& t, double reach) {
  Contact nearest;
  Collector collector(Collector::Kind::contacts, reach, {&nearest, 1});
  query::collect_of(PagedScene(residents, PagedScene::What::coming), {t.body(), t.place()}, {}, collector);
  return collector.count() > 0 ? std::max(0.0, nearest.distance) : reach;
}

}  // namespace

void SpeedLimiter::look(const Residents& residents, const TrackedBody& tracked, double latency, bool changed,
                        bool complete) {
  latency_ = latency;
  if (complete) {
    ready_ = limit_ = std::numeric_limits<double>::infinity();
    radius_ = -1.0;
    return;
  }
  const double reach = std::clamp(horizon_ * tracked.speed(), least_reach, greatest_reach);
  const double moved = glm::length(tracked.place() - place_);
  const bool same_body = tracked.body().radius == radius_ && tracked.body().half_height == half_height_;
  if (changed || !same_body || moved > trusted_part * found_ || reach > 2.0 * reach_) {
    place_ = tracked.place();
    radius_ = tracked.body().radius;
    half_height_ = tracked.body().half_height;
    reach_ = reach;
    found_ = gap(residents, tracked, reach);
    ready_ = found_;
  } else {
    ready_ = found_ - moved;
  }
  limit_ = std::max(least_limit, ready_ / (latency_ + two_updates));
}

void SpeedLimiter::forget_latency() { limit_ = std::max(least_limit, ready_ / two_updates); }

bool SpeedLimiter::anything_coming(const Residents& residents, const TrackedBody& tracked, double reach) {
  return gap(residents, tracked, reach) < reach;
}

}  // namespace roam::paging
