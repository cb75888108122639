#include "train/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "cli/progress.h"
#include "cli/tell.h"
#include "math/level_distance.h"
#include "math/step_limit.h"
#include "scenes/frame.h"
#include "words/measures.h"
#include "words/training.h"

namespace roam::app {
namespace {

using words::at;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json json_of(const TrainedPath& path) {
  Json trials = Json::array();
  for (const Trial& t : path.trials) {
    trials.push_back({{"radius", t.radius},
                      {"support_radius", t.support_radius},
                      {"outcome", roam::to_string(t.outcome)},
                      {"at", to_json(t.at)}});
  }
  Json way = Json::array();
  for (const Vec3& p : path.way) way.push_back(to_json(p));
  return {{"from", to_json(path.from)}, {"to", to_json(path.to)},      {"largest", or_null(path.largest)},
          {"smallest", path.smallest},  {"trials", std::move(trials)}, {"way", std::move(way)}};
}

/// "5 paths, 12 trials: 8 reached, 2 blocked, 2 fell"
std::string trials_line(const Training& t) {
  std::map<std::string, std::size_t> outcomes;
  std::size_t trials = 0;
  for (const TrainedPath& path : t.paths) {
    for (const Trial& trial : path.trials) {
      ++trials;
      ++outcomes[roam::to_string(trial.outcome)];
    }
  }
  std::string text = fmt::format("{} paths, {} trials", t.paths.size(), trials);
  const char* separator = ": ";
  for (const auto& [outcome, count] : outcomes) {
    text += fmt::format("{}{} {}", separator, count, outcome);
    separator = ", ";
  }
  return text;
}

/// z of the floor above or below a point: at the nearest position of all ways, seen from above.
double floor_under(const Training& training, const Vec3& point) {
  double least = std::numeric_limits<double>::infinity(), z = point.z;
  for (const TrainedPath& path : training.paths) {
    for (std::size_t i = 1; i < path.way.size(); ++i) {
      const Vec3 from = path.way[i - 1], along = path.way[i] - from;
      const double squared = along.x * along.x + along.y * along.y;
      const Vec3 to = point - from;
      const double part = squared > 0.0 ? std::clamp((to.x * along.x + to.y * along.y) / squared, 0.0, 1.0) : 0.0;
      const Vec3 foot = from + part * along;
      const double apart = level_distance(point, foot);
      if (apart < least && foot.z <= point.z + 1.0) {
        least = apart;
        z = foot.z;
      }
    }
  }
  return z;
}

}  // namespace

Json json_report(const TrainReport& report) {
  const Training& t = report.training;
  Json paths = Json::array(), decisive = Json::array(), regions = Json::array(), cracks = Json::array();
  for (const TrainedPath& path : t.paths) paths.push_back(json_of(path));
  for (const words::Decisive& d : words::decisive(t)) {
    const std::size_t i = decisive.size();
    decisive.push_back(
        {{"kind", d.kind()}, {"point", to_json(d.point)}, {"width_m", d.width}, {"direction", to_json(d.direction)}});
    if (i < report.names.size()) decisive.back()["objects"] = {report.names[i].first, report.names[i].second};
  }
  for (const SizeRegion& r : t.regions) {
    regions.push_back(
        {{"bounds", to_json(r.bounds)}, {"radius", r.radius}, {"support_radius", r.support_radius}, {"why", r.why}});
  }
  for (const Crack& c : t.cracks) {
    cracks.push_back({{"kind", to_string(c.kind)},
                      {"point", to_json(c.point)},
                      {"width_m", 2.0 * c.radius},
                      {"direction", to_json(c.direction)},
                      {"on_a_path", c.on_a_path}});
  }
  Json contradictions = Json::array();
  for (const Contradiction& c : t.contradictions) contradictions.push_back(words::contradiction(c));
  Json parts = Json::array();
  for (const ConnectedPart& p : t.parts) {
    parts.push_back({{"place", to_json(p.place)},
                     {"area_m2", report.options.mode == Mode::walk ? Json(p.area) : Json(nullptr)},
                     {"places", p.places},
                     {"trained", p.trained},
                     {"whole", p.whole},
                     {"why", words::why(p.left_out)}});
  }
  Json json = {{"scene", report.scene},
               {"frame", to_json(report.frame)},
               {"triangles", report.triangles},
               {"mode", roam::to_string(report.options.mode)},
               {"method", to_string(report.options.method)},
               {"seed", report.options.seed},
               {"answer", words::answer(t, report.options)},
               {"radius", t.radius},
               {"height", t.height},
               {"support_radius", t.support_radius},
               {"step", t.step},
               {"slope", t.slope_degrees},
               {"spacing", report.options.spacing},
               {"interval", {{"min", t.smallest}, {"max", or_null(t.largest)}}},
               {"trapped_radius", t.trapped_radius},
               {"feasible", t.feasible},
               {"complete", t.complete},
               {"paths", std::move(paths)},
               {"decisive", std::move(decisive)},
               {"regions", std::move(regions)},
               {"cracks", std::move(cracks)},
               {"contradictions", std::move(contradictions)},
               {"parts", std::move(parts)},
               {"places", t.places},
               {"profile", nullptr},
               {"seconds", t.seconds}};
  if (!report.profile.empty()) json["profile"] = report.profile.string();
  return json;
}

std::string text_report(const TrainReport& report) {
  return words::report(report.training, report.options, report.names, report.profile.string(), report.is_beside);
}

std::string stats_report(const TrainReport& report) {
  const Training& t = report.training;
  std::string text;
  const auto line = [&](const std::string& what, const std::string& value) {
    text += fmt::format("  {:<17}{}\n", what, printable_part(value));
  };
  std::string body =
      fmt::format("{}, radius {:.3f} m, height {:.3f} m", roam::to_string(report.options.mode), t.radius, t.height);
  if (t.support_radius > 0.0) body += fmt::format(", support disc of radius {:.3f} m", t.support_radius);
  line("body", body);
  if (!t.paths.empty()) {
    line("interval", fmt::format("{} to {}", t.smallest > 0.0 ? fmt::format("{:.4f} m", t.smallest) : "0",
                                 t.largest ? fmt::format("{:.4f} m", *t.largest) : "not limited") +
                         (t.feasible ? "" : ": no one radius"));
  }
  if (t.trapped_radius > 0.0)
    line("trapped", fmt::format("a rolling sphere below {:.3f} m cannot climb out of that crack", t.trapped_radius));
  for (const words::Decisive& d : words::decisive(t))
    line(d.kind(), fmt::format("{:.4f} m wide at {}", d.width, at(d.point)));
  std::map<std::string, std::size_t> kinds;
  for (const Crack& c : t.cracks) ++kinds[to_string(c.kind)];
  for (const auto& [kind, count] : kinds) line(kind, fmt::format("{}", count));
  for (const SizeRegion& r : t.regions)
    line("region", fmt::format("radius {:.3f} m at {}: {}", r.radius, at(r.bounds.center()), r.why));
  line("roamed", trials_line(t));
  for (const ConnectedPart& p : t.parts) {
    line("part", fmt::format("{:.0f} m2, {} places about {}{}", p.area, p.places, at(p.place),
                             p.trained ? "" : std::string(": ") + words::why(p.left_out)));
  }
  line("time", fmt::format("{}, {} places", short_time(t.seconds), t.places));
  return text;
}

std::vector<draw::OpeningView> views_of(const TrainReport& report) {
  const Training& t = report.training;
  std::vector<draw::OpeningView> views;
  for (const words::Decisive& d : words::decisive(t)) {
    draw::OpeningView view;
    const bool split = d.split;
    view.kind = split ? draw::OpeningView::Kind::crack : draw::OpeningView::Kind::passage;
    view.heading = fmt::format("{} {:.3f} m wide", split ? "Crack" : "Opening", d.width);
    view.text = split ? fmt::format("Carries no body or support disc below a radius of {:.3f} m.", t.smallest)
                      : fmt::format("Lets a radius of {:.3f} m through, at most.", t.largest.value_or(0.0));
    view.point = d.point;
    view.direction = d.direction;
    view.width = d.width;
    view.mode = report.options.mode;
    view.floor = split ? d.point.z : floor_under(t, d.point);
    if (view.mode == Mode::fly) view.floor = d.point.z - t.radius;
    view.radius = t.radius;
    view.height = t.height;
    view.step = std::min(t.step, step_limit(view.height));
    view.support_radius = t.support_radius;
    view.fits = split ? std::max(t.radius, t.support_radius) > 0.5 * d.width : 2.0 * t.radius < d.width;
    views.push_back(std::move(view));
  }
  return views;
}

}  // namespace roam::app
