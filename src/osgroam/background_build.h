#pragma once
/// \file
/// A world that is built in a thread of its own.

#include <atomic>
#include <future>
#include <memory>
#include <vector>

#include "roam/world.h"

namespace osgRoam {

class BackgroundBuild {
 public:
  explicit BackgroundBuild(std::vector<roam::Mesh> meshes);
  /// Cancels, and waits until that is noticed.
  ~BackgroundBuild();
  BackgroundBuild(const BackgroundBuild&) = delete;
  BackgroundBuild& operator=(const BackgroundBuild&) = delete;

  [[nodiscard]] double fraction() const { return fraction_; }
  [[nodiscard]] bool ready() const;
  /// When ready, once. Throws what roam::World::build throws.
  [[nodiscard]] std::shared_ptr<const roam::World> take() { return world_.get(); }

 private:
  std::atomic<double> fraction_ = 0.0;
  std::atomic<bool> cancelled_ = false;
  std::future<std::shared_ptr<const roam::World>> world_;
};

}  // namespace osgRoam
