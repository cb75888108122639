#pragma once
/// \file
/// Meshes, and boxes of swept bodies, for OpenSceneGraph.

#include <algorithm>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Polytope>

#include "roam/mesh.h"

namespace roam::bench {

inline osg::Vec3d to_osg(const Vec3& v) { return {v.x, v.y, v.z}; }

/// A geode as in a file. `shift` is added to all places before they are rounded to floats.
inline osg::ref_ptr<osg::Geode> to_geode(const Mesh& mesh, const Vec3& shift = Vec3(0.0)) {
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  vertices->reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) vertices->push_back(osg::Vec3(to_osg(v + shift)));
  osg::ref_ptr<osg::DrawElementsUInt> indices = new osg::DrawElementsUInt(GL_TRIANGLES);
  indices->reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) indices->insert(indices->end(), triangle.begin(), triangle.end());
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexArray(vertices);
  geometry->addPrimitiveSet(indices);
  osg::ref_ptr<osg::Geode> geode = new osg::Geode;
  geode->addDrawable(geometry);
  return geode;
}

/// The box of a body that moves straight from one place to another. `reach`: half of the body's own box, metres.
inline osg::Polytope box_of_sweep(const Vec3& reach, const Vec3& from, const Vec3& to) {
  osg::Polytope polytope;
  for (int k = 0; k < 3; ++k) {
    osg::Vec3d axis;
    axis[k] = 1.0;
    polytope.add(osg::Plane(axis, reach[k] - std::min(from[k], to[k])));
    polytope.add(osg::Plane(-axis, reach[k] + std::max(from[k], to[k])));
  }
  return polytope;
}

}  // namespace roam::bench
