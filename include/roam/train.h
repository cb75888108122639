#pragma once
/// \file
/// Training: the sizes of a body that pass everywhere in a scene and fall nowhere.
///
///     const roam::Training t = roam::train(survey, {.height = 1.8});
///     if (t.feasible) std::cout << "a radius of " << t.radius << " m serves all " << t.paths.size() << " paths\n";
///     if (!t.paths.empty()) roam::save_profile(roam::profile_of(t, survey), roam::profile_path("dam.ply"));
///
/// Method::paper is figure 6 of Xie & Niu 2020 (PLoS ONE 15(2): e0229038): it roams random paths, with a smaller radius
/// if the body cannot enter, and a larger one if it falls. Method::interval finds both ends of the interval from the
/// widest ways (passage.h) and the cracks of the floor, and confirms them by trials with a Walker. docs/training.md has
/// the definitions, docs/cracks.md the measured errors.
///
/// Lengths in metres. The same survey, options and seed give the same bits. Thread-safe. Target roam::training.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "roam/crack.h"
#include "roam/opening.h"
#include "roam/profile.h"
#include "roam/survey.h"
#include "roam/trial.h"
#include "roam/walker_settings.h"

namespace roam {

enum class Method : std::uint8_t { interval, paper };

/// "interval" or "paper".
[[nodiscard]] const char* to_string(Method method);

/// Stages of training, in order.
enum class TrainStage : std::uint8_t {
  places,         ///< finds free positions
  planning,       ///< plans paths between them
  cracks,         ///< finds cracks of the floor
  walking,        ///< walks the planned paths
  beside_paths,   ///< finds narrower openings beside them
  trials,         ///< tries bodies just inside and just outside both ends
  roaming_paths,  ///< Method::paper: roams the paths
};

struct TrainOptions {
  Mode mode = Mode::walk;  ///< walk or fly
  Method method = Method::interval;
  std::uint64_t seed = 1;  ///< of the paths
  int paths = 0;           ///< number of paths; 0: 5, or one for each dead-end room if there are more
  /// Openings narrower than this radius are ignored: they neither limit the result nor get a region, and no radius is
  /// feasible for a path that leads through one. The chosen radius is at least this where the interval allows it. At
  /// most the largest possible radius is used. Ways are reported down to min(0.05, radius_min).
  double radius_min = 0.15;
  double radius_max = 1.0;   ///< largest radius searched for
  double support_max = 1.0;  ///< largest radius of a support disc; a wider crack is an open drop
  double height = 0.0;       ///< of a walking body: 1.8 for a person; 0: a sphere
  double step = 0.3;         ///< see WalkerSettings; at most half of `height` is used
  double spacing = 0.2;      ///< see PassageOptions
  double speed = 1.4;        ///< of the trials, m/s
  int threads = 0;           ///< >= 0; 0: one per core
  /// Called now and then, from one thread at a time, with the stage and the fraction of all of training that is done:
  /// in [0, 1], never falling, 1 only at the end. Returning false ends training; the result so far has
  /// Training::complete false.
  std::function<bool(TrainStage stage, double done)> progress = {};
};

/// A path: the widest way between two random positions.
struct TrainedPath {
  Vec3 from{0.0}, to{0.0};         ///< of the feet; flying: of the centre
  std::vector<Vec3> way;           ///< likewise; standing.h turns feet into centres, which follow() takes
  std::optional<double> largest;   ///< radius that passes; none: unlimited
  double smallest = 0.0;           ///< half the width of the widest crack on the way; 0: none
  std::optional<Opening> opening;  ///< limits `largest`
  std::vector<Trial> trials;
};

/// A planned path that no walker completed. It does not count as a path.
struct UnwalkedPath {
  Vec3 from{0.0}, to{0.0};             ///< of the feet
  Outcome outcome = Outcome::blocked;  ///< of the last walker
  Vec3 at{0.0};                        ///< its feet at the end
};

/// Why a part of the scene was left out.
enum class LeftOut : std::uint8_t {
  none,            ///< trained
  backs,           ///< faced by the backs of triangles: outside, or within walls
  on_top,          ///< on top of something
  over_low_rooms,  ///< on top of rooms lower than the body
  small_or_open,   ///< small beside the rest, or open to the sky
  unfinished,      ///< open country, not searched whole
  much_smaller,    ///< than the rest
  no_path,         ///< no path was planned in it
};

/// A part of the scene that is connected for the smallest body.
struct ConnectedPart {
  Vec3 place{0.0};    ///< its widest position: of the feet; flying: of the centre
  double area = 0.0;  ///< m2 of floor; 0 when flying
  std::uint64_t places = 0;
  bool trained = false;  ///< paths were planned in it
  bool whole = true;     ///< false: not searched whole
  LeftOut left_out = LeftOut::none;
};

/// Why there is nothing to train.
enum class Nowhere : std::uint8_t {
  empty_scene,     ///< no triangle
  no_floor,        ///< no triangle is level enough
  over_low_rooms,  ///< only on top of rooms lower than the body: see `parts`
  no_room,         ///< the smallest body fits nowhere
};

/// A trial whose outcome contradicts the geometry.
struct Contradiction {
  enum class Body : std::uint8_t {
    chosen,           ///< the resulting body on the whole path: should arrive
    chosen_back,      ///< the same, back up over a crack: should arrive
    inside_opening,   ///< just narrower than the path's opening: should arrive
    outside_opening,  ///< just wider: should be stopped
    wide_disc,        ///< support disc just wide enough for the crack: should arrive
    small_disc,       ///< support disc just too small: should fall
  };
  Body body = Body::chosen;
  Trial trial;
};

/// A crack so shallow that its bottom carries the body.
struct Trench {
  Crack crack;
  double depth = 0.0;
};

/// Result of Method::paper.
struct PaperResult {
  enum class Ending : std::uint8_t {
    settled,        ///< `radius` passes all paths
    contradiction,  ///< a blocked body is smaller than one that fell, or larger by less than a centimetre
    too_small,      ///< the smallest is blocked
    too_large,      ///< the largest falls
    out_of_trials,  ///< 20 of one path
    cancelled,
  };
  Ending ending = Ending::cancelled;
  double radius = 0.0;           ///< that passed the largest number of paths, the smallest of several; 0: none
  std::optional<Trial> fallen;   ///< largest that fell
  std::optional<Trial> blocked;  ///< smallest that was blocked
};

/// The body to use, see profile_of() and apply(), and how it was found. Without positions or paths it is that of a
/// person. Its height is TrainOptions::height, its step at most TrainOptions::step, a sphere's at most its radius. Over
/// uneven rims the interval begins above `smallest`.
struct Training : FittingBody {
  Method method = Method::interval;
  bool feasible = false;             ///< one body without a support disc passes all paths
  std::optional<TrainStage> ended;   ///< the stage that ended early
  std::optional<Nowhere> nowhere;    ///< why no free position was found
  std::optional<PaperResult> paper;  ///< of Method::paper

