#pragma once
/// \file
/// Which sizes of a body can go everywhere in a scene and fall nowhere; and what to use where no one size can.
///
///     const roam::Training t = roam::train(survey, {.height = 1.8});
///     if (t.feasible) std::cout << "a radius of " << t.radius << " m serves all " << t.paths.size() << " paths\n";
///     if (t.places > 0) roam::save_profile(roam::profile_of(t, survey), roam::profile_path("dam.ply"));  // profile.h
///
/// Xie & Niu 2020 (PLoS ONE 15(2): e0229038, figure 6) roam n random paths with a radius that goes down where the
/// viewpoint cannot enter and up where it flies off. Method::paper does that and no more; Method::interval finds both
/// ends from the scene itself, by the widest way (passage.h) and the cracks of the floor, and proves them by trials
/// with the real Walker just inside and just outside. docs/training.md has the method, docs/cracks.md
/// the measured errors of the lower end.
///
/// It takes a second or so for some rooms, 5 to 30 s for a furnished house, a mine or a dam of 2 million triangles.
///
/// Same survey, options and seed, same bits. Safe to call from any thread. Library target roam::training.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "roam/crack.h"
#include "roam/opening.h"
#include "roam/profile.h"
#include "roam/size_region.h"
#include "roam/survey.h"
#include "roam/trial.h"
#include "roam/walker_settings.h"

namespace roam {

enum class Method : std::uint8_t { interval, paper };

/// "interval" or "paper".
[[nodiscard]] const char* to_string(Method method);

/// What is being done, in the order in which it is.
enum class TrainStage : std::uint8_t {
  places,         ///< places are looked for
  planning,       ///< paths are planned between them
  cracks,         ///< cracks of the floor are looked for
  walking,        ///< walkers go along the planned paths
  beside_paths,   ///< smaller openings are looked for beside them
  trials,         ///< bodies just inside and just outside both ends are sent
  roaming_paths,  ///< Method::paper: the paths are roamed
};

struct TrainOptions {
  Mode mode = Mode::walk;  ///< walk or fly
  Method method = Method::interval;
  std::uint64_t seed = 1;  ///< of the paths
  int paths = 0;           ///< that are planned; 0: 5, or one for each dead-end room where there are more
  /// m: what lets less than this radius through is for nobody. It decides no body that is answered, and gets no region.
  /// More than half of the largest radius that there can be counts as that half. Ways are looked at, and told of, down
  /// to 0.05 m or this, whichever is less.
  double radius_min = 0.15;
  double radius_max = 1.0;   ///< of the body, m: larger ones are not looked for
  double support_max = 1.0;  ///< of the foot, m: a crack that is wider is an open drop, where a body is held back
  double height = 0.0;   ///< of the body on foot, m: say 1.8 for a person; 0: the paper's sphere. WalkerSettings{}: 1.8
  double step = 0.3;     ///< m, see WalkerSettings
  double spacing = 0.2;  ///< m, see PassageOptions
  double speed = 1.4;    ///< of the trials, m/s
  int threads = 0;       ///< >= 0; 0: one per core
  /// Called now and then, from any one thread at a time, with what is being done and how much of it, in [0, 1].
  /// Returning false ends training: what is known by then is answered, with Training::complete false.
  std::function<bool(TrainStage stage, double done)> progress = {};
};

/// A planned path: the widest way between two places that were drawn.
struct TrainedPath {
  Vec3 from{0.0}, to{0.0};         ///< of the feet, or the centre when flying
  std::vector<Vec3> way;           ///< likewise; on foot not for follow() as it is: see standing() in standing.h
  std::optional<double> largest;   ///< radius that passes, m; none: not limited
  double smallest = 0.0;           ///< half the width of the widest crack on the way, m; 0: there is none
  std::optional<Opening> opening;  ///< that decides `largest`
  std::vector<Trial> trials;
};

/// Two places that were drawn as the ends of a path, and that no walker came between: it does not count as one.
struct UnwalkedPath {
  Vec3 from{0.0}, to{0.0};             ///< of the feet
  Outcome outcome = Outcome::blocked;  ///< of the last walker
  Vec3 at{0.0};                        ///< where it ended, of the feet
};

/// What decides one end of the interval.
struct Decisive {
  enum class Kind : std::uint8_t { opening, split };
  Kind kind = Kind::opening;
  Vec3 point{0.0};
  double width = 0.0;   ///< m: of the door, or the split
  Vec3 direction{0.0};  ///< unit, across
};

/// "opening" or "split".
[[nodiscard]] const char* to_string(Decisive::Kind kind);

/// Why a part of the scene was left out.
enum class LeftOut : std::uint8_t {
  none,            ///< it was trained
  backs,           ///< the backs of triangles look at it: outside, or within walls
  on_top,          ///< on top of something
  over_low_rooms,  ///< on top of rooms that are lower than the body
  small_or_open,   ///< small beside the rest, or open to the sky, and windings do not tell whether it is inside
  unfinished,      ///< open country, not looked at whole
  much_smaller,    ///< than the rest
  no_path,         ///< no path was planned in it
};

/// What of the scene hangs together for the smallest body, and is no scrap.
struct ConnectedPart {
  Vec3 place{0.0};    ///< where it is widest: of the feet, or the centre when flying
  double area = 0.0;  ///< m2 of floor; 0 when flying
  std::uint64_t places = 0;
  bool trained = false;  ///< paths were planned in it
  bool whole = true;     ///< false: not all of it was looked at
  LeftOut left_out = LeftOut::none;
};

/// Why there is nothing to train.
enum class Nowhere : std::uint8_t {
  empty_scene,     ///< no triangle
  no_floor,        ///< no triangle is level enough
  over_low_rooms,  ///< there is room on top of rooms that are lower than the body alone: see `parts`
  no_room,         ///< not even the smallest body fits anywhere
};

/// A trial that ended otherwise than the geometry says it must.
struct Contradiction {
  enum class Body : std::uint8_t {
    chosen,           ///< the body that is answered, along the whole path: must come through
    chosen_back,      ///< the same, back up over a gap: must come through
    inside_opening,   ///< just narrower than the path's opening: must come through
    outside_opening,  ///< just wider: must be stopped
    wide_foot,        ///< on a foot that is just wide enough for the crack: must come through
    small_foot,       ///< on one that is just too small: must fall
  };
  Body body = Body::chosen;
  Trial trial;
};

/// A gap too shallow for a foot to be carried over: the floor at its bottom carries it.
struct Trench {
  Crack crack;
  double depth = 0.0;  ///< m
};

/// How Method::paper ended.
struct PaperResult {
  enum class Ending : std::uint8_t {
    settled,        ///< `radius` passes all paths
    contradiction,  ///< a body that was blocked is not larger than one that fell, or by less than a centimetre
    too_small,      ///< the smallest is blocked
    too_large,      ///< the largest falls
    out_of_trials,  ///< 20 of one path
    cancelled,
  };
  Ending ending = Ending::cancelled;
  double radius = 0.0;           ///< that passes all paths, or passed most of them: the smallest of those; 0: none did
  std::optional<Trial> fallen;   ///< the largest that fell
  std::optional<Trial> blocked;  ///< the smallest that was blocked
};

struct Training {
  Mode mode = Mode::walk;            ///< as asked
  Method method = Method::interval;  ///< likewise
  /// The body that serves: use it from now on. profile_of() makes a Profile of it, and apply() settings. Where no place
  /// was found (places 0), or no path planned, it is only what a person has.
  double radius = 0.0;          ///< m
  double height = 0.0;          ///< m: as asked; of a sphere twice the radius
  double support_radius = 0.0;  ///< of its foot, m; 0: it needs none of its own
  double step = 0.3;            ///< that it climbs, m: TrainOptions::step or less, a sphere at most its radius
  double slope_degrees = 45.0;  ///< that it climbs: the survey's

