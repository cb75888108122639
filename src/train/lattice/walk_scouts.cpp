#include "train/lattice/walk_scouts.h"

#include <exception>
#include <utility>

namespace roam::training {
Scouts::~Scouts() noexcept {
  ended_ = true;
  group_.wait();
}

void Scouts::send(NodeId from, const Standing& here, const LatticePoint& at, std::uint8_t asked) {
  ScoutedSteps& steps = next_->places[next_->count].steps;
  steps.here = here;
  steps.at = at;
  steps.asked = asked;
  out_.emplace(from, Out{next_, next_->count++});
  if (next_->count < places_together) return;
  group_.run([this, errand = std::exchange(next_, std::make_shared<Errand>())] { run(*errand); });
}

void Scouts::run(Errand& errand) const {
  for (Place& place : errand.places) {
    State waiting = State::waiting;
    if (ended_ || !place.state.compare_exchange_strong(waiting, State::taken)) continue;
    try {
      answer(place.steps);
      place.state = State::answered;
    } catch (const std::exception&) {
      // Who comes there asks again, and is told.
    }
  }
}

void Scouts::answer(ScoutedSteps& steps) const {
  for (std::size_t direction = 0; direction < directions; ++direction) {
    const unsigned bit = 1U << direction;
    if ((steps.asked & bit) == 0) continue;
    const std::optional<Foot>& foot = steps.foot[direction] =
        steps_.foot_from(steps.here, plan_.point(beside(steps.at, direction)));
    if (!foot) continue;
    steps.clearance[direction] = steps_.clearance(foot->place);
    const Standing there = standing_at(*foot, steps.clearance[direction]);
    if (there.free > 0.0 && steps_.linked(steps.here, there))
      steps.linked = static_cast<std::uint8_t>(steps.linked | bit);
  }
}

std::shared_ptr<const ScoutedSteps> Scouts::take(NodeId from) {
  const auto found = out_.find(from);
  if (found == out_.end()) return nullptr;
  const Out out = std::move(found->second);
  out_.erase(found);
  Place& place = out.errand->places[out.number];
  State waiting = State::waiting;
  if (place.state.compare_exchange_strong(waiting, State::taken) || place.state != State::answered) return nullptr;
  ++answered_;
  return {out.errand, &place.steps};
}

void Scouts::forget() {
  for (const auto& [from, out] : out_) {
    State waiting = State::waiting;
    out.errand->places[out.number].state.compare_exchange_strong(waiting, State::taken);
  }
  out_.clear();
  next_ = std::make_shared<Errand>();
}

}  // namespace roam::training
