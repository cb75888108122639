#include "graphics/pipeline.h"

#include <algorithm>
#include <array>
#include <new>
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

/// The largest width and height that the driver can draw to, pixels.
std::array<int, 2> largest_sides() {
  GLint buffer = 0;
  std::array<GLint, 2> viewport{};
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE_EXT, &buffer);
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  return {std::min(buffer, viewport[0]), std::min(buffer, viewport[1])};
}

/// Clears errors of OpenGL, so that OpenSceneGraph does not report them again.
void forget_errors() {
  constexpr int most = 8;  // a lost context reports errors without end
  for (int i = 0; i < most && glGetError() != GL_NO_ERROR; ++i) continue;
}

osg::GLExtensions& functions(osg::RenderInfo& info) { return *info.getState()->get<osg::GLExtensions>(); }

}  // namespace

void Frame::Pipeline::attach(osg::Camera& camera) {
  // The buffers bound below are no window, so OpenSceneGraph must not use its back buffer.
  camera.setDrawBuffer(GL_COLOR_ATTACHMENT0_EXT);
  camera.setReadBuffer(GL_COLOR_ATTACHMENT0_EXT);
  camera.setPreDrawCallback(callback(this, [this](osg::RenderInfo& info) { begin(info); }));
  camera.setPostDrawCallback(callback(this, [this](osg::RenderInfo& info) { resolve(info); }));
  camera.setFinalDrawCallback(callback(this, [this](osg::RenderInfo& info) { finish(info); }));
}

void Frame::Pipeline::request(bool with_hud, Finish finish, Done done, Failed failed) {
  const std::lock_guard lock(mutex_);
  requests_.push_back({with_hud, finish, std::move(done), std::move(failed)});
}

void Frame::Pipeline::begin(osg::RenderInfo& info) {
  if (timed_) {
    const auto before = FrameTimes::Clock::now();
    glFinish();
    times_.waited = FrameTimes::Clock::now() - before;
  }
  osg::GLExtensions& gl = functions(info);
  const osg::Viewport& viewport = *info.getCurrentCamera()->getViewport();
  const int width = std::max(1, static_cast<int>(viewport.width()));
  const int height = std::max(1, static_cast<int>(viewport.height()));
  const Plan plan = plan_for(width, height);
  if (plan != wished_) {
    osg::State& state = *info.getState();
    state.setActiveTextureUnit(0);
    resize(gl, plan);
    // Making textures has bound others.
    state.haveAppliedTextureAttribute(0, osg::StateAttribute::TEXTURE);
  }
  gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, scene_.frame);
}

void Frame::Pipeline::resolve(osg::RenderInfo& info) {
  osg::GLExtensions& gl = functions(info);
  info.getState()->applyMode(GL_SCISSOR_TEST, false);
  const bool effects = plan_.effects.any();
  if (flat_scene_.frame != scene_.frame) {
    gl.glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, scene_.frame);
    gl.glBindFramebuffer(GL_DRAW_FRAMEBUFFER_EXT, flat_scene_.frame);
    const GLbitfield depth = effects ? GL_DEPTH_BUFFER_BIT : 0u;
    gl.glBlitFramebuffer(0, 0, plan_.width, plan_.height, 0, 0, plan_.width, plan_.height, GL_COLOR_BUFFER_BIT | depth,
                         GL_NEAREST);
  }
  if (effects) {
    const osg::Matrixd& projection = info.getCurrentCamera()->getProjectionMatrix();
    const int whole_height = whole_height_;
    composite_.draw(info, {flat_scene_.color, flat_scene_.depth, picture_.frame, projection, reversed_depth_,
                           whole_height > 0 ? whole_height : plan_.height});
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
  if (timed_) {
    // The window's own buffer may not be free before the screen has shown the last picture.
    glFinish();
    times_.drawn = FrameTimes::Clock::now();
  }
  if (problem_.empty() && whole_height_ == 0) {
    gl.glBindFramebuffer(GL_READ_FRAMEBUFFER_EXT, picture_.frame);
    gl.glBindFramebuffer(GL_DRAW_FRAMEBUFFER_EXT, window.getDefaultFboId());
    state.glDrawBuffer(window.getTraits()->doubleBuffer ? GL_BACK : GL_FRONT);
    gl.glBlitFramebuffer(0, 0, plan_.width, plan_.height, 0, 0, plan_.width, plan_.height, GL_COLOR_BUFFER_BIT,
                         GL_NEAREST);
  }
  gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, window.getDefaultFboId());
}