  bool feasible = false;             ///< one body without a foot of its own serves all paths
  bool complete = true;              ///< false: ended early
  std::optional<TrainStage> ended;   ///< where it ended early
  std::optional<Nowhere> nowhere;    ///< where no place was found and that was looked for to the end
  std::optional<PaperResult> paper;  ///< of Method::paper, where a place was found

  /// Between which one radius serves all paths, m; over uneven rims from above `smallest` on. 0: no crack. None: free.
  double smallest = 0.0;
  std::optional<double> largest;
  /// The smallest radius that comes over all cracks on the paths in both directions, m: `smallest`, or more where a rim
  /// is higher than the one opposite; infinite where none that was tried does.
  double least = 0.0;
  /// m: from here on the rims of these cracks carry without any doubt; a body between `least` and this sags.
  double carried = 0.0;
  std::optional<Crack> hardest;  ///< with such a rim, where it decides `least`
  double trapped_radius = 0.0;   ///< a sphere that rolls without a foot cannot climb out of the widest crack below this
  double least_foot = 0.0;       ///< m: the smallest foot that is carried over all cracks; 0: there are none
  std::optional<Trench> trench;  ///< the widest that the body sinks into

  std::vector<TrainedPath> paths;
  std::vector<UnwalkedPath> unwalked;
  std::uint64_t uncertain_ways = 0;  ///< that were planned and could be certified for no size; they do not count
  std::vector<Crack> cracks;         ///< of the floor that was reached, widest first
  bool all_cracks = true;            ///< false: ended before all were found
  std::vector<Decisive> decisive;    ///< of the upper end, then of the lower, where there is one
  std::vector<SizeRegion> regions;   ///< where another size is to be used, and why
  std::vector<ConnectedPart> parts;  ///< those that were trained, then those left out; most places first
  std::uint64_t separate = 0;        ///< parts that paths were looked for in, without a way between them; scraps count
  std::vector<Contradiction> contradictions;
  std::uint64_t triangles = 0;  ///< in the scene
  std::uint64_t places = 0;     ///< free places looked at
  double seconds = 0.0;         ///< of wall clock; the only member that differs between runs
};

/// Throws roam::Error for options out of range. A scene with no free place, no floor, no room that is high enough, or
/// rooms without a way between them is no error: the facts above say it.
[[nodiscard]] Training train(const Survey& survey, const TrainOptions& options = {});

/// The profile of what was trained, ready to be saved: all members, of the scene that `survey` was built of (another
/// identity_of where it was read from a store). A training that found no place (Training::places 0) is not worth it.
[[nodiscard]] Profile profile_of(const Training& training, const Survey& survey);
[[nodiscard]] Profile profile_of(const Training& training, const SceneIdentity& scene);

}  // namespace roam
