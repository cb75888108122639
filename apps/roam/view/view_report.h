#pragma once
/// \file
/// What `roam view` tells when it ends.

#include <optional>
#include <string>
#include <vector>

#include "cli/histogram.h"
#include "cli/report.h"
#include "roam/pager.h"
#include "roam/route.h"
#include "verify/piece_log.h"
#include "view/pose.h"

namespace roam::app {

/// Median, 99th percentile and largest.
struct Times {
  double median = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

/// `scale`: of the histogram's unit.
[[nodiscard]] Times times(const Histogram& histogram, double scale);

struct ViewReport {
  std::string scene;
  std::uint64_t triangles = 0;  ///< of the collision; 0 when it did not come
  WalkerSettings settings;
  std::string profile;                ///< the file that the body was taken from; empty: none
  int learned = 0;                    ///< sizes that were taken on the way
  Mode mode = Mode::walk;             ///< at the end
  std::optional<RouteResult> result;  ///< of a path
  bool path_ended = false;            ///< the result has an outcome: nobody ended the session before
  std::string object;                 ///< what blocked on the path, by name
  std::size_t waypoints = 0;          ///< of the path
  bool roamed = false;                ///< the body came into the scene
  std::optional<Pose> start;          ///< home
  Pose end;
  Vec3 eye{0.0};
  std::uint64_t steps = 0;
  double simulated = 0.0;
  double length = 0.0;
  std::uint64_t throttled = 0;
  std::optional<double> least_axis_clearance;
  std::uint64_t frames = 0;
  Times frame_ms;
  Times collision_ns;      ///< a frame, by the clock
  Times collision_own_ns;  ///< of that, what the thread itself used
  std::uint64_t resident_bytes = 0;
  std::uint64_t world_bytes = 0;
  std::string store;                 ///< that the body collided with at the end; empty: none
  std::optional<PagerStats> paging;  ///< of it
  std::string renderer;
  std::vector<std::string> hud;    ///< as shown in the last frame, line by line
  std::vector<std::string> notes;  ///< what is not as it should be
  std::uint64_t missing_textures = 0;
  std::vector<std::string> missing_texture_files;
  std::uint64_t missing_pages = 0;
  std::vector<std::string> written;  ///< files
  std::vector<Mesh> meshes;          ///< for --verify; none where it was a store from the beginning
  verification::PieceLog pieces;     ///< for --verify
  std::optional<verification::Verification> verified;
};

/// Appends the sentences of `more` that are not in `all`.
void append(std::vector<std::string>& all, const std::vector<std::string>& more);

[[nodiscard]] Json json_report(const ViewReport& report);
[[nodiscard]] std::string text_report(const ViewReport& report);

}  // namespace roam::app
