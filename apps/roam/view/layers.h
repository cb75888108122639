#pragma once
/// \file
/// Objects and groups of the scene, on and off by name.

#include <memory>
#include <osgGA/GUIEventHandler>
#include <set>
#include <string>
#include <vector>

#include "osgRoam/Manipulator.h"
#include "view/commands.h"
#include "view/hidden_space.h"
#include "view/prompt.h"
#include "view/scene_graph.h"
#include "view/stage.h"

namespace roam::app {

/// A list with boxes for the mouse, which scrolls and can be searched. What is hidden is not drawn, and clicks do not
/// find it; HiddenSpace decides whether the body meets it.
///
/// Call all members from the thread that draws, between two frames.
class Layers : public osgGA::GUIEventHandler {
 public:
  Layers(Stage& stage, SceneGraph& scene, HiddenSpace& hidden, const osgRoam::Manipulator& roamer, Prompt& prompt,
         News& news);

  /// Adds "layers", which shows or hides the list.
  void add_to(Commands& commands);
  /// Call it in each frame.
  void update();
  /// Notes for the report, before it is made, the patterns that have matched no name.
  void finish() { note_vain_patterns(true); }
  [[nodiscard]] bool is_shown() const { return shown_; }
  void close() { shown_ = false; }

  using osgGA::GUIEventHandler::handle;
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;

 protected:
  ~Layers() override = default;

 private:
  void note_vain_patterns(bool at_end);
  void show_list();
  void click(const std::string& part);
  void search();
  void scroll(double rows);

  Stage& stage_;
  SceneGraph& scene_;
  HiddenSpace& hidden_;
  const osgRoam::Manipulator& roamer_;
  Prompt& prompt_;
  News& news_;
  bool shown_ = false, patterns_told_ = false;
  bool is_down_ = false;  ///< a button of the mouse was pressed here

  // The list.
  std::set<SceneObjects::Number> open_;
  std::string search_;
  std::size_t first_ = 0;  ///< of the rows that are shown
  bool rows_changed_ = true;
  std::vector<graphics::ListRow> rows_;
  bool rows_pass_ = false;                                 ///< HiddenSpace::passes() of the rows
  std::shared_ptr<const SceneObjects::Flags> rows_flags_;  ///< of the rows
};

}  // namespace roam::app
