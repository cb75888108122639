#pragma once
/// \file
/// How many times as fast as the fastest other engine roam is: for each row, which is one set of queries in one scene,
/// and the geometric mean over rows.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "comparison.h"

namespace roam::bench {

/// In one figure of one row.
struct Lead {
  double times = 0;    ///< 1: as fast as the fastest other engine; 0: unknown, e.g. if nothing hits
  std::string engine;  ///< the fastest other one
};

inline constexpr std::array<const char*, 3> lead_figures{"p50", "hit p50", "p99"};

/// The leads of one row, in the order of lead_figures. In each figure another engine may be the fastest.
struct LeadRow {
  std::string scene, set;
  std::array<Lead, lead_figures.size()> leads;
};

/// One row for each set of sweeps in which roam and another engine have times. Engines that do not say when they hit do
/// not count. A slow engine counts by the part of the queries that it answered.
[[nodiscard]] std::vector<LeadRow> leads_in(const std::string& scene, std::span<const EngineRun> runs);

/// Over all rows with a known lead in one figure.
struct LeadSummary {
  double mean = 0;                 ///< geometric; 0 if there are no rows
  const LeadRow* worst = nullptr;  ///< the row with the least lead; it belongs to `rows`
};
[[nodiscard]] LeadSummary summarize(std::span<const LeadRow> rows, std::size_t figure);

}  // namespace roam::bench
