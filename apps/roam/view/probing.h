#pragma once
/// \file
/// "Can the body get there?": `roam probe` between two clicked points.

#include <filesystem>
#include <memory>
#include <optional>
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
  Vec3 start{0.0}, target{0.0};  ///< the body's places for both: the feet, in flight the centre
  bool passable = false;
  std::vector<Vec3> way;           ///< metres; likewise; empty: no way
  std::optional<Vec3> stopped_at;  ///< if the way is not passable: the place of it that stops the body
  /// Marked places, with the words of the pictures of `roam probe`: the place that decides, steps down.
  std::vector<std::pair<Vec3, std::string>> marks;
  std::vector<std::string> text;  ///< lines for people
};

/// The clicked points of a question; none: the body's place.
struct Clicked {
  std::optional<Vec3> from, to;
};

/// A way, up to what stops the body and beyond.
struct ProbedWay {
  std::vector<Vec3> open, barred;
};
[[nodiscard]] ProbedWay way_of(const ProbeReply& reply);

/// Runs `roam probe` as a child, one question at a time, with the scene and the body of the session. Call all members
/// from the thread that draws, between two frames.
class Probing {
 public:
  /// `program`: path of roam; empty: the running program.
  Probing(std::filesystem::path program, SceneAndStore what, const osgRoam::Manipulator& roamer);
  ~Probing();  ///< ends the child

  /// Begins to search a way. Ends an earlier search.
  void ask(const Vec3& from, const Vec3& to, const std::vector<std::string>& ignored = {}, const Clicked& clicked = {});
  /// Shows nothing any more, and ends the search. The report keeps the answers. Returns whether it ended a search.
  bool clear();

  void fill(Status& status);
  /// Adds the way. The graph is the scene minus `origin`.
  void add_to(graphics::Marks& marks, const Vec3& origin);
  /// The answer that is shown; null: none.
  [[nodiscard]] const ProbeReply* shown();
  /// All answers of the session.
  [[nodiscard]] const std::vector<ProbeReply>& replies();

 private:
  struct Search;
  void receive();

  std::filesystem::path program_;
  SceneAndStore what_;
  const osgRoam::Manipulator& roamer_;
  std::unique_ptr<Search> search_;  ///< null: nothing is shown
  Clicked clicked_;                 ///< of the search
  bool flies_ = false;              ///< likewise
  std::vector<ProbeReply> replies_;
};

/// The members of one answer in the viewer's report.
[[nodiscard]] Json to_json(const ProbeReply& reply);

}  // namespace roam::app
