#pragma once
/// \file
/// What the head-up display of `roam view` says, from what is so.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "roam/error.h"
#include "roam/pager.h"
#include "roam/walker.h"
#include "view/hold.h"

namespace roam::app {

/// How far the loading of one thing has come.
struct LoadState {
  enum class Phase : std::uint8_t { comparing, reading, indexing, looking, done, failed };
  Phase phase = Phase::reading;
  double share = 0.0;           ///< of this phase, in [0, 1]
  std::uint64_t triangles = 0;  ///< so far
  double seconds_left = -1.0;   ///< negative: cannot be told yet
  Error error{""};              ///< of a failed one
};

[[nodiscard]] inline bool is_over(const LoadState& state) {
  return state.phase == LoadState::Phase::done || state.phase == LoadState::Phase::failed;
}

struct Status {
  std::optional<Mode> mode;  ///< none: no body yet
  double speed = 0.0;        ///< m/s, now
  double pace = 0.0;         ///< m/s, what keys move at
  WalkerSettings body;       ///< as it is now
  std::string size_reason;   ///< why it is not as large as elsewhere; empty: it is
  bool crouched = false;
  bool grounded = false;
  Vec3 place{0.0};                ///< of the body's centre, in the scene's frame
  double yaw = 0.0, pitch = 0.0;  ///< degrees
  std::string camera;             ///< of another manipulator than ours; empty: ours
  LoadState display, collision;
  std::uint64_t triangles = 0;        ///< of the collision; 0: not known yet
  std::uint64_t resident = 0;         ///< bytes of the process
  std::uint64_t world_bytes = 0;      ///< of the collision
  std::optional<PagerStats> paging;   ///< where the collision comes from a store
  std::optional<LoadState> building;  ///< of a store; none: nobody builds one
  std::string store_key;              ///< builds a store, which is worth it; empty: there is nothing to build
  double frame_ms = 0.0;              ///< 0: not known yet
  double collision_us = 0.0;          ///< a frame
  std::string recording;              ///< what is being written
  std::vector<Told> news;             ///< for this moment
  Told hold;
};

/// A line of the panel: what, and its value.
struct StatusText {
  std::string label;
  std::string value;
  bool warning = false;
};

/// The lines from top to bottom. The first alone is the minimal display.
[[nodiscard]] std::vector<StatusText> status_lines(const Status& status);

/// What is told below the middle: what holds the body, what is being loaded, and the news.
[[nodiscard]] Told status_message(const Status& status);

/// "collision 43 %: 1.2 M triangles, 8 s left"; empty when it is done.
[[nodiscard]] std::string load_text(const char* what, const LoadState& state);

/// The share of the work that is done, in [0, 1]; negative when all of it is.
[[nodiscard]] double load_share(const LoadState& display, const LoadState& collision);

/// "512 MB", "1.4 GB".
[[nodiscard]] std::string byte_text(std::uint64_t bytes);

/// The memory of this process that is in RAM, in bytes; 0 where it cannot be told.
[[nodiscard]] std::uint64_t resident_bytes();

}  // namespace roam::app
