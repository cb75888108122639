#pragma once
/// \file
/// The recorded path and the bookmarks of a session.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "graphics/plan_panel.h"
#include "osgRoam/Manipulator.h"
#include "roam/error.h"
#include "roam/scene_frame.h"
#include "scenes/scene_options.h"
#include "view/bookmarks.h"
#include "view/commands.h"
#include "view/news.h"
#include "view/path_recorder.h"
#include "view/prompt.h"
#include "view/status.h"
#include "view/view_report.h"

namespace roam::app {

class Cameras;

/// Records the body's path, and keeps bookmarks. Needs no window. Call all members from one thread, between two frames.
/// Recording and adding bookmarks need a walker.
class Records {
 public:
  /// Reads the scene's bookmarks from settings_folder(); a warning says why they cannot be read.
  Records(const SceneOptions& scene, osgRoam::Manipulator& roamer, News& news);

  /// The bookmark of that name. Throws roam::Error if the bookmarks cannot be read, UsageError if there is no such
  /// name, or only in another frame of the scene.
  [[nodiscard]] Pose named(const std::string& name);
  /// Adds the body's pose. Throws roam::Error on failure.
  void add_bookmark();
  /// Gives the bookmark that was kept or visited last another name; `replaces`: also that of another. Throws
  /// roam::Error on failure.
  void name_bookmark(const std::string& name, bool replaces = false);
  /// The same with a name that the person types, who may replace another bookmark of that name. Errors become news.
  void ask_name(Prompt& prompt);
  /// All bookmarks, seen from above.
  [[nodiscard]] std::vector<graphics::PlanPlace> places() const;
  [[nodiscard]] std::vector<std::string> bookmark_names() const;
  /// Throws roam::Error on failure.
  void remove_bookmark(const std::string& name);
  /// Puts the body at the bookmark of that name, if there is one.
  void go_to_bookmark(const std::string& name);
  /// Puts the body at the next bookmark, or the previous one; at first, at the first or the last.
  void go_to_next_bookmark(bool backwards);
  /// Adds both as "bookmark" and "next_bookmark". Adds "record", which ends the recording, or begins one in the current
  /// folder under a new name. From now on the body's camera leads at a bookmark.
  void add_to(Commands& commands, Cameras& cameras);

  /// Begins to record the path. Throws roam::Error if the file cannot be written.
  void record(const std::filesystem::path& file, files::Naming naming = files::Naming::exact);
  /// Call it in each frame with a body. `now`: seconds since the session began.
  void add_frame(double now);
  [[nodiscard]] bool is_recording() const { return recorder_.has_value(); }
  /// Ends the recording, if there is one.
  void finish();

  void fill(Status& status) const;
  void fill(ViewReport& report) const;

 private:
  void go_to_present();
  void ask_name(Prompt& prompt, const std::string& question, const std::string& text, const std::string& replaced);

  osgRoam::Manipulator& roamer_;
  News& news_;
  Cameras* cameras_ = nullptr;       ///< null before add_to()
  std::optional<SceneFrame> frame_;  ///< of the scene; none: its files differ
  std::optional<Bookmarks> bookmarks_;
  std::optional<Error> problem_;  ///< why the bookmarks cannot be read
  std::optional<PathRecorder> recorder_;
};

}  // namespace roam::app
