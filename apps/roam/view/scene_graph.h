#pragma once
/// \file
/// The scene in the graph that is drawn: pieces come while it is shown, pages follow the eye.

#include <cstdint>
#include <memory>
#include <osg/Group>
#include <osg/ref_ptr>
#include <osgUtil/IncrementalCompileOperation>
#include <osgViewer/Viewer>
#include <string>

#include "view/display_loader.h"

namespace roam::app {

/// Takes what a DisplayLoader has ready, has it sent to the graphics card a little a frame, and puts it into the graph.
/// Reads nothing itself, and no file of a scene is read in this process. All members belong to the thread that draws,
/// between two frames.
class SceneGraph {
 public:
  /// How pieces come into the graph: a little in each frame, so that no frame hitches; or at once, where nobody looks.
  enum class Arrival : std::uint8_t { smooth, at_once };

  /// Puts a group below `parent`. From now on OpenSceneGraph reads in this process what PageSource gives it.
  SceneGraph(osgViewer::Viewer& viewer, osg::Group& parent, std::unique_ptr<DisplayLoader> loader, Arrival arrival);
  ~SceneGraph();
  SceneGraph(const SceneGraph&) = delete;
  SceneGraph& operator=(const SceneGraph&) = delete;

  /// Lets the loading come to its end; does not wait for that.
  void cancel() { loader_->cancel(); }
  /// Before each frame.
  void update();

  /// How far the loading was before the last update(): if it was over, all pieces are in the graph.
  [[nodiscard]] const LoadState& state() const { return state_; }
  /// Of what has come, in the scene's frame; empty at first.
  [[nodiscard]] const Box& bounds() const { return bounds_; }
  /// The graph is scene - origin; zero before the first piece.
  [[nodiscard]] const Vec3& origin() const { return origin_; }
  [[nodiscard]] osg::Group& group() { return *group_; }
  [[nodiscard]] bool has_pieces() const { return pieces_ > 0; }
  /// Whether all that is to be seen from here is in the graph. For pages, call it once a frame: it is true when for
  /// some frames nothing more has come.
  [[nodiscard]] bool is_complete();
  /// What was read, when it has been.
  [[nodiscard]] const std::optional<DisplayReport>& report() const { return report_; }
  /// Pages that could not be read while they were wanted.
  [[nodiscard]] std::uint64_t missing_pages() const;
  /// Why the first of them could not.
  [[nodiscard]] std::string page_problem() const;

 private:
  void attach(DisplayNode&& piece);
  [[nodiscard]] bool is_compiling() const;

  osgViewer::Viewer& viewer_;
  osg::ref_ptr<osg::Group> group_;
  Arrival arrival_;
  osg::ref_ptr<osgUtil::IncrementalCompileOperation> compiler_;
  LoadState state_;
  Box bounds_;
  Vec3 origin_{0.0};
  std::uint64_t pieces_ = 0;
  std::uint64_t last_count_ = 0;  ///< of page reads, when is_complete() looked last
  int quiet_frames_ = 0;
  std::optional<DisplayReport> report_;
  std::unique_ptr<DisplayLoader> loader_;
};

}  // namespace roam::app
