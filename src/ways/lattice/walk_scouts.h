#pragma once
/// \file
/// Steps from places of the lattice asked ahead, on other cores, of what the scene answers about them. No answer
/// depends on whether it was asked ahead: who comes to a place before its scout is back asks for himself.

#include <tbb/task_group.h>

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <unordered_map>

#include "ways/lattice/walk_step.h"

namespace roam::ways {

/// Steps from one place, by direction: those that are asked about, and what is answered.
struct ScoutedSteps {
  Standing here;
  LatticePoint at;
  std::uint8_t asked = 0;                            ///< bit set
  std::array<std::optional<Foot>, directions> foot;  ///< as WalkSteps::foot_from
  std::array<float, directions> clearance;           ///< there
  std::array<bool, directions> linked;               ///< to who will stand there
  std::atomic<std::uint8_t> answered{0};             ///< bit set, of those that may be read
  std::atomic<bool> done{false};                     ///< nobody needs the others any more

  [[nodiscard]] bool is_answered(std::size_t direction) const {
    return (answered.load(std::memory_order_acquire) >> direction & 1U) != 0;
  }
};

/// Used by one thread. Worth it only where there are other cores: who sends them sees to that.
class Scouts {
 public:
  Scouts(const WalkSteps& steps, const LatticePlan& plan) : steps_(steps), plan_(plan) {}
  ~Scouts() noexcept;
  Scouts(const Scouts&) = delete;
  Scouts& operator=(const Scouts&) = delete;

  /// Asks about the steps of a place in `asked`, the last direction first: who is there himself begins with the first.
  void send(NodeId from, const Standing& here, const LatticePoint& at, std::uint8_t asked);
  /// What is asked about a place, and answered by now or later; it is forgotten here. Null: nothing.
  [[nodiscard]] std::shared_ptr<ScoutedSteps> take(NodeId from);
  /// Nobody needs what is not answered yet.
  void forget();
  /// Of how many places something is asked and not taken.
  [[nodiscard]] std::size_t out() const { return out_.size(); }

 private:
  void answer(ScoutedSteps& steps) const;

  const WalkSteps& steps_;
  const LatticePlan& plan_;
  std::unordered_map<NodeId, std::shared_ptr<ScoutedSteps>> out_;
  std::atomic<bool> ended_{false};
  tbb::task_group group_;
};

}  // namespace roam::ways
