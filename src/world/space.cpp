#include "roam/space.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "index/margin.h"
#include "math/finite.h"
#include "math/floating_point.h"
#include "math/largest.h"
#include "math/parallel_floating_point.h"
#include "roam/collector.h"
#include "text/number.h"
#include "world/floor_only.h"
#include "world/nearby.h"
#include "world/query.h"

namespace roam {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw Error("cannot answer a query: " + what); }

[[noreturn]] void refuse_length(double value, double limit, const char* name) {
  refuse(std::string(name) + " is " + number_text(value) + " m; it must be between 0 and " +
         std::to_string(static_cast<long>(limit)) + " m");
}

/// Kept small, so that it is inlined.
void check_length(double value, double limit, const char* name) {
  if (!(value >= 0.0 && value <= limit)) refuse_length(value, limit, name);
}

void check_reach(double reach) { check_length(reach, Space::reach_limit, "the reach"); }

/// The nearest contact, if any, as a clearance.
Clearance as_clearance(const Collector& collector, double distance) {
  Clearance result;
  result.distance = collector.initial_reach();
  if (collector.count() == 0) return result;
  static_cast<Contact&>(result) = collector.kept()[0];
  result.distance = distance;
  result.found = true;
  return result;
}

/// Queries that one core takes at a time: some 0.1 ms.
constexpr std::size_t at_a_time = 64;

/// Computes all results of a batch; throws before the first if a query is refused.
template <class Result, class Compute>
void compute_all(std::span<const Query> queries, std::span<Result> results, const Compute& compute) {
  if (queries.size() != results.size()) {
    refuse("there are " + std::to_string(queries.size()) + " queries and room for " + std::to_string(results.size()) +
           " results");
  }
  for (std::size_t i = 0; i < queries.size(); ++i) {
    try {
      query::check(queries[i]);
    } catch (const Error& error) {
      throw Error("query " + std::to_string(i) + ": " + error.what());
    }
  }
  if (queries.size() <= at_a_time) {
    for (std::size_t i = 0; i < queries.size(); ++i) results[i] = compute(queries[i]);
    return;
  }
  in_default_floating_point([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, queries.size(), at_a_time), [&](const auto& some) {
      for (std::size_t i = some.begin(); i < some.end(); ++i) results[i] = compute(queries[i]);
    });
  });
}

}  // namespace

void query::check(const Query& query) {
  const Body& body = query.body;
  const Vec3 &from = query.from, &motion = query.motion;
  // Most queries are valid and pass at once. A comparison with a NaN fails.
  const double far = std::abs(from.x) + std::abs(from.y) + std::abs(from.z);
  const double way = std::abs(motion.x) + std::abs(motion.y) + std::abs(motion.z);
  if (far <= std::numeric_limits<double>::max() && way <= Space::motion_limit && body.radius >= 0.0 &&
      body.radius <= Space::reach_limit && body.half_height >= 0.0 && body.half_height <= Space::reach_limit) {
    return;
  }
  check_length(body.radius, Space::reach_limit, "the radius");
  check_length(body.half_height, Space::reach_limit, "the half height");
  if (!std::isfinite(from.x) || !std::isfinite(from.y) || !std::isfinite(from.z)) refuse("the place is not finite");
  if (!std::isfinite(motion.x) || !std::isfinite(motion.y) || !std::isfinite(motion.z)) {
    refuse("the motion is not finite");
  }
  check_length(largest(motion), Space::motion_limit, "the motion's largest component");
}

void query::check_update(const Body& body, const Vec3& place, const Vec3& velocity) {
  check({body, place});
  if (!is_finite(velocity)) throw Error("cannot update a space: the velocity is not finite");
}

