#include "osgroam/background_build.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace osgRoam {

BackgroundBuild::BackgroundBuild(std::vector<roam::Mesh> meshes) {
  world_ = std::async(std::launch::async, [this, meshes = std::move(meshes)]() -> std::shared_ptr<const roam::World> {
    roam::BuildOptions options;
    options.progress = [this](double fraction) {
      fraction_ = std::min(fraction, 1.0);
      return !cancelled_;
    };
    return std::make_shared<const roam::World>(roam::World::build(meshes, options));
  });
}

BackgroundBuild::~BackgroundBuild() {
  cancelled_ = true;
  if (world_.valid()) world_.wait();
}

bool BackgroundBuild::ready() const {
  return world_.valid() && world_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace osgRoam
