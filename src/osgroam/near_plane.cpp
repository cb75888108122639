#include "osgroam/near_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <osg/observer_ptr>
#include <osgUtil/CullVisitor>

namespace osgRoam {
namespace {

/// OpenSceneGraph uses far * ratio as the least near plane, where far is that of the present picture. A fixed ratio for
/// the whole scene would put the plane much nearer than necessary in most pictures, and depth would be coarse. So this
/// callback chooses the ratio for each picture.
class NearLimit final : public osg::CullSettings::ClampProjectionMatrixCallback {
 public:
  explicit NearLimit(osg::Camera& camera) : camera_(&camera) {}

  void renew(double distance) {
    distance_ = distance;
    view_ = camera_->getViewMatrix();
  }

  bool clampProjectionMatrixImplementation(osg::Matrixf& projection, double& near, double& far) const override {
    return clamp(projection, near, far);
  }
  bool clampProjectionMatrixImplementation(osg::Matrixd& projection, double& near, double& far) const override {
    return clamp(projection, near, far);
  }

 private:
  template <class Matrix>
  bool clamp(Matrix& projection, double& near, double& far) const {
    const osg::ref_ptr<osgUtil::CullVisitor> usual = osgUtil::CullVisitor::create();
    osg::ref_ptr<osg::Camera> camera;
    if (camera_.lock(camera)) {
      double ratio = camera->getNearFarRatio();
      // Another manipulator's view of the camera is not limited here.
      const bool ours = camera->getViewMatrix() == view_;
      if (ours && far > 0.0) ratio = std::min(ratio, farthest_near_plane(projection, distance_) / far);
      usual->setNearFarRatio(ratio);
    }
    return usual->clampProjectionMatrixImplementation(projection, near, far);
  }

  osg::observer_ptr<osg::Camera> camera_;  // an observer, because the camera owns the callback; slaves inherit it
  osg::Matrixd view_;
  double distance_ = 0.0;
};

}  // namespace

double farthest_near_plane(const osg::Matrixd& projection, double distance) {
  const bool perspective = projection(3, 3) == 0.0 && projection(2, 3) == -1.0;
  if (!perspective || projection(0, 0) == 0.0 || projection(1, 1) == 0.0) {
    return std::numeric_limits<double>::infinity();
  }
  // The slopes of the picture's corner that is farthest from the view axis.
  const double across = (1.0 + std::abs(projection(2, 0))) / projection(0, 0);
  const double above = (1.0 + std::abs(projection(2, 1))) / projection(1, 1);
  return distance / std::sqrt(1.0 + across * across + above * above);
}

void limit_near_plane(osg::Camera& camera, double distance) {
  osg::CullSettings::ClampProjectionMatrixCallback* present = camera.getClampProjectionMatrixCallback();
  auto* limit = dynamic_cast<NearLimit*>(present);
  if (!limit) {
    if (present || camera.getComputeNearFarMode() == osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR) return;
    camera.setClampProjectionMatrixCallback(limit = new NearLimit(camera));
  }
  limit->renew(distance);
}

void leave_near_plane(osg::Camera& camera) {
  if (dynamic_cast<NearLimit*>(camera.getClampProjectionMatrixCallback())) {
    camera.setClampProjectionMatrixCallback(nullptr);
  }
}

}  // namespace osgRoam