/// Completes a hit with its contact. Inlined, because every sweep makes it.
[[gnu::always_inline]] inline Impact Space::touched(const Query& query, const FirstImpact& first) const {
  Impact result;
  if (!first.hit) return result;
  Contact found;
  const Contact* touched = &found;
  if (first.contact) {
    touched = &*first.contact;
  } else {
    Collector collector(first, found);
    find_near({query.body, query.from + query.motion * first.time, Vec3(0.0), query.ignored}, collector, nullptr);
  }
  result.hit = true;
  result.time = first.time;
  result.point = touched->point;
  result.normal = touched->normal;
  result.feature = touched->feature;
  // `time` is certified free, so only rounding can give less.
  result.distance = first.time > 0.0 ? std::max(0.0, touched->distance) : touched->distance;
  result.triangle = first.triangle;
  result.object = first.object;
  result.unknown = first.unknown;
  return result;
}

Impact Space::swept(const Query& query, Vicinity* vicinity) const {
  const DefaultFloatingPoint guard;
  query::check(query);
  const FirstImpact first = find_first(query, vicinity);
  return touched(query, first);
}

FirstImpact Space::first_impact(const Query& query) const {
  const DefaultFloatingPoint guard;
  query::check(query);
  FirstImpact first = find_first(query, nullptr);
  first.revision = facts().revision.value_or(0);
  return first;
}

Impact Space::completed(const Query& query, const FirstImpact& first) const {
  const DefaultFloatingPoint guard;
  query::check(query);
  if (first.hit && first.revision != facts().revision.value_or(0)) {
    throw Error("cannot complete a first impact: the space has changed since then; call first_impact() again");
  }
  return touched(query, first);
}

std::size_t Space::contacts(const Query& query, double reach, std::span<Contact> contacts) const {
  const DefaultFloatingPoint guard;
  query::check(query);
  check_reach(reach);
  if (contacts.empty()) return 0;
  Collector collector(Collector::Kind::contacts, reach, contacts);
  if (largest(query.motion) > index::longest_piece) collector.expect_repeats();
  find_near(query, collector, nullptr);
  collector.sort();
  return collector.count();
}

Clearance Space::clearance(const Query& query, double reach) const {
  const DefaultFloatingPoint guard;
  query::check(query);
  check_reach(reach);
  Contact nearest;
  Collector collector(Collector::Kind::clearance, reach, {&nearest, 1});
  find_near(query, collector, nullptr);
  return as_clearance(collector, collector.certified());
}

Clearance Space::floor_clearance(const Body& body, const Vec3& place, double reach, const Floor& floor) const {
  const DefaultFloatingPoint guard;
  const Query query{body, place};
  query::check(query);
  check_reach(reach);
  const query::FloorOnly only(floor, place);
  Contact nearest;
  Collector collector(Collector::Kind::floor_clearance, reach, {&nearest, 1});
  collector.expect_repeats();
  collector.take_floor_only(only);
  find_near(query, collector, nullptr);
  return as_clearance(collector, nearest.distance);
}

double Space::gap_over(const Query& query, double reach, Vicinity* vicinity) const {
  const DefaultFloatingPoint guard;
  query::check(query);
  check_reach(reach);
  Contact nearest;
  Collector collector(Collector::Kind::gap, reach, {&nearest, 1});
  find_near(query, collector, vicinity);
  return collector.count() > 0 ? collector.certified() : reach;
}

void Space::sweep(std::span<const Query> queries, std::span<Impact> results) const {
  const DefaultFloatingPoint guard;
  compute_all(queries, results, [this](const Query& query) { return sweep(query); });
}

void Space::clearance(std::span<const Query> queries, double reach, std::span<Clearance> results) const {
  const DefaultFloatingPoint guard;
  check_reach(reach);
  compute_all(queries, results, [&](const Query& query) { return clearance(query, reach); });
}

void Space::gap_bound(std::span<const Query> queries, double reach, std::span<double> results) const {
  const DefaultFloatingPoint guard;
  check_reach(reach);
  compute_all(queries, results, [&](const Query& query) { return gap_bound(query, reach); });
}

Impact Nearby::sweep(const Space& space, Vicinity& vicinity, const Query& query) {
  return space.swept(query, &vicinity);
}

double Nearby::gap_bound(const Space& space, Vicinity& vicinity, const Query& query, double reach) {
  return space.gap_over(query, reach, &vicinity);
}

}  // namespace roam
