#pragma once
/// \file
/// Whether bodies get from one place to another, and how it is told: the values behind `roam probe`.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report.h"
#include "roam/passage.h"
#include "roam/route.h"
#include "roam/survey.h"
#include "roam/walker.h"

namespace roam::app {

struct ProbedSize {
  double radius = 0.3;
  double height = 0.6;  ///< at least twice the radius; exactly that: a sphere
};

/// "0.3, 0.4x1.9": radii, or radius x height, in metres, separated by commas or blanks. `where` begins messages.
/// Throws UsageError for what is none.
[[nodiscard]] std::vector<ProbedSize> parse_sizes(const std::string& text, const std::string& where);

struct ProbeQuestion {
  Vec3 from{0.0}, to{0.0};
  Mode mode = Mode::walk;  ///< walk or fly
  double step = 0.3;
  double slope_degrees = 45.0;
  double spacing = 0.2;
  double support_radius = 0.0;  ///< of the foot, for the walker that goes the way; 0: none of its own
};

/// What a body of that size climbs, metres: a sphere at most its radius, a capsule at most what is below its round head
/// when it stands on its round foot.
[[nodiscard]] double climbed(const ProbeQuestion& question, const ProbedSize& size);
/// The body as a Walker takes it. Throws roam::Error for a size that no walker has.
[[nodiscard]] WalkerSettings settings_of(const ProbeQuestion& question, const ProbedSize& size);

/// How the real walker fared along the way.
struct ProbeWalk {
  Outcome outcome = Outcome::reached;
  Vec3 at{0.0};  ///< of the centre; where it fell or stopped
};

/// What decides: the narrowest place of the way, or what stops the body.
struct Limit {
  enum class Kind : std::uint8_t {
    door,    ///< walls on both sides; `size` from one to the other
    lintel,  ///< something above and below, met aslant; `size` is the diameter of the largest body that passes
    gap,     ///< flying: any two sides; `size` from one to the other
    edge,    ///< a wall on one side, and on the other the floor ends; `size` from the wall to the axis
    start,   ///< the start stands beside a wall; `size` from it to its axis. Or under a ceiling: see `too_low`
    target,  ///< the same of the target
    height,  ///< `size` is the height from the feet that a body of this radius may have
    step,    ///< `size` is by how much the floor rises or falls at once
    apart,   ///< nothing joins both ends: here they come nearest to each other
  };
  Kind kind = Kind::door;
  Vec3 point{0.0};       ///< the middle of what is measured; of a height and a step on the floor
  Vec3 direction{0.0};   ///< unit, along what is measured
  Vec3 heading{0.0};     ///< unit, as the way leads there; 0: not known
  Vec3 feet{0.0};        ///< where the body stands there; flying: its centre
  double size = 0.0;     ///< m
  double needed = 0.0;   ///< m, by the body; of a step what it climbs
  double along = 0.0;    ///< m of the way up to there
  bool too_low = false;  ///< of an end: a headroom is measured, not a distance
};

/// "door", "lintel", "gap", "edge", "end", "height", "step" or "apart".
[[nodiscard]] const char* name(Limit::Kind kind);
[[nodiscard]] inline bool is_end(Limit::Kind kind) { return kind == Limit::Kind::start || kind == Limit::Kind::target; }

struct ProbeAnswer {
  ProbedSize size;
  Passage passage;
  double narrowest = 0.0;         ///< m: of bodies that are not larger than this nothing is known
  bool wide_enough = false;       ///< there is a way that is wide enough for the body
  bool passable = false;          ///< and the walker has gone it
  bool proven = false;            ///< that no wider way exists, or none that is wide enough, is certified
  Vec3 start{0.0}, target{0.0};   ///< where a body stands for `from` and `to`
  std::optional<Limit> limit;     ///< none where nothing on the way is as narrow as is looked for
  double missing = 0.0;           ///< m, what `limit` leaves too little for the body; 0 where it is enough
  std::optional<Vec3> room;       ///< where an end is in the way: the nearest place where it would not be
  std::optional<ProbeWalk> walk;  ///< where the way is wide enough
};

/// Called with places looked at; false ends the search: roam::Cancelled.
using ProbeProgress = std::function<bool(std::uint64_t)>;

/// The answers for all sizes, in their order. Sizes of one height that climb alike share one search. Throws what
/// widest_way throws, and roam::Error for an end where nobody can stand, with the nearest place where one could.
[[nodiscard]] std::vector<ProbeAnswer> probe(const Survey& survey, const ProbeQuestion& question,
                                             std::span<const ProbedSize> sizes, const ProbeProgress& progress);

/// The way as places of the centre of the body. Flying, it keeps so near the scene, as far as the ends allow, that who
/// goes it has not left it.
[[nodiscard]] std::vector<Vec3> centres(const Survey& survey, const ProbeQuestion& question, const ProbeAnswer& answer);

/// What decides, in a few words, with its size: "door 0.520 m wide".
[[nodiscard]] std::string text_of(const Limit& limit);
/// One to four sentences.
[[nodiscard]] std::string explain(const ProbeQuestion& question, const ProbeAnswer& answer);
/// The members of one size; `way` and what belongs to it only where they are asked for.
[[nodiscard]] Json json_report(const ProbeAnswer& answer, bool with_way);
/// One line a size.
[[nodiscard]] std::string table(const ProbeQuestion& question, std::span<const ProbeAnswer> answers);

}  // namespace roam::app