  std::optional<Crack> widest;       ///< decides `smallest`
  std::optional<Opening> narrowest;  ///< decides `largest`
  /// Smallest radius that crosses all cracks of the paths both ways: `smallest`, or more over an uneven rim; infinite
  /// if no tried radius does.
  double least = 0.0;
  double carried = 0.0;          ///< smallest radius that crosses them without sagging
  std::optional<Crack> hardest;  ///< crack with an uneven rim that decides `least`
  double trapped_radius = 0.0;   ///< a smaller sphere cannot roll out of the widest crack
  double least_support = 0.0;    ///< smallest support disc that spans all cracks; 0: no crack
  std::optional<Trench> trench;  ///< the widest that the body sinks into

  std::vector<TrainedPath> paths;
  std::vector<UnwalkedPath> unwalked;
  std::uint64_t uncertain_ways = 0;  ///< planned, but certified for no size; not counted as paths
  std::vector<Crack> cracks;         ///< of the reached floor, widest first
  bool all_cracks = true;            ///< false: ended before all were found
  std::vector<ConnectedPart> parts;  ///< trained ones first, then by number of positions
  std::uint64_t separate = 0;        ///< searched parts without a way between them, small ones included
  std::vector<Contradiction> contradictions;
  std::uint64_t triangles = 0;  ///< in the scene
  std::uint64_t places = 0;     ///< free positions searched
  double seconds = 0.0;         ///< of wall clock; the only member that differs between runs
};

/// Throws roam::Error if options are out of range. A scene without floor, room or paths is no error; see Training.
[[nodiscard]] Training train(const Survey& survey, const TrainOptions& options = {});

/// The profile of a training, ready to be saved. For a survey of a store's triangles pass identity_of(store.info()). It
/// is of no use without Training::paths.
[[nodiscard]] Profile profile_of(const Training& training, const Survey& survey);
[[nodiscard]] Profile profile_of(const Training& training, const SceneIdentity& scene);

}  // namespace roam
