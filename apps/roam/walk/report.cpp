#include "walk/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/progress.h"
#include "cli/tell.h"
#include "scenes/frame.h"
#include "words/lines.h"
#include "words/measures.h"
#include "words/verification.h"

namespace roam::app {
namespace {

/// The least clearance as a lower bound: reported clearances may be too low, and have a maximum.
std::string clearance_line(const WalkReport& report) {
  const RouteResult& result = report.result;
  if (!words::knows_clearance(report)) return "not known: the body fitted nowhere";
  const double reach = report.settings.clearance_reach;
  constexpr double near_cap = 0.7;  // share of the reach: above, there may have been no surface nearby
  const std::string cap = result.least_gap < near_cap * reach
                              ? ""
                              : fmt::format("; it was looked for no farther than {:g} m from the surface", reach);
  return fmt::format("at least {:.6f} m from its axis, {:.6f} m from its surface (certified{})",
                     result.least_axis_clearance, result.least_gap, cap);
}

/// "0.60 m wide and 1.80 m high, walking, on a support disc of radius 0.645 m, from gallery.ply.roam.json".
std::string body_line(const WalkReport& report) {
  const WalkerSettings& s = report.settings;
  std::string text = words::size_of(s.radius, s.height);
  text += report.mode == Mode::walk ? ", walking" : report.mode == Mode::fly ? ", flying" : ", a ghost";
  if (report.mode == Mode::walk && s.support_radius > s.radius) {
    text += fmt::format(", with a support disc {:.2f} m wide", 2.0 * s.support_radius);
  }
  return report.profile.empty() ? text : text + " (trained: " + printable_part(report.profile) + ")";
}

Json wall(const Vec3& point, const std::string& object) { return {{"point", to_json(point)}, {"object", object}}; }

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
               {"frame", to_json(report.frame)},
               {"triangles", report.triangles},
               {"mode", to_string(report.mode)},
               {"radius", report.settings.radius},
               {"height", report.settings.height},
               {"support_radius", report.settings.support_radius},
               {"outcome", words::outcome(report)},
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
               {"narrowest", nullptr},
               {"headroom", nullptr},
               {"ducked", report.ducked},
               {"measured_beside_m", report.reach},
               {"waypoints_reached", result.waypoints},
               {"end", {{"position", to_json(result.end)}, {"eye", to_json(report.eye)}}},
               {"verified", nullptr},
               {"events", events}};
  if (words::knows_clearance(report)) {
    json["least_clearance_m"] = result.least_axis_clearance;
    json["least_gap_m"] = result.least_gap;
  }
  if (report.narrowest) {
    const measure::NarrowPlace& n = *report.narrowest;
    json["narrowest"] = {{"width_m", n.width},
                         {"spare_m", n.spare()},
                         {"point", to_json(n.centre)},
                         {"along_m", n.along},
                         {"left", wall(n.left, report.left)},
                         {"right", wall(n.right, report.right)}};
  }
  if (report.lowest) {
    json["headroom"] = {{"height_m", report.lowest->height},
                        {"point", to_json(report.lowest->centre)},
                        {"along_m", report.lowest->along}};
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
  json["interrupted"] = report.interrupted;
  return json;
}

std::string text_report(const WalkReport& report) {
  const RouteResult& result = report.result;
  words::Lines lines(words::headline(report));
  if (report.interrupted || result.outcome != Outcome::reached) lines.add("why", words::explain(report));
  if (const auto freed = words::first(result, EventKind::freed)) {
    lines.add("start", fmt::format("did not fit where it was put, inside a wall or too near to one; freed to {}",
                                   words::exactly_at(*freed)));
  }
  lines.add("narrowest", words::narrowest_place(report));
  lines.add("headroom", words::headroom(report));
  if (report.mode == Mode::fly && words::knows_clearance(report)) {
    lines.add("nearest", fmt::format("at least {} from everything", words::metres(std::max(0.0, result.least_gap))));
  }
  lines.add("body", body_line(report));
  if (report.paging && report.paging->failed > 0) {
    lines.add("not read", fmt::format("{} solid: {}",
                                      report.paging->failed == 1
                                          ? "1 tile or page of the store is"
                                          : fmt::format("{} tiles or pages of the store are", report.paging->failed),
                                      printable_part(report.paging->last_failure)));
  }
  if (report.verified) {
    lines.add("checked", words::checked(*report.verified, report.triangles));
    for (const std::string& remark : verification::remarks(*report.verified)) lines.add("", printable_part(remark));
  }
  return lines.text();
}

std::string stats_report(const WalkReport& report) {
  const RouteResult& result = report.result;
  std::string text;
  const auto line = [&](const char* what, const std::string& value) {
    text += fmt::format("  {:<17}{}\n", what, printable_part(value));
  };
  line("scene", fmt::format("{}, {} triangles", report.scene, report.triangles));
  line("steps", fmt::format("{} in {:.1f} s, to {}", result.steps, result.simulated, words::exactly_at(result.end)));
  if (report.mode != Mode::ghost) line("least clearance", clearance_line(report));
  line("time of a step", fmt::format("{:.2f} us median, {:.2f} us p99, {:.2f} us at most", report.times.median * 1e-3,
                                     report.times.p99 * 1e-3, report.times.max * 1e-3));
  if (result.throttled > 0) line("throttled", fmt::format("{} steps ended early or were slowed", result.throttled));
  if (report.paging) {
    const PagerStats& p = *report.paging;
    line("paging", fmt::format("{}B of memory, {} loads, {} evictions, {}B read", short_count(double(p.memory)),
                               p.loads, p.evictions, short_count(double(p.bytes_read))));
  }
  if (report.verified) {
    line("verified", verification::summary(*report.verified) + ", " + short_time(report.verify_seconds));
  }
  return text;
}

}  // namespace roam::app
