#include "comparison.h"

#include <algorithm>
#include <chrono>
#include <deque>
#include <exception>
#include <functional>

namespace roam::bench {
namespace {

/// Queries an engine. If the engine fails, notes how, and does not query it again.
class Guarded {
 public:
  explicit Guarded(const Ask& ask) : ask_(ask) {}
  void operator()(std::span<const Query> queries, std::span<double> nanoseconds, std::span<Answer> answers) {
    if (!failure.empty()) return;
    try {
      ask_(queries, nanoseconds, answers);
    } catch (const std::exception& error) {
      failure = error.what();
      if (failure.empty()) failure = "ended early";
    }
  }

  std::string failure{};

 private:
  const Ask& ask_;
};

/// As many answers as the engine gives within the time of a round, at least one portion.
std::vector<Answer> ask_patiently(Guarded& engine, std::span<const Query> queries, const ComparisonOptions& options) {
  constexpr std::size_t portion = 32;
  std::vector<Answer> answers(queries.size());
  std::vector<double> unused(portion);
  const auto start = std::chrono::steady_clock::now();
  const auto end = start + std::chrono::duration<double>(options.patience);
  std::size_t done = 0;
  while (engine.failure.empty() && done < queries.size() && (done == 0 || std::chrono::steady_clock::now() < end)) {
    if (options.between) options.between();
    const std::size_t count = std::min(portion, queries.size() - done);
    engine(queries.subspan(done, count), unused, std::span(answers).subspan(done, count));
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
  for (const Query& query : queries) {
    if (options.between) options.between();
    truth.push_back(set.kind == QueryKind::nearest
                        ? Answer{.distance = reference.clearance(query.body, query.from, nearest_reach)}
                        : reference.sweep(query));
  }

  std::vector<EngineRun> runs;
  std::deque<Guarded> guarded;
  std::vector<Ask> asked;
  std::vector<std::size_t> counts;
  for (const Engine& engine : engines) {
    const Ask& ask = set.kind == QueryKind::nearest ? engine.nearest : engine.ask;
    if (!ask || (capsules && engine.spheres_only) || (set.kind == QueryKind::ray && !engine.rays)) continue;
    Guarded& guard = guarded.emplace_back(ask);
    const std::vector<Answer> answers = ask_patiently(guard, queries, options);
    const std::size_t count = answers.size();
    EngineRun& run = runs.emplace_back();
    run.set = set.name;
    run.kind = set.kind;
    run.engine = &engine;
    run.asked = count;
    if (guard.failure.empty()) {
      const std::span<const Answer> true_answers = std::span(truth).first(count);
      run.verdict = set.kind == QueryKind::nearest
                        ? judge_nearest(answers, true_answers)
                        : judge(answers, true_answers, queries.first(count), reference, engine.says_when);
    }
    asked.push_back(std::ref(guard));
    counts.push_back(count);
  }
  const std::vector<Times> times = time_in_turns(asked, counts, queries, options.rounds, options.between);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].failure = guarded[i].failure;
    if (!runs[i].failure.empty()) {
      runs[i].verdict = {};
      continue;
    }
    std::vector<bool> hits;
    for (std::size_t q = 0; q < counts[i]; ++q) hits.push_back(truth[q].hit);
    runs[i].times = summarize(times[i], hits);
  }
  return runs;
}

}  // namespace roam::bench
