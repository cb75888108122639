#pragma once
/// \file
/// The passes that make a picture of the drawn scene: ambient occlusion, edges, smoothing.
///
///     occlusion   half size   depth -> share of light, depth
///     blur        half size   the same, averaged over 4 x 4 pixels of one surface
///     mix         full size   colour, depth, occlusion -> colour
///     smooth      full size   colour -> colour
///
/// The depth texture holds near / distance, which is linear in the picture on every plane. So normals, creases and
/// steps follow from differences of neighbours, exactly. The alpha of the scene's colour is the share of the occlusion
/// and of the edges that a pixel takes: 1 for lit surfaces, 0 for photogrammetry and the sky.

#include <array>
#include <osg/GLExtensions>
#include <osg/Geometry>
#include <osg/Matrixd>
#include <osg/Program>
#include <osg/RenderInfo>
#include <osg/StateSet>
#include <osg/Uniform>
#include <osg/ref_ptr>
#include <vector>

#include "graphics/quality.h"

namespace roam::graphics {

/// A new texture without content, not smoothed except for 8-bit colours. Deletion is the caller's.
[[nodiscard]] GLuint make_texture(GLenum format, int width, int height);

/// Textures with one sample a pixel, and the framebuffer to draw to.
struct CompositeInput {
  GLuint color = 0, depth = 0, target = 0;
  osg::Matrixd projection{};
  bool reversed_depth = true;
  int whole_height = 0;  ///< pixels; larger than the textures for a part of a picture
};

/// Pixels around each pixel on which the effects depend, in a picture of this height.
[[nodiscard]] int effects_reach(int whole_height);
/// The pattern of the occlusion repeats after so many pixels.
inline constexpr int effects_period = 8;

/// Runs in the drawing thread.
class Composite {
 public:
  Composite();

  /// Makes the passes' own buffers. If the driver refuses, leaves none and returns false.
  bool resize(osg::GLExtensions& gl, int width, int height, const Effects& effects);
  [[nodiscard]] int passes() const { return 1 + (effects_.occlusion ? 2 : 0) + (effects_.smoothing ? 1 : 0); }
  /// Frees the buffers.
  void release(osg::GLExtensions& gl);
  /// Draws the picture. Leaves `target` bound, with the viewport of its whole size.
  void draw(osg::RenderInfo& info, const CompositeInput& input);

 private:
  /// A framebuffer object and its texture; 0 if there is none.
  struct Target {
    GLuint frame = 0, texture = 0;
    int width = 0, height = 0;
  };
  struct Pass {
    osg::ref_ptr<osg::StateSet> state;
    osg::ref_ptr<osg::Viewport> viewport;
  };

  static bool make(osg::GLExtensions& gl, Target& target, int width, int height, GLenum format);
  Pass make_pass(const char* name, const char* source, const std::vector<const char*>& textures) const;
  void run(osg::RenderInfo& info, const Pass& pass, GLuint target, std::array<int, 2> size,
           const std::vector<GLuint>& textures) const;

  int width_ = 0, height_ = 0;
  Effects effects_;
  Target occlusion_, blurred_, mixed_;
  osg::ref_ptr<osg::Geometry> cover_;
  osg::ref_ptr<osg::Uniform> size_, tangents_, shift_, depth_scale_, near_, reach_;
  Pass occlusion_pass_, blur_pass_, mix_pass_, smooth_pass_;
};

}  // namespace roam::graphics
