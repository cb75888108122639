#pragma once
/// \file
/// Looks of an OpenSceneGraph geometry, from its arrays, its state and that of its ancestors.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <osg/Array>
#include <osg/Geometry>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/StateSet>

#include "import/reader/display/look.h"
#include "import/reader/display/textures.h"

namespace roam::reader {

/// The looks of one geometry at one place in the graph.
class OsgLooks {
 public:
  /// `path`: the nodes above the geometry, and itself. Both must outlive this object.
  OsgLooks(const osg::Geometry& geometry, const osg::NodePath& path, const osg::Matrixd& to_world, Textures& textures);

  [[nodiscard]] const Look& look() const { return look_; }
  /// The look of a vertex in that primitive set.
  [[nodiscard]] VertexLook of(std::uint64_t vertex, unsigned set) const;
  /// Whether the look of a vertex depends on the primitive set.
  [[nodiscard]] bool by_set() const;

 private:
  void take_state(const osg::StateSet& state, Textures& textures);

  const osg::Array* normals_;
  const osg::Array* colours_;
  const osg::Array* coordinates_;
  glm::dmat3 normal_matrix_;
  osg::Matrixd texture_matrix_;
  Look look_;
  Colour material_ = white;
};

}  // namespace roam::reader
