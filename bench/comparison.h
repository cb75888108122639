#pragma once
/// \file
/// Engines on the same queries: who is wrong, and how long each takes.

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
  const Engine* engine = nullptr;
  std::size_t asked = 0;  ///< fewer than the set has when the engine is too slow for all
  Verdict verdict;
  Summary times;        ///< nanoseconds
  std::string failure;  ///< empty, or how the engine ended while it was asked: then there is neither verdict nor time
};

struct ComparisonOptions {
  int rounds = 5;
  double patience = 1.0;            ///< seconds: an engine that needs longer for a set gets the first part of it
  std::function<void()> between{};  ///< called between engines, portions and rounds; what it throws ends the comparison
};

/// Judges all answers first, then times the engines in turns. Engines that know no capsule are left out where the set
/// has one. An engine that throws while it is asked has failed, and the others go on. One thread; the engines must
/// outlive the runs.
[[nodiscard]] std::vector<EngineRun> compare(std::span<const Engine> engines, const QuerySet& set,
                                             const Reference& reference, const ComparisonOptions& options);

}  // namespace roam::bench
