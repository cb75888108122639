#pragma once
/// \file
/// Edges of floors that may have a void outside. This needs the scene only, not the reached places, so it can be
/// computed while a search for places is running.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "cracks/cracks.h"

namespace roam::cracks {

/// Used by one thread at a time.
class RimEdges {
 public:
  /// `survey` must outlive it. `floors_together` is the size of one piece of work. The default takes some milliseconds,
  /// because most edges are inside a floor.
  explicit RimEdges(const Survey& survey, const CrackOptions& options, int floors_together = 4096);
  ~RimEdges() noexcept;
  RimEdges(const RimEdges&) = delete;
  RimEdges& operator=(const RimEdges&) = delete;

  [[nodiscard]] const CrackOptions& options() const;
  /// Starts the work on one other core at low priority, if there is one.
  void look_ahead();
  /// Does the next piece of that work on this thread. Returns false if nothing was left.
  bool look_ahead_here();

  /// Receives a floor's index in survey.floor_triangles(). Bit k of `without` is set if no void lies outside the edge
  /// from corner k to the next, because floor continues there or a wall stands there. `is_known`: all other edges have
  /// a void somewhere; otherwise they have not been examined.
  using Look = std::function<void(std::size_t floor, std::uint8_t& without, bool is_known)>;
  /// Ends looking ahead, then calls `look` for all floors, from all cores; `look` sets the bits that it finds. Calls
  /// `goes_on`, if any, with the fraction done, from one thread at a time; false ends it early. Returns true if it was
  /// not ended: then everything is known.
  bool look_at_all(const Look& look, const std::function<bool(double)>& goes_on);

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace roam::cracks
