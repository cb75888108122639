#pragma once
/// \file
/// Parts of a probe besides the widest way: standing places at the ends, and the limit that stops a body.

#include <optional>
#include <vector>

#include "roam/probe.h"
#include "ways/lattice/lattice.h"

namespace roam::ways {

/// The body of one search: its height and step as the searches use them.
struct ProbeSearch {
  const Survey& survey;
  const ProbeQuestion& question;
  PassageOptions options;  ///< all but `progress`

  [[nodiscard]] Measure measure() const;
  /// The widest way between both ends. Throws roam::Cancelled.
  [[nodiscard]] Passage widest() const;
};

/// Options for a body of that size. Several sizes that share a search pass the largest and the smallest.
[[nodiscard]] PassageOptions options_for(const ProbeQuestion& question, const ProbedSize& largest, double smallest);
[[nodiscard]] inline PassageOptions options_for(const ProbeQuestion& question, const ProbedSize& size) {
  return options_for(question, size, size.radius);
}

[[nodiscard]] inline bool is_end(ProbeLimit::Kind kind) {
  return kind == ProbeLimit::Kind::start || kind == ProbeLimit::Kind::target;
}

/// Whether a body stands aside of the point that was given for it.
[[nodiscard]] bool is_moved(const Vec3& place, const Vec3& given, Mode mode);

/// The standing place for `given`; none if no body of options.narrowest fits there or near. It has room for `radius` if
/// there is such a place: near `given` by a straight way, or in sight if options.narrowest does not fit at `given`.
[[nodiscard]] std::optional<Vec3> stand_for(const ProbeSearch& search, const Vec3& given, double radius);

/// The nearest place found where a body of `radius` has room: in sight and at most 3 m away, else on the nearest
/// floors.
[[nodiscard]] std::optional<Vec3> nearest_room(const ProbeSearch& search, const Vec3& place, double radius);

/// The height limit of a body of `narrowest` at `given`; none if no body can stand there at any height.
[[nodiscard]] std::optional<ProbeLimit> low_end(const ProbeSearch& search, const Vec3& given, ProbeLimit::Kind end);

/// Throws NoRoomAtEnd if an end lies so far outside the scene that the search would have to cover all the air between.
void refuse_far_end(const ProbeSearch& search, const Vec3& given, const char* end);

/// Throws an error with the reason why no body fits at an end, and the nearest place where one does.
[[noreturn]] void refuse_end(const ProbeSearch& search, const Vec3& given, const char* end, double radius);

/// Standing places for both ends.
struct ProbeEnds {
  Vec3 start{0.0}, target{0.0};
};

/// The limit of a way. If none was found: an end without room for the body, or the place where it breaks off.
[[nodiscard]] std::optional<ProbeLimit> limit_of(const ProbeSearch& search, const Passage& passage,
                                                 const ProbeEnds& ends, double radius);

/// A way with steps down that the body cannot climb back. Without one, passage.complete is false if a limit ended the
/// search.
struct WayDown {
  Passage passage;
  std::vector<ProbeDrop> drops;
};
/// A way for a body of `radius` (m) that steps down by at most `deepest` (m) at a time. An end with too little room has
/// none. Throws roam::Cancelled.
[[nodiscard]] WayDown way_down(const ProbeSearch& search, const ProbeEnds& ends, double radius, double deepest);

/// The largest height, to a millimetre, with which a body of that radius gets through, if it is too tall now. None if
/// no height helps.
[[nodiscard]] std::optional<ProbeLimit> headroom(const ProbeSearch& search, double radius);

/// The highest step of the part of a way that lies in a box, as a limit without `needed`: the largest change of floor
/// height between its samples.
[[nodiscard]] ProbeLimit highest_step(const ProbeSearch& search, const std::vector<Vec3>& way, const Box& where);

/// The highest step of a way that climbs least, to 2 cm.
struct StepUp {
  ProbeLimit limit;
  double least = 0.0;  ///< the radius of the body
  Passage passage;     ///< the way, at least that wide
};
/// For a body of that radius, if no way was found. None if no step helps.
[[nodiscard]] std::optional<StepUp> step_up(const ProbeSearch& search, double radius);

}  // namespace roam::ways
