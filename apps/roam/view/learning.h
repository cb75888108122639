#pragma once
/// \file
/// The sizes of the body that a session learns: `--adapt`, and the key for it.

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

/// Watches the body, offers a size that helps where it is stopped, and keeps accepted sizes beside the scene. Needs no
/// window. All members belong to one thread.
class Learning {
 public:
  /// Learning continues the plan's profile. Without one, it starts a profile for `scene` and the manipulator's body,
  /// unless the options forbid it, or the scene has a profile of another body.
  Learning(const ViewOptions& options, const ViewPlan& plan, const SceneIdentity& scene, osgRoam::Manipulator& roamer,
           News& news);

  /// After each step, see SizeLearner::watch.
  void watch(const Vec3& wish, double seconds);
  /// Adds "adapt", which accepts the present offer, if there is one.
  void add_to(Commands& commands) {
    commands.add("adapt", [this] { accepted_ = true; });
  }
  /// Between two frames: gives the walker what is accepted, and saves it.
  void update();
  /// Gives accepted sizes to a new walker.
  void resize();

  /// Adds the offer to what holds the body: "Y takes it: opening 0.68 m wide: a body of 0.33 m here".
  void fill(Status& status) const;
  /// How many sizes were accepted.
  [[nodiscard]] int taken() const { return taken_; }

 private:
  void take(const Lesson& lesson);

  osgRoam::Manipulator& roamer_;
  News& news_;
  SizeLearner learner_;
  std::filesystem::path file_;  ///< empty: nothing is saved
  bool takes_;                  ///< every offer
  bool accepted_ = false;
  std::optional<Lesson> lesson_;
  double seconds_free_ = 0.0;  ///< since the body was stopped last
  int taken_ = 0;
};

/// Why the body has the size that it has, from the region that it is in; empty outside all.
[[nodiscard]] std::string size_reason(const Walker& walker);

}  // namespace roam::app
