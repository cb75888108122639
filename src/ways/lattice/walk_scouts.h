#pragma once
/// \file
/// Steps from lattice places, computed ahead on other cores. No result depends on that: a place expanded before its
/// scout is done computes its steps itself.

#include <tbb/task_group.h>

#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <unordered_map>

#include "ways/lattice/walk_step.h"

namespace roam::ways {

/// Steps from one place, by direction: the requested ones and their results.
struct ScoutedSteps {
  Standing here;
  LatticePoint at;
  std::uint8_t requested = 0;                              ///< bit set of the requested directions
  std::array<std::optional<FloorPlace>, directions> foot;  ///< as WalkSteps::foot_from
  std::array<float, directions> clearance;                 ///< there
  std::array<bool, directions> linked;                     ///< to the standing there
  std::atomic<std::uint8_t> ready{0};                      ///< bit set of the directions whose results may be read
  std::atomic<bool> done{false};                           ///< no other results are needed

  [[nodiscard]] bool is_ready(std::size_t direction) const {
    return (ready.load(std::memory_order_acquire) >> direction & 1U) != 0;
  }
};

/// Used by one thread. The caller makes sure that there are other cores; without them, scouts only cost time.
class Scouts {
 public:
  Scouts(const WalkSteps& steps, const LatticePlan& plan) : steps_(steps), plan_(plan) {}
  ~Scouts() noexcept;
  Scouts(const Scouts&) = delete;
  Scouts& operator=(const Scouts&) = delete;

  /// Computes the steps of a place in the directions `requested`, the last one first: expand() begins with the first
  /// one.
  void send(NodeId from, const Standing& here, const LatticePoint& at, std::uint8_t requested);
  /// The request for a place, with its results now or later. Removes it from here. Null if there is none.
  [[nodiscard]] std::shared_ptr<ScoutedSteps> take(NodeId from);
  /// Cancels all requests that are not computed yet.
  void forget();
  /// The number of requests that were not taken.
  [[nodiscard]] std::size_t out() const { return out_.size(); }

 private:
  void compute(ScoutedSteps& steps) const;

  const WalkSteps& steps_;
  const LatticePlan& plan_;
  std::unordered_map<NodeId, std::shared_ptr<ScoutedSteps>> out_;
  std::atomic<bool> ended_{false};
  tbb::task_group group_;
};

}  // namespace roam::ways
