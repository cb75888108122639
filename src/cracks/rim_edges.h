#pragma once
/// \file
/// Edges of floors that may have a void outside, whoever comes there: what is asked of the scene alone, and so may be
/// asked while places are looked for.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "cracks/cracks.h"

namespace roam::cracks {

/// Used by one thread at a time.
class RimEdges {
 public:
  /// `survey` must outlive it. So many floors are looked at together: some milliseconds of work, for most edges are
  /// inside a floor.
  explicit RimEdges(const Survey& survey, const CrackOptions& options, int floors_together = 4096);
  ~RimEdges() noexcept;
  RimEdges(const RimEdges&) = delete;
  RimEdges& operator=(const RimEdges&) = delete;

  [[nodiscard]] const CrackOptions& options() const;
  /// Lets one other core begin, where there is one and as long as it has nothing else to do.
  void look_ahead();
  /// What that core does next, done here. Returns whether there was anything left.
  bool look_ahead_here();

  /// Of one of survey.floor_triangles(), by its number. Bit k of `without`: no void lies outside the edge from corner k
  /// to the next, within one floor or beside it. `is_known`: the others have one somewhere; else they have not been
  /// looked at.
  using Look = std::function<void(std::size_t floor, std::uint8_t& without, bool is_known)>;
  /// Ends looking ahead, and calls `look` with all floors, from all cores: it sets what it finds out. `goes_on`, if
  /// any, is asked with the fraction done, by one thread at a time; false ends it early. Returns whether it did not end
  /// so: all is known then.
  bool look_at_all(const Look& look, const std::function<bool(double)>& goes_on);

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace roam::cracks
