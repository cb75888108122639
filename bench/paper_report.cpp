#include "paper_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>

#include "charts.h"
#include "timing.h"

namespace roam::bench {
namespace {

using app::Json;

// Indices in paper_ways.
constexpr std::size_t straight = 0, corner = 1, split = 2, room = 4, adapted = 5, table_1_ways = 3;

/// Summary of some steps, microseconds.
struct Steps {
  std::size_t count = 0, jams = 0;
  double p50 = 0.0, p99 = 0.0, most = 0.0, sum = 0.0;
};

Steps steps_of(const RowFindings& row, const std::vector<std::size_t>& ways) {
  std::vector<double> all;
  for (const std::size_t way : ways) {
    const auto& times = row.result.ways[way].nanoseconds;
    all.insert(all.end(), times.begin(), times.end());
  }
  if (all.empty()) return {};
  std::sort(all.begin(), all.end());
  const auto at = [&](double part) { return 1e-3 * quantile(all, part); };
  Steps steps{all.size(), 0, at(0.5), at(0.99), at(1.0), 1e-3 * std::accumulate(all.begin(), all.end(), 0.0)};
  steps.jams =
      static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](double ns) { return ns > 1e9 * jam; }));
  return steps;
}

/// Seconds, as the paper seems to count them: the time of the way at its speed, plus the time of the steps.
double time_of_way(const Steps& steps) { return static_cast<double>(steps.count) / paper_rate + 1e-6 * steps.sum; }

/// One way of one row.
struct Cell1 {
  const RowFindings& row;
  std::size_t way;
  [[nodiscard]] const Judgement& judged() const { return row.judged[way]; }
  [[nodiscard]] bool cut() const { return judged().ending == Ending::cut; }
  [[nodiscard]] Steps steps() const { return steps_of(row, {way}); }
  /// The least radius of the body.
  [[nodiscard]] double radius() const {
    const auto& radii = row.result.ways[way].radii;
    return radii.empty() ? 0.0 : *std::min_element(radii.begin(), radii.end());
  }
};

/// One row of Table 2.
struct Cells2 {
  double load_s = 0.0, peak_mib = 0.0;
  Steps steps;
  int flew_off = 0, ended = 0;  // of Table 1's three ways
  bool massive = false;
  std::optional<bool> room_entered{}, radius_adapts{};  // empty: the way was cut
};

std::optional<bool> completed(const Judgement& judged) {
  if (judged.ending == Ending::cut) return std::nullopt;
  return judged.ending == Ending::reached;
}

Cells2 cells_2(const RowFindings& row) {
  Cells2 cells{row.result.load_seconds, static_cast<double>(row.result.peak_bytes) / (1 << 20),
               steps_of(row, {straight, corner})};
  for (std::size_t way = 0; way < table_1_ways; ++way) {
    const Ending ending = row.judged[way].ending;
    cells.flew_off += ending == Ending::fell || ending == Ending::through ? 1 : 0;
    cells.ended += ending == Ending::cut ? 0 : 1;
  }
  cells.room_entered = completed(row.judged[room]);
  cells.massive = row.result.peak_bytes <= massive_limit;
  cells.radius_adapts = row.result.adapts ? completed(row.judged[adapted]) : false;
  return cells;
}

const char* yes(std::optional<bool> is) { return !is ? "not finished" : *is ? "yes" : "no"; }

Json known(std::optional<bool> is) { return is ? Json(*is) : Json(nullptr); }

bool failed(const RowFindings& row) { return row.row->load && row.judged.empty(); }

std::string outcome(const Judgement& judged, double patience) {
  if (judged.ending == Ending::cut) return fmt::format("{} in {:g} s", to_string(judged.ending), patience);
  return to_string(judged.ending);
}

std::string table_1(const PaperFindings& findings) {
  std::string out =
      fmt::format("{:<18} {:>6} {:<26} {:<22} {:>9} {:>7} {:>9} {:>9} {:>9} {:>9} {:>10}\n", "way", "r, m", "row",
                  "outcome", "time, s", "steps", "p50, us", "p99, us", "max, us", "in walls", "deepest");
  if (std::all_of(findings.rows.begin(), findings.rows.end(), [](const auto& row) { return row.judged.empty(); })) {
    return out + "no row went a way\n\n";
  }
  for (std::size_t way = 0; way < findings.ways.size(); ++way) {
    for (const RowFindings& row : findings.rows) {
      if (row.judged.empty()) continue;
      const Cell1 cell{row, way};
      const Steps s = cell.steps();
      const Judgement& j = cell.judged();
      out += fmt::format("{:<18} {:>6.3g} {:<26} {:<22} {:>9} {:>7} {:>9.3g} {:>9.3g} {:>9.3g} {:>9} {:>7.3g} mm\n",
                         findings.ways[way].name, cell.radius(), row.row->title, outcome(j, findings.patience),
                         cell.cut() ? "-" : fmt::format("{:.4g}", time_of_way(s)), s.count, s.p50, s.p99, s.most,
                         j.in_walls, 1e3 * j.deepest);
    }
    out += "\n";
  }
  return out;
}

