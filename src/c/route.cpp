// Routes.
#include "roam/route.h"

#include "c/progress.h"
#include "c/structs.h"
#include "c/walker.h"

namespace roam::c {
namespace {

RouteResult follow_route(roam_walker& walker, std::span<const Vec3> waypoints, const RouteOptions& options,
                         Progress& progress) {
  const auto total = static_cast<double>(waypoints.size());
  if (walker.in.live == nullptr) {
    Route route(walker.walker, waypoints, options);
    while (!route.done()) {
      route.advance();
      progress.check(static_cast<double>(route.result().waypoints) / total);
    }
    return route.result();
  }
  struct Watched {
    explicit Watched(StoreSpace& of, Progress& progress) : store(of) {
      store.before_update = [&progress] { progress.check(0.0); };
    }
    ~Watched() { store.before_update = nullptr; }
    StoreSpace& store;
  };
  const Watched watched(*walker.in.store, progress);
  return follow(walker.walker, *walker.in.live, waypoints, options);
}

}  // namespace
}  // namespace roam::c

using namespace roam::c;

roam_status roam_route_follow(roam_walker* walker, const roam_vec3* waypoints, size_t count,
                              const roam_route_options* options, roam_route_result* result) {
  return guarded([&] {
    roam_walker& body = needed(walker, "the walker");
    if (count > 0) (void)needed(waypoints, "the array of waypoints");
    check_room(result, "roam_route_result");
    const auto how = given_or_default(options, "roam_route_options");
    roam::RouteOptions route;
    if (how.speed != 0.0) route.speed = how.speed;
    if (how.dt != 0.0) route.dt = how.dt;
    if (how.patience != 0.0) route.patience = how.patience;
    if (how.wait != 0.0) route.wait = how.wait;
    std::vector<roam::Vec3> path;
    for (std::size_t i = 0; i < count; ++i) path.push_back(cpp_of(waypoints[i]));
    Progress progress(how.progress, how.progress_data);
    const roam::RouteResult walked = follow_route(body, path, route, progress);

    roam_route_result facts{};
    facts.outcome = static_cast<int32_t>(walked.outcome);
    facts.waypoints = walked.waypoints;
    facts.steps = walked.steps;
    facts.length = walked.length;
    facts.simulated = walked.simulated;
    facts.least_gap = walked.least_gap;
    facts.end = c_of(walked.end);
    facts.blocked_by = roam::no_triangle;
    if (walked.blocked_at) {
      facts.blocked_by = walked.blocked_at->triangle;
      facts.blocked_at = c_of(walked.blocked_at->point);
      facts.opening = walked.blocked_at->opening.value_or(0.0);
    }
    put(*result, facts);
  });
}
