#pragma once
/// \file
/// Times single calls of some tens of nanoseconds, and sums them up.

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "query.h"

namespace roam::bench {

/// Nanoseconds that each query took: one value a query, the median over rounds.
///
/// Each call is timed by itself, between two fenced readings of the processor's clock, and the cost of an empty pair of
/// readings (their median, measured anew for each call of an Ask) is taken off. Because of the fences no query overlaps
/// the next: what is measured is latency, not throughput.
using Times = std::vector<double>;

/// Answers queries in order and says how many nanoseconds each took. The answers are kept so that no compiler can leave
/// the work out.
using Ask = std::function<void(std::span<const Query>, std::span<double> nanoseconds, std::span<Answer>)>;

/// The times of each of `asked` on the first queries[i] of `queries`. The engines take turns, `rounds` times; all
/// queries of a round are asked in order, so that each engine's caches hold what its own queries left there. `between`
/// is called before each turn; what it throws ends the timing.
[[nodiscard]] std::vector<Times> time_in_turns(std::span<const Ask> asked, std::span<const std::size_t> queries,
                                               std::span<const Query> all, int rounds,
                                               const std::function<void()>& between = {});

/// The upper one where there are two in the middle. `values` must not be empty.
[[nodiscard]] double median(std::vector<double> values);

/// What lies at this part, 0 to 1, of the way through values in ascending order, the lower one where it is between two:
/// p99 at 0.99, the largest at 1. 0 when there are none.
[[nodiscard]] inline double quantile(std::span<const double> sorted, double part) {
  return sorted.empty() ? 0.0 : sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

/// The figures of a set of queries, in nanoseconds.
struct Summary {
  double mean = 0;
  double p50 = 0;
  double p99 = 0;
  double most = 0;
  double hit_p50 = 0;  ///< median of the queries that hit, 0 when none does
  double hit_share = 0;
};

/// `hits[i]` says whether query i hits.
[[nodiscard]] Summary summarize(const Times& times, const std::vector<bool>& hits);

/// The processor's clock, fenced: whatever is between the two is done between the two. In a header, as a call would be
/// timed too.
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

/// Differences of two readings of that clock become nanoseconds, in place, less the cost of an empty pair of readings.
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
