#pragma once
/// \file
/// "Can the body get there?": `roam probe` between two clicked points.

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/report.h"
#include "graphics/overlay.h"
#include "osgRoam/Manipulator.h"
#include "view/loading.h"
#include "view/status.h"
#include "view/store_choice.h"

namespace roam::app {

/// What `roam probe` answers; docs/probing.md.
struct ProbeReply {
  Vec3 from{0.0}, to{0.0};
  bool passable = false;
  std::vector<Vec3> way;  ///< metres; the feet, in flight the centre; empty: no way
  /// Marked places, with the words of the pictures of `roam probe`: the place that decides, steps down.
  std::vector<std::pair<Vec3, std::string>> marks;
  std::vector<std::string> text;  ///< lines for people
};

/// Runs `roam probe` as a child, one question at a time, with the scene and the body of the session. Call all members
/// from the thread that draws, between two frames.
class Probing {
 public:
  /// `program`: path of roam; empty: the running program.
  Probing(std::filesystem::path program, SceneAndStore what, const osgRoam::Manipulator& roamer);
  ~Probing();  ///< ends the child

  /// Begins to search a way. Ends an earlier search.
  void ask(const Vec3& from, const Vec3& to, const std::vector<std::string>& ignored = {});
  /// Shows nothing any more, and ends the search. The report keeps the answers. Returns whether it ended a search.
  bool clear();

  void fill(Status& status);
  /// Adds the way. The graph is the scene minus `origin`.
  void add_to(graphics::Marks& marks, const Vec3& origin);
  /// All answers of the session.
  [[nodiscard]] const std::vector<ProbeReply>& replies();

 private:
  struct Search;
  void receive();

  std::filesystem::path program_;
  SceneAndStore what_;
  const osgRoam::Manipulator& roamer_;
  std::unique_ptr<Search> search_;  ///< null: nothing is shown
  std::vector<ProbeReply> replies_;
};

/// The members of one answer in the viewer's report.
[[nodiscard]] Json to_json(const ProbeReply& reply);

}  // namespace roam::app
