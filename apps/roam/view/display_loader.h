#pragma once
/// \file
/// Loads what is to be seen, beside the thread that draws.

#include <atomic>
#include <deque>
#include <mutex>
#include <optional>
#include <osg/Node>
#include <osg/ref_ptr>
#include <thread>

#include "import/display.h"
#include "roam/import.h"
#include "scene_options.h"
#include "view/status.h"

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
  explicit DisplayLoader(const SceneOptions& scene);
  /// Ends what runs, the reader's process too, and waits for that: a fraction of a second.
  ~DisplayLoader();
  DisplayLoader(const DisplayLoader&) = delete;
  DisplayLoader& operator=(const DisplayLoader&) = delete;

  /// Lets what runs come to its end; does not wait for that.
  void cancel() { cancelled_ = true; }
  /// How far it is; from any thread.
  [[nodiscard]] LoadState state() const;
  /// The next piece that is ready, if there is one.
  [[nodiscard]] std::optional<DisplayNode> take();
  /// What was loaded, once, when the loading has ended well; else nothing.
  [[nodiscard]] std::optional<DisplayReport> take_report();

 private:
  void run();
  bool receive(DisplayPart&& part);

  SceneOptions scene_;
  std::atomic<bool> cancelled_ = false;
  mutable std::mutex mutex_;
  LoadState state_;
  std::deque<DisplayNode> ready_;
  std::optional<DisplayReport> report_;
  std::thread thread_;
};

}  // namespace roam::app
