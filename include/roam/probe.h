#pragma once
/// \file
/// Whether a body of a given size gets from one place to another, and if not, what stops it and what is missing.
///
///     const roam::ProbeQuestion question{.from = {2, 0.3, 1}, .to = {18, -0.4, 1}};
///     const roam::ProbeAnswer answer = roam::probe(survey, question, {.radius = 0.3, .height = 1.9});
///     if (answer.passable) {
///       go(roam::probed_path(survey, question, answer));
///     } else if (answer.limit) {
///       std::cout << to_string(answer.limit->kind) << " " << answer.limit->size << " m\n";  // "door 0.52 m"
///     }
///
/// passage.h says how wide the widest way is; this says what that means to one body, or to many in one search. A yes is
/// said of a way that is wide enough and that a real Walker has gone. A no comes with what decides: a door, a headroom,
/// a step, the wall beside an end. `roam probe` asks just this; docs/probing.md has it in a shell's words.
///
/// Lengths are metres, up is +z. Same input, same bits. Functions may be called at the same time for one survey.
/// Library target roam::ways.

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

/// What is asked for every size. The floors are those of the survey: its slope limit is the walker's.
struct ProbeQuestion {
  Vec3 from{0.0};                         ///< of the feet or the eyes, taken down to the floor; flying: of the centre
  Vec3 to{0.0};                           ///< the same
  Mode mode = Mode::walk;                 ///< walk or fly
  double step = 0.3;                      ///< >= 0: what walking climbs at once; see climbed()
  double spacing = 0.2;                   ///< as PassageOptions::spacing
  double support_radius = 0.0;            ///< of the walker's foot, see WalkerSettings; 0: none of its own
  std::uint64_t most_places = 4'000'000;  ///< of one search, as PassageOptions::most_places
  /// As PassageOptions::progress, for each search there is; but false ends it all: probe() throws Cancelled.
  std::function<bool(std::uint64_t)> progress = {};
};

struct ProbedSize {
  double radius = 0.3;
  double height = 0.6;  ///< at least twice the radius; exactly that, as flying must be: a sphere. A person: say 1.8
};

/// What a body of that size climbs: a sphere at most its radius, a capsule at most what is below its round head when it
/// stands on its round foot.
[[nodiscard]] double climbed(const ProbeQuestion& question, const ProbedSize& size);

/// The body as a Walker takes it, its eye as apply() in profile.h has it. Throws Error for a size that no walker has.
[[nodiscard]] WalkerSettings probed_body(const ProbeQuestion& question, const ProbedSize& size,
                                         double slope_degrees = 45.0);

/// How the walker fared that was sent along the way.
struct ProbeWalk {
  Outcome outcome = Outcome::reached;
  Vec3 at{0.0};      ///< of its centre: where it came to, lost the ground, or stopped
  Vec3 on_way{0.0};  ///< the place of Passage::way that is nearest to it
};

/// What decides: the narrowest place of the way, or what stops the body.
struct ProbeLimit {
  enum class Kind : std::uint8_t {
    door,    ///< walls on both sides; `size` from one to the other
    lintel,  ///< something above and below, met aslant; `size` is the diameter of the largest body that passes
    gap,     ///< flying: any two sides; `size` from one to the other
    edge,    ///< a wall on one side, and on the other the floor ends; `size` from the wall to the axis
    start,   ///< `from` lies beside a wall; `size` from it to the axis. Or under a ceiling: see `too_low`
    target,  ///< the same of `to`
    height,  ///< a lower body passes; `size` is the height from the feet that one of this radius may have
    step,    ///< who stepped more would pass; `size` is by how much the floor rises or falls at once
    apart,   ///< nothing joins both ends: here what is reached from them comes nearest to each other; no `size`.
             ///< Told only where that is 1 m or nearer on foot, and 2 m flying
  };
  Kind kind = Kind::door;
  Vec3 point{0.0};       ///< the middle of what is measured; of a height and a step on the floor
  Vec3 direction{0.0};   ///< unit, along what is measured
  Vec3 heading{0.0};     ///< unit, level, as the way leads there; 0: not known
  Vec3 feet{0.0};        ///< where the body stands there; flying: its centre
  double size = 0.0;     ///< what there is
  double needed = 0.0;   ///< what the body needs; of a step what it climbs
  double width = 0.0;    ///< of a height: how wide it is there for a body that passes; 0: not known, or not narrow
  double along = 0.0;    ///< of the way up to there
  bool too_low = false;  ///< of an end: a headroom is measured, not a distance
};

/// "door", "lintel", "gap", "edge", "end" (of both), "height", "step" or "apart".
[[nodiscard]] const char* to_string(ProbeLimit::Kind kind);

struct ProbeAnswer {
  ProbedSize size;
  bool passable = false;     ///< there is a way that is wide enough, and the walker has gone it
  bool wide_enough = false;  ///< there is one, whatever the walker did
  Passage passage;           ///< the widest way for bodies that are as high and climb as much
  double narrowest = 0.0;    ///< no way for a body of a radius up to that was looked for
  /// Where a way is wide enough: as Passage::proven. Else: that none for a body of this radius exists is certified; of
  /// an end that is too low, that it is.
  bool proven = false;
  Vec3 start{0.0}, target{0.0};  ///< where a body stands for `from` and `to`: at most 2 m aside, in sight
  /// None where nothing on the way is as narrow as is looked for. Of a no, none where nothing joins both ends (not
  /// passage.found) and they come nowhere near each other: two floors, say.
  std::optional<ProbeLimit> limit;
  double missing = 0.0;           ///< what `limit` leaves too little for the body; 0 where it is enough, and for apart
  std::optional<Vec3> room;       ///< where an end is in the way: the nearest place found where it would not be
  std::optional<ProbeWalk> walk;  ///< where the way is wide enough
};

/// Nobody can be at an end, nor near it, or it lies off the scene by more than its diagonal and 100 m: what() begins
/// with "from" or "to" and says why.
class NoRoomAtEnd : public Error {
 public:
  NoRoomAtEnd(const std::string& why, const std::optional<Vec3>& place) : Error(why), nearest(place) {}
  std::optional<Vec3> nearest;  ///< the nearest place found where a body of the smallest radius asked for has room
};

/// The answers for all sizes, in their order. Sizes of one height that climb alike share one search. Throws Error for
/// sizes that no walker has, and flying for one that is no sphere, what widest_way throws, NoRoomAtEnd, and Cancelled
/// when `progress` says so.
[[nodiscard]] std::vector<ProbeAnswer> probe(const Survey& survey, const ProbeQuestion& question,
                                             std::span<const ProbedSize> sizes);
/// The answer for one.
[[nodiscard]] ProbeAnswer probe(const Survey& survey, const ProbeQuestion& question, const ProbedSize& size);

/// The way as places of the body's centre, for follow(); empty where none was found. Flying, it keeps so near the
/// scene, as far as the ends allow, that who goes it has not left it.
[[nodiscard]] std::vector<Vec3> probed_path(const Survey& survey, const ProbeQuestion& question,
                                            const ProbeAnswer& answer);

/// Places that the smallest bodies come to from both ends, at most `most` from each, for a picture of a no: of the
/// feet, flying of the centre. Flying, none farther beyond the box of the scene than some metres, nor from an end that
/// lies there. Throws Cancelled when `progress` says so.
struct ProbeReach {
  std::vector<Vec3> from_start, from_target;
};
[[nodiscard]] ProbeReach probed_reach(const Survey& survey, const ProbeQuestion& question, const ProbeAnswer& answer,
                                      std::uint64_t most);

}  // namespace roam