std::string table_2(const PaperFindings& findings) {
  std::string out =
      fmt::format("{:<26} {:>8} {:>9} {:>9} {:>9} {:>6} {:>9} {:>12} {:>13} {:>14}\n", "row", "load, s", "peak, MiB",
                  "p50, us", "p99, us", "jams", "flew off", "small room", "within 1 GiB", "radius adapts");
  for (const RowFindings& row : findings.rows) {
    if (row.judged.empty()) {
      out += fmt::format("{:<26} {}\n", row.row->title,
                         failed(row) ? "failed: " + row.result.failure : "not here: " + row.row->missing);
      continue;
    }
    const Cells2 c = cells_2(row);
    out += fmt::format("{:<26} {:>8.3g} {:>9.1f} {:>9.3g} {:>9.3g} {:>6} {:>7}/{} {:>12} {:>13} {:>14}\n",
                       row.row->title, c.load_s, c.peak_mib, c.steps.p50, c.steps.p99, c.steps.jams, c.flew_off,
                       c.ended, yes(c.room_entered), yes(c.massive), yes(c.radius_adapts));
  }
  return out;
}

}  // namespace

std::string paper_tables(const PaperFindings& findings) {
  std::string out = fmt::format(
      "{}, laid out in {:.1f} s; us of the thread's own time a step; PhysX's by the clock of its process\n\n",
      findings.scene, findings.prepared);
  out += "Table 1: the ways. Time: the way at its speed and the time of its steps.\n" + table_1(findings);
  out +=
      "Table 2: the rows. Steps of ways 1 and 2; a jam is a step of over 16 ms; flew off: fell, or went through a "
      "wall.\n" +
      table_2(findings);
  out += "\n";
  for (const RowFindings& row : findings.rows) {
    if (row.row->load) out += fmt::format("{:<26} {}\n", row.row->title, row.row->how);
  }
  return out;
}

Json paper_json(const PaperFindings& findings) {
  Json table_1 = Json::array(), table_2 = Json::array(), absent = Json::array(), broken = Json::array();
  for (const RowFindings& row : findings.rows) {
    if (row.judged.empty()) {
      const Json why = failed(row) ? row.result.failure : row.row->missing;
      (failed(row) ? broken : absent).push_back({{"row", row.row->name}, {"title", row.row->title}, {"why", why}});
      continue;
    }
    for (std::size_t way = 0; way < findings.ways.size(); ++way) {
      const Cell1 cell{row, way};
      const Steps s = cell.steps();
      table_1.push_back({{"way", findings.ways[way].name},
                         {"row", row.row->name},
                         {"radius_m", cell.radius()},
                         {"outcome", to_string(cell.judged().ending)},
                         {"time_s", cell.cut() ? Json(nullptr) : Json(time_of_way(s))},
                         {"steps", s.count},
                         {"p50_us", s.p50},
                         {"p99_us", s.p99},
                         {"max_us", s.most},
                         {"steps_in_walls", cell.judged().in_walls},
                         {"deepest_m", cell.judged().deepest}});
    }
    const Cells2 c = cells_2(row);
    table_2.push_back({{"row", row.row->name},
                       {"title", row.row->title},
                       {"how", row.row->how},
                       {"load_s", c.load_s},
                       {"peak_mib", c.peak_mib},
                       {"p50_us", c.steps.p50},
                       {"p99_us", c.steps.p99},
                       {"jams", c.steps.jams},
                       {"flew_off", c.flew_off},
                       {"ways_ended", c.ended},
                       {"small_room", known(c.room_entered)},
                       {"within_1_gib", c.massive},
                       {"radius_adapts", known(c.radius_adapts)}});
  }
  return {{"scene", findings.scene},         {"triangles", findings.triangles}, {"laid_out_s", findings.prepared},
          {"patience_s", findings.patience}, {"table_1", std::move(table_1)},   {"table_2", std::move(table_2)},
          {"absent", std::move(absent)},     {"failed", std::move(broken)}};
}

app::ExitStatus paper_status(const PaperFindings& findings) {
  bool in_wall = false;
  for (const RowFindings& row : findings.rows) {
    if (!row.row->name.starts_with("roam")) continue;
    if (failed(row)) return app::failed;
    in_wall |= std::any_of(row.judged.begin(), row.judged.end(), [](const Judgement& j) { return j.in_walls > 0; });
  }
  return in_wall ? app::answer_no : app::done;
}

draw::Sheet paper_chart(const PaperFindings& findings) {
  std::vector<BarGroup> groups;
  for (std::size_t way = 0; way < table_1_ways; ++way) {
    BarGroup& group = groups.emplace_back();
    group.title = "way " + findings.ways[way].name;
    for (const RowFindings& row : findings.rows) {
      if (row.judged.empty()) continue;
      const Cell1 cell{row, way};
      const Steps s = cell.steps();
      group.bars.push_back({.name = row.row->title,
                            .p50 = s.p50,
                            .p99 = s.p99,
                            .note = outcome(cell.judged(), findings.patience),
                            .stressed = row.row->name.starts_with("roam")});
    }
  }
  return bar_chart("A step, " + findings.scene, groups);
}

}  // namespace roam::bench
