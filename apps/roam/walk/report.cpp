#include "walk/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/progress.h"
#include "cli/tell.h"
#include "words/measures.h"

namespace roam::app {
namespace {

/// A bound: clearances may be told a quarter of the gap, two skins and 2 mm less than they are, and are capped.
std::string clearance_line(const WalkReport& report) {
  const RouteResult& result = report.result;
  if (!words::knows_clearance(report)) return "not known: the body fitted nowhere";
  const double reach = report.settings.clearance_reach;
  constexpr double near_cap = 0.7;  // of the reach: from here on nothing need have been there
  const std::string cap = result.least_gap < near_cap * reach
                              ? ""
                              : fmt::format("; it was looked for no farther than {:g} m from the surface", reach);
  return fmt::format("at least {:.6f} m from its axis, {:.6f} m from its surface (certified{})",
                     result.least_axis_clearance, result.least_gap, cap);
}

}  // namespace

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
               {"why", words::explain(report)},
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
  if (words::knows_clearance(report)) {
    json["least_clearance_m"] = result.least_axis_clearance;
    json["least_gap_m"] = result.least_gap;
  }
  json["profile"] = report.profile.empty() ? Json(nullptr) : Json(report.profile);
  if (report.paging) json["paging"] = to_json(*report.paging);
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
  std::string text = fmt::format("{}: {}\n", to_string(result.outcome), words::explain(report));
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<17}{}\n", what, printable_part(value));
  };
  if (const auto freed = words::first(result, EventKind::freed)) {
    line("start", fmt::format("did not fit where it was put, inside a wall or too near to one; freed to {}",
                              words::exactly_at(*freed)));
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
