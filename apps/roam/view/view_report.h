#pragma once
/// \file
/// The final report of `roam view`.

#include <optional>
#include <string>
#include <vector>

#include "cli/histogram.h"
#include "cli/report.h"
#include "roam/pager.h"
#include "roam/route.h"
#include "roam/scene_frame.h"
#include "verify/piece_log.h"
#include "view/measuring.h"
#include "view/pose.h"
#include "view/probing.h"
#include "view/section.h"

namespace roam::app {

struct Times {
  double median = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

/// Median, 99th percentile and maximum, multiplied by `scale`.
[[nodiscard]] Times times(const Histogram& histogram, double scale);

struct ViewReport {
  std::string scene;
  std::uint64_t triangles = 0;  ///< of the collision; 0: no collision
  WalkerSettings settings;
  std::string profile;  ///< file of the body's profile; empty: none
  std::optional<SceneFrame> frame;
  int learned = 0;                    ///< number of sizes accepted on the way
  Mode mode = Mode::walk;             ///< at the end
  std::optional<RouteResult> result;  ///< of a path
  bool path_ended = false;            ///< the path has an outcome; the session did not end before
  std::string object;                 ///< name of the object that blocked the path
  std::optional<double> slope;        ///< degrees: of the face on which the path ended by a fall; none: not known
  std::size_t waypoints = 0;          ///< number of waypoints of the path
  bool roamed = false;                ///< whether the body came into the scene
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
  Times draw_calls;        ///< a frame
  Times collision_ns;      ///< per frame, by the clock
  Times collision_own_ns;  ///< per frame, by the thread's processor time
  std::uint64_t resident_bytes = 0;
  std::uint64_t world_bytes = 0;
  std::uint64_t page_bytes = 0;      ///< of the picture's pages
  std::string store;                 ///< store of the collision at the end; empty: none
  std::optional<PagerStats> paging;  ///< of that store
  std::string renderer;
  std::vector<std::string> hud;    ///< lines of the last frame
  std::vector<std::string> notes;  ///< warnings
  std::vector<std::string> noted;  ///< those of them that the terminal has
  std::uint64_t missing_textures = 0;
  std::vector<std::string> missing_texture_files;
  std::uint64_t missing_pages = 0;
  std::vector<Measurement> measurements;
  std::vector<ProbeReply> probes;
  SectionShape section;              ///< at the end
  std::size_t hidden_objects = 0;    ///< at the end
  bool passes_objects = false;       ///< the body passes through hidden objects, if there are any
  bool passes_section = false;       ///< the body passes through what the section hides
  std::vector<std::string> written;  ///< files
  std::string untold;                ///< lines of measurements and files that the terminal lacks
  std::vector<Mesh> meshes;          ///< for --verify; none if the session began with a store
  verification::PieceLog pieces;     ///< for --verify
  std::optional<verification::Verification> verified;
};

/// Appends those sentences of `more` that `all` lacks.
void append(std::vector<std::string>& all, const std::vector<std::string>& more);
/// Adds the notes and results of the session before. Measurements and probes are left out if their frame was another.
void add_earlier(ViewReport& report, ViewReport earlier);

[[nodiscard]] Json json_report(const ViewReport& report);
/// Without what was told.
[[nodiscard]] std::string text_report(const ViewReport& report);

/// Lines of the text report.
[[nodiscard]] std::string measured_line(const Measurement& measurement);
[[nodiscard]] std::string written_line(const std::string& file);

}  // namespace roam::app
