#pragma once
/// \file
/// Whether bodies get from one place to another, and how it is told: the values behind `roam probe`.

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "picture/opening.h"
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

struct ProbeAnswer {
  ProbedSize size;
  Passage passage;
  bool passable = false;
  bool proven = false;            ///< that no wider way exists, or none that is wide enough, is certified
  double along = 0.0;             ///< metres of the way up to the opening
  double missing = 0.0;           ///< metres of the opening's width; 0 where it is wide enough
  std::optional<ProbeWalk> walk;  ///< where it was walked
};

/// The answers for all sizes, in their order. Sizes of one height that climb alike share one search. `progress` is
/// called with places looked at; false ends it: roam::Cancelled. Throws what widest_way throws.
[[nodiscard]] std::vector<ProbeAnswer> probe(const Survey& survey, const ProbeQuestion& question,
                                             std::span<const ProbedSize> sizes,
                                             const std::function<bool(std::uint64_t)>& progress);

/// The way as places of the centre of the body.
[[nodiscard]] std::vector<Vec3> centres(const ProbeQuestion& question, const ProbeAnswer& answer);
/// Sends the walker along the way.
[[nodiscard]] ProbeWalk walk_way(const Survey& survey, const ProbeQuestion& question, const ProbeAnswer& answer);

/// One to three sentences.
[[nodiscard]] std::string explain(const ProbeQuestion& question, const ProbeAnswer& answer);
/// The opening that decides, with the body in it; nothing where no opening does.
[[nodiscard]] std::optional<picture::OpeningView> view_of(const Survey& survey, const ProbeQuestion& question,
                                                          const ProbeAnswer& answer);

/// The members of one size; `way` and what belongs to it only where they are asked for.
[[nodiscard]] Json json_report(const ProbeAnswer& answer, bool with_way);
/// One line a size.
[[nodiscard]] std::string table(std::span<const ProbeAnswer> answers);

}  // namespace roam::app
