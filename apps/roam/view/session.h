#pragma once
/// \file
/// One session of `roam view`: from the empty window to the last frame.

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "osgRoam/Manipulator.h"
#include "roam/path_file.h"
#include "view/bookmarks.h"
#include "view/build_process.h"
#include "view/cameras.h"
#include "view/collision_loader.h"
#include "view/commands.h"
#include "view/hold.h"
#include "view/learning.h"
#include "view/options.h"
#include "view/path_recorder.h"
#include "view/replay.h"
#include "view/scene_graph.h"
#include "view/stage.h"
#include "view/view_report.h"
#include "view/walk_log.h"

namespace roam::app {

/// Everything that happens between two frames happens in the thread that calls frame(); reading, indexing and the
/// search for a start happen in threads of their own, and never hold a frame up.
///
/// What the body collides with is the scene's store, where there is one that is of it, or the scene as it was read. A
/// store that is built meanwhile takes its place when it is done.
///
/// Time: in a window it is that of the clock. Headless every frame is 1/60 s, however long it takes, and frames that
/// nobody sees are not drawn.
class Session {
 public:
  /// Opens the window and begins to load. Throws roam::Error and UsageError for what can not be begun.
  Session(const ViewOptions& options, const ViewPlan& plan, const ViewSettings& settings);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  /// One frame. False when the session is at its end: closed, or all is done that was asked for. Throws roam::Error
  /// when nothing of the scene can be loaded, or what was asked for can not be done.
  bool frame();
  /// Writes what is still to be written, and tells how it was. The session is over.
  [[nodiscard]] ViewReport finish();

  /// What a key of the table does, as if it had been pressed. Of commands that are the viewer's own.
  void run(Command command);

  [[nodiscard]] osgRoam::Manipulator& roamer() { return *roamer_; }
  [[nodiscard]] Stage& stage() { return *stage_; }
  [[nodiscard]] const WalkLog& log() const { return log_; }
  [[nodiscard]] const Status& status() const { return status_; }
  /// The body is in the scene and the person leads it, or the path.
  [[nodiscard]] bool roaming() const { return placed_; }
  /// Keys go to the body's camera, not to one of the others.
  [[nodiscard]] bool roamer_leads() const;
  /// Escape goes down: closes the help, else gives the mouse back. False when there is neither.
  bool escape();
  /// What the person should read once: shown for some seconds.
  void tell(std::string news, bool warning = false);
  /// The same of what is not as it should be: kept for the report, too.
  void note(std::string sentence);

 private:
  void set_up_cameras();
  void receive_collision();
  void place();
  void begin_learning();
  void take_sizes();
  void take_lesson();
  void place_ghost(const std::string& why);
  void enter();
  void tell_where_put();
  void begin_replay();
  void see_events();
  void see_to_store();
  void follow_builder();
  void change_to(std::shared_ptr<Pager> pager);
  void tell_of_failures(const PagerStats& paging);
  void toggle_building();
  [[nodiscard]] std::string key_of(const char* command) const;
  void name_blockage(ViewReport& report) const;
  void step_taken(const StepReport& report, double seconds);
  void watch_footing(const StepReport& report, double seconds);
  [[nodiscard]] bool ground_below() const;
  void fly_without_ground();
  [[nodiscard]] Vec3 wish() const;
  void look_along_path(double seconds);
  void show_overview();
  void update_near();
  void update_status(bool at_once);
  void update_marks();
  void written(const std::filesystem::path& file);
  void record_way();
  void toggle_recording();
  void add_bookmark();
  void next_bookmark(bool backwards);
  void go_to(const Pose& pose);
  [[nodiscard]] Pose pose() const;
  [[nodiscard]] std::string camera_name() const;
  [[nodiscard]] bool replay_is_over() const;
  [[nodiscard]] bool is_at_its_end() const;
  [[nodiscard]] bool wants_end();
  [[nodiscard]] bool is_watched() const;
  void tell_of_loading();
  [[nodiscard]] ViewReport report();

  SceneAndStore what_;
  ViewOptions options_;
  ViewPlan plan_;
  std::optional<Bookmarks> bookmarks_;
  std::string bookmark_problem_;
  std::size_t bookmark_ = 0;
  osg::ref_ptr<osgRoam::Manipulator> roamer_;
  osg::ref_ptr<Cameras> cameras_;
  WalkLog log_;
  std::optional<Stage> stage_;
  std::optional<SceneGraph> scene_;
  std::optional<CollisionLoader> collision_;
  std::optional<Collision> loaded_;
  std::shared_ptr<Pager> pager_;  ///< what the body collides with, where it is a store
  std::optional<BuildProcess> builder_;
  std::future<void> freeing_;     ///< of the world or the pager that a store has replaced
  bool builder_stopped_ = false;  ///< by the person
  bool store_is_stale_ = false;
  bool store_offered_ = false;
  std::string failure_told_;  ///< of the store
  double failure_told_at_ = -1e9;
  std::string all_keys_;  ///< of a ghost in an empty space, which lacks some: as they were
  std::optional<Replay> replay_;
  std::optional<PathRecorder> recorder_;
  Hold hold_;
  std::optional<Learning> learning_;
  bool lesson_wanted_ = false;   ///< by the person
  bool without_ground_ = false;  ///< it walks, and would fall for ever
  Status status_;
  bool placed_ = false;
  bool ghost_only_ = false;
  bool marks_ = false;
  bool picture_taken_ = false;
  bool quits_ = false;
  bool display_told_ = false;
  std::uint64_t pages_told_ = 0;
  double speed_ = 0.0;       ///< m/s, of the body, a mean
  double now_ = 0.0;         ///< s since the session began
  double frame_time_ = 0.0;  ///< s that the present frame stands for
  double placed_at_ = 0.0;
  double status_at_ = -1.0;
  std::uint64_t frames_ = 0;
  std::vector<std::string> notes_;    ///< all, for the report
  std::vector<std::string> written_;  ///< files, for the report
  struct News {
    Told told;
    double until = 0.0;
  };
  std::vector<News> news_;  ///< for the display
  std::optional<Pose> start_;
  std::chrono::steady_clock::time_point begin_;
};

}  // namespace roam::app
