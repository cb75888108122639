#pragma once
/// \file
/// One part as a scene graph, and as the bytes of a file.

#include <map>
#include <optional>
#include <osg/Group>
#include <osg/StateSet>
#include <osg/Texture2D>
#include <string>

#include "import/reader/display/surface.h"
#include "import/reader/display/textures.h"
#include "roam/math.h"

namespace roam::reader {

/// Builds what display.h says of a part.
class PartGraph {
 public:
  /// `origin` is subtracted from every coordinate.
  PartGraph(Textures& textures, const Vec3& origin);

  /// Adds the chunks of a surface of one look. `normals`: whether all of its vertices have one.
  void add(const Surface& surface, const Look& look, bool normals);
  /// Adds a ready node, in coordinates that are relative to the origin already.
  void add(osg::Node& node) { root_->addChild(&node); }

  [[nodiscard]] const Box& bounds() const { return bounds_; }
  /// Of geometry and images, about.
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  /// A file in OpenSceneGraph's binary format. Throws roam::Error when OpenSceneGraph's own plugin is not there.
  [[nodiscard]] std::string osgb() const;

 private:
  osg::ref_ptr<osg::StateSet> state_of(const Look& look);
  osg::Group& cell_around(const Vec3& place, Vec3& cell);

  Textures& textures_;
  Vec3 origin_;
  Box bounds_;
  std::size_t bytes_ = 0;
  osg::ref_ptr<osg::Group> root_ = new osg::Group;
  std::map<std::array<double, 3>, osg::Group*> cells_;
  std::map<TextureId, osg::ref_ptr<osg::Texture2D>> loaded_;
  std::map<Look, osg::ref_ptr<osg::StateSet>> states_;
};

}  // namespace roam::reader
