#include "graphics/composite.h"

#include <algorithm>
#include <cmath>
#include <osg/State>
#include <osg/Texture>
#include <osg/Viewport>
#include <string>

#include "graphics/composite_shaders.h"

namespace roam::graphics {
namespace {

/// The farthest neighbour that occludes a pixel: in pixels, and as a share of the picture's height.
constexpr double most_reach = 696.0, reach_share = 0.16;

float occlusion_reach(int whole_height) { return static_cast<float>(std::min(reach_share * whole_height, most_reach)); }

osg::ref_ptr<osg::Geometry> make_cover() {
  osg::ref_ptr<osg::Geometry> cover = new osg::Geometry;
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
  for (const auto& [x, y] : {std::pair{-1.0f, -1.0f}, std::pair{3.0f, -1.0f}, std::pair{-1.0f, 3.0f}}) {
    corners->push_back(osg::Vec3(x, y, 0));
  }
  cover->setVertexArray(corners);
  cover->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
  cover->setUseDisplayList(false);
  cover->setUseVertexBufferObjects(true);
  return cover;
}

}  // namespace

GLuint make_texture(GLenum format, int width, int height) {
  const bool depth = format == GL_DEPTH_COMPONENT32F || format == GL_DEPTH_COMPONENT24;
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  const GLint filter = format == GL_RGBA8 ? GL_LINEAR : GL_NEAREST;
  for (const GLenum which : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) {
    glTexParameteri(GL_TEXTURE_2D, which, filter);
  }
  for (const GLenum which : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T}) {
    glTexParameteri(GL_TEXTURE_2D, which, GL_CLAMP_TO_EDGE);
  }
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0, depth ? GL_DEPTH_COMPONENT : GL_RGBA,
               depth ? GL_FLOAT : GL_UNSIGNED_BYTE, nullptr);
  glBindTexture(GL_TEXTURE_2D, 0);
  return texture;
}

int effects_reach(int whole_height) {
  // Blurring and mixing add six pixels, smoothing four, and rounding to pixels of half size the rest.
  constexpr int around = 16;
  return static_cast<int>(std::ceil(occlusion_reach(whole_height))) + around;
}

Composite::Composite()
    : cover_(make_cover()),
      size_(new osg::Uniform("roam_size", osg::Vec2())),
      tangents_(new osg::Uniform("roam_tangents", osg::Vec2())),
      shift_(new osg::Uniform("roam_shift", osg::Vec2())),
      depth_scale_(new osg::Uniform("roam_depth_scale", osg::Vec2())),
      near_(new osg::Uniform("roam_near", 0.0f)),
      reach_(new osg::Uniform("roam_reach", 0.0f)) {
  occlusion_pass_ = make_pass("occlusion", occlusion_glsl, {"roam_depth"});
  blur_pass_ = make_pass("blur", blur_glsl, {"roam_occlusion"});
  mix_pass_ = make_pass("mix", mix_glsl, {"roam_color", "roam_depth", "roam_occlusion"});
  smooth_pass_ = make_pass("smooth", smooth_glsl, {"roam_color"});
}

Composite::Pass Composite::make_pass(const char* name, const char* source,
                                     const std::vector<const char*>& textures) const {
  Pass pass{new osg::StateSet, new osg::Viewport};
  const osg::ref_ptr<osg::Program> program = new osg::Program;
  program->setName(std::string("roam ") + name);
  program->addShader(new osg::Shader(osg::Shader::VERTEX, cover_vertex_glsl));
  program->addShader(new osg::Shader(osg::Shader::FRAGMENT, std::string(picture_glsl) + source));
  pass.state->setAttributeAndModes(program);
  pass.state->setAttribute(pass.viewport);
  for (const GLenum mode : {GL_DEPTH_TEST, GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST}) {
    pass.state->setMode(mode, osg::StateAttribute::OFF);
  }
  for (const auto& uniform : {size_, tangents_, shift_, depth_scale_, near_, reach_}) pass.state->addUniform(uniform);
  for (std::size_t i = 0; i < textures.size(); ++i) {
    pass.state->addUniform(new osg::Uniform(textures[i], static_cast<int>(i)));
  }
  return pass;
}

