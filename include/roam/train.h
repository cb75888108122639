#pragma once
/// \file
/// Which sizes of a body can go everywhere in a scene and fall nowhere; and what to use where no one size can.
///
///     const roam::Training t = roam::train(survey, {.height = 1.8});
///     std::cout << t.answer << "\n";  // and t.radius serves all paths without a foot, where t.feasible
///     if (t.places > 0) roam::save_profile(roam::profile_of(t, survey), roam::profile_path("dam.ply"));  // profile.h
///
/// Xie & Niu 2020 (PLoS ONE 15(2): e0229038, figure 6) roam n random paths with a radius that goes down where the
/// viewpoint cannot enter and up where it flies off. Method::paper does that and no more; Method::interval finds both
/// ends from the scene itself, by the widest way (passage.h) and the cracks of the floor, and proves them by trials
/// with the real Walker just inside and just outside. docs/training.md has the definitions, the measured errors and
/// what is certified.
///
/// It takes a second or so for some rooms, 5 to 30 s for a furnished house, a mine or a dam of 2 million triangles.
///
/// Same survey, options and seed, same bits. Safe to call from any thread. Library target roam::train.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "roam/passage.h"
#include "roam/route.h"
#include "roam/size_region.h"
#include "roam/survey.h"

namespace roam {

enum class Method : std::uint8_t { interval, paper };

/// "interval" or "paper".
[[nodiscard]] const char* name(Method method);

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
  std::function<bool(const std::string& stage, double done)> progress = {};
};

/// One walk or flight along a planned path by a body of one size.
struct Trial {
  double radius = 0.0;
  double support_radius = 0.0;  ///< 0: none of its own
  Outcome outcome = Outcome::reached;
  Vec3 at{0.0};          ///< of the centre when it ended
  std::size_t path = 0;  ///< of Training::paths
};

/// A planned path: the widest way between two places that were drawn.
struct TrainedPath {
  Vec3 from{0.0}, to{0.0};        ///< of the feet, or the centre when flying
  std::vector<Vec3> way;          ///< likewise; on foot not for follow() as it is: see standing() in standing.h
  std::optional<double> largest;  ///< radius that passes, m; none: not limited
  double smallest = 0.0;          ///< half the width of the widest crack on the way, m; 0: there is none
  std::vector<Trial> trials;
};

/// A gap of the floor into which a small enough body falls. See docs/training.md for what is one.
struct Crack {
  enum class Kind : std::uint8_t {
    crack,      ///< carried over by a large enough body or foot
    step_down,  ///< its bottom is floor that one walks on
    open_drop,  ///< larger than any foot: a pit, a shaft, a cliff. Sets no radius.
  };
  Kind kind = Kind::crack;
  Vec3 point{0.0};         ///< centre of the largest disc free of floor, at the level of the rim
  double radius = 0.0;     ///< of that disc, m: a split of width w has w / 2
  Vec3 direction{0.0};     ///< level unit vector across it
  bool on_a_path = false;  ///< one of the paths goes over it
};

/// "crack", "step_down" or "open_drop".
[[nodiscard]] const char* name(Crack::Kind kind);

/// What decides one end of the interval.
struct Decisive {
  enum class Kind : std::uint8_t { opening, split };
  Kind kind = Kind::opening;
  Vec3 point{0.0};
  double width = 0.0;   ///< m: of the door, or the split
  Vec3 direction{0.0};  ///< unit, across
};

/// "opening" or "split".
[[nodiscard]] const char* name(Decisive::Kind kind);

/// What of the scene hangs together for the smallest body, and is no scrap.
struct ConnectedPart {
  Vec3 place{0.0};    ///< where it is widest: of the feet, or the centre when flying
  double area = 0.0;  ///< m2 of floor; 0 when flying
  std::uint64_t places = 0;
  bool trained = false;  ///< paths were planned in it
  bool whole = true;     ///< false: not all of it was looked at
  std::string why;       ///< it was left out; empty where it was trained
};

struct Training {
  Mode mode = Mode::walk;            ///< as asked
  Method method = Method::interval;  ///< likewise
  /// The body that serves: use it from now on. profile_of() in profile.h makes a Profile of it, and apply() settings.
  /// Where no place was found (places 0), or no path planned, it is only what a person has.
  double radius = 0.0;          ///< m
  double height = 0.0;          ///< m: as asked; of a sphere twice the radius
  double support_radius = 0.0;  ///< of its foot, m; 0: it needs none of its own
  double step = 0.3;            ///< that it climbs, m: TrainOptions::step or less, a sphere at most its radius
  double slope_degrees = 45.0;  ///< that it climbs: the survey's
  /// Between which one radius serves all paths, m; over uneven rims from above `smallest` on. 0: no crack. None: free.
  double smallest = 0.0;
  std::optional<double> largest;
  double trapped_radius = 0.0;  ///< a sphere that rolls without a foot cannot climb out of the widest crack below this
  bool feasible = false;        ///< one body without a foot of its own serves all paths
  bool complete = true;         ///< false: ended early
  std::string answer;           ///< in plain words, one to three sentences
  std::vector<TrainedPath> paths;
  std::vector<Crack> cracks;         ///< of the floor that was reached, widest first
  std::vector<Decisive> decisive;    ///< of the upper end, then of the lower, where there is one
  std::vector<SizeRegion> regions;   ///< where another size is to be used, and why
  std::vector<ConnectedPart> parts;  ///< those that were trained, then those left out; most places first
  /// Trials that ended otherwise than the ends say they must, a sentence each; `answer` names the first of them.
  std::vector<std::string> contradictions;
  std::uint64_t places = 0;  ///< free places looked at
  double seconds = 0.0;      ///< of wall clock; the only member that differs between runs
};

/// Throws roam::Error for options out of range. A scene with no free place, no floor, no room that is high enough, or
/// rooms without a way between them is no error: `answer` says it.
[[nodiscard]] Training train(const Survey& survey, const TrainOptions& options = {});

}  // namespace roam
