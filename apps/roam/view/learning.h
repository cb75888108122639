#pragma once
/// \file
/// The learned sizes of a session's body: `--adapt`, and its key.

#include <filesystem>
#include <optional>
#include <string>

#include "osgRoam/Manipulator.h"
#include "roam/size_learner.h"
#include "view/commands.h"
#include "view/news.h"
#include "view/options.h"
#include "view/status.h"

namespace roam::app {

/// Observes the body, offers a helpful size where the body is stopped, and saves accepted sizes beside the scene. Needs
/// no window. Call all members from one thread.
class Learning {
 public:
  /// Continues the plan's profile. Without one, starts a profile for `scene` and the manipulator's body, unless the
  /// options forbid it or the scene has a profile of another body.
  Learning(const ViewOptions& options, const ViewPlan& plan, const SceneIdentity& scene, osgRoam::Manipulator& roamer,
           News& news);

  /// After each step, see SizeLearner::watch.
  void watch(const Vec3& wish, double seconds);
  /// Adds "adapt", which accepts the present offer, if any.
  void add_to(Commands& commands) {
    commands.add("adapt", [this] { accepted_ = true; });
  }
  /// Call it between two frames: applies an accepted size to the walker, and saves it. Returns whether there was one.
  bool update();
  /// Applies the accepted sizes to a new walker.
  void resize();

  /// Adds the offer to the hold: "Y takes it: opening 0.68 m wide: a body of 0.33 m here".
  void fill(Status& status) const;
  /// The number of accepted sizes.
  [[nodiscard]] int taken() const { return taken_; }

 private:
  void take(const Lesson& lesson);

  osgRoam::Manipulator& roamer_;
  News& news_;
  SizeLearner learner_;
  std::filesystem::path file_;  ///< empty: nothing is saved
  bool takes_;                  ///< accepts every offer
  bool accepted_ = false;
  std::optional<Lesson> lesson_;
  double seconds_free_ = 0.0;  ///< since the body was last stopped
  int taken_ = 0;
};

/// The reason for the body's present size, from the profile's region around it; empty outside all regions.
[[nodiscard]] std::string size_reason(const Walker& walker);

}  // namespace roam::app
