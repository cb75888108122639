#include "graphics/pipeline.h"

#include <algorithm>
#include <osg/GraphicsContext>
#include <osg/Notify>
#include <osg/RenderInfo>
#include <osg/State>
#include <utility>

namespace roam::graphics {
namespace {

/// Calls one of the pipeline's steps, and keeps the pipeline alive as long as the camera.
template <class Step>
class StepCallback : public osg::Camera::DrawCallback {
 public:
  StepCallback(osg::ref_ptr<osg::Referenced> owner, Step step) : owner_(std::move(owner)), step_(step) {}
  void operator()(osg::RenderInfo& info) const override { step_(info); }

 private:
  osg::ref_ptr<osg::Referenced> owner_;
  Step step_;
};

template <class Step>
osg::ref_ptr<osg::Camera::DrawCallback> callback(osg::Referenced* owner, Step step) {
  return new StepCallback<Step>(owner, step);
}

osg::GLExtensions& functions(osg::RenderInfo& info) { return *info.getState()->get<osg::GLExtensions>(); }

}  // namespace

void Frame::Pipeline::attach(osg::Camera& camera) {
  // What is bound below is no window: OpenSceneGraph must not ask for its back buffer.
  camera.setDrawBuffer(GL_COLOR_ATTACHMENT0_EXT);
  camera.setReadBuffer(GL_COLOR_ATTACHMENT0_EXT);
  camera.setPreDrawCallback(callback(this, [this](osg::RenderInfo& info) { begin(info); }));
  camera.setPostDrawCallback(callback(this, [this](osg::RenderInfo& info) { resolve(info); }));
  camera.setFinalDrawCallback(callback(this, [this](osg::RenderInfo& info) { finish(info); }));
}

void Frame::Pipeline::request(bool with_display, Done done) {
  const std::lock_guard lock(mutex_);
  requests_.push_back({with_display, std::move(done)});
}

void Frame::Pipeline::begin(osg::RenderInfo& info) {
  osg::GLExtensions& gl = functions(info);
  const osg::Viewport& viewport = *info.getCurrentCamera()->getViewport();
  const int width = std::max(1, static_cast<int>(viewport.width()));
  const int height = std::max(1, static_cast<int>(viewport.height()));
  if (width != width_ || height != height_) resize(gl, width, height);
  gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, scene_.frame);
}

void Frame::Pipeline::resolve(osg::RenderInfo& info) {
  osg::GLExtensions& gl = functions(info);
  info.getState()->applyMode(GL_SCISSOR_TEST, false);
  if (picture_.frame != scene_.frame) {
    gl.glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, scene_.frame);
    gl.glBindFramebuffer(GL_DRAW_FRAMEBUFFER_EXT, picture_.frame);
    gl.glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, picture_.frame);
  serve(false);
}

void Frame::Pipeline::finish(osg::RenderInfo& info) {
  osg::GLExtensions& gl = functions(info);
  osg::State& state = *info.getState();
  const osg::GraphicsContext& window = *state.getGraphicsContext();
  state.applyMode(GL_SCISSOR_TEST, false);
  serve(true);
  gl.glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, picture_.frame);
  gl.glBindFramebuffer(GL_DRAW_FRAMEBUFFER_EXT, window.getDefaultFboId());
  state.glDrawBuffer(window.getTraits()->doubleBuffer ? GL_BACK : GL_FRONT);
  gl.glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, window.getDefaultFboId());
}

void Frame::Pipeline::resize(osg::GLExtensions& gl, int width, int height) {
  release(gl, scene_);
  if (samples_ > 1) release(gl, picture_);
  width_ = width;
  height_ = height;
  bool complete = allocate(gl, scene_, samples_, true);
  if (samples_ > 1) {
    complete = allocate(gl, picture_, 0, false) && complete;
  } else {
    picture_ = scene_;
  }
  if (!complete) {
    OSG_WARN << "The graphics card has no room for a picture of " << width << " x " << height << " pixels with "
             << std::max(1, samples_) << " samples each. Choose a smaller window or fewer samples.\n";
  }
}

bool Frame::Pipeline::allocate(osg::GLExtensions& gl, Buffers& buffers, int samples, bool with_depth) const {
  const auto attach = [&](GLuint& buffer, GLenum where, GLenum format) {
    gl.glGenRenderbuffers(1, &buffer);
    gl.glBindRenderbuffer(GL_RENDERBUFFER_EXT, buffer);
    if (samples > 1) {
      gl.glRenderbufferStorageMultisample(GL_RENDERBUFFER_EXT, samples, format, width_, height_);
    } else {
      gl.glRenderbufferStorage(GL_RENDERBUFFER_EXT, format, width_, height_);
    }
    gl.glFramebufferRenderbuffer(GL_FRAMEBUFFER_EXT, where, GL_RENDERBUFFER_EXT, buffer);
  };
  gl.glGenFramebuffers(1, &buffers.frame);
  gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, buffers.frame);
  attach(buffers.color, GL_COLOR_ATTACHMENT0_EXT, GL_RGBA8);
  if (with_depth) {
    attach(buffers.depth, GL_DEPTH_ATTACHMENT_EXT, reversed_depth_ ? GL_DEPTH_COMPONENT32F : GL_DEPTH_COMPONENT24);
  }
  gl.glBindRenderbuffer(GL_RENDERBUFFER_EXT, 0);
  return gl.glCheckFramebufferStatus(GL_FRAMEBUFFER_EXT) == GL_FRAMEBUFFER_COMPLETE_EXT;
}

void Frame::Pipeline::release(osg::GLExtensions& gl, Buffers& buffers) {
  // Zeros are passed over by OpenGL.
  gl.glDeleteFramebuffers(1, &buffers.frame);
  gl.glDeleteRenderbuffers(1, &buffers.color);
  gl.glDeleteRenderbuffers(1, &buffers.depth);
  buffers = {};
}

void Frame::Pipeline::serve(bool with_display) {
  std::vector<Request> served;
  {
    const std::lock_guard lock(mutex_);
    const auto rest = std::stable_partition(requests_.begin(), requests_.end(),
                                            [&](const Request& r) { return r.with_display != with_display; });
    served.assign(std::make_move_iterator(rest), std::make_move_iterator(requests_.end()));
    requests_.erase(rest, requests_.end());
  }
  if (served.empty()) return;
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->readPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE);
  for (const Request& request : served) request.done(image);
}

}  // namespace roam::graphics
