#pragma once
// Draws a scene without a screen, and reads its pixels.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/Image>
#include <osg/NodeVisitor>
#include <osg/StateSet>
#include <osgViewer/Viewer>
#include <utility>
#include <vector>

#include "graphics/context.h"
#include "graphics/frame.h"
#include "graphics/shading.h"

namespace roam::test {

struct Pixel {
  int r = 0, g = 0, b = 0;
  bool operator==(const Pixel&) const = default;
  [[nodiscard]] int sum() const { return r + g + b; }
  [[nodiscard]] int distance(const Pixel& o) const { return std::abs(r - o.r) + std::abs(g - o.g) + std::abs(b - o.b); }
};

inline std::ostream& operator<<(std::ostream& out, const Pixel& p) {
  return out << "(" << p.r << " " << p.g << " " << p.b << ")";
}

/// x to the right, y up.
inline Pixel at(const osg::Image& image, int x, int y) {
  const unsigned char* p = image.data(static_cast<unsigned>(x), static_cast<unsigned>(y));
  return {p[0], p[1], p[2]};
}

/// The number of pixels that differ by more than `tolerance` levels in total.
inline int differing(const osg::Image& a, const osg::Image& b, int tolerance = 0) {
  int count = 0;
  for (int y = 0; y < a.t(); ++y) {
    for (int x = 0; x < a.s(); ++x) count += at(a, x, y).distance(at(b, x, y)) > tolerance;
  }
  return count;
}

/// A rectangle centre +- u +- v, without normals or colours.
inline osg::ref_ptr<osg::Geometry> quad(const osg::Vec3d& centre, const osg::Vec3d& u, const osg::Vec3d& v) {
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
  for (const auto& [s, t] : {std::pair{-1, -1}, std::pair{1, -1}, std::pair{1, 1}, std::pair{-1, 1}}) {
    corners->push_back(centre + u * s + v * t);
  }
  geometry->setVertexArray(corners);
  osg::ref_ptr<osg::DrawElementsUByte> triangles = new osg::DrawElementsUByte(GL_TRIANGLES);
  for (const GLubyte i : {0, 1, 2, 0, 2, 3}) triangles->push_back(i);
  geometry->addPrimitiveSet(triangles);
  return geometry;
}

inline osg::ref_ptr<osg::Geometry> paint(osg::ref_ptr<osg::Geometry> geometry, const osg::Vec4& color) {
  osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(1);
  (*colors)[0] = color;
  geometry->setColorArray(colors, osg::Array::BIND_OVERALL);
  return geometry;
}

/// Prepares geometries for the scene group: white and without normals, unless they have their own.
struct Completion : osg::NodeVisitor {
  Completion() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
  void apply(osg::Geometry& geometry) override {
    geometry.setUseDisplayList(false);
    geometry.setUseVertexBufferObjects(true);
    if (!geometry.getColorArray()) {
      osg::ref_ptr<osg::Vec4Array> white = new osg::Vec4Array(1);
      (*white)[0].set(1, 1, 1, 1);
      geometry.setColorArray(white, osg::Array::BIND_OVERALL);
    }
    if (!geometry.getNormalArray()) geometry.setNormalArray(new osg::Vec3Array(1), osg::Array::BIND_OVERALL);
    osg::StateSet* state = geometry.getStateSet();
    const bool textured = state && state->getTextureAttribute(0, osg::StateAttribute::TEXTURE);
    if (textured) graphics::apply({.textured = true}, *state);
  }
};

inline const osg::Vec3d x_axis(1, 0, 0), y_axis(0, 1, 0), z_axis(0, 0, 1);

/// One sample a pixel; `plain` without effects, so that pixels are exact.
inline const graphics::FrameSettings plain{.samples = 1, .quality = graphics::Quality::plain};
inline const graphics::FrameSettings with_light{.samples = 1, .quality = graphics::Quality::light};
inline const graphics::FrameSettings with_full{.samples = 1, .quality = graphics::Quality::full};

/// A viewer without a screen. By default nothing is smoothed, so that pixels are exact.
struct Stage {
  explicit Stage(int width = 320, int height = 180, const graphics::FrameSettings& settings = plain,
                 graphics::Headless how = graphics::Headless::any)
      : Stage(graphics::open_headless(width, height, how), settings) {}
  Stage(graphics::Context opened, const graphics::FrameSettings& settings)
      : context(std::move(opened)), frame(viewer, context, settings), scene(graphics::make_scene_group()) {
    viewer.setThreadingModel(osgViewer::Viewer::SingleThreaded);
    viewer.setKeyEventSetsDone(0);
    frame.space()->addChild(graphics::make_sky());
    frame.space()->addChild(scene);
    look({0, 0, 0}, {0, 1, 0});
  }

  void add(const osg::ref_ptr<osg::Node>& node) {
    Completion completion;
    node->accept(completion);
    scene->addChild(node);
  }
  void look(const osg::Vec3d& eye, const osg::Vec3d& at_point) {
    viewer.getCamera()->setViewMatrixAsLookAt(eye, at_point, osg::Vec3d(0, 0, 1));
  }
  osg::ref_ptr<osg::Image> picture(bool with_hud = false) {
    osg::ref_ptr<osg::Image> taken;
    frame.request_picture(with_hud, [&](osg::ref_ptr<osg::Image> image) { taken = image; });
    viewer.frame();
    return taken;
  }

  graphics::Context context;
  osgViewer::Viewer viewer;
  graphics::Frame frame;
  osg::ref_ptr<osg::Group> scene;
};

}  // namespace roam::test
