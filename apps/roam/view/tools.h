#pragma once
/// \file
/// Tools for the mouse: whatever a click does besides leading the body.

#include <osgGA/GUIEventHandler>

#include "graphics/overlay.h"
#include "osgRoam/Manipulator.h"
#include "view/cameras.h"
#include "view/commands.h"
#include "view/hidden_space.h"
#include "view/live_plan.h"
#include "view/measuring.h"
#include "view/presses.h"
#include "view/probing.h"
#include "view/scene_graph.h"
#include "view/section.h"
#include "view/section_grips.h"
#include "view/stage.h"
#include "view/view_report.h"

namespace roam::app {

/// Recognizes clicks of the left button: pressed and released at one place. Drags still look around. A double click
/// leads the body to what is seen there. While a tool is on, clicks are its own. The section stays while one measures.
/// With a grabbed mouse, a click is at the middle of the picture. A click on the plan leads the body there, seen by its
/// own camera, and the wheel zooms it.
///
/// Call all members from the thread that draws, between two frames. add_to() needs a body in the scene.
class Tools : public osgGA::GUIEventHandler {
 public:
  /// `program`: path of roam; empty: the running program. `section`: at first.
  Tools(Stage& stage, SceneGraph& scene, osgRoam::Manipulator& roamer, Cameras& cameras, const HiddenSpace& hidden,
        const SceneAndStore& what, const std::filesystem::path& program, SectionShape section);

  /// Adds "measure", "section" and "section_box", which turn these tools on or off; "probe", which searches a way
  /// between the measured points; and "plan", which shows the plan smaller, larger or not.
  void add_to(Commands& commands);
  /// Call it in each frame. `has_plan`: whether there is room for the plan; `places`: on it.
  void update(bool has_body, bool has_plan, const std::vector<graphics::PlanPlace>& places);

  using osgGA::GUIEventHandler::handle;
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;

  /// The body was put somewhere.
  void jump() { plan_.jump(); }
  void fill(Status& status);
  void fill(ViewReport& report);
  void add_to(graphics::Marks& marks);
  [[nodiscard]] const std::vector<Measurement>& measurements() const { return measuring_.all(); }
  [[nodiscard]] const LivePlan& plan() const { return plan_; }
  [[nodiscard]] bool is_measuring() const { return tool_ == Tool::measure; }
  [[nodiscard]] const SectionShape& section() const { return section_.shape(); }
  [[nodiscard]] CameraView camera() const;  ///< of the window

 protected:
  ~Tools() override = default;

 private:
  /// A point of the picture, from -1 to 1.
  struct Point {
    double x = 0.0, y = 0.0;
  };
  [[nodiscard]] Point point_of(const osgGA::GUIEventAdapter& event) const;
  /// What clicks on the picture do.
  enum class Tool : std::uint8_t { none, measure, section, box };

  bool press(const osgGA::GUIEventAdapter& event);
  bool scroll(const osgGA::GUIEventAdapter& event);
  void release(const osgGA::GUIEventAdapter& event);
  bool go(const Point& at);
  void click(const Point& at);
  void toggle_measuring();
  void toggle_section();
  void toggle_box();
  [[nodiscard]] std::string ended_text() const;
  void probe();
  [[nodiscard]] std::optional<Pick> pick_at(const Point& at) const;
  [[nodiscard]] Box room_around() const;
  void cut(Pick pick);
  bool drag(const osgGA::GUIEventAdapter& event);
  void add_ends_to(std::vector<graphics::PlanPlace>& places);
  void resize_box(const Point& at, double notches);

  Stage& stage_;
  SceneGraph& scene_;
  osgRoam::Manipulator& roamer_;
  Cameras& cameras_;
  const HiddenSpace& hidden_;
  Tool tool_ = Tool::none;
  Measuring measuring_;
  Probing probing_;
  Section section_;
  LivePlan plan_;
  std::optional<Grip> grip_;       ///< of the box, held by the mouse
  Box gripped_;                    ///< the box when it was pressed
  std::optional<Sightline> from_;  ///< then
  Presses presses_;
  bool is_down_ = false;
  bool is_on_plan_ = false;  ///< the present press is
};

}  // namespace roam::app
