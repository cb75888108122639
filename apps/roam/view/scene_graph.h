#pragma once
/// \file
/// The scene's graph: pieces arrive while it is shown, pages follow the eye.

#include <cstdint>
#include <memory>
#include <osg/Group>
#include <osg/ref_ptr>
#include <osgUtil/IncrementalCompileOperation>
#include <osgViewer/Viewer>
#include <string>

#include "view/display_loader.h"

namespace roam::app {

/// Takes ready pieces from a DisplayLoader, uploads them to the graphics card over several frames, and adds them to the
/// graph. Reads no file itself; no file of a scene is read in this process. Call all members from the thread that
/// draws, between two frames.
class SceneGraph {
 public:
  /// How pieces enter the graph: a little in each frame, without hitches; or at once, when headless.
  enum class Arrival : std::uint8_t { smooth, at_once };

  /// Adds a group below `parent`. From now on PageSource supplies everything that OpenSceneGraph reads in this process.
  /// `objects`: those to which `loader` adds the scene's objects.
  SceneGraph(osgViewer::Viewer& viewer, osg::Group& parent, std::unique_ptr<DisplayLoader> loader,
             std::shared_ptr<SceneObjects> objects, Arrival arrival);
  ~SceneGraph();
  SceneGraph(const SceneGraph&) = delete;
  SceneGraph& operator=(const SceneGraph&) = delete;

  /// Cancels the loading without waiting.
  void cancel() { loader_->cancel(); }
  /// Before each frame.
  void update();

  /// The progress before the last update(). If it was over, all pieces are in the graph.
  [[nodiscard]] const LoadState& state() const { return state_; }
  /// The bounds of all pieces so far, in the scene's frame; empty at first.
  [[nodiscard]] const Box& bounds() const { return bounds_; }
  /// The graph is scene - origin; zero before the first piece.
  [[nodiscard]] const Vec3& origin() const { return origin_; }
  [[nodiscard]] osg::Group& group() { return *group_; }
  /// The objects with names. What is hidden there is not drawn from the next update() on.
  [[nodiscard]] SceneObjects& objects() { return *objects_; }
  [[nodiscard]] bool has_pieces() const { return pieces_ > 0; }
  /// Whether the detail of some piece depends on the eye.
  [[nodiscard]] bool is_paged() const { return paged_; }
  /// A number that changes with the drawn pages and objects.
  [[nodiscard]] std::uint64_t version() const { return loader_->pages().changes() + shown_; }
  /// Whether everything visible from here is in the graph. Call it once a frame: with pages, it is true after some
  /// frames without a new one.
  [[nodiscard]] bool is_complete();
  /// The report, after the loading.
  [[nodiscard]] const std::optional<DisplayReport>& report() const { return report_; }
  /// Of the pages; see PageSource.
  [[nodiscard]] const PageSource& pages() const { return loader_->pages(); }
  /// The number of pages that could not be read.
  [[nodiscard]] std::uint64_t missing_pages() const;
  /// The error of the first such page.
  [[nodiscard]] std::string page_problem() const;

 private:
  void attach(DisplayNode&& piece);
  void hide_objects();
  [[nodiscard]] bool is_compiling() const;

  osgViewer::Viewer& viewer_;
  osg::ref_ptr<osg::Group> group_;
  Arrival arrival_;
  osg::ref_ptr<osgUtil::IncrementalCompileOperation> compiler_;
  LoadState state_;
  Box bounds_;
  Vec3 origin_{0.0};
  std::uint64_t pieces_ = 0;
  bool paged_ = false;
  std::uint64_t last_count_ = 0;  ///< count of page reads at the last is_complete()
  int quiet_frames_ = 0;
  std::optional<DisplayReport> report_;
  std::shared_ptr<SceneObjects> objects_;
  std::uint64_t objects_version_ = 0;  ///< that the graph shows
  std::uint64_t shown_ = 0;            ///< how often objects were hidden or shown in the graph
  int frames_until_check_ = 0;
  bool unsettled_ = false;  ///< pieces could still arrive at the last check of what is hidden
  std::unique_ptr<DisplayLoader> loader_;
};

}  // namespace roam::app
