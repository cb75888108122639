#include "sphere_box.h"

#include <algorithm>
#include <cmath>

#include "affine.h"
#include "math/largest.h"
#include "roam/error.h"
#include "roam/mesh.h"
#include "vectors.h"

namespace osgRoam {

bool isFinite(const osg::Matrixd& matrix) {
  return std::all_of(matrix.ptr(), matrix.ptr() + 16, [](double x) { return std::isfinite(x); });
}

roam::Box boxOf(const osg::BoundingSphere& sphere, const osg::Matrixd& matrix) {
  const osg::Vec3d local = sphere.center();
  const double size = local.length() + sphere.radius();
  if (!(sphere.radius() > 0.0f) || !std::isfinite(size) || !isFinite(matrix)) return {};
  const roam::Vec3 centre = to_roam(local * matrix);
  const double stretch = greatestStretch(matrix);
  // The second term is the error of the computations here in doubles: a dozen roundings of all terms.
  const double rounding = sphereRounding * stretch * size + 0x1p-48 * (stretch * size + matrix.getTrans().length());
  const double radius = sphere.radius() * stretch + rounding;
  constexpr double limit = roam::coordinate_limit;
  roam::Box box;
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = std::max(centre[k] - radius, -limit);
    box.upper[k] = std::min(centre[k] + radius, limit);
  }
  const bool finite = std::isfinite(roam::largest(centre)) && std::isfinite(radius);
  return finite && !box.empty() ? box : roam::Box();
}

void checkBoundsMargin(double margin) {
  if (!(margin >= 0.0 && std::isfinite(margin))) {
    throw roam::Error("the margin of bounding volumes must be finite and not negative; boundsMargin() measures it.");
  }
}

}  // namespace osgRoam
