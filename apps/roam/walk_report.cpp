#include "walk_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/progress.h"
#include "cli/tell.h"
#include "text/printable.h"

namespace roam::app {
namespace {

std::string at(const Vec3& p) { return fmt::format("({:.3f}, {:.3f}, {:.3f})", p.x, p.y, p.z); }

std::string quoted(const std::string& object) {
  return object.empty() ? "an object without a name" : fmt::format("\"{}\"", printable(object));
}

/// Where the first event of a kind was.
std::optional<Vec3> first(const RouteResult& result, EventKind kind) {
  const auto found = std::find_if(result.events.begin(), result.events.end(),
                                  [kind](const RouteEvent& e) { return e.event.kind == kind; });
  if (found == result.events.end()) return std::nullopt;
  return found->event.point;
}

std::string explain_blocked(const WalkReport& report) {
  const RouteResult& result = report.result;
  if (!result.blocked_at) return fmt::format("it came no nearer to the next waypoint at {}", at(result.end));
  const Blockage& blockage = *result.blocked_at;
  std::string text = fmt::format("at {} by {} (triangle {}), touched at {}", at(result.end), quoted(report.object),
                                 blockage.triangle, at(blockage.point));
  if (blockage.opening) {
    const Body body = report.body.value_or(Body::capsule(report.settings.radius, report.settings.height));
    text += fmt::format("; the opening there is {:.3f} m, the body needs {:.3f} m across and {:.3f} m in height",
                        *blockage.opening, 2.0 * body.radius, body.height());
  } else if (report.mode == Mode::walk && blockage.normal.z < 0.5) {
    text += "; there is no opening: lead the path around it";
  }
  return text;
}

/// Why a body did not go on though no wall was in its way.
std::string explain_wait(const WalkReport& report) {
  const RouteResult& result = report.result;
  if (!result.blocked_at) {
    return fmt::format("at {} what lies ahead does not come fast enough; go slower, or read it from a faster disk",
                       at(result.end));
  }
  return fmt::format("at {} what lies ahead is solid until it is read, from {} on: {}", at(result.end),
                     at(result.blocked_at->point),
                     report.object.empty() ? "not loaded yet" : printable_part(report.object));
}

std::string spans(const Box& box) { return fmt::format("{} to {}", at(box.lower), at(box.upper)); }

/// Whether the body has been held since it was put where it starts.
bool held_since_start(const RouteResult& result) {
  if (result.steps == 0) return true;
  const auto last = std::find_if(result.events.rbegin(), result.events.rend(),
                                 [](const RouteEvent& e) { return e.event.kind == EventKind::held; });
  return last != result.events.rend() && last->step == 0;
}

std::string explain_left(const WalkReport& report) {
  const RouteResult& result = report.result;
  const std::string scene = report.bounds.empty() ? "" : ", which spans " + spans(report.bounds);
  if (report.waypoints > 0) {
    return fmt::format("nothing of the scene{} lies ahead any more at {}; is the path in the scene's frame?",
                       scene.empty() ? "" : scene + ",", at(result.end));
  }
  if (result.steps == 0) {
    return fmt::format("where it starts, {} (--from), is outside the scene{}", at(result.end), scene);
  }
  return fmt::format("at {} it has wandered out of the scene{}", at(result.end), scene);
}

std::string explain_held(const WalkReport& report) {
  const RouteResult& result = report.result;
  const bool wanders = report.waypoints == 0;
  if (held_since_start(result) && first(result, EventKind::met_unknown)) {
    return fmt::format("where it starts, {}, what is there cannot be read, or has not been in time", at(result.end));
  }
  if (held_since_start(result)) {
    return fmt::format(
        "it does not fit where it starts, {}: it is inside a wall or too near to one, and no free place is close "
        "by; {} or take a smaller radius",
        at(result.end), wanders ? "start elsewhere (--from)" : "move the first waypoint");
  }
  if (!first(result, EventKind::put_back)) return explain_wait(report);
  return fmt::format("at {} there is no ground below to stand on; {}, or fly", at(result.end),
                     wanders ? "start elsewhere (--from)" : "move the waypoint onto the ground");
}

/// A bound: clearances may be told a quarter of the gap, two skins and 2 mm less than they are, and are capped.
std::string clearance_line(const WalkReport& report) {
  const RouteResult& result = report.result;
  if (!knows_clearance(report)) return "not known: the body fitted nowhere";
  const double reach = report.settings.clearance_reach;
  constexpr double near_cap = 0.7;  // of the reach: from here on nothing need have been there
  const std::string cap = result.least_gap < near_cap * reach
                              ? ""
                              : fmt::format("; it was looked for no farther than {:g} m from the surface", reach);
  return fmt::format("at least {:.6f} m from its axis, {:.6f} m from its surface (certified{})",
                     result.least_axis_clearance, result.least_gap, cap);
}

}  // namespace

bool knows_clearance(const WalkReport& report) {
  return report.mode != Mode::ghost && report.result.least_axis_clearance > 0.0;
}

std::string note_on_size(const WalkerSettings& body, const Box& scene) {
  if (scene.empty()) return {};
  const Vec3 size = scene.size();
  const double across = 2.0 * body.radius;
  if (std::max(across, body.height) <= std::max({size.x, size.y, size.z})) return {};
  return fmt::format(
      "the body, {:g} m across and {:g} m high, is larger than the scene, {:.3g} x {:.3g} x {:.3g} m: are --radius, "
      "--height and --unit right?",
      across, body.height, size.x, size.y, size.z);
}

std::string explain(const WalkReport& report) {
  const RouteResult& result = report.result;
  switch (result.outcome) {
    case Outcome::reached:
      if (report.waypoints == 0) return fmt::format("the end of its time, having wandered to {}", at(result.end));
      return fmt::format("came to the last of {} waypoints at {}", report.waypoints, at(result.end));
    case Outcome::blocked:
      return explain_blocked(report);
    case Outcome::left_scene:
      return explain_left(report);
    case Outcome::fell: {
      const Vec3 from = first(result, EventKind::fell).value_or(result.end);
      const WalkerSettings& s = report.settings;
      const bool foot = s.support_radius > s.radius;
      return fmt::format("at {} the ground ends, or has a gap that a {} of {:g} m does not bridge; a larger one may",
                         at(from), foot ? "support radius" : "radius", foot ? s.support_radius : s.radius);
    }
    case Outcome::held:
      return explain_held(report);
  }
  return {};
}

Json json_report(const PagerStats& paging) {
  return {{"memory", paging.memory},
          {"used", paging.used},
          {"tiles", paging.tiles},
          {"pages", paging.pages},
          {"triangles", paging.triangles},
          {"wanted", paging.wanted},
          {"loads", paging.loads},
          {"evictions", paging.evictions},
          {"failures", paging.failures},
          {"failed", paging.failed},
          {"bytes_read", paging.bytes_read},
          {"worst_read_s", paging.worst_read_s},
          {"worst_decode_s", paging.worst_decode_s},
          {"ready_m", paging.ready_m},
          {"last_failure", paging.last_failure}};
}

Json json_report(const WalkReport& report) {
  const RouteResult& result = report.result;
  Json blocked = nullptr;
  if (result.blocked_at) {
    blocked = {{"point", to_json(result.blocked_at->point)},
               {"normal", to_json(result.blocked_at->normal)},
               {"triangle", result.blocked_at->triangle},
               {"object", report.object},
               {"opening_m", nullptr}};
    if (result.blocked_at->opening) blocked["opening_m"] = *result.blocked_at->opening;
  }
  Json events = Json::array();
  for (const RouteEvent& e : result.events) {
    events.push_back({{"step", e.step}, {"kind", to_string(e.event.kind)}, {"point", to_json(e.event.point)}});
  }
  Json json = {{"scene", report.scene},
               {"triangles", report.triangles},
               {"mode", to_string(report.mode)},
               {"radius", report.settings.radius},
               {"height", report.settings.height},
               {"support_radius", report.settings.support_radius},
               {"outcome", to_string(result.outcome)},
               {"why", explain(report)},
               {"length_m", result.length},
               {"steps", result.steps},
               {"simulated_s", result.simulated},
               {"step_ns", {{"median", report.times.median}, {"p99", report.times.p99}, {"max", report.times.max}}},
               {"least_clearance_m", nullptr},
               {"least_gap_m", nullptr},
               {"clearance_reach_m", report.settings.clearance_reach},
               {"violations", nullptr},
               {"throttled", result.throttled},
               {"blocked_at", blocked},
               {"waypoints_reached", result.waypoints},
               {"end", {{"position", to_json(result.end)}, {"eye", to_json(report.eye)}}},
               {"verified", nullptr},
               {"events", events}};
  if (knows_clearance(report)) {
    json["least_clearance_m"] = result.least_axis_clearance;
    json["least_gap_m"] = result.least_gap;
  }
  json["profile"] = report.profile.empty() ? Json(nullptr) : Json(report.profile);
  if (report.paging) json["paging"] = json_report(*report.paging);
  if (report.verified) {
    const verification::Verification& v = *report.verified;
    if (v.counted()) json["violations"] = v.violations;
    json["verified"] = {{"pieces", v.pieces},     {"distances", v.distances},
                        {"least_gap_m", nullptr}, {"overstated_clearances", v.overstated},
                        {"unread", v.unread},     {"seconds", report.verify_seconds}};
    if (v.least_gap) json["verified"]["least_gap_m"] = *v.least_gap;
  }
  return json;
}

std::string text_report(const WalkReport& report) {
  const RouteResult& result = report.result;
  std::string text = fmt::format("{}: {}\n", to_string(result.outcome), explain(report));
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<17}{}\n", what, printable_part(value));
  };
  if (const auto freed = first(result, EventKind::freed)) {
    line("start",
         fmt::format("did not fit where it was put, inside a wall or too near to one; freed to {}", at(*freed)));
  }
  line("scene", fmt::format("{}, {} triangles", report.scene, report.triangles));
  line("body", fmt::format("{}, radius {:g} m, height {:g} m", to_string(report.mode), report.settings.radius,
                           report.settings.height));
  if (report.settings.support_radius > 0.0)
    line("", fmt::format("support radius {:g} m", report.settings.support_radius));
  if (!report.profile.empty()) line("profile", report.profile);
  line("way", fmt::format("{:.2f} m in {:.1f} s, {} steps", result.length, result.simulated, result.steps));
  if (report.mode != Mode::ghost) {
    line("least clearance", clearance_line(report));
  }
  line("time of a step", fmt::format("{:.2f} us median, {:.2f} us p99, {:.2f} us at most", report.times.median * 1e-3,
                                     report.times.p99 * 1e-3, report.times.max * 1e-3));
  if (result.throttled > 0) line("throttled", fmt::format("{} steps ended early or were slowed", result.throttled));
  if (report.paging) {
    const PagerStats& p = *report.paging;
    line("paging", fmt::format("{}B of memory, {} loads, {} evictions, {}B read", short_count(double(p.memory)),
                               p.loads, p.evictions, short_count(double(p.bytes_read))));
    if (p.failed > 0) line("", fmt::format("{} tiles or pages are solid: {}", p.failed, p.last_failure));
  }
  if (report.verified) {
    const verification::Verification& v = *report.verified;
    line("verified", verification::summary(v) + ", " + short_time(report.verify_seconds));
    for (const std::string& remark : verification::remarks(v)) line("", remark);
  }
  return text;
}

}  // namespace roam::app
