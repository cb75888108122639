#pragma once
/// \file
/// What `roam view` learns about the size of the body while one roams: `--adapt` and the key beside it.

#include <filesystem>
#include <optional>
#include <string>

#include "roam/size_learner.h"
#include "view/hold.h"

namespace roam::app {

/// Watches the body, offers a size that would help where it is stopped, and keeps what was taken beside the scene.
class Learning {
 public:
  /// `known`: what is known of the scene, or its identity and the body that roams there. What is learned is saved to
  /// `file`; an empty one: nowhere. `takes`: without being told.
  Learning(Profile known, std::filesystem::path file, bool takes);

  /// After each step, see SizeLearner::watch.
  void watch(const Walker& walker, const Vec3& wish, double seconds);

  /// What the body could be, for the display: "Y: a body of 0.33 m here (opening 0.68 m wide)". Empty: nothing, or it
  /// is taken anyway.
  [[nodiscard]] std::string offer(const std::string& key) const;

  struct Taken {
    Told told;
    bool placed = false;  ///< the body was put elsewhere
  };
  /// Between two frames: gives the walker what is offered, if it is to be taken or was `asked` for, and saves it.
  /// Nothing when nothing was taken.
  [[nodiscard]] std::optional<Taken> take(Walker& walker, bool asked);

  [[nodiscard]] const Profile& profile() const { return learner_.profile(); }
  /// How many lessons were taken.
  [[nodiscard]] int taken() const { return taken_; }

 private:
  SizeLearner learner_;
  std::filesystem::path file_;
  bool takes_;
  std::optional<Lesson> lesson_;
  double seconds_free_ = 0.0;  ///< since the body was stopped last
  int taken_ = 0;
};

/// Why the body has the size that it has, from the region that it is in; empty outside all.
[[nodiscard]] std::string size_reason(const Walker& walker);

}  // namespace roam::app
