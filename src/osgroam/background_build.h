#pragma once
/// \file
/// Construction of a world in a thread of its own.

#include <atomic>
#include <future>
#include <memory>
#include <vector>

#include "roam/world.h"

namespace osgRoam {

class BackgroundBuild {
 public:
  explicit BackgroundBuild(std::vector<roam::Mesh> meshes);
  /// Cancels the construction and waits until it has stopped.
  ~BackgroundBuild();
  BackgroundBuild(const BackgroundBuild&) = delete;
  BackgroundBuild& operator=(const BackgroundBuild&) = delete;

  [[nodiscard]] double fraction() const { return fraction_; }
  [[nodiscard]] bool ready() const;
  /// The world. Call it once, after ready() is true. Throws the exceptions of roam::World::build.
  [[nodiscard]] std::shared_ptr<const roam::World> take() { return world_.get(); }

 private:
  std::atomic<double> fraction_ = 0.0;
  std::atomic<bool> cancelled_ = false;
  std::future<std::shared_ptr<const roam::World>> world_;
};

}  // namespace osgRoam
