#pragma once
/// \file
/// The rendering of the scene graph into the pixels of the window.
///
/// The scene is drawn into a separate buffer with several samples a pixel and *reversed depth*, which stays precise
/// from walls before the eye to the horizon. The vertex shader writes near / distance, which is 1 at the near plane and
/// 0 at infinity, into 32-bit floats. Their exponent gives every distance the same relative precision (2^-24, that is
/// 0.6 mm at 10 km). So the near plane can be a few centimetres, and there is no far plane. Then the effects of the
/// quality (quality.h) and the head-up display are added, and the result goes to the window and to requested pictures.
///
///     graph      root() ── space() ── sky, scene, overlay     own depth; shaders must use depth_glsl()
///                      └── flat()  ── head-up display         over the picture, no depth
///
/// For OpenSceneGraph the camera is an ordinary perspective camera that renders to the window. Culling, picking, level
/// of detail and manipulators work as usual. Only fixed-function drawing below space() does not work, because its depth
/// is not reversed. Give such a node a program that uses depth_glsl().

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <osg/Group>
#include <osg/Image>
#include <osg/Viewport>
#include <osg/ref_ptr>
#include <osgViewer/Viewer>
#include <string>

#include "graphics/context.h"
#include "graphics/quality.h"
#include "roam/math.h"

namespace roam::graphics {

/// How a requested picture is drawn. `full`: with Quality::full, whatever the quality of the frame. `as_shown`: with
/// the quality of the frame; it waits while frames are drawn with more for other requests.
enum class Finish : std::uint8_t { as_shown, full };

struct FrameSettings {
  double vertical_fov = 65.0;  ///< degrees, in [10, 150]
  /// Metres, in (0, 1000]. Nothing nearer is drawn. For a body of radius r to see every wall that it can touch, use
  /// near_limit(r, ...).
  double near = 0.05;
  /// Samples a pixel of Quality::full. Limited by the driver; 1 if it cannot give them.
  int samples = 4;
  Quality quality = Quality::full;
  bool reversed_depth = true;  ///< false: an ordinary depth buffer even if the driver supports a reversed one
};

/// When a frame was drawn, without waits for the screen.
struct FrameTimes {
  using Clock = std::chrono::steady_clock;
  Clock::duration waited{};   ///< at its begin, for the end of the frame before
  Clock::time_point drawn{};  ///< before the window takes the picture
};

/// A part of a picture that is larger than what is drawn at once. Pixels.
struct PicturePart {
  int whole_width = 0, whole_height = 0;
  int x = 0, y = 0;  ///< lower left corner
  int width = 0, height = 0;
};

/// The largest near plane, in metres, that cuts no wall at least `radius` metres from the eye. It is nearer than
/// `radius` because the corners of the picture are farther from the eye than its centre.
[[nodiscard]] double near_limit(double radius, double vertical_fov, double aspect);

/// Sets up `viewer` to draw to a context. All that it makes stays in the viewer, so a Frame may be destroyed before or
/// after it. Use it from the thread that calls viewer.frame(). The viewer may have any of OpenSceneGraph's threading
/// models.
class Frame {
 public:
  /// Takes over the viewer's camera (context, viewport, projection, clearing, draw callbacks, lighting) and its scene
  /// data (root()). Throws roam::Error for settings out of range. Call it before viewer.realize().
  Frame(osgViewer::Viewer& viewer, const Context& context, const FrameSettings& settings);
  ~Frame();
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  [[nodiscard]] osg::Group* root() const;
  [[nodiscard]] osg::Group* space() const;  ///< drawn in space: add the sky, the scene and the overlay here
  [[nodiscard]] osg::Camera* flat() const;  ///< drawn on the picture: pixels from the lower left corner
  [[nodiscard]] const Context& context() const;
  [[nodiscard]] int width() const;   ///< pixels; follows the window
  [[nodiscard]] int height() const;  ///< pixels; follows the window

  /// Takes effect with the next frame. The value as in FrameSettings; throws roam::Error.
  void set_near(double near);
  [[nodiscard]] double near() const;
  [[nodiscard]] double vertical_fov() const;

  /// Take effect with the next frame.
  void set_quality(Quality quality);
  void set_edges(bool shown);
  /// The frames from the next one on are timed: they wait until all is drawn, so they take a little longer.
  void set_timed(bool timed);
  /// The times of the last timed frame. They are known only if the thread that calls viewer.frame() also draws.
  [[nodiscard]] const FrameTimes& times() const;
  [[nodiscard]] Quality quality() const;
  /// The quality of the next frame, which is full if a full picture of it is requested.
  [[nodiscard]] Quality next_quality() const;
  [[nodiscard]] bool edges() const;

  /// The next frames draw this part of a picture of the same view, with the same vertical field of view, without
  /// flat(). Only requested pictures show it; the window keeps what it shows. None: they draw the window again. Events
  /// must wait for that.
  void set_part(const std::optional<PicturePart>& part);

  /// Whether the depth is reversed. If not, it is an ordinary 24-bit depth, with which distant surfaces flicker.
  [[nodiscard]] bool reversed_depth() const;
  /// Counts the draw calls of each frame from now on, which visits all that is drawn.
  void count_draw_calls();
  /// The draw calls of the last frame, if they are counted: the primitive sets of shadow maps, scene and head-up
  /// display, and one a pass of the effects. They are known only if the thread that calls viewer.frame() also draws.
  [[nodiscard]] int draw_calls() const;

  /// A sentence about effects and samples that the last frame lacks because the driver cannot give them; or empty.
  [[nodiscard]] std::string lack() const;
  /// One line: renderer, depth, samples, and missing abilities.
  [[nodiscard]] std::string describe() const;

  /// Requests the picture of the next frame: RGB, 8 bit, rows from the bottom as in osg::Image. With `with_hud` it
  /// includes flat(). Either `done` or `failed` is called, once, in the drawing thread. `failed` is called if the
  /// picture is too large for the driver; `reason` names a size that can be drawn.
  void request_picture(bool with_hud, std::function<void(osg::ref_ptr<osg::Image>)> done,
                       std::function<void(const std::string& reason)> failed = {}, Finish finish = Finish::as_shown);

 private:
  class Pipeline;
  void project();

  osg::ref_ptr<osg::Camera> camera_;
  Context context_;
  FrameSettings settings_;
  osg::ref_ptr<Pipeline> pipeline_;
  osg::ref_ptr<osg::Group> root_, space_;
  osg::ref_ptr<osg::Camera> flat_;
  std::optional<PicturePart> part_;
  osg::ref_ptr<osg::Viewport> window_;  ///< the viewport of the window while there is a part
};

/// GLSL 1.20 to put before a vertex shader for use below Frame::space(). `vec4 roam_clip(vec4 eye)` returns the
/// gl_Position of a point in eye coordinates.
[[nodiscard]] const char* depth_glsl();

}  // namespace roam::graphics
