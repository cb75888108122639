#include "leads.h"

#include <algorithm>
#include <cmath>

namespace roam::bench {
namespace {

constexpr std::array<double Summary::*, lead_figures.size()> figures{&Summary::p50, &Summary::hit_p50, &Summary::p99};

}  // namespace

std::vector<LeadRow> leads_in(const std::string& scene, std::span<const EngineRun> runs) {
  std::vector<LeadRow> rows;
  for (const EngineRun& own : runs) {
    if (own.engine->name != "roam" || own.kind != QueryKind::sweep) continue;
    LeadRow row{.scene = scene, .set = own.set, .leads = {}};
    bool known = false;
    for (std::size_t i = 0; i < figures.size(); ++i) {
      const EngineRun* best = nullptr;
      for (const EngineRun& other : runs) {
        if (other.set != own.set || &other == &own || !other.engine->says_when) continue;
        if (other.times.*figures[i] <= 0.0) continue;
        if (best == nullptr || other.times.*figures[i] < best->times.*figures[i]) best = &other;
      }
      if (best == nullptr || own.times.*figures[i] <= 0.0) continue;
      row.leads[i] = {best->times.*figures[i] / own.times.*figures[i], best->engine->name};
      known = true;
    }
    if (known) rows.push_back(std::move(row));
  }
  return rows;
}

LeadSummary summarize(std::span<const LeadRow> rows, std::size_t figure) {
  LeadSummary summary;
  double sum = 0.0;
  std::size_t count = 0;
  for (const LeadRow& row : rows) {
    const double times = row.leads[figure].times;
    if (times <= 0.0) continue;
    sum += std::log(times);
    ++count;
    if (summary.worst == nullptr || times < summary.worst->leads[figure].times) summary.worst = &row;
  }
  if (count > 0) summary.mean = std::exp(sum / static_cast<double>(count));
  return summary;
}

}  // namespace roam::bench
