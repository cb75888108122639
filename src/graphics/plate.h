#pragma once
/// \file
/// Rectangles on the picture, with rounded corners and smooth edges.

#include <osg/Geometry>
#include <osg/StateSet>
#include <osg/Vec4>
#include <osg/ref_ptr>

namespace roam::graphics {

/// A rectangle in pixels from the lower left corner of the picture.
struct Rectangle {
  float x = 0, y = 0, width = 0, height = 0;
  bool operator==(const Rectangle&) const = default;
};

/// Whether two rectangles have common points inside.
[[nodiscard]] inline bool overlap(const Rectangle& a, const Rectangle& b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/// A filled rectangle; `radius` of its corners in pixels. Draw it below a node with plate_state(), in any threading
/// model.
[[nodiscard]] osg::ref_ptr<osg::Geometry> make_plate(const Rectangle& where, float radius, const osg::Vec4& color);
/// Moves a plate. Call it between frames.
void move_plate(osg::Geometry& plate, const Rectangle& where, float radius);

/// The state that plates need, with their shader program.
[[nodiscard]] osg::ref_ptr<osg::StateSet> plate_state();

}  // namespace roam::graphics