bool Composite::make(osg::GLExtensions& gl, Target& target, int width, int height, GLenum format) {
  target.width = width;
  target.height = height;
  target.texture = make_texture(format, width, height);
  gl.glGenFramebuffers(1, &target.frame);
  gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, target.frame);
  gl.glFramebufferTexture2D(GL_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT, GL_TEXTURE_2D, target.texture, 0);
  return gl.glCheckFramebufferStatus(GL_FRAMEBUFFER_EXT) == GL_FRAMEBUFFER_COMPLETE_EXT;
}

bool Composite::resize(osg::GLExtensions& gl, int width, int height, const Effects& effects) {
  release(gl);
  width_ = width;
  height_ = height;
  effects_ = effects;
  const int half_width = (width + 1) / 2, half_height = (height + 1) / 2;
  bool complete = true;
  if (effects.occlusion) {
    complete = make(gl, occlusion_, half_width, half_height, GL_RG32F) &&
               make(gl, blurred_, half_width, half_height, GL_RG32F);
  }
  if (effects.smoothing) complete = complete && make(gl, mixed_, width, height, GL_RGBA8);
  osg::StateSet& mix = *mix_pass_.state;
  const auto define = [&](const char* name, bool on) { on ? mix.setDefine(name) : mix.removeDefine(name); };
  define("ROAM_OCCLUSION", effects.occlusion);
  define("ROAM_EDGES", effects.edges);
  define("ROAM_SMOOTHING", effects.smoothing);
  if (!complete) release(gl);
  return complete;
}

void Composite::release(osg::GLExtensions& gl) {
  for (Target* target : {&occlusion_, &blurred_, &mixed_}) {
    gl.glDeleteFramebuffers(1, &target->frame);
    glDeleteTextures(1, &target->texture);
    *target = {};
  }
}

void Composite::draw(osg::RenderInfo& info, const CompositeInput& input) {
  double left = 0.0, right = 0.0, bottom = 0.0, top = 0.0, near = 0.0, far = 0.0;
  input.projection.getFrustum(left, right, bottom, top, near, far);
  size_->set(osg::Vec2(static_cast<float>(width_), static_cast<float>(height_)));
  tangents_->set(
      osg::Vec2(static_cast<float>(1.0 / input.projection(0, 0)), static_cast<float>(1.0 / input.projection(1, 1))));
  shift_->set(osg::Vec2(static_cast<float>(input.projection(2, 0)), static_cast<float>(input.projection(2, 1))));
  reach_->set(occlusion_reach(input.whole_height));
  depth_scale_->set(input.reversed_depth ? osg::Vec2(0, 1) : osg::Vec2(1, static_cast<float>(near / far - 1.0)));
  near_->set(static_cast<float>(near));

  const std::array<int, 2> size{width_, height_}, half{occlusion_.width, occlusion_.height};
  if (effects_.occlusion) {
    run(info, occlusion_pass_, occlusion_.frame, half, {input.depth});
    run(info, blur_pass_, blurred_.frame, half, {occlusion_.texture});
  }
  const GLuint mixed = effects_.smoothing ? mixed_.frame : input.target;
  run(info, mix_pass_, mixed, size, {input.color, input.depth, blurred_.texture});
  if (effects_.smoothing) run(info, smooth_pass_, input.target, size, {mixed_.texture});
}

void Composite::run(osg::RenderInfo& info, const Pass& pass, GLuint target, std::array<int, 2> size,
                    const std::vector<GLuint>& textures) const {
  osg::State& state = *info.getState();
  state.get<osg::GLExtensions>()->glBindFramebuffer(GL_FRAMEBUFFER_EXT, target);
  pass.viewport->setViewport(0, 0, size[0], size[1]);
  state.haveAppliedAttribute(osg::StateAttribute::VIEWPORT);
  state.apply(pass.state);
  for (unsigned unit = 0; unit < textures.size(); ++unit) {
    state.setActiveTextureUnit(unit);
    glBindTexture(GL_TEXTURE_2D, textures[unit]);
    state.haveAppliedTextureAttribute(unit, osg::StateAttribute::TEXTURE);
  }
  cover_->draw(info);
}

}  // namespace roam::graphics
