#pragma once
/// \file
/// The feasible interval of a layout: both ends from widest ways and cracks, the body chosen from it, and the trials
/// that prove it.

#include <optional>
#include <string>
#include <vector>

#include "cracks/rim_edges.h"
#include "roam/train.h"
#include "training/crossings.h"
#include "training/layout.h"
#include "training/stages.h"

namespace roam::training {

/// Part of the upper end that a body gets. The rest, 1 cm on each side of a door of 0.7 m, is room to turn into it.
inline constexpr double inside_share = 0.97;
/// Part of the upper end with which certainly no body passes.
inline constexpr double outside_share = 1.02;
/// m. A support disc exceeds a crack's half width by this. In a trial that must fall, the support disc is smaller by
/// this.
inline constexpr double support_margin = 0.02;

/// Half widths of a crack: the least radius that both rims carry is 1 / sin(70 degrees) (docs/walking.md). The rest is
/// for rims that are not straight.
inline constexpr double carried_share = 1.08;

/// A gap on a path.
struct PathCrossing {
  std::size_t path = 0;
  Crossing crossing;
};

/// The findings behind both ends.
struct Evidence {
  std::vector<cracks::FoundCrack> cracks;  ///< along the reached floor
  /// m, for each crack with Kind::crack that is no trench: the least radius that its rims carry in both directions. The
  /// walkers that confirm the paths may raise it.
  std::vector<double> carried_radius;
  std::vector<PathCrossing> crossings;        ///< of gaps with Kind::crack
  std::optional<std::size_t> limiting_path;   ///< the path that decides the upper end
  std::optional<std::size_t> limiting_crack;  ///< the crack that decides the lower end
  std::optional<std::size_t> hardest;  ///< the crack on a path that needs the largest body, because its rims are uneven
  std::optional<std::size_t> shallow;  ///< the widest crack that no support disc bridges, because it is shallow
  double least_support = 0.0;          ///< m, the least support disc that bridges all cracks; 0: there are none
  bool complete = true;                ///< false: ended before all cracks were found
};

/// The options of the search for cracks.
[[nodiscard]] cracks::CrackOptions crack_options(const TrainOptions& options, const ways::Measure& measure);

/// The cracks along the reached floor. `ahead` holds rim edges examined so far; it is ignored if its options differ.
[[nodiscard]] Evidence find_cracks(const Survey& survey, const TrainOptions& options, const Layout& layout,
                                   cracks::RimEdges& ahead, Stages& stages);

/// A body and its support disc, m.
struct BodySize {
  double radius = 0.0, support_radius = 0.0;
  bool operator==(const BodySize&) const = default;
};

/// The body that choose_body() would choose for paths that cross those cracks, if no paths are added.
[[nodiscard]] BodySize body_of_paths(const ways::BodyKind& kind, const TrainOptions& options, const Evidence& evidence,
                                     const Crossings& crossings, const Layout& layout);

/// Fills in paths, cracks, both ends, trapped_radius, narrowest and widest. If the number of paths is left open, a
/// crack wider than those on the paths that cannot be walked around gets a path of its own.
void find_ends(const Survey& survey, const TrainOptions& options, Layout& layout, Evidence& evidence,
               Training& training);

/// Whether a body is so much smaller than a crack that it sinks into it.
[[nodiscard]] bool sinks_into(double radius, const Crack& crack);

/// The radius below which a sphere that sank into a crack with that disc cannot step out of it; 0 if it always can.
[[nodiscard]] double trapped_below(double crack_radius, double step);

/// m, the least radius that all cracks on the paths carry in both directions.
[[nodiscard]] double carried_on_paths(const Evidence& evidence, const Training& training);

/// m, the lower end: half the width of the widest crack on the paths, or the least radius that rolls up over a higher
/// rim.
[[nodiscard]] double least_on_paths(const Evidence& evidence, const Training& training);

/// Chooses radius and support_radius from the paths and both ends, and sets `feasible`:
/// - the radius of a person, 0.3 m, if it lies in the interval; else the nearest one that does. The margin is 3 % to
///   the upper end. To the lower end it is 8 %, so that the rims carry the body, and more if one rim is higher;
/// - if the upper end is too small for any use: as above, from the paths that let a useful size through;
/// - if no radius is in the interval: the person's radius, or the largest that passes, and a support disc;
/// - the support disc, if any crack of the floor is too wide for the body: its disc and 2 cm; beside a wall, the
/// largest disc
///   whose centre is in the gap.
void choose_body(const ways::BodyKind& kind, const TrainOptions& options, const Evidence& evidence, Training& training);

/// Adds regions of smaller sizes where the chosen body does not pass: necks that are on no path, and the rooms behind.
void add_regions(const Survey& survey, const TrainOptions& options, const Layout& layout, Stages& stages,
                 Training& training);

/// Sends bodies along all paths with the chosen size. Sends others with sizes just inside and just outside both ends
/// past the decisive opening or over the decisive crack. Adds the trials to the paths, and contradictions to the
/// training.
void prove(const Survey& survey, const ways::BodyKind& kind, const Layout& layout, const Evidence& evidence,
           Stages& stages, Training& training);

}  // namespace roam::training
