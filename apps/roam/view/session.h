#pragma once
/// \file
/// One session of `roam view`: from the empty window to the last frame.

#include <memory>
#include <optional>
#include <string>

#include "cli/output_file.h"
#include "osgRoam/Manipulator.h"
#include "view/arrival.h"
#include "view/bookmark_list.h"
#include "view/cameras.h"
#include "view/commands.h"
#include "view/controllers.h"
#include "view/display.h"
#include "view/hidden_space.h"
#include "view/layers.h"
#include "view/learning.h"
#include "view/news.h"
#include "view/options.h"
#include "view/prompt.h"
#include "view/records.h"
#include "view/replay.h"
#include "view/rereading.h"
#include "view/scene_graph.h"
#include "view/stage.h"
#include "view/store_building.h"
#include "view/tools.h"
#include "view/view_report.h"
#include "view/walk_log.h"

namespace roam::app {

/// Joins the objects of a session, each of which owns its state:
///
///     Arrival        loads the collision, puts the body into the scene
///     StoreBuilding  builds the scene's store meanwhile
///     Learning       sizes of the body
///     Records        the recorded path, bookmarks
///     Display        head-up display, marks, overview
///     Layers         objects on and off by name
///     BookmarkList   bookmarks for the mouse
///     HiddenSpace    what the body and clicks meet of what is hidden
///     Controllers    gamepads
///     Tools          measuring by clicks, sections, the plan
///     Rereading      the end of the session for another one
///     Stage          window, time, pictures and films
///
/// All of them write to News, and add their actions to Commands. The body collides with the scene's store if it matches
/// the scene, else with the scene as read. A store that is built meanwhile replaces it.
///
/// Everything between two frames runs in the thread that calls frame(). Reading, indexing and the search for a start
/// have threads of their own and never delay a frame.
///
/// In a window, time follows the clock. Headless, every frame is 1/60 s, however long it takes, and frames that nothing
/// records are not drawn.
class Session {
 public:
  /// Opens the window and begins to load. Throws roam::Error or UsageError if that is impossible.
  Session(const ViewOptions& options, const ViewPlan& plan, const ViewSettings& settings);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// Runs one frame. False at the end of the session: closed, or all work done. Throws roam::Error if nothing of the
  /// scene can be loaded, or if the path or --verify is not possible.
  bool frame();
  /// Set if the session has ended for another one.
  [[nodiscard]] std::optional<NextSession> next() const;
  /// Ends the session and writes its outputs, each of which may fail.
  [[nodiscard]] ViewReport finish(Unwritten& unwritten);

  /// Commands::run; the display shows the effect at once.
  bool run(const std::string& command, bool shift = false);
  /// Does what the first key of a command does, or of a camera, for menus and buttons; nothing if it has none.
  void press(const std::string& command, bool shift = false);

  [[nodiscard]] osgRoam::Manipulator& roamer() { return *roamer_; }
  [[nodiscard]] Stage& stage() { return stage_; }
  [[nodiscard]] const Tools& tools() const { return *tools_; }
  /// The list that is shown; null: none.
  [[nodiscard]] ListPanel* shown_list();
  [[nodiscard]] HiddenSpace& hidden() { return hidden_; }
  [[nodiscard]] const SceneGraph& scene() const { return scene_; }
  [[nodiscard]] const WalkLog& log() const { return log_; }
  [[nodiscard]] const Status& status() const { return display_.shown(); }
  /// Whether the body is in the scene, led by the person or the path.
  [[nodiscard]] bool roaming() const { return arrival_.is_placed(); }
  /// Whether the body's camera receives the keys.
  [[nodiscard]] bool roamer_leads() const { return cameras_->body_leads(); }

 private:
  void enter();
  void step_taken(const StepReport& report, double seconds);
  void see_to_store();
  [[nodiscard]] bool runs() const;
  void turn_around();
  void load_pages_of_film();
  void show_keys();
  void show(bool at_once);
  void tell_results();
  [[nodiscard]] Vec3 place() const;
  [[nodiscard]] bool is_replaying() const { return replay_ && !replay_->done(); }
  [[nodiscard]] bool is_at_its_end() const;

  const SceneAndStore what_;
  const ViewOptions options_;
  const osg::ref_ptr<osgRoam::Manipulator> roamer_;
  News news_;
  Commands commands_;
  Records records_;
  const ViewPlan plan_;
  WalkLog log_;
  Stage stage_;
  Unwritten picture_;  ///< of --screenshot
  osg::ref_ptr<Cameras> cameras_;
  Arrival arrival_;
  const std::shared_ptr<SceneObjects> objects_;
  SceneGraph scene_;
  Display display_;
  const osg::ref_ptr<Prompt> prompt_;
  HiddenSpace hidden_;
  const osg::ref_ptr<Layers> layers_;
  const osg::ref_ptr<BookmarkList> bookmark_list_;
  const osg::ref_ptr<Tools> tools_;
  Controllers controllers_;
  StoreBuilding building_;
  Rereading rereading_;
  std::optional<Learning> learning_;
  std::optional<Replay> replay_;
  double placed_at_ = 0.0;            ///< s since the session began
  std::optional<double> turning_at_;  ///< s since the session began, of the turntable's start
  bool quits_ = false;
  bool tells_results_ = false;  ///< on the terminal
  std::size_t measurements_told_ = 0, written_told_ = 0;
};

}  // namespace roam::app
