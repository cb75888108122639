#include "ways/lattice/walk_scouts.h"

#include <exception>
#include <utility>

namespace roam::ways {

Scouts::~Scouts() noexcept {
  ended_ = true;
  group_.wait();
}

void Scouts::send(NodeId from, const Standing& here, const LatticePoint& at, std::uint8_t requested) {
  const auto steps = std::make_shared<ScoutedSteps>();
  steps->here = here;
  steps->at = at;
  steps->requested = requested;
  out_[from] = steps;
  group_.run([this, steps] {
    try {
      compute(*steps);
    } catch (const std::exception&) {
      // expand() repeats these queries itself and sees the error.
    }
  });
}

void Scouts::compute(ScoutedSteps& steps) const {
  for (std::size_t direction = directions; direction-- > 0;) {
    const unsigned bit = 1U << direction;
    if ((steps.requested & bit) == 0) continue;
    if (ended_ || steps.done) return;
    const std::optional<FloorPlace>& foot = steps.foot[direction] =
        steps_.foot_from(steps.here, plan_.point(beside(steps.at, direction)));
    if (foot) {
      steps.clearance[direction] = steps_.clearance(foot->place);
      const Standing there = standing_at(*foot, steps.clearance[direction]);
      steps.linked[direction] = there.free > 0.0 && steps_.linked(steps.here, there);
    }
    steps.ready.fetch_or(static_cast<std::uint8_t>(bit), std::memory_order_release);
  }
}

std::shared_ptr<ScoutedSteps> Scouts::take(NodeId from) {
  const auto found = out_.find(from);
  if (found == out_.end()) return nullptr;
  std::shared_ptr<ScoutedSteps> steps = std::move(found->second);
  out_.erase(found);
  return steps;
}

void Scouts::forget() {
  for (const auto& [from, steps] : out_) steps->done = true;
  out_.clear();
}

}  // namespace roam::ways
