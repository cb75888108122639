#include "engines_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "charts.h"
#include "leads.h"

namespace roam::bench {
namespace {

using app::Json;

double bytes_a_triangle(const Engine& engine, const SceneFindings& findings) {
  return static_cast<double>(engine.bytes) / static_cast<double>(findings.triangles);
}

std::string or_dash(bool there, const std::string& text) { return there ? text : "-"; }

/// The rows of sweeps, or all others.
std::string rows(const SceneFindings& findings, bool sweeps) {
  std::string out, last;
  for (const EngineRun& run : findings.runs) {
    if ((run.kind == QueryKind::sweep) != sweeps) continue;
    if (!last.empty() && last != run.set) out += "\n";
    last = run.set;
    const Verdict& v = run.verdict;
    const bool when = run.engine->says_when;
    out += fmt::format("{:<9} {:<27} {:>8} {:>7} {:>7} {:>7} {:>7} {:>9} {:>9.3g} {:>9.3g} {:>9.3g} {:>9.3g}\n",
                       run.set, run.engine->name, run.asked, v.missed, or_dash(when, std::to_string(v.late)),
                       or_dash(when, std::to_string(v.early)), v.false_hits,
                       or_dash(v.deepest > 0, fmt::format("{:.3g} mm", 1e3 * v.deepest)), 1e-3 * run.times.p50,
                       1e-3 * run.times.p99, 1e-3 * run.times.most, 1e-3 * run.times.hit_p50);
  }
  return out;
}

std::string table(const SceneFindings& findings, int rounds) {
  std::string out = fmt::format("{}; {} interleaved rounds, medians; us\n\n", findings.scene, rounds);
  out +=
      fmt::format("wrong: missed or late by more than {:g} mm of depth, early or false by more than {:g} mm of gap\n",
                  1e3 * depth_allowed, 1e3 * gap_allowed);
  const std::string head =
      fmt::format("{:<9} {:<27} {:>8} {:>7} {:>7} {:>7} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "set", "engine",
                  "queries", "missed", "late", "early", "false", "deepest", "p50", "p99", "max", "hit p50");
  const std::string sweeps = rows(findings, true), points = rows(findings, false);
  if (!sweeps.empty()) out += head + sweeps;
  if (!points.empty()) {
    out += fmt::format(
        "{}rays and nearest points; late: a ray more than {:g} mm behind the touch, a distance that much "
        "too great\n",
        sweeps.empty() ? "" : "\n", 1e3 * depth_allowed);
    out += head + points;
  }
  out +=
      fmt::format("\n{:<27} {:>10} {:>10} {:>10}   {}\n", "engine", "B/triangle", "build 1, s", "build 2, s", "used");
  for (const Engine& engine : findings.engines) {
    out += fmt::format("{:<27} {:>10} {:>10.3f} {:>10}   {}\n", engine.name,
                       or_dash(engine.bytes > 0, fmt::format("{:.1f}", bytes_a_triangle(engine, findings))),
                       engine.build_one, or_dash(engine.build_two > 0, fmt::format("{:.3f}", engine.build_two)),
                       engine.used);
  }
  for (const EngineFailure& failure : findings.failed) {
    out += fmt::format("{:<27} failed while it was {}: {}\n", failure.name,
                       failure.set.empty() ? "built" : "asked " + failure.set, failure.why);
  }
  return out;
}

std::string or_unknown(const Lead& lead) { return or_dash(lead.times > 0, fmt::format("{:.2f}", lead.times)); }

std::string lead_table(const std::vector<LeadRow>& rows) {
  if (rows.empty()) return {};
  std::size_t width = 0;
  for (const LeadRow& row : rows) width = std::max(width, row.scene.size());
  std::string out = fmt::format("times as fast as the fastest other engine, in each figure\n{:<{}}", "", width + 10);
  for (const char* figure : lead_figures) out += fmt::format(" {:>8}", figure);
  out += "\n";
  for (const LeadRow& row : rows) {
    out += fmt::format("{:<{}} {:<9}", row.scene, width, row.set);
    for (const Lead& lead : row.leads) out += fmt::format(" {:>8}", or_unknown(lead));
    out += "\n";
  }
  out += fmt::format("{:<{}}", "geometric mean", width + 10);
  for (std::size_t i = 0; i < lead_figures.size(); ++i) {
    const LeadSummary summary = summarize(rows, i);
    out += fmt::format(" {:>8}", or_dash(summary.worst != nullptr, fmt::format("{:.2f}", summary.mean)));
  }
  out += "\n";
  for (std::size_t i = 0; i < lead_figures.size(); ++i) {
    const LeadRow* worst = summarize(rows, i).worst;
    if (worst == nullptr) continue;
    out += fmt::format("worst row by {}: {:.2f} ({}, {}; {})\n", lead_figures[i], worst->leads[i].times, worst->scene,
                       worst->set, worst->leads[i].engine);
  }
  return out;
}

Json to_json(const EngineRun& run) {
  const Verdict& v = run.verdict;
  return {{"set", run.set},
          {"engine", run.engine->name},
          {"queries", run.asked},
          {"hits", v.hits},
          {"missed", v.missed},
          {"late", v.late},
          {"early", v.early},
          {"false", v.false_hits},
          {"says_when", run.engine->says_when},
          {"deepest_m", v.deepest},
          {"mean_us", 1e-3 * run.times.mean},
          {"p50_us", 1e-3 * run.times.p50},
          {"p99_us", 1e-3 * run.times.p99},
          {"max_us", 1e-3 * run.times.most},
          {"hit_p50_us", 1e-3 * run.times.hit_p50}};
}

Json to_json(const SceneFindings& findings) {
  Json engines = Json::array(), failed = Json::array(), runs = Json::array();
  for (const Engine& engine : findings.engines) {
    Json one{{"engine", engine.name},
             {"used", engine.used},
             {"bytes", engine.bytes},
             {"bytes_a_triangle", bytes_a_triangle(engine, findings)},
             {"build_one_thread_s", engine.build_one}};
    if (engine.build_two > 0) one["build_two_threads_s"] = engine.build_two;
    engines.push_back(one);
  }
  for (const EngineFailure& f : findings.failed) {
    failed.push_back({{"engine", f.name}, {"set", f.set}, {"why", f.why}});
  }
  for (const EngineRun& run : findings.runs) runs.push_back(to_json(run));
  return {{"scene", findings.scene},
          {"triangles", findings.triangles},
          {"engines", engines},
          {"failed", failed},
          {"runs", runs}};
}

Json to_json(const Lead& lead) {
  if (lead.times <= 0) return nullptr;
  return {{"times", lead.times}, {"engine", lead.engine}};
}

constexpr std::array<const char*, lead_figures.size()> lead_keys{"p50", "hit_p50", "p99"};

Json to_json(const LeadRow& row) {
  Json json{{"scene", row.scene}, {"set", row.set}};
  for (std::size_t i = 0; i < lead_keys.size(); ++i) json[lead_keys[i]] = to_json(row.leads[i]);
  return json;
}

Json lead_summaries(const std::vector<LeadRow>& rows) {
  Json json = Json::object();
  for (std::size_t i = 0; i < lead_keys.size(); ++i) {
    const LeadSummary summary = summarize(rows, i);
    if (summary.worst == nullptr) continue;
    const Lead& worst = summary.worst->leads[i];
    json[lead_keys[i]] = {{"mean", summary.mean},
                          {"worst", worst.times},
                          {"worst_scene", summary.worst->scene},
                          {"worst_set", summary.worst->set},
                          {"worst_engine", worst.engine}};
  }
  return json;
}

std::vector<LeadRow> leads_of(const EngineFindings& findings) {
  std::vector<LeadRow> rows;
  for (const SceneFindings& scene : findings.scenes) {
    for (LeadRow& row : leads_in(scene.scene, scene.runs)) rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

std::string engine_tables(const EngineFindings& findings) {
  std::string out;
  for (const SceneFindings& scene : findings.scenes) out.append(table(scene, findings.rounds)).append(1, '\n');
  for (const EngineOffer& offer : findings.absent) {
    out += fmt::format("{:<27} not here: {}\n", offer.name, offer.missing);
  }
  if (!findings.absent.empty()) out.append(1, '\n');
  return out + lead_table(leads_of(findings));
}

Json engine_json(const EngineFindings& findings) {
  Json absent = Json::array(), scenes = Json::array(), rows = Json::array();
  for (const EngineOffer& offer : findings.absent)
    absent.push_back({{"engine", offer.name}, {"missing", offer.missing}});
  for (const SceneFindings& scene : findings.scenes) scenes.push_back(to_json(scene));
  const std::vector<LeadRow> leads = leads_of(findings);
  for (const LeadRow& row : leads) rows.push_back(to_json(row));
  return {{"rounds", findings.rounds},
          {"depth_allowed_m", depth_allowed},
          {"gap_allowed_m", gap_allowed},
          {"absent", absent},
          {"scenes", scenes},
          {"leads", {{"rows", rows}, {"all", lead_summaries(leads)}}}};
}

draw::Sheet engine_chart(const EngineFindings& findings) {
  std::vector<BarGroup> groups;
  const bool one = findings.scenes.size() == 1;
  for (const SceneFindings& scene : findings.scenes) {
    std::string last;
    for (const EngineRun& run : scene.runs) {
      if (run.kind != QueryKind::sweep) continue;
      if (run.set != last) groups.push_back({one ? run.set : scene.scene + ": " + run.set, {}});
      last = run.set;
      const std::size_t wrong = run.verdict.missed + run.verdict.late;
      groups.back().bars.push_back({.name = run.engine->name,
                                    .p50 = 1e-3 * run.times.p50,
                                    .p99 = 1e-3 * run.times.p99,
                                    .note = wrong == 0 ? ""
                                                       : fmt::format("({:.2g} % missed or late)",
                                                                     100.0 * static_cast<double>(wrong) / run.asked),
                                    .stressed = run.engine->name == "roam"});
    }
  }
  return bar_chart(one ? "Sweeps, " + findings.scenes.front().scene : "Sweeps", groups);
}

app::ExitStatus engine_status(const EngineFindings& findings) {
  bool wrong = false;
  for (const SceneFindings& scene : findings.scenes) {
    for (const EngineFailure& failure : scene.failed) {
      if (failure.name == "roam") return app::failed;
    }
    wrong |= std::any_of(scene.runs.begin(), scene.runs.end(), [](const EngineRun& run) {
      return run.engine->name == "roam" && run.verdict.missed + run.verdict.late > 0;
    });
  }
  return wrong ? app::answer_no : app::done;
}

}  // namespace roam::bench
