#pragma once
/// \file
/// Everything that a session shows except the scene: head-up display, marks, and the view before there is a body.

#include "osgRoam/Manipulator.h"
#include "view/news.h"
#include "view/scene_graph.h"
#include "view/stage.h"
#include "view/status.h"
#include "view/view_report.h"

namespace roam::app {

/// Watches the body and the scene's graph, and says how they are. All members belong to the thread that draws, between
/// two frames.
class Display {
 public:
  /// `fov`: of the picture's height, in degrees.
  Display(Stage& stage, SceneGraph& scene, osgRoam::Manipulator& roamer, News& news, double fov);

  /// After each step: `wish` is the velocity that was wished for (m/s).
  void watch(const StepReport& report, const Vec3& wish);
  /// Adds "marks", which shows or hides the body, what it touches, and the nearest triangles.
  void add_to(Commands& commands) {
    commands.add("marks", [this] { marks_ = !marks_; });
  }

  /// In each frame: says what of the scene cannot be loaded, and which pictures are written.
  void tell_news();
  /// Whether it is time to show() again.
  [[nodiscard]] bool is_due() const;
  /// Shows the next frame's status at once.
  void hurry() { shown_at_ = -1.0; }
  /// The part of the status that this object knows. `has_body`: a walker is in the scene.
  [[nodiscard]] Status status(bool has_body);
  /// Shows `status` until it is due again.
  void show(Status status);
  /// The status shown last.
  [[nodiscard]] const Status& shown() const { return shown_; }

  /// In each frame: draws the marks, and fits the near plane to `room`, the eye's distance from every wall (m).
  void update(bool has_body, double room);
  /// From where all of the scene is seen.
  [[nodiscard]] Pose overview() const;
  /// Looks from there.
  void look_from_above();

  void fill(ViewReport& report);

 private:
  [[nodiscard]] double aspect() const;

  Stage& stage_;
  SceneGraph& scene_;
  osgRoam::Manipulator& roamer_;
  News& news_;
  double fov_;
  Hold hold_;
  double speed_ = 0.0;  ///< m/s, of the body, a mean
  bool marks_ = false;
  Status shown_;
  double shown_at_ = -1.0;  ///< s
  bool display_told_ = false;
  std::uint64_t pages_told_ = 0;
};

}  // namespace roam::app
