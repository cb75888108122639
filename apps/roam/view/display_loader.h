#pragma once
/// \file
/// Loader of the scene's picture, in a thread of its own.

#include <deque>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <osg/Node>
#include <osg/ref_ptr>

#include "import/display.h"
#include "roam/import.h"
#include "scenes/scene_options.h"
#include "view/loading.h"
#include "view/page_source.h"

namespace roam::app {

/// A piece of the scene, ready for the graph.
struct DisplayNode {
  osg::ref_ptr<osg::Node> node;
  Vec3 origin{0.0};    ///< the graph is scene - origin
  Box bounds;          ///< in the scene's frame
  bool paged = false;  ///< its detail depends on the eye
};

/// A store, and the place in it that is to be seen.
struct PlaceInStore {
  std::shared_ptr<const Store> store;
  Vec3 place{0.0};
};

/// Reads in a thread and a reader process of its own, piece by piece.
class DisplayLoader {
 public:
  /// `objects` receives the names of the scene's objects; not null.
  DisplayLoader(const SceneOptions& scene, const TextureQuality& quality, std::shared_ptr<SceneObjects> objects,
                const PageSettings& pages = {});
  /// For a store without its scene: the triangles around `place`, once that is known. See show_store.
  explicit DisplayLoader(std::future<PlaceInStore> place);

  /// Ends the work, the reader process too, within a fraction of a second. Does not wait for that; the destructor does.
  void cancel() {
    loading_.cancel();
    pages_->cancel();
  }
  /// The source of pages for the pieces already taken.
  [[nodiscard]] PageSource& pages() { return *pages_; }
  /// Progress; from any thread.
  [[nodiscard]] LoadState state() const { return loading_.state(); }
  /// The next ready piece, if there is one.
  [[nodiscard]] std::optional<DisplayNode> take();
  /// The report, once, after the loading has succeeded; else nothing.
  [[nodiscard]] std::optional<DisplayReport> take_report();

 private:
  void load_scene();
  void load_store();
  void finish(DisplayReport&& report);
  bool receive(const DisplayPart& part);

  SceneOptions scene_;
  std::future<PlaceInStore> place_;
  osg::ref_ptr<PageSource> pages_;
  std::deque<DisplayNode> ready_;
  std::optional<DisplayReport> report_;
  Loading loading_;
};

}  // namespace roam::app
