#pragma once
/// \file
/// The queries of the benchmarks.

#include <string>
#include <vector>

#include "roam/math.h"
#include "roam/sweep.h"

namespace roam::bench {

/// One sweep: the body's centre goes from `from` to `from + motion` (metres, scene frame).
struct Query {
  Body body;
  Vec3 from{0.0};
  Vec3 motion{0.0};
};

/// A sweep and a ray return the first touch, of a body or of a point. The nearest point's distance is from `from`.
enum class QueryKind { sweep, ray, nearest };

/// Distances that are not smaller need not be found, metres.
constexpr double nearest_reach = 5.0;

/// Queries of one kind, in order: consecutive ones of a walk are neighbours in space.
struct QuerySet {
  std::string name;
  std::vector<Query> queries;
  QueryKind kind = QueryKind::sweep;
};

/// An engine's answer to one query.
struct Answer {
  bool hit = false;
  double time = 1.0;                ///< fraction of the motion until the first touch; 1 when free
  double distance = nearest_reach;  ///< of a nearest query, at most nearest_reach
};

}  // namespace roam::bench
