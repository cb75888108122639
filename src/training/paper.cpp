#include "training/paper.h"

#include <algorithm>
#include <map>

#include "training/judgement.h"

namespace roam::training {

namespace {

using Ending = PaperResult::Ending;

/// The radius that passed most paths; the smallest of several.
double most_passed(const std::vector<Trial>& trials) {
  std::map<double, std::size_t> passed;
  for (const Trial& trial : trials) passed[trial.radius] += judged(trial.outcome) == Judgement::passed ? 1 : 0;
  double best = 0.0;
  std::size_t most = 0;
  for (const auto& [radius, count] : passed) {
    if (count > most) {
      most = count;
      best = radius;
    }
  }
  return best;
}

class Adjustment {
 public:
  Adjustment(const PaperOptions& options, PaperResult& result) : options_(options), result_(result) {}

  /// Records a trial. Returns the next radius; none if the bounds leave nothing to try.
  std::optional<double> next(const Trial& trial) {
    const Judgement said = judged(trial.outcome);
    if (said == Judgement::cannot_enter && (!result_.blocked || trial.radius < result_.blocked->radius))
      result_.blocked = trial;
    if (said == Judgement::flies_off && (!result_.fallen || trial.radius > result_.fallen->radius))
      result_.fallen = trial;
    if (result_.blocked && result_.fallen) {
      const double low = result_.fallen->radius, high = result_.blocked->radius;
      if (high - low <= options_.precision) return ended(Ending::contradiction);
      return 0.5 * (low + high);
    }
    if (said == Judgement::cannot_enter) {
      if (trial.radius <= options_.smallest) return ended(Ending::too_small);
      return std::max(options_.smallest, 0.5 * trial.radius);
    }
    if (trial.radius >= options_.largest) return ended(Ending::too_large);
    return std::min(options_.largest, 2.0 * trial.radius);
  }

 private:
  std::optional<double> ended(Ending why) {
    result_.ending = why;
    return std::nullopt;
  }

  const PaperOptions& options_;
  PaperResult& result_;
};

}  // namespace

PaperRun adjust_radius(std::size_t paths, const PaperOptions& options,
                       const std::function<std::optional<Trial>(std::size_t path, double radius)>& roam) {
  PaperRun result;
  Adjustment adjustment(options, result);
  double radius = std::clamp(options.start, options.smallest, options.largest);
  std::vector<double> passed_with(paths, 0.0);
  std::vector<int> tried(paths, 0);
  for (;;) {
    const auto open = std::find_if(passed_with.begin(), passed_with.end(), [&](double r) { return r != radius; });
    if (open == passed_with.end()) {
      result.ending = Ending::settled;
      result.radius = radius;
      return result;
    }
    const auto path = static_cast<std::size_t>(open - passed_with.begin());
    if (tried[path]++ >= options.most_trials) {
      result.ending = Ending::out_of_trials;
      break;
    }
    const std::optional<Trial> trial = roam(path, radius);
    if (!trial) {
      result.ending = Ending::cancelled;
      break;
    }
    result.trials.push_back(*trial);
    if (judged(trial->outcome) == Judgement::passed) {
      passed_with[path] = radius;
      continue;
    }
    const std::optional<double> next = adjustment.next(*trial);
    if (!next) break;
    radius = *next;
  }
  result.radius = most_passed(result.trials);
  return result;
}

}  // namespace roam::training
