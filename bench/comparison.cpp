#include "comparison.h"

#include <algorithm>
#include <chrono>

namespace roam::bench {
namespace {

/// As many answers as the engine gives in the time that a round may take, at least one portion.
std::vector<Answer> ask_patiently(const Engine& engine, std::span<const Query> queries, double patience) {
  constexpr std::size_t portion = 32;
  std::vector<Answer> answers(queries.size());
  std::vector<double> unused(portion);
  const auto start = std::chrono::steady_clock::now();
  const auto end = start + std::chrono::duration<double>(patience);
  std::size_t done = 0;
  while (done < queries.size() && (done == 0 || std::chrono::steady_clock::now() < end)) {
    const std::size_t count = std::min(portion, queries.size() - done);
    engine.ask(queries.subspan(done, count), unused, std::span(answers).subspan(done, count));
    done += count;
  }
  answers.resize(done);
  return answers;
}

}  // namespace

std::vector<EngineRun> compare(std::span<const Engine> engines, const QuerySet& set, const Reference& reference,
                               const ComparisonOptions& options) {
  const std::span<const Query> queries(set.queries);
  const bool capsules =
      std::any_of(queries.begin(), queries.end(), [](const Query& q) { return q.body.half_height > 0; });
  std::vector<Answer> truth;
  for (const Query& query : queries) truth.push_back(reference.sweep(query));

  std::vector<EngineRun> runs;
  std::vector<Ask> asked;
  std::vector<std::size_t> counts;
  for (const Engine& engine : engines) {
    if (capsules && engine.spheres_only) continue;
    const std::vector<Answer> answers = ask_patiently(engine, queries, options.patience);
    const std::size_t count = answers.size();
    runs.push_back(
        {.set = set.name,
         .engine = &engine,
         .asked = count,
         .verdict = judge(answers, std::span(truth).first(count), queries.first(count), reference, engine.says_when),
         .times = {}});
    asked.push_back(engine.ask);
    counts.push_back(count);
  }
  const std::vector<Times> times = time_in_turns(asked, counts, queries, options.rounds);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    std::vector<bool> hits;
    for (std::size_t q = 0; q < counts[i]; ++q) hits.push_back(truth[q].hit);
    runs[i].times = summarize(times[i], hits);
  }
  return runs;
}

}  // namespace roam::bench