bool Frame::Pipeline::is_full_requested() {
  const std::lock_guard lock(mutex_);
  return std::any_of(requests_.begin(), requests_.end(), [](const Request& r) { return r.finish == Finish::full; });
}

Quality Frame::Pipeline::next_quality() { return is_full_requested() ? Quality::full : quality_.load(); }

Frame::Pipeline::Plan Frame::Pipeline::plan_for(int width, int height) {
  fully_ = is_full_requested();
  const Quality quality = fully_ ? Quality::full : quality_.load();
  Plan plan{width, height, quality == Quality::full ? std::max(wished_samples_, 1) : 1, {}};
  if (quality == Quality::full) plan.effects = full_effects;
  if (quality == Quality::light) plan.effects = light_effects;
  if (!edges_) plan.effects.edges = false;
  return plan;
}

void Frame::Pipeline::resize(osg::GLExtensions& gl, const Plan& plan) {
  wished_ = plan;
  problem_.clear();
  const auto [widest, highest] = largest_sides();
  const bool within = plan.width <= widest && plan.height <= highest;
  const std::array<Plan, 4> plans{plan,
                                  {plan.width, plan.height, 1, plan.effects},
                                  {plan.width, plan.height, plan.samples, {}},
                                  {plan.width, plan.height, 1, {}}};
  for (auto next = plans.begin(); next != plans.end(); ++next) {
    samples_ = next->samples;
    lacks_samples_ = next->samples < plan.samples;
    lacks_effects_ = next->effects != plan.effects;
    const bool tried = std::find(plans.begin(), next, *next) != next;
    if (within && !tried && allocate(gl, *next)) return;
  }
  problem_ = refuse(gl);
  // OpenSceneGraph draws in any case, so give it one invisible pixel.
  allocate(gl, {1, 1, 1, {}});
  // A program without a screen gets the message with the picture that it requests.
  if (!headless_) OSG_WARN << "The picture cannot be drawn: " << problem_ << ".\n";
}

std::string Frame::Pipeline::refuse(osg::GLExtensions& gl) {
  const auto text = [](int width, int height, const char* times) {
    return std::to_string(width) + times + std::to_string(height);
  };
  const std::string refusal =
      text(wished_.width, wished_.height, " x ") + " pixels are too many for this graphics driver";
  constexpr double smaller = 0.7;  // half the pixels
  const auto [widest, highest] = largest_sides();
  double scale =
      std::min({1.0, static_cast<double>(widest) / wished_.width, static_cast<double>(highest) / wished_.height});
  for (;; scale *= smaller) {
    const int width = static_cast<int>(scale * wished_.width), height = static_cast<int>(scale * wished_.height);
    if (width < 1 || height < 1) return refusal;
    if (!allocate(gl, {width, height, 1, {}})) continue;
    if (headless_)
      return refusal + ". " + text(width, height, " x ") + " can be drawn: --size " + text(width, height, "x");
    return refusal + ". Make the window smaller: " + text(width, height, " x ") + " can be drawn";
  }
}

bool Frame::Pipeline::allocate(osg::GLExtensions& gl, const Plan& plan) {
  release(gl);
  plan_ = plan;
  bool complete = make(gl, scene_, plan, Depth::kept);
  const Plan flat{plan.width, plan.height, 1, plan.effects};
  if (plan.samples > 1) {
    complete = complete && make(gl, flat_scene_, flat, plan.effects.any() ? Depth::kept : Depth::none);
  } else {
    flat_scene_ = scene_;
  }
  if (plan.effects.any()) {
    complete = complete && make(gl, picture_, {plan.width, plan.height, 1, {}}, Depth::none) &&
               composite_.resize(gl, plan.width, plan.height, plan.effects);
  } else {
    picture_ = flat_scene_;
  }
  if (complete) return true;
  release(gl);
  forget_errors();
  return false;
}

