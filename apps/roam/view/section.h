#pragma once
/// \file
/// Planes and a box that hide a part of the picture, to look into buildings.

#include <optional>
#include <osg/Group>
#include <string>
#include <vector>

#include "graphics/shading.h"
#include "view/pick.h"

namespace roam::app {

/// Hides half spaces, and everything outside a box; in the scene's frame.
struct SectionShape {
  static constexpr std::size_t most_planes = graphics::most_section_planes - 6;  ///< the box has six sides
  std::vector<HalfSpace> planes;                                                 ///< at most most_planes
  std::optional<Box> box;

  [[nodiscard]] bool empty() const { return planes.empty() && !box; }
  /// All that is hidden.
  [[nodiscard]] std::vector<HalfSpace> hidden() const;
};

/// "z = 2.40 m"; of a slanting plane "12.30 m along (0.50, 0.00, 0.87)".
[[nodiscard]] std::string place_text(const HalfSpace& plane);
/// "8.00 x 5.20 x 2.50 m"
[[nodiscard]] std::string size_text(const Box& box);

/// Adds a section of the option --section: "z<2.5" hides everything above, "box 0 0 0, 10 10 3" everything outside the
/// box between these corners. Throws UsageError for any other text, a second box, a box without volume, or too many
/// planes.
void add_section(const std::string& text, SectionShape& shape);

/// A section that the mouse changes. It hides parts of the picture; HiddenSpace decides what the body meets.
///
/// Call all members from the thread that draws, between two frames.
class Section {
 public:
  static constexpr double least_side = 0.05;  ///< of the box, metres

  explicit Section(SectionShape shape) : shape_(std::move(shape)) {}

  [[nodiscard]] const SectionShape& shape() const { return shape_; }
  [[nodiscard]] const std::optional<Box>& box() const { return shape_.box; }
  void set_box(std::optional<Box> box) { shape_.box = box; }
  /// Hides a surface that was clicked, and everything before it. With most_planes, the last plane moves there.
  void cut(const Pick& pick);
  /// Moves the last plane away from the side that it hides, by a fraction of its distance from the eye; < 0: back.
  void move(double notches, const Vec3& eye);
  void clear_planes() { shape_.planes.clear(); }
  /// Draws `scene` with the section. The graph is the scene minus `origin`. Does nothing if it is drawn so already.
  void show(osg::Group& scene, const Vec3& origin);

 private:
  SectionShape shape_;
  std::vector<HalfSpace> shown_;  ///< in the frame of the graph
};

}  // namespace roam::app
