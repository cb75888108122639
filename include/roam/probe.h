#pragma once
/// \file
/// Probe: whether a body of a given size gets from one position to another, and its obstacle if not.
///
///     const roam::ProbeQuestion question{.from = {2, 0.3, 1}, .to = {18, -0.4, 1}};
///     const roam::ProbeAnswer answer = roam::probe(survey, question, {.radius = 0.3, .height = 1.9});
///     if (answer.passable) {
///       go(roam::probed_path(survey, question, answer));
///     } else if (answer.limit) {
///       std::cout << to_string(answer.limit->kind) << " " << answer.limit->size << " m\n";  // "door 0.52 m"
///     }
///
/// `passable` means that a way is wide enough (passage.h) and that a Walker has gone it. Otherwise `limit` names the
/// obstacle: a door, a headroom, a step, a wall beside an end. The program is `roam probe`; docs/probing.md explains
/// the answers.
///
/// Metres, up is +z. The same input gives the same bits. Thread-safe. Target roam::ways.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "roam/error.h"
#include "roam/passage.h"
#include "roam/route.h"
#include "roam/survey.h"
#include "roam/walker.h"

namespace roam {

/// The question, for all sizes. The slope limit is that of the survey.
struct ProbeQuestion {
  Vec3 from{0.0};                         ///< of feet or eyes, which drop to the floor below; flying: of the centre
  Vec3 to{0.0};                           ///< likewise
  Mode mode = Mode::walk;                 ///< walk or fly
  double step = 0.3;                      ///< >= 0: see climbed()
  double spacing = 0.2;                   ///< as PassageOptions::spacing
  double support_radius = 0.0;            ///< see WalkerSettings; 0: none
  std::uint64_t most_places = 4'000'000;  ///< of each search, as PassageOptions::most_places
  /// As PassageOptions::progress, for each search. Returning false makes probe() throw Cancelled.
  std::function<bool(std::uint64_t)> progress = {};
};

struct ProbedSize {
  double radius = 0.3;
  double height = 0.6;  ///< >= 2 * radius; flying == 2 * radius, a sphere; 1.8 for a person
};

/// The step that a body of that size climbs: a capsule at most half its height, and at most height - 2 * radius; a
/// sphere, or one < 5 mm higher, its radius.
[[nodiscard]] double climbed(const ProbeQuestion& question, const ProbedSize& size);

/// Settings of the walker that goes the way. Throws Error if a Walker refuses the size.
[[nodiscard]] WalkerSettings probed_body(const ProbeQuestion& question, const ProbedSize& size,
                                         double slope_degrees = 45.0);

/// How the walker fared on the way.
struct ProbeWalk {
  Outcome outcome = Outcome::reached;
  Vec3 at{0.0};       ///< its centre at the end
  Vec3 on_way{0.0};   ///< the nearest point of Passage::way
  double step = 0.0;  ///< m: if it is blocked by a step that is a little too high, the step's height; else 0
};

/// A step down that the body cannot climb back. A walker goes down by at most its Walker::fall_limit().
struct ProbeDrop {
  Vec3 rim{0.0};            ///< the end of the upper floor
  Vec3 from{0.0}, to{0.0};  ///< the feet before and after it
  [[nodiscard]] double height() const { return from.z - to.z; }
};

/// The limit: the narrowest position of the way, or the obstacle.
struct ProbeLimit {
  enum class Kind : std::uint8_t {
    door,    ///< walls on both sides; `size` is the distance between them
    lintel,  ///< surfaces above and below at an angle; `size` is the diameter of the largest body that passes
    gap,     ///< flying: any two surfaces; `size` is the distance between them
    edge,    ///< a wall on one side, the end of the floor on the other; `size` is from the wall to the body's axis
    start,   ///< `from` is beside a wall, and `size` is from it to the axis; or under a ceiling, see `too_low`
    target,  ///< likewise for `to`
    height,  ///< headroom; `size` is the height that a body of this radius may have
    step,    ///< the highest step of the way that climbs least, to 2 cm; `size` is its height
    apart,   ///< no way: here the positions reached from both ends come nearest, within 1 m, flying 2 m; no `size`
  };
  Kind kind = Kind::door;
  Vec3 point{0.0};       ///< middle of the measured distance; for a height or step, on the floor
  Vec3 direction{0.0};   ///< unit, along the measured distance
  Vec3 heading{0.0};     ///< unit, level, along the way; 0: unknown
  Vec3 feet{0.0};        ///< of the body there; flying: its centre
  double size = 0.0;     ///< available
  double needed = 0.0;   ///< by the body; for a step, the highest that it climbs
  double width = 0.0;    ///< for a height: width for a body that passes; 0: unknown or not narrow
  double along = 0.0;    ///< length of the way up to there
  bool too_low = false;  ///< for an end: `size` is a headroom
  /// For a door: both sides are of one object and reach up to what is above. Otherwise, it is a gap between things.
  bool has_head = false;
};

/// "door", "lintel", "gap", "edge", "end" (start and target), "height", "step" or "apart".
[[nodiscard]] const char* to_string(ProbeLimit::Kind kind);

struct ProbeAnswer {
  ProbedSize size;
  bool passable = false;     ///< a way is wide enough, and the walker has gone it
  bool wide_enough = false;  ///< a way is wide enough
  /// The widest way for bodies of this height and step; after a fall, one that avoids what this body falls into. With
  /// `drops`: a way for this body.
  Passage passage;
  /// The way leads from `from` to `to` only: in its order, the steps down that the body cannot climb back. A way
  /// without drops comes first.
  std::vector<ProbeDrop> drops;
  double narrowest = 0.0;  ///< smallest radius searched for
  /// If a way was found that is not wide enough: a radius, to half a millimetre, with which a walker has gone it. 0: no
  /// walker has.
  double passing = 0.0;
  /// If wide_enough: Passage::proven. Otherwise: it is certified that no way for this radius exists, or that an end is
  /// too low.
  bool proven = false;
  Vec3 start{0.0}, target{0.0};  ///< the body's places for `from` and `to`: at most 2 m aside, in sight
  /// None if nothing limits the way, or if no way was found and both ends are far apart.
  std::optional<ProbeLimit> limit;
  /// A second obstacle. It stops this body, too, but not narrower ones. The limit is then a step or headroom.
  std::optional<ProbeLimit> other;
  double missing = 0.0;           ///< max(0, needed - size) of the limit; 0 for `apart`
  std::optional<Vec3> room;       ///< if an end is the limit: the nearest position with room
  std::optional<ProbeWalk> walk;  ///< if wide_enough
};

/// No body fits at an end or near it, or the end is farther from the scene than its diagonal + 100 m. where() is the
/// end, "from (2.00, 0.00, 1.00)" or "to (8.00, 0.00, 1.00)".
class NoRoomAtEnd : public Error {
 public:
  NoRoomAtEnd(std::string_view end, std::string_view why, const std::optional<Vec3>& place)
      : Error(end, why), nearest(place) {}
  std::optional<Vec3> nearest;  ///< nearest position with room for the smallest radius
};

/// Answers for all sizes, in their order. Sizes of the same height, step and ends share one search. Throws Error for
/// sizes that a Walker refuses, flying for one that is no sphere, and as widest_way() does; NoRoomAtEnd; Cancelled.
[[nodiscard]] std::vector<ProbeAnswer> probe(const Survey& survey, const ProbeQuestion& question,
                                             std::span<const ProbedSize> sizes);
/// As above, for one size.
[[nodiscard]] ProbeAnswer probe(const Survey& survey, const ProbeQuestion& question, const ProbedSize& size);

/// The way as positions of the body's centre, for follow(); empty if there is none. A flying way stays near the scene.
[[nodiscard]] std::vector<Vec3> probed_path(const Survey& survey, const ProbeQuestion& question,
                                            const ProbeAnswer& answer);

/// Positions that the smallest body reaches from each end, at most `most` each, for a picture: of the feet, flying of
/// the centre near the scene. Throws Cancelled.
struct ProbeReach {
  std::vector<Vec3> from_start, from_target;
};
[[nodiscard]] ProbeReach probed_reach(const Survey& survey, const ProbeQuestion& question, const ProbeAnswer& answer,
                                      std::uint64_t most);

}  // namespace roam
