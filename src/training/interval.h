#pragma once
/// \file
/// The feasible interval of a layout: its ends from widest ways and cracks, the body that is chosen from it, and the
/// trials that prove it.

#include <optional>
#include <string>
#include <vector>

#include "cracks/rim_edges.h"
#include "roam/train.h"
#include "training/crossings.h"
#include "training/layout.h"
#include "training/stages.h"

namespace roam::training {

/// Part of the upper end that a body gets: 1 cm less on each side of a door of 0.7 m is for turning into it.
inline constexpr double inside_share = 0.97;
/// Part of the upper end that certainly no body passes with.
inline constexpr double outside_share = 1.02;
/// m. A foot is so much larger than a crack's half width, and a trial's foot that is to fall so much smaller.
inline constexpr double foot_margin = 0.02;

/// A round body is carried by both rims of a crack from 1 / sin(70 degrees) of its half width on (docs/walking.md); and
/// a little for rims that are not straight.
inline constexpr double carried_share = 1.08;

/// A gap on a path.
struct PathCrossing {
  std::size_t path = 0;
  Crossing crossing;
};

/// What the ends were found from.
struct Evidence {
  std::vector<cracks::FoundCrack> cracks;  ///< along the floor that was reached
  /// m, of each of them that is one and no trench: the least radius that its rims carry in both directions. The walkers
  /// that confirm the paths may ask for more.
  std::vector<double> carried;
  std::vector<PathCrossing> crossings;   ///< of gaps that are cracks
  std::optional<std::size_t> narrowest;  ///< the path that decides the upper end
  std::optional<std::size_t> widest;     ///< the crack that decides the lower end
  std::optional<std::size_t> hardest;  ///< the one on a path that asks for the largest body, where its rims are uneven
  std::optional<std::size_t> shallow;  ///< the widest that no foot is carried over
  double least_foot = 0.0;             ///< m, of the least foot that is carried over all of them; 0: there are none
  bool complete = true;                ///< false: ended before all cracks were found
};

/// How cracks are looked for.
[[nodiscard]] cracks::CrackOptions crack_options(const TrainOptions& options, const ways::Measure& measure);

/// The cracks of what was reached. `ahead` is what was looked at meanwhile, of any options.
[[nodiscard]] Evidence find_cracks(const Survey& survey, const TrainOptions& options, const Layout& layout,
                                   cracks::RimEdges& ahead, Stages& stages);

/// A body and its foot, m.
struct BodySize {
  double radius = 0.0, support_radius = 0.0;
  bool operator==(const BodySize&) const = default;
};

/// The body that choose_body() chooses for paths that go over those cracks, as long as no more are added.
[[nodiscard]] BodySize body_of_paths(const ways::BodyKind& kind, const TrainOptions& options, const Evidence& evidence,
                                     const Crossings& crossings, const Layout& layout);

/// Fills in paths, cracks, both ends, trapped_radius and decisive. Where the number of paths is left open, a crack that
/// is wider than those on the paths and that nobody can walk around gets a path of its own.
void find_ends(const Survey& survey, const TrainOptions& options, Layout& layout, Evidence& evidence,
               Training& training);

/// Whether a body is so much smaller than a crack that it sinks into it.
[[nodiscard]] bool sinks_into(double radius, const Crack& crack);

/// The radius below which a sphere that sank into a crack of that disc cannot step out of it; 0 where it can always.
[[nodiscard]] double trapped_below(double crack_radius, double step);

/// The least radius that is carried over all cracks on the paths in both directions, m.
[[nodiscard]] double carried_on_paths(const Evidence& evidence, const Training& training);

/// The lower end, m: half the width of the widest crack on the paths, or the least radius that comes up over a higher
/// rim.
[[nodiscard]] double least_on_paths(const Evidence& evidence, const Training& training);

/// Chooses radius and support_radius from the paths and both ends, and says whether the interval is feasible:
///   - the radius of a person, 0.3 m, where it lies in the interval; else the nearest to it that does, with a margin of
///     3 % to the upper end and 8 % to the lower, so that the rims carry it, and more where one rim is higher;
///   - where the upper end is of no use to anybody, as above of the paths that let a useful size through;
///   - where no radius is in the interval, the person's or the largest that passes, and a foot;
///   - the foot, where any crack of the floor is too wide for the body: its disc and 2 cm; beside a wall the largest
///   disc
///     whose centre is in the gap.
void choose_body(const ways::BodyKind& kind, const TrainOptions& options, const Evidence& evidence, Training& training);

/// Where the chosen body does not pass: smaller ones, for necks that are no part of a path, and the rooms behind.
void add_regions(const Survey& survey, const TrainOptions& options, const Layout& layout, Stages& stages,
                 Training& training);

/// Sends bodies along all paths with the chosen size, and with sizes just inside and just outside both ends past the
/// opening or over the crack that decides; adds the trials to the paths, and what contradicts the ends.
void prove(const Survey& survey, const ways::BodyKind& kind, const Layout& layout, const Evidence& evidence,
           Stages& stages, Training& training);

}  // namespace roam::training
