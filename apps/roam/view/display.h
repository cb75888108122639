#pragma once
/// \file
/// Everything that a session shows besides the scene: head-up display, marks, overview before the body arrives.

#include <optional>

#include "graphics/sun.h"
#include "osgRoam/Manipulator.h"
#include "view/daylight.h"
#include "view/news.h"
#include "view/pick.h"
#include "view/scene_graph.h"
#include "view/stage.h"
#include "view/status.h"
#include "view/view_report.h"

namespace roam::app {

/// Observes the body and the scene's graph, and shows their state. Call all members from the thread that draws, between
/// two frames.
class Display {
 public:
  /// `fov`: vertical field of view, degrees.
  Display(Stage& stage, SceneGraph& scene, osgRoam::Manipulator& roamer, News& news, double fov);

  /// Call it after each step. `wish`: the desired velocity, m/s.
  void watch(const StepReport& report, const Vec3& wish);
  /// Adds "marks", which shows or hides the body, its contact, and the nearest triangles.
  void add_to(Commands& commands) {
    commands.add("marks", [this] { marks_ = !marks_; });
  }

  /// Call it in each frame: reports parts of the scene that cannot be loaded, and written pictures.
  void tell_news();
  /// Whether it is time to show() again.
  [[nodiscard]] bool is_due() const;
  /// Makes the next frame show the status.
  void hurry() { shown_at_ = -1.0; }
  /// This object's part of the status. `has_body`: a walker is in the scene.
  [[nodiscard]] Status status(bool has_body);
  /// Shows `status` until is_due() is true again.
  void show(Status status);
  /// The status shown last.
  [[nodiscard]] const Status& shown() const { return shown_; }

  /// Call it in each frame: draws the `marks` of tools and its own, fits the near plane to `room`, the eye's distance
  /// from every wall (m), and the light to the sky that the eye sees.
  void update(bool has_body, double room, graphics::Marks marks);
  /// A pose from which the whole scene is visible.
  [[nodiscard]] Pose overview() const;
  /// Moves the camera to overview().
  void look_from_above() { look_from(overview()); }
  /// Moves the camera. Degrees.
  void look_from(const Pose& pose);
  /// The line of sight in the middle of the next frame's picture, of whichever camera.
  [[nodiscard]] std::optional<Sightline> middle() const;
  /// Width divided by height of the picture.
  [[nodiscard]] double aspect() const;

  void fill(ViewReport& report);

 private:
  void show_labels(const std::vector<graphics::LabelMark>& labels);
  void light(bool has_body);
  void tell_of_pages();
  /// The view matrix of the next frame.
  [[nodiscard]] osg::Matrixd view() const;

  Stage& stage_;
  SceneGraph& scene_;
  osgRoam::Manipulator& roamer_;
  News& news_;
  double fov_;
  graphics::Sun sun_;
  Daylight daylight_;
  double lit_at_ = 0.0;  ///< s
  Hold hold_;
  double speed_ = 0.0;  ///< m/s, mean speed of the body
  bool marks_ = false;
  Status shown_;
  double shown_at_ = -1.0;  ///< s
  bool display_told_ = false;
  std::uint64_t pages_told_ = 0;
  std::size_t page_notes_told_ = 0;
  std::string driver_lack_told_;
  bool coarser_told_ = false, lack_told_ = false;
};

}  // namespace roam::app
