#pragma once
/// \file
/// What a probe asks besides the widest way: where the ends stand, and what it is that stops a body.

#include <optional>

#include "roam/probe.h"
#include "ways/lattice/lattice.h"

namespace roam::ways {

/// One search's kind of body: its height and step as the searches take them.
struct ProbeSearch {
  const Survey& survey;
  const ProbeQuestion& question;
  PassageOptions options;  ///< all but `progress`

  [[nodiscard]] Measure measure() const;
  /// The widest way between both ends. Throws roam::Cancelled.
  [[nodiscard]] Passage widest() const;
};

/// How a body of that size is searched for; of several that are measured alike, the largest and the smallest.
[[nodiscard]] PassageOptions options_for(const ProbeQuestion& question, const ProbedSize& largest, double smallest);
[[nodiscard]] inline PassageOptions options_for(const ProbeQuestion& question, const ProbedSize& size) {
  return options_for(question, size, size.radius);
}

[[nodiscard]] inline bool is_end(ProbeLimit::Kind kind) {
  return kind == ProbeLimit::Kind::start || kind == ProbeLimit::Kind::target;
}

/// Where a body stands for a place that was asked for; none where none of options.narrowest can.
[[nodiscard]] std::optional<Vec3> stand_for(const ProbeSearch& search, const Vec3& asked);

/// The nearest place where a body of `radius` has room, as far as one is found: in sight and at most 3 m away, or else
/// on the floors that are nearest.
[[nodiscard]] std::optional<Vec3> nearest_room(const ProbeSearch& search, const Vec3& place, double radius);

/// How high a body of `narrowest` may be at the place that was asked for; none where none can stand there.
[[nodiscard]] std::optional<ProbeLimit> low_end(const ProbeSearch& search, const Vec3& asked, ProbeLimit::Kind end);

/// Says so where an end lies so far outside the scene that all the air between would have to be looked at. Throws
/// NoRoomAtEnd.
void refuse_far_end(const ProbeSearch& search, const Vec3& asked, const char* end);

/// Says why nobody can be at an end, and where one could be.
[[noreturn]] void refuse_end(const ProbeSearch& search, const Vec3& asked, const char* end, double radius);

/// Where bodies stand for both ends.
struct ProbeEnds {
  Vec3 start{0.0}, target{0.0};
};

/// What decides a way that was found; of one that was not, an end without room for the body, or where it breaks off.
[[nodiscard]] std::optional<ProbeLimit> limit_of(const ProbeSearch& search, const Passage& passage,
                                                 const ProbeEnds& ends, double radius);

/// Where a body of that radius is too high, and a lower one gets through: the height of the largest that does, to a
/// millimetre. None where no height helps.
[[nodiscard]] std::optional<ProbeLimit> headroom(const ProbeSearch& search, double radius);

/// Where a body of that radius would get through if it climbed more: what it would have to. `broken`: the passage that
/// was not found. None where no step helps.
[[nodiscard]] std::optional<ProbeLimit> step_up(const ProbeSearch& search, const Passage& broken, double radius);

}  // namespace roam::ways