bool Frame::Pipeline::make(osg::GLExtensions& gl, Buffers& buffers, const Plan& plan, Depth depth) const {
  // Effects read textures.
  buffers.textures = plan.samples == 1 && plan.effects.any();
  const auto attach = [&](GLuint& buffer, GLenum where, GLenum format) {
    if (buffers.textures) {
      buffer = make_texture(format, plan.width, plan.height);
      gl.glFramebufferTexture2D(GL_FRAMEBUFFER_EXT, where, GL_TEXTURE_2D, buffer, 0);
      return;
    }
    gl.glGenRenderbuffers(1, &buffer);
    gl.glBindRenderbuffer(GL_RENDERBUFFER_EXT, buffer);
    if (plan.samples > 1) {
      gl.glRenderbufferStorageMultisample(GL_RENDERBUFFER_EXT, plan.samples, format, plan.width, plan.height);
    } else {
      gl.glRenderbufferStorage(GL_RENDERBUFFER_EXT, format, plan.width, plan.height);
    }
    gl.glFramebufferRenderbuffer(GL_FRAMEBUFFER_EXT, where, GL_RENDERBUFFER_EXT, buffer);
  };
  gl.glGenFramebuffers(1, &buffers.frame);
  gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, buffers.frame);
  attach(buffers.color, GL_COLOR_ATTACHMENT0_EXT, GL_RGBA8);
  if (depth == Depth::kept) {
    attach(buffers.depth, GL_DEPTH_ATTACHMENT_EXT, reversed_depth_ ? GL_DEPTH_COMPONENT32F : GL_DEPTH_COMPONENT24);
  }
  gl.glBindRenderbuffer(GL_RENDERBUFFER_EXT, 0);
  return gl.glCheckFramebufferStatus(GL_FRAMEBUFFER_EXT) == GL_FRAMEBUFFER_COMPLETE_EXT;
}

void Frame::Pipeline::release(osg::GLExtensions& gl) {
  composite_.release(gl);
  if (picture_.frame == flat_scene_.frame) picture_ = {};
  if (flat_scene_.frame == scene_.frame) flat_scene_ = {};
  for (Buffers* buffers : {&scene_, &flat_scene_, &picture_}) {
    // OpenGL ignores zeros.
    gl.glDeleteFramebuffers(1, &buffers->frame);
    for (GLuint* buffer : {&buffers->color, &buffers->depth}) {
      if (buffers->textures) {
        glDeleteTextures(1, buffer);
      } else {
        gl.glDeleteRenderbuffers(1, buffer);
      }
    }
    *buffers = {};
  }
}

void Frame::Pipeline::serve(bool with_hud) {
  std::vector<Request> served;
  {
    const std::lock_guard lock(mutex_);
    const auto rest = std::stable_partition(requests_.begin(), requests_.end(), [&](const Request& r) {
      // A request that came after the frame began waits for the next; a film waits while stills are drawn.
      const bool later = r.finish == Finish::full ? !fully_ : fully_ && quality_ != Quality::full;
      return r.with_hud != with_hud || later;
    });
    served.assign(std::make_move_iterator(rest), std::make_move_iterator(requests_.end()));
    requests_.erase(rest, requests_.end());
  }
  if (served.empty()) return;
  std::string problem = problem_;
  osg::ref_ptr<osg::Image> image = new osg::Image;
  try {
    if (problem.empty()) image->readPixels(0, 0, plan_.width, plan_.height, GL_RGB, GL_UNSIGNED_BYTE);
  } catch (const std::bad_alloc&) {
    problem = "there is no memory for its pixels";
  }
  for (const Request& request : served) {
    if (problem.empty()) {
      request.done(image);
    } else if (request.failed) {
      request.failed(problem);
    }
  }
}

}  // namespace roam::graphics
