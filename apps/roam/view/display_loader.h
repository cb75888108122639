#pragma once
/// \file
/// Loads what is to be seen, beside the thread that draws.

#include <deque>
#include <filesystem>
#include <future>
#include <optional>
#include <osg/Node>
#include <osg/ref_ptr>

#include "import/display.h"
#include "roam/import.h"
#include "scenes/scene_options.h"
#include "view/loading.h"
#include "view/page_source.h"

namespace roam::app {

/// A piece of the scene that can be put into the graph as it is.
struct DisplayNode {
  osg::ref_ptr<osg::Node> node;
  Vec3 origin{0.0};  ///< the graph is scene - origin
  Box bounds;        ///< in the scene's frame
};

/// Reads in a thread of its own, with a reader's process of its own; hands over piece by piece.
class DisplayLoader {
 public:
  DisplayLoader(const SceneOptions& scene, const TextureQuality& quality);
  /// Of a store whose scene is not there: the triangles around a place, when that is known. See show_store.
  DisplayLoader(const std::filesystem::path& store, std::future<Vec3> place);

  /// Lets what runs come to its end, the reader's process too; does not wait for that, as the destructor does: a
  /// fraction of a second.
  void cancel() {
    loading_.cancel();
    pages_->cancel();
  }
  /// Reads the pages of the pieces that have come.
  [[nodiscard]] PageSource& pages() { return *pages_; }
  /// How far it is; from any thread.
  [[nodiscard]] LoadState state() const { return loading_.state(); }
  /// The next piece that is ready, if there is one.
  [[nodiscard]] std::optional<DisplayNode> take();
  /// What was loaded, once, when the loading has ended well; else nothing.
  [[nodiscard]] std::optional<DisplayReport> take_report();

 private:
  void load_scene();
  void load_store();
  void finish(DisplayReport&& report);
  bool receive(const DisplayPart& part);

  SceneOptions scene_;
  std::filesystem::path store_;
  std::future<Vec3> place_;
  osg::ref_ptr<PageSource> pages_;
  std::deque<DisplayNode> ready_;
  std::optional<DisplayReport> report_;
  Loading loading_;
};

}  // namespace roam::app
