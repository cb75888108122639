#pragma once
/// \file
/// The node of a scene's pages: which of its levels is drawn, and when its page is dropped.

#include <cstdint>
#include <limits>
#include <memory>
#include <osg/CullStack>
#include <osg/PagedLOD>
#include <vector>

#include "import/display_part.h"

namespace roam::app {

/// State shared by all nodes of pages in a session. Only the thread that draws uses it.
struct PageRules {
  double allowed_error = 0.0;  ///< pixels; see DisplayMeasure::error. 0: the finest level everywhere
  /// Pages that were seen last before this time (osg::FrameStamp's reference time, s) may be dropped.
  double drop_before = -std::numeric_limits<double>::infinity();
  std::uint64_t changes = 0;  ///< how often a node was drawn by other levels than before
};

/// Levels are chosen by the distance of the node's centre; by the pixels of the node's diameter at that distance; or by
/// error: the level changes where the node's error is as large on the screen as is allowed, seen from the eye at the
/// nearest point of the node's box. All parts of a picture choose the same. Each picture chooses anew; visitors that do
/// not draw find what was drawn last, and so does a parallel projection, such as the sun's.
class PageLod : public osg::PagedLOD {
 public:
  /// Takes all but the levels from `pages`.
  PageLod(const DisplayPages& pages, std::shared_ptr<PageRules> rules);

  /// Sets the range of the level added last, in the measure of the pages.
  void add_range(float from, float to);

  void traverse(osg::NodeVisitor& visitor) override;
  bool removeExpiredChildren(double time, unsigned int frame, osg::NodeList& removed) override;

  /// In the measure of the pages. An error is a multiple of the allowed one. `eye`: in the frame of the node. `pixels`:
  /// of a metre at a distance of one metre.
  [[nodiscard]] float value(const osg::Vec3d& eye, double pixels) const;

 protected:
  ~PageLod() override = default;

 private:
  void choose(const osg::CullStack& camera);
  void note_drawn(const osg::NodeVisitor& visitor);
  void draw_last(osg::NodeVisitor& visitor);

  std::shared_ptr<PageRules> rules_;
  DisplayMeasure measure_;
  double error_;
  osg::Vec3d half_;
  RangeList levels_;             ///< in the measure of the pages
  std::vector<unsigned> drawn_;  ///< the children that were drawn last
};

}  // namespace roam::app
