#pragma once
/// \file
/// The search of BoxIntersector in one drawable.

#include <osg/Geometry>
#include <osg/KdTree>

#include "osgRoam/BoxIntersector.h"
#include "osg_triangles/primitives.h"

namespace osgRoam {

/// Rejects triangles whose box is outside that of the swept body, transforms the others into the intersector's frame,
/// and sweeps or gathers them.
class BoxIntersector::Search {
 public:
  Search(BoxIntersector& below, osgUtil::IntersectionVisitor& visitor, osg::Drawable& drawable);

  void run(const osg::Geometry& geometry);

  // Interface of osg_triangles::Primitives.
  template <class Vertex>
  void begin(const Vertex* vertices, std::size_t count) {
    vertices_ = roam::osg_triangles::Vertices(count, vertices);
    floats_ = nullptr;
  }
  void begin(const osg::Vec3* vertices, std::size_t count) {
    vertices_ = roam::osg_triangles::Vertices(count, vertices);
    floats_ = vertices;
  }
  void triangle(const roam::osg_triangles::Corners& t) {
    if (t.a >= vertices_.size() || t.b >= vertices_.size() || t.c >= vertices_.size()) return;
    // Float vertices, the usual case, are compared without conversion.
    if (floats_ != nullptr && outside(floats_[t.a], floats_[t.b], floats_[t.c])) return;
    offer(t);
  }

  /// Whether a box in the drawable's frame is outside that of the swept body.
  [[nodiscard]] bool outside(const osg::BoundingBox& box) const {
    for (int k = 0; k < 3; ++k) {
      if (box._max[k] < lower_[k] || box._min[k] > upper_[k]) return true;
    }
    return false;
  }

 private:
  [[nodiscard]] bool outside(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c) const {
    for (int k = 0; k < 3; ++k) {
      if ((a[k] < lower_[k] && b[k] < lower_[k] && c[k] < lower_[k]) ||
          (a[k] > upper_[k] && b[k] > upper_[k] && c[k] > upper_[k])) {
        return true;
      }
    }
    return false;
  }
  /// Computes the box of the swept body in the drawable's frame, rounded outwards to floats. It is infinite if the
  /// matrix has no inverse.
  void bring_box();
  /// The k-d tree of this geometry; null if it is absent or unreliable.
  [[nodiscard]] const osg::KdTree* kd_tree(const osg::Geometry& geometry) const;
  void offer(const roam::osg_triangles::Corners& corners);
  void sweep(const roam::Triangle& triangle, const roam::osg_triangles::Corners& corners);
  void keep(const roam::SweepResult& result, const roam::Triangle& triangle,
            const roam::osg_triangles::Corners& corners);
  [[nodiscard]] osg::Vec3d local_point(const roam::Vec3& point, const roam::Triangle& triangle,
                                       const roam::osg_triangles::Corners& corners) const;

  BoxIntersector& below_;
  BoxIntersector& root_;
  osgUtil::IntersectionVisitor& visitor_;
  osg::Drawable& drawable_;
  roam::Vec3 from_, motion_;
  osg::Vec3f lower_, upper_;
  roam::osg_triangles::Vertices vertices_;
  const osg::Vec3* floats_ = nullptr;
  Intersections::iterator kept_;  ///< of this drawable, if only its earliest is wanted
  bool has_kept_ = false;
};

}  // namespace osgRoam
