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

#include "train/lattice/walk_step.h"

namespace roam::training {

/// Steps from one place, by direction: those that are asked about, and what is answered.
struct ScoutedSteps {
  Standing here;
  LatticePoint at;
  std::uint8_t asked = 0;                            ///< bit set
  std::array<std::optional<Foot>, directions> foot;  ///< as WalkSteps::foot_from
  std::array<float, directions> clearance;           ///< there
  std::uint8_t linked = 0;                           ///< bit set: to who will stand there
};

/// Used by one thread. Nothing is asked where there is but one core for it.
class Scouts {
 public:
  Scouts(const WalkSteps& steps, const LatticePlan& plan) : steps_(steps), plan_(plan) {}
  ~Scouts() noexcept;
  Scouts(const Scouts&) = delete;
  Scouts& operator=(const Scouts&) = delete;

  /// Whether a place's steps were asked for, and not taken yet.
  [[nodiscard]] bool are_out(NodeId from) const { return out_.contains(from); }
  /// Of how many places that is so.
  [[nodiscard]] std::size_t out() const { return out_.size(); }
  /// Of how many places the answers were known when they were taken.
  [[nodiscard]] std::uint64_t answered() const { return answered_; }
  /// Asks about the steps of a place in `asked`.
  void send(NodeId from, const Standing& here, const LatticePoint& at, std::uint8_t asked);
  /// The answers about a place, where they are known by now; they are forgotten here.
  [[nodiscard]] std::shared_ptr<const ScoutedSteps> take(NodeId from);
  /// Nothing is out any more.
  void forget();

 private:
  static constexpr std::size_t places_together = 8;
  enum class State : std::uint8_t { waiting, taken, answered };
  struct Place {
    std::atomic<State> state{State::waiting};
    ScoutedSteps steps;
  };
  /// Some hundred microseconds of work.
  struct Errand {
    std::array<Place, places_together> places;
    std::size_t count = 0;
  };
  struct Out {
    std::shared_ptr<Errand> errand;
    std::size_t number;
  };

  void run(Errand& errand) const;
  void answer(ScoutedSteps& steps) const;

  const WalkSteps& steps_;
  const LatticePlan& plan_;
  std::unordered_map<NodeId, Out> out_;
  std::uint64_t answered_ = 0;
  std::shared_ptr<Errand> next_ = std::make_shared<Errand>();
  std::atomic<bool> ended_{false};
  tbb::task_group group_;
};

}  // namespace roam::training
