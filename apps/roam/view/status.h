#pragma once
/// \file
/// The status of a session, and its text on the head-up display.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "roam/error.h"
#include "roam/import.h"
#include "roam/pager.h"
#include "roam/scene_frame.h"
#include "roam/walker.h"
#include "view/hold.h"
#include "view/surroundings.h"

namespace roam::app {

/// Progress of a loading thread.
struct LoadState {
  enum class Phase : std::uint8_t { comparing, reading, indexing, looking, done, failed };
  Phase phase = Phase::reading;
  double share = 0.0;           ///< of this phase, in [0, 1]
  std::uint64_t triangles = 0;  ///< so far
  double seconds_left = -1.0;   ///< negative: not known yet
  /// Why, if the phase is failed. The first text is for a lack of memory, in which no other one can be set.
  Error error{"out of memory; build a store of it, which takes little (roam build), or take a smaller scene"};
};

[[nodiscard]] inline bool is_over(const LoadState& state) {
  return state.phase == LoadState::Phase::done || state.phase == LoadState::Phase::failed;
}

/// A line of the panel.
struct StatusText {
  std::string label;
  std::string value;
  bool warning = false;
  bool figures = false;  ///< for programmers
  bool yields = false;   ///< to the lines of a tool, where there is little room
};

struct Status {
  std::optional<Mode> mode;  ///< none: no body yet
  double speed = 0.0;        ///< m/s, present speed
  double pace = 0.0;         ///< m/s, speed of a move by keys
  WalkerSettings body;       ///< present settings
  std::string size_reason;   ///< why the body has another size here; empty: it has not
  bool crouched = false;
  bool grounded = false;
  Surroundings around;
  std::optional<Georeference> georeference;  ///< of the coordinates in `georeferenced`
  SceneFrame georeferenced;                  ///< the file's frame, or the scene's
  double yaw = 0.0, pitch = 0.0;             ///< degrees
  std::string camera;                        ///< name of the active camera, if not the body's; else empty
  LoadState display, collision;
  std::uint64_t triangles = 0;        ///< of the collision; 0: not known yet
  std::uint64_t resident = 0;         ///< bytes of the process
  std::uint64_t world_bytes = 0;      ///< bytes of the collision
  std::optional<PagerStats> paging;   ///< set if the collision is from a store
  std::optional<LoadState> building;  ///< progress of a store's build; none: no build
  std::string store_key;              ///< the key that builds a store, if one is worth building; else empty
  double frame_ms = 0.0;              ///< 0: not known yet
  std::string quality;                ///< why the drawing is not full; empty if there is nothing to say
  double collision_us = 0.0;          ///< per frame
  std::string recording;              ///< what is being recorded
  std::vector<StatusText> tool;       ///< of the tool that is on
  std::string hidden;                 ///< which objects are not shown, and whether they stop the body; may be empty
  std::string section;                ///< what hides a part of the scene, and whether it stops the body; may be empty
  std::vector<Told> news;             ///< at this moment
  Told hold;
  std::string coming;  ///< see coming_text
};

/// "512001.25, 5403002.00, 403.46 EPSG:32632": a point in the reference system; empty if there is none.
[[nodiscard]] std::string site_text(const Status& status, const Vec3& point);

/// The lines from top to bottom. The first alone is the minimal display.
[[nodiscard]] std::vector<StatusText> status_lines(const Status& status);

/// The sentence below the middle: why the body is held, what is loading, or the news.
[[nodiscard]] Told status_message(const Status& status);

/// "collision 43 %: 1.2 M triangles, 8 s left"; empty when it is done.
[[nodiscard]] std::string load_text(const char* what, const LoadState& state);

/// "12 tiles to come from example.org"; empty if there are none, or no web server.
[[nodiscard]] std::string coming_text(std::uint64_t tiles, std::string_view server);

/// The finished share of the loading, in [0, 1]; negative if all of it is finished.
[[nodiscard]] double load_share(const LoadState& display, const LoadState& collision);

/// A direction from above, from north, +y: 135, "SE".
struct Bearing {
  int degrees = 0;  ///< [0, 360)
  const char* wind = "N";
};
/// `yaw`: degrees, see Pose.
[[nodiscard]] Bearing bearing_of(double yaw);

/// The bearing of a gaze from north, +y: "212\u00b0 SW, 10\u00b0 down". Degrees, see Pose.
[[nodiscard]] std::string heading_text(double yaw, double pitch);

/// "512 MB", "1.4 GB".
[[nodiscard]] std::string byte_text(std::uint64_t bytes);

/// The resident memory of this process, in bytes; 0 if unknown.
[[nodiscard]] std::uint64_t resident_bytes();

}  // namespace roam::app
