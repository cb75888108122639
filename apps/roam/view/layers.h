#pragma once
/// \file
/// Objects and groups of the scene, on and off by name.

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "osgRoam/Manipulator.h"
#include "view/commands.h"
#include "view/hidden_space.h"
#include "view/list_panel.h"
#include "view/scene_graph.h"

namespace roam::app {

/// A list with boxes for the mouse, which scrolls. What is typed searches it. What is hidden is not drawn, and clicks
/// do not find it; HiddenSpace decides whether the body meets it.
///
/// Call all members from the thread that draws, between two frames.
class Layers : public ListPanel {
 public:
  Layers(Stage& stage, SceneGraph& scene, HiddenSpace& hidden, const osgRoam::Manipulator& roamer, News& news);

  /// Adds "layers", which shows or hides the list in place of `other`.
  void add_to(Commands& commands, ListPanel& other);
  /// Call it in each frame.
  void update();
  /// Notes for the report, before it is made, the patterns that have matched no name.
  void finish() { note_vain_patterns(true); }

  using ListPanel::handle;
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;

 protected:
  ~Layers() override = default;
  [[nodiscard]] graphics::HudList head() override;
  void click(const std::string& part) override;

 private:
  void note_vain_patterns(bool at_end);
  void end_search();
  bool type(int key);

  SceneGraph& scene_;
  HiddenSpace& hidden_;
  bool patterns_told_ = false;

  // The list.
  std::set<SceneObjects::Number> open_;
  std::string search_;
  bool rows_changed_ = true;
  bool rows_pass_ = false;                                 ///< HiddenSpace::passes() of the rows
  std::shared_ptr<const SceneObjects::Flags> rows_flags_;  ///< of the rows
};

}  // namespace roam::app
