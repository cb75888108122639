#pragma once
/// \file
/// Objects and groups of the scene, on and off by name.

#include <memory>
#include <osgGA/GUIEventHandler>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "osgRoam/Manipulator.h"
#include "roam/filtered.h"
#include "view/arrival.h"
#include "view/commands.h"
#include "view/prompt.h"
#include "view/scene_graph.h"
#include "view/stage.h"
#include "view/view_report.h"

namespace roam::app {

/// A list with boxes for the mouse, which scrolls and can be searched. What is hidden is not drawn, and clicks do not
/// find it. The body still meets it, unless the person lets it pass through: then Filtered leaves out the hidden
/// objects of its world, except those with a name that something visible has, too.
///
/// Call all members from the thread that draws, between two frames.
class Layers : public osgGA::GUIEventHandler {
 public:
  /// `may_pass`: whether the body may pass through objects. No if all its moves are to be verified, or follow a path.
  Layers(Stage& stage, SceneGraph& scene, const Arrival& arrival, osgRoam::Manipulator& roamer, Prompt& prompt,
         News& news, bool may_pass);

  /// Adds "layers", which shows or hides the list.
  void add_to(Commands& commands);
  /// Call it in each frame.
  void update();
  /// Notes for the report, before it is made, the patterns that have matched no name.
  void finish() { note_vain_patterns(true); }
  [[nodiscard]] bool is_shown() const { return shown_; }
  void close() { shown_ = false; }

  /// Lets the body pass through hidden objects, or no longer. Says why not if that is impossible. While the walls are
  /// being loaded, it waits for them.
  void pass_through(bool passes);
  /// The space without hidden objects; null if none is hidden, or their triangles are not known.
  [[nodiscard]] const Space* visible() const { return visible_.get(); }
  /// Patterns of --ignore for the objects that the body passes through.
  [[nodiscard]] std::vector<std::string> passed() const;

  using osgGA::GUIEventHandler::handle;
  bool handle(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& action) override;

  void fill(Status& status) const;
  void fill(ViewReport& report) const;

 protected:
  ~Layers() override = default;

 private:
  void follow();
  void tell_of_store();
  void note_vain_patterns(bool at_end);
  void show_list();
  void click(const std::string& part);
  void search();
  void scroll(double rows);

  Stage& stage_;
  SceneGraph& scene_;
  const Arrival& arrival_;
  osgRoam::Manipulator& roamer_;
  Prompt& prompt_;
  News& news_;
  bool may_pass_;
  bool shown_ = false, passes_ = false, patterns_told_ = false;
  bool is_down_ = false;  ///< a button of the mouse was pressed here

  // The list.
  std::set<SceneObjects::Number> open_;
  std::string search_;
  std::size_t first_ = 0;  ///< of the rows that are shown
  bool rows_changed_ = true;
  std::vector<graphics::ListRow> rows_;

  // The inputs of the last follow().
  std::shared_ptr<const SceneObjects::Flags> flags_;
  SceneObjects::HiddenNames names_;
  std::shared_ptr<const World> world_;
  std::unordered_multimap<std::string, ObjectId> ids_;  ///< of the world's objects
  std::shared_ptr<const Space> visible_;
};

}  // namespace roam::app
