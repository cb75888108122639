#pragma once
/// \file
/// Planes that hide a part of the picture, to look into buildings.

#include <osg/Group>
#include <string>
#include <vector>

#include "graphics/shading.h"
#include "view/pick.h"

namespace roam::app {

/// A plane of the option --section, in the scene's frame: "z<2.5" hides everything above. Throws UsageError for any
/// other text.
[[nodiscard]] graphics::SectionPlane parse_section(const std::string& text);

/// A list of planes in the scene's frame. It hides parts of the picture; the body still meets them.
///
/// Call all members from the thread that draws, between two frames.
class Section {
 public:
  explicit Section(std::vector<graphics::SectionPlane> planes) : planes_(std::move(planes)) {}

  [[nodiscard]] const std::vector<graphics::SectionPlane>& planes() const { return planes_; }
  /// Hides a surface that was clicked, and everything before it. With most_section_planes, the last plane moves there.
  void cut(const Pick& pick);
  /// Moves the last plane away from the side that it hides, by a fraction of its distance from the eye; < 0: back.
  void move(double notches, const Vec3& eye);
  void clear();
  /// Draws `scene` with the planes. The graph is the scene minus `origin`. Does nothing if it is drawn so already.
  void show(osg::Group& scene, const Vec3& origin);

 private:
  std::vector<graphics::SectionPlane> planes_;
  std::vector<graphics::SectionPlane> shown_;  ///< in the frame of the graph
};

}  // namespace roam::app
