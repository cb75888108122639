#pragma once
/// \file
/// The visit of SceneSpace: as osgUtil::IntersectionVisitor, but what is visited does not depend on where an eye is,
/// and what is not loaded is told.

#include <osgUtil/IntersectionVisitor>
#include <string>
#include <vector>

#include "roam/math.h"

namespace osgRoam {

class SceneVisitor : public osgUtil::IntersectionVisitor {
 public:
  SceneVisitor(osgUtil::Intersector* intersector, ReadCallback* read)
      : osgUtil::IntersectionVisitor(intersector, read) {}

  /// What a PagedLOD or ProxyNode stands for and nobody can see.
  struct Unknown {
    roam::Box box;  ///< in the frame of the graph
    osg::NodePath path;
    std::string file;
  };
  [[nodiscard]] const std::vector<Unknown>& unknown() const { return unknown_; }
  /// Files that are not loaded and of which the graph does not say where they belong.
  [[nodiscard]] const std::vector<std::string>& unplaced() const { return unplaced_; }

  using osgUtil::IntersectionVisitor::apply;
  void apply(osg::Billboard&) override {}
  void apply(osg::Camera& camera) override;
  void apply(osg::Sequence& sequence) override;
  void apply(osg::LOD& lod) override;
  void apply(osg::PagedLOD& lod) override;
  void apply(osg::ProxyNode& proxy) override;

 private:
  [[nodiscard]] bool continues_a_sibling(const osg::LOD& lod) const;
  [[nodiscard]] osg::ref_ptr<osg::Node> read(const std::string& file);
  void add_unknown(const osg::Node& node, const std::string& file);

  std::vector<Unknown> unknown_;
  std::vector<std::string> unplaced_;
};

}  // namespace osgRoam
