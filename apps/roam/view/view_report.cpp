#include "view/view_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/progress.h"
#include "cli/tell.h"
#include "scenes/frame.h"
#include "words/walk.h"

namespace roam::app {
namespace {

Json to_json(const Times& times) { return {{"median", times.median}, {"p99", times.p99}, {"max", times.max}}; }

/// Degrees in (-180, 180].
double normalized(double yaw) {
  const double angle = std::remainder(yaw, 360.0) + 0.0;  // turns -0 into 0
  return angle <= -180.0 ? 180.0 : angle;
}

Json to_json(const Pose& pose) {
  return {{"position", app::to_json(pose.position)}, {"yaw", normalized(pose.yaw)}, {"pitch", pose.pitch}};
}

Json blockage(const ViewReport& report) {
  if (!report.result || !report.result->blocked_at) return nullptr;
  const Blockage& at = *report.result->blocked_at;
  Json json = {{"point", app::to_json(at.point)},
               {"normal", app::to_json(at.normal)},
               {"triangle", at.triangle},
               {"object", report.object},
               {"opening_m", nullptr}};
  if (at.opening) json["opening_m"] = *at.opening;
  return json;
}

Json to_json(const Pick& pick) {
  return {{"point", app::to_json(pick.point)},
          {"normal", app::to_json(pick.normal)},
          {"object", pick.object},
          {"slope_degrees", slope_degrees(pick)}};
}

Json to_json(const Measurement& measurement) {
  Json json = {{"a", to_json(measurement.a)}, {"b", nullptr}};
  if (!measurement.b) return json;
  const Span span = span_of(measurement.a.point, measurement.b->point);
  json["b"] = to_json(*measurement.b);
  json["distance_m"] = span.distance;
  json["level_m"] = span.level;
  json["height_m"] = span.height;
  json["slope_degrees"] = span.slope_degrees;
  return json;
}

}  // namespace

Times times(const Histogram& histogram, double scale) {
  return {scale * histogram.quantile(0.5), scale * histogram.quantile(0.99), scale * histogram.largest()};
}

void append(std::vector<std::string>& all, const std::vector<std::string>& more) {
  for (const std::string& one : more) {
    if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
  }
}

void add_earlier(ViewReport& report, ViewReport earlier) {
  using Report = ViewReport;
  for (const auto list : {&Report::notes, &Report::noted, &Report::written}) {
    append(earlier.*list, report.*list);
    report.*list = std::move(earlier.*list);
  }
  if (report.frame == earlier.frame) {
    const auto add = [](auto& all, const auto& before) { all.insert(all.begin(), before.begin(), before.end()); };
    add(report.measurements, earlier.measurements);
    add(report.probes, earlier.probes);
  }
  report.learned += earlier.learned;
  report.untold = earlier.untold + report.untold;
}

Json json_report(const ViewReport& report) {
  Json json = {{"scene", report.scene},
               {"frame", to_json(report.frame)},
               {"triangles", report.triangles},
               {"mode", to_string(report.mode)},
               {"radius", report.settings.radius},
               {"height", report.settings.height},
               {"outcome", nullptr},
               {"roamed", report.roamed},
               {"length_m", report.length},
               {"steps", report.steps},
               {"simulated_s", report.simulated},
               {"collision_ns", to_json(report.collision_ns)},
               {"collision_own_ns", to_json(report.collision_own_ns)},
               {"frames", report.frames},
               {"frame_ms", to_json(report.frame_ms)},
               {"draw_calls", to_json(report.draw_calls)},
               {"least_clearance_m", nullptr},
               {"violations", nullptr},
               {"throttled", report.throttled},
               {"blocked_at", blockage(report)},
               {"start", nullptr},
               {"end", to_json(report.end)},
               {"memory",
                {{"resident_bytes", report.resident_bytes},
                 {"world_bytes", report.world_bytes},
                 {"page_bytes", report.page_bytes}}},
               {"renderer", report.renderer},
               {"hud", report.hud},
               {"notes", report.notes},
               {"missing_textures", report.missing_textures},
               {"missing_texture_files", report.missing_texture_files},
               {"missing_pages", report.missing_pages},
               {"written", report.written}};
  json["profile"] = report.profile.empty() ? Json(nullptr) : Json(report.profile);
  json["learned"] = report.learned;
  json["store"] = report.store.empty() ? Json(nullptr) : Json(report.store);
  json["measurements"] = Json::array();
  for (const Measurement& measurement : report.measurements) json["measurements"].push_back(to_json(measurement));
  json["probes"] = Json::array();
  for (const ProbeReply& reply : report.probes) json["probes"].push_back(to_json(reply));
  json["hidden"] = {{"objects", report.hidden_objects}, {"passed", report.passes_objects}};
  json["section"] = Json::array();
  for (const auto& [normal, distance] : report.section.planes) {
    json["section"].push_back(Json::object({{"normal", to_json(normal)}, {"distance_m", distance}}));
  }
  json["section_passed"] = report.passes_section;
  json["section_box"] = nullptr;
  if (const auto& box = report.section.box) {
    json["section_box"] = Json::object({{"lower", to_json(box->lower)}, {"upper", to_json(box->upper)}});
  }
  if (report.paging) json["paging"] = to_json(*report.paging);
  json["end"]["eye"] = app::to_json(report.eye);
  if (report.start) json["start"] = to_json(*report.start);
  if (report.least_axis_clearance) json["least_clearance_m"] = *report.least_axis_clearance;
  if (report.result) {
    if (report.path_ended) json["outcome"] = to_string(report.result->outcome);
    json["waypoints_reached"] = report.result->waypoints;
  }
  if (report.verified) {
    if (report.verified->counted()) json["violations"] = report.verified->violations;
    json["verified"] = {{"pieces", report.verified->pieces},
                        {"distances", report.verified->distances},
                        {"least_gap_m", nullptr},
                        {"overstated_clearances", report.verified->overstated},
                        {"unread", report.verified->unread}};
    if (report.verified->least_gap) json["verified"]["least_gap_m"] = *report.verified->least_gap;
  }
  return json;
}

std::string text_report(const ViewReport& report) {
  std::string text;
  if (report.result) {
    if (report.path_ended) {
      words::EndedWalk walk;
      walk.mode = report.mode;
      walk.settings = report.settings;
      walk.result = *report.result;
      walk.waypoints = report.waypoints;
      walk.object = report.object;
      walk.slope = report.slope;
      text += fmt::format("{}: {}\n", to_string(report.result->outcome), words::explain(walk));
    } else {
      text += "ended before the path did\n";
    }
    text += fmt::format("{} of {} waypoints, {:.2f} m in {:.1f} s\n", report.result->waypoints, report.waypoints,
                        report.length, report.simulated);
  }
  if (report.verified) {
    text += fmt::format("verified: {}\n", summary(*report.verified));
  }
  return text + report.untold;
}

std::string measured_line(const Measurement& measurement) {
  return fmt::format("measured: {}\n", text_of(measurement));
}

std::string written_line(const std::string& file) { return fmt::format("written: {}\n", printable_part(file)); }

}  // namespace roam::app
