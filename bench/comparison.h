#pragma once
/// \file
/// Compares engines on the same queries: wrong answers and times.

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine.h"
#include "judge.h"
#include "query.h"
#include "reference.h"
#include "timing.h"

namespace roam::bench {

/// One engine on one set of queries.
struct EngineRun {
  std::string set;
  QueryKind kind = QueryKind::sweep;
  const Engine* engine = nullptr;
  std::size_t asked = 0;  ///< fewer than in the set if the engine is too slow for all
  Verdict verdict;
  Summary times;        ///< nanoseconds
  std::string failure;  ///< empty, or how the engine failed; then there are neither verdict nor times
};

struct ComparisonOptions {
  int rounds = 5;
  double patience = 1.0;            ///< seconds: an engine that needs longer for a set gets only the first part of it
  std::function<void()> between{};  ///< called between engines, portions and rounds; an exception ends the comparison
};

/// Judges all answers first, then times the engines in turns. Engines without capsules are skipped if the set has one,
/// and so are engines without rays or nearest points.
/// An engine that throws has failed; the others continue. Uses one thread; the engines must outlive the runs.
[[nodiscard]] std::vector<EngineRun> compare(std::span<const Engine> engines, const QuerySet& set,
                                             const Reference& reference, const ComparisonOptions& options);

}  // namespace roam::bench
