#pragma once
/// \file
/// The picture: everything between the scene graph and the pixels of the window.
///
/// The scene is drawn into a buffer of our own, with several samples a pixel and a depth that keeps its precision from
/// the wall before the nose to the horizon: *reversed depth*. The vertex shader writes near / distance, which is 1 at
/// the near plane and 0 at infinity, into 32-bit floats; their exponent gives every distance the same relative
/// precision (2^-24, that is 0.6 mm at 10 km), so that the near plane can be a few centimetres and there is no far one.
/// Then the display is drawn over it, and what results goes to the window and to who asked for the picture.
///
///     graph      root() ── space() ── sky, scene, overlay     own depth; shaders must use depth_glsl()
///                      └── flat()  ── head-up display         over the picture, no depth
///
/// To OpenSceneGraph the camera is an ordinary perspective camera that renders to the window: culling, picking, level
/// of detail and manipulators work as they always do. Only fixed-function drawing below space() does not: its depth
/// would be the wrong way round. Give such a node a program that uses depth_glsl().

#include <functional>
#include <osg/Group>
#include <osg/Image>
#include <osg/ref_ptr>
#include <osgViewer/Viewer>
#include <string>

#include "graphics/context.h"
#include "roam/math.h"

namespace roam::graphics {

struct FrameSettings {
  double vertical_fov = 65.0;  ///< degrees, in [10, 150]
  /// Metres, in (0, 1000]: nothing nearer is drawn. For a body of radius r to see every wall it can touch:
  /// near_limit(r, ...).
  double near = 0.05;
  /// A pixel; 0 or 1: jagged edges, and the least work. At most what the driver can; 1 where it has no room for more.
  int samples = 4;
  bool reversed_depth = true;  ///< false: an ordinary depth buffer even where a reversed one could be had
};

/// The largest near plane, in metres, at which an eye `radius` metres from every wall sees no wall cut by it: the
/// corners of the picture are further out than its centre.
[[nodiscard]] double near_limit(double radius, double vertical_fov, double aspect);

/// A line of sight. In the frame of the scene graph: what is drawn is the scene minus one origin, so add that to
/// `origin` to have a place of the scene.
struct Ray {
  Vec3 origin{0.0};     ///< metres
  Vec3 direction{0.0};  ///< length 1
};

/// Sets up `viewer` to draw to a context. Everything it made lives on in the viewer: a Frame may go before or after.
/// Use it from the thread that calls viewer.frame(), which may run in any of OpenSceneGraph's threading models.
class Frame {
 public:
  /// Takes over the viewer's camera (context, viewport, projection, clearing, draw callbacks, lighting) and its scene
  /// data (root()). Throws roam::Error for settings out of range. Call before viewer.realize().
  Frame(osgViewer::Viewer& viewer, const Context& context, const FrameSettings& settings);
  ~Frame();
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  [[nodiscard]] osg::Group* root() const;
  [[nodiscard]] osg::Group* space() const;  ///< what is in space: add the sky, the scene, the overlay here
  [[nodiscard]] osg::Camera* flat() const;  ///< what is on the picture: pixels from the lower left corner
  [[nodiscard]] const Context& context() const;
  [[nodiscard]] int width() const;   ///< pixels; follows the window
  [[nodiscard]] int height() const;  ///< pixels; follows the window

  /// Takes effect with the next frame. Values as in FrameSettings; throws roam::Error.
  void set_near(double near);
  void set_vertical_fov(double degrees);
  [[nodiscard]] double near() const;
  [[nodiscard]] double vertical_fov() const;

  /// Whether the depth is reversed, or an ordinary 24-bit one: then what is far flickers.
  [[nodiscard]] bool reversed_depth() const;
  /// One line: renderer, depth, samples, and what is missing.
  [[nodiscard]] std::string describe() const;

  /// What lies under a pixel of the window, by the camera's present place: x to the right, y up, from the lower left
  /// corner, as osgGA's events count them. In the frame of the scene graph, as the camera is: scene minus origin.
  [[nodiscard]] Ray ray(double x, double y) const;

  /// Asks for the picture of the next frame that is drawn: RGB, 8 bit, rows from the bottom, as osg::Image is used to.
  /// with_hud: with what is drawn in flat(). Either `done` or `failed` is called, once, in the thread that draws:
  /// `failed` where the picture is too large for the driver, with the reason and a size that can be drawn.
  void request_picture(bool with_hud, std::function<void(osg::ref_ptr<osg::Image>)> done,
                       std::function<void(const std::string& reason)> failed = {});

 private:
  class Pipeline;
  void project();

  osg::ref_ptr<osg::Camera> camera_;
  Context context_;
  FrameSettings settings_;
  osg::ref_ptr<Pipeline> pipeline_;
  osg::ref_ptr<osg::Group> root_, space_;
  osg::ref_ptr<osg::Camera> flat_;
};

/// GLSL 1.20, to be put before a vertex shader for use below Frame::space(): `vec4 roam_clip(vec4 eye)` gives the
/// gl_Position of a point in eye coordinates.
[[nodiscard]] const char* depth_glsl();

}  // namespace roam::graphics
