#pragma once
/// \file
/// Times single calls of some tens of nanoseconds, and summarizes them.

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "query.h"

namespace roam::bench {

/// Nanoseconds that each query took: one value a query, the median over rounds.
///
/// Each call is timed by itself, between two fenced readings of the processor's clock. The cost of an empty pair of
/// readings is subtracted: their median, measured again for each call of an Ask. The fences keep queries from
/// overlapping, so this measures latency, not throughput.
using Times = std::vector<double>;

/// Runs queries in order and gives the nanoseconds of each. Keeps the answers, so that no compiler can remove the work.
using Ask = std::function<void(std::span<const Query>, std::span<double> nanoseconds, std::span<Answer>)>;

/// The times of each of `asked` on the first queries[i] queries of `all`. The engines take turns, `rounds` times. A
/// turn runs all its queries in order, so the caches hold what the engine's own queries left. Calls `between` before
/// each turn; an exception ends the timing.
[[nodiscard]] std::vector<Times> time_in_turns(std::span<const Ask> asked, std::span<const std::size_t> queries,
                                               std::span<const Query> all, int rounds,
                                               const std::function<void()>& between = {});

/// The upper of two middle values. `values` must not be empty.
[[nodiscard]] double median(std::vector<double> values);

/// The value at `part`, 0 to 1, of the way through ascending values; the lower one if it is between two. p99 is at
/// 0.99, the largest at 1. 0 if there are none.
[[nodiscard]] inline double quantile(std::span<const double> sorted, double part) {
  return sorted.empty() ? 0.0 : sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

/// The figures of a set of queries, in nanoseconds.
struct Summary {
  double mean = 0;
  double p50 = 0;
  double p99 = 0;
  double most = 0;
  double hit_p50 = 0;  ///< median of the queries that hit, 0 if there are none
};

/// `hits[i]` says whether query i hits.
[[nodiscard]] Summary summarize(const Times& times, const std::vector<bool>& hits);

/// The processor's clock, fenced: work between two readings cannot move out. In a header, because a call would be timed
/// too.
#if defined(__x86_64__)
inline std::uint64_t clock_before() {
  __builtin_ia32_lfence();
  return __builtin_ia32_rdtsc();
}
inline std::uint64_t clock_after() {
  unsigned processor = 0;
  const std::uint64_t ticks = __builtin_ia32_rdtscp(&processor);
  __builtin_ia32_lfence();
  return ticks;
}
#else
inline std::uint64_t clock_before() {
  return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
}
inline std::uint64_t clock_after() { return clock_before(); }
#endif

/// Converts differences of two readings of that clock to nanoseconds, in place, less the cost of an empty pair of
/// readings.
void to_nanoseconds(std::span<double> ticks);

/// An Ask from anything that maps a Query to an Answer, without a call through a pointer between the clock readings.
template <class Sweep>
[[nodiscard]] Ask timed(Sweep sweep) {
  return [sweep](std::span<const Query> queries, std::span<double> nanoseconds, std::span<Answer> answers) {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const Query query = queries[i];
      const std::uint64_t before = clock_before();
      answers[i] = sweep(query);
      nanoseconds[i] = static_cast<double>(clock_after() - before);
    }
    to_nanoseconds(nanoseconds.first(queries.size()));
  };
}

}  // namespace roam::bench
