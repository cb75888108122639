#include "walkers_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "charts.h"
#include "judge.h"
#include "roam/generate.h"
#include "timing.h"

namespace roam::bench {
namespace {

using app::Json;

const ControllerWalk* best_other(const WalkerFindings& findings, const ControllerWalk& own,
                                 std::vector<double> ControllerWalk::*figure) {
  const ControllerWalk* best = nullptr;
  for (const ControllerWalk& walk : findings.walks) {
    if (walk.way != own.way || &walk == &own || walk.judged.ending != Ending::reached) continue;
    if (best == nullptr || median(walk.*figure) < median(best->*figure)) best = &walk;
  }
  return best;
}

std::string times(double value) { return value > 0.0 ? fmt::format("{:.2f}", value) : "-"; }

}  // namespace

std::vector<Way> walkers_ways(const Vec3& shift) {
  constexpr double radius = 0.3, height = 1.8, walking = 1.4, fast = 50.0;  // m, m/s
  const Vec3 from = generate::gallery_paths[0].from + shift, to = generate::gallery_paths[0].to + shift;
  return {{"on foot, 1.4 m/s", from, to, radius, walking, true, false, height},
          {"on foot, 50 m/s", from, to, radius, fast, true, false, height},
          {"flying, 1.4 m/s", from, to, radius, walking, false, false}};
}

void ControllerWalk::add(const Walked& walked) {
  if (p50.empty()) steps = walked.nanoseconds.size();
  std::vector<double> sorted = walked.nanoseconds;
  std::sort(sorted.begin(), sorted.end());
  p50.push_back(1e-3 * quantile(sorted, 0.5));
  p99.push_back(1e-3 * quantile(sorted, 0.99));
  most.push_back(1e-3 * quantile(sorted, 1.0));
}

std::vector<WalkerLead> walker_leads(const WalkerFindings& findings) {
  std::vector<WalkerLead> leads;
  for (const ControllerWalk& own : findings.walks) {
    if (own.controller != "roam") continue;
    WalkerLead& lead = leads.emplace_back();
    lead.way = own.way;
    const ControllerWalk* p50 = best_other(findings, own, &ControllerWalk::p50);
    if (p50 == nullptr) continue;
    lead.p50 = median(p50->p50) / median(own.p50);
    lead.p99 = median(best_other(findings, own, &ControllerWalk::p99)->p99) / median(own.p99);
  }
  return leads;
}

std::string walkers_tables(const WalkerFindings& findings) {
  std::string out = fmt::format("{}; {} interleaved rounds, medians; us a step\n\n", findings.scene, findings.rounds);
  out += fmt::format("in walls: steps deeper than {:g} mm\n", 1e3 * depth_allowed);
  out += fmt::format("{:<18} {:<11} {:<15} {:>7} {:>9} {:>11} {:>9} {:>9} {:>9}\n", "way", "controller", "outcome",
                     "steps", "in walls", "deepest", "p50", "p99", "max");
  std::string last;
  for (const ControllerWalk& walk : findings.walks) {
    if (!last.empty() && last != walk.way) out += "\n";
    last = walk.way;
    out += fmt::format("{:<18} {:<11} {:<15} {:>7} {:>9} {:>8.3g} mm {:>9.3g} {:>9.3g} {:>9.3g}\n", walk.way,
                       walk.controller, to_string(walk.judged.ending), walk.steps, walk.judged.in_walls,
                       1e3 * walk.judged.deepest, median(walk.p50), median(walk.p99), median(walk.most));
  }
  out += fmt::format("\n{:<44} {:>8} {:>8}\n", "times as fast as the fastest other controller", "p50", "p99");
  for (const WalkerLead& lead : walker_leads(findings)) {
    out += fmt::format("{:<45} {:>8} {:>8}\n", lead.way, times(lead.p50), times(lead.p99));
  }
  out += "\n";
  for (const ControllerWalk& walk : findings.walks) {
    if (walk.way == findings.walks.front().way) out += fmt::format("{:<11} {}\n", walk.controller, walk.used);
  }
  for (const ControllerFailure& failure : findings.failed) {
    out += fmt::format("{:<11} failed: {}\n", failure.controller, failure.why);
  }
  for (const Controller& controller : findings.absent) {
    out += fmt::format("{:<11} not here: {}\n", controller.name, controller.missing);
  }
  return out;
}

Json walkers_json(const WalkerFindings& findings) {
  Json walks = Json::array(), leads = Json::array(), absent = Json::array(), failed = Json::array();
  for (const ControllerWalk& walk : findings.walks) {
    walks.push_back({{"way", walk.way},
                     {"controller", walk.controller},
                     {"used", walk.used},
                     {"outcome", to_string(walk.judged.ending)},
                     {"steps", walk.steps},
                     {"steps_in_walls", walk.judged.in_walls},
                     {"deepest_m", walk.judged.deepest},
                     {"p50_us", median(walk.p50)},
                     {"p99_us", median(walk.p99)},
                     {"max_us", median(walk.most)}});
  }
  const auto known = [](double value) { return value > 0.0 ? Json(value) : Json(nullptr); };
  for (const WalkerLead& lead : walker_leads(findings)) {
    leads.push_back({{"way", lead.way}, {"p50", known(lead.p50)}, {"p99", known(lead.p99)}});
  }
  for (const Controller& controller : findings.absent) {
    absent.push_back({{"controller", controller.name}, {"missing", controller.missing}});
  }
  for (const ControllerFailure& f : findings.failed) failed.push_back({{"controller", f.controller}, {"why", f.why}});
  return {{"scene", findings.scene}, {"rounds", findings.rounds}, {"walks", walks},
          {"leads", leads},          {"absent", absent},          {"failed", failed}};
}

draw::Sheet walkers_chart(const WalkerFindings& findings) {
  std::vector<BarGroup> groups;
  for (const ControllerWalk& walk : findings.walks) {
    if (groups.empty() || groups.back().title != walk.way) groups.push_back({walk.way, {}});
    std::string note;
    if (walk.judged.in_walls > 0) {
      note = fmt::format("({} steps in walls, up to {:.2g} mm)", walk.judged.in_walls, 1e3 * walk.judged.deepest);
    }
    if (walk.judged.ending != Ending::reached) note += fmt::format(" {}", to_string(walk.judged.ending));
    groups.back().bars.push_back({.name = walk.controller,
                                  .p50 = median(walk.p50),
                                  .p99 = median(walk.p99),
                                  .note = note,
                                  .stressed = walk.controller == "roam"});
  }
  return bar_chart("A step, " + findings.scene, groups);
}

app::ExitStatus walkers_status(const WalkerFindings& findings) {
  if (std::any_of(findings.failed.begin(), findings.failed.end(),
                  [](const ControllerFailure& failure) { return failure.controller == "roam"; })) {
    return app::failed;
  }
  const bool in_wall = std::any_of(findings.walks.begin(), findings.walks.end(), [](const ControllerWalk& walk) {
    return walk.controller == "roam" && walk.judged.in_walls > 0;
  });
  return in_wall ? app::answer_no : app::done;
}

}  // namespace roam::bench
