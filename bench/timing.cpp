#include "timing.h"

#include <algorithm>
#include <numeric>

namespace roam::bench {
namespace {

using SteadyClock = std::chrono::steady_clock;

double ticks_per_nanosecond() {
  static const double rate = [] {
    constexpr auto span = std::chrono::milliseconds(50);
    const auto start = SteadyClock::now();
    const std::uint64_t before = clock_before();
    while (SteadyClock::now() - start < span) {
    }
    const std::uint64_t after = clock_after();
    const std::chrono::duration<double, std::nano> passed = SteadyClock::now() - start;
    return static_cast<double>(after - before) / passed.count();
  }();
  return rate;
}

double empty_ticks() {
  std::vector<double> empty(1001);
  for (double& ticks : empty) {
    const std::uint64_t before = clock_before();
    ticks = static_cast<double>(clock_after() - before);
  }
  return median(empty);
}

}  // namespace

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void to_nanoseconds(std::span<double> ticks) {
  const double empty = empty_ticks();
  for (double& t : ticks) t = std::max(0.0, t - empty) / ticks_per_nanosecond();
}

std::vector<Times> time_in_turns(std::span<const Ask> asked, std::span<const std::size_t> queries,
                                 std::span<const Query> all, int rounds, const std::function<void()>& between) {
  std::vector<std::vector<std::vector<double>>> runs(asked.size());
  std::vector<Answer> answers(all.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t e = 0; e < asked.size(); ++e) {
      if (between) between();
      const std::size_t count = std::min(queries[e], all.size());
      asked[e](all.first(count), runs[e].emplace_back(count), answers);
    }
  }
  std::vector<Times> times(asked.size());
  for (std::size_t e = 0; e < asked.size(); ++e) {
    times[e].resize(runs[e].front().size());
    for (std::size_t i = 0; i < times[e].size(); ++i) {
      std::vector<double> of_query;
      for (const auto& run : runs[e]) of_query.push_back(run[i]);
      times[e][i] = median(of_query);
    }
  }
  return times;
}

Summary summarize(const Times& times, const std::vector<bool>& hits) {
  std::vector<double> sorted = times;
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> of_hits;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (hits[i]) of_hits.push_back(times[i]);
  }
  std::sort(of_hits.begin(), of_hits.end());
  const auto count = static_cast<double>(std::max<std::size_t>(times.size(), 1));
  return {.mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / count,
          .p50 = quantile(sorted, 0.5),
          .p99 = quantile(sorted, 0.99),
          .most = quantile(sorted, 1.0),
          .hit_p50 = quantile(of_hits, 0.5)};
}

}  // namespace roam::bench
