#pragma once
/// \file
/// Edges of floors that may have a void outside, whoever comes there: what is asked of the scene alone, and so may be
/// asked while places are looked for.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "train/cracks/cracks.h"

namespace roam::training {

/// Used by one thread at a time.
class RimEdges {
 public:
  /// `survey` must outlive it.
  RimEdges(const Survey& survey, const CrackOptions& options);
  ~RimEdges() noexcept;
  RimEdges(const RimEdges&) = delete;
  RimEdges& operator=(const RimEdges&) = delete;

  [[nodiscard]] const CrackOptions& options() const;
  /// Lets one other core begin, where there is one and as long as it has nothing else to do.
  void look_ahead();
  /// Ends that. Of each of survey.floor_triangles(), bit k: no void lies outside the edge from corner k to the next,
  /// within one floor or beside it. What was not looked at yet is not set: who looks sets it, each floor by one thread.
  [[nodiscard]] std::vector<std::uint8_t>& without_void();
  /// After that: so many of the floors, from the first one on, have been looked at.
  [[nodiscard]] std::size_t looked_at() const;
  void set_all_looked_at();

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace roam::training
