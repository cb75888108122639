#include "graphics/abilities.h"

#include <osg/GLExtensions>
#include <osg/State>

#include "roam/error.h"

namespace roam::graphics {
namespace {

/// All drawing needs shaders of GLSL 1.20 and framebuffer objects.
constexpr float least_version = 2.1f;

std::string text(GLenum name) {
  const GLubyte* words = glGetString(name);
  return words ? reinterpret_cast<const char*>(words) : "";
}

/// Whether this is one of Mesa's drivers without a graphics card.
bool is_software(const std::string& renderer) {
  for (const char* name : {"llvmpipe", "softpipe", "swrast", "Software Rasterizer"}) {
    if (renderer.find(name) != std::string::npos) return true;
  }
  return false;
}

/// Whether the driver accepts a framebuffer with this depth. Tries it, because some drivers claim formats that they
/// refuse.
bool takes_depth(osg::GLExtensions& gl, GLenum depth_format) {
  constexpr GLsizei size = 16;
  GLuint frame = 0;
  GLuint buffers[2] = {};
  gl.glGenFramebuffers(1, &frame);
  gl.glGenRenderbuffers(2, buffers);
  gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, frame);
  gl.glBindRenderbuffer(GL_RENDERBUFFER_EXT, buffers[0]);
  gl.glRenderbufferStorage(GL_RENDERBUFFER_EXT, GL_RGBA8, size, size);
  gl.glBindRenderbuffer(GL_RENDERBUFFER_EXT, buffers[1]);
  gl.glRenderbufferStorage(GL_RENDERBUFFER_EXT, depth_format, size, size);
  gl.glBindRenderbuffer(GL_RENDERBUFFER_EXT, 0);
  gl.glFramebufferRenderbuffer(GL_FRAMEBUFFER_EXT, GL_COLOR_ATTACHMENT0_EXT, GL_RENDERBUFFER_EXT, buffers[0]);
  gl.glFramebufferRenderbuffer(GL_FRAMEBUFFER_EXT, GL_DEPTH_ATTACHMENT_EXT, GL_RENDERBUFFER_EXT, buffers[1]);
  const bool complete = gl.glCheckFramebufferStatus(GL_FRAMEBUFFER_EXT) == GL_FRAMEBUFFER_COMPLETE_EXT;
  gl.glBindFramebuffer(GL_FRAMEBUFFER_EXT, 0);
  gl.glDeleteFramebuffers(1, &frame);
  gl.glDeleteRenderbuffers(2, buffers);
  return complete;
}

Abilities ask_current(osg::GraphicsContext& window) {
  Abilities abilities;
  abilities.renderer = text(GL_RENDERER);
  abilities.version = text(GL_VERSION);
  abilities.software = is_software(abilities.renderer);
  osg::GLExtensions& gl = *window.getState()->get<osg::GLExtensions>();
  const bool frames = gl.isFrameBufferObjectSupported && gl.glBlitFramebuffer != nullptr;
  if (gl.glVersion < least_version || !frames) {
    throw Error("the OpenGL here is too old: \"" + abilities.version + "\" of " + abilities.renderer +
                (frames ? "" : ", without framebuffer objects") +
                ". roam draws with OpenGL 2.1 with framebuffer objects and later: install the driver of the graphics "
                "card, or Mesa's (Debian: libgl1-mesa-dri)");
  }
  const unsigned id = window.getState()->getContextID();
  const bool clip_control =
      gl.glClipControl != nullptr && osg::isGLExtensionOrVersionSupported(id, "GL_ARB_clip_control", 4.5f);
  const bool float_depth = osg::isGLExtensionOrVersionSupported(id, "GL_ARB_depth_buffer_float", 3.0f);
  abilities.reversed_depth = clip_control && float_depth && takes_depth(gl, GL_DEPTH_COMPONENT32F);
  if (gl.isRenderbufferMultisampleSupported()) {
    GLint samples = 0;
    glGetIntegerv(GL_MAX_SAMPLES_EXT, &samples);
    abilities.samples = samples;
  }
  return abilities;
}

}  // namespace

Abilities ask_abilities(osg::GraphicsContext& window) {
  if (!window.makeCurrent()) throw Error("the graphics driver refused to draw to what it had opened");
  try {
    Abilities abilities = ask_current(window);
    window.releaseContext();
    return abilities;
  } catch (...) {
    window.releaseContext();
    throw;
  }
}

}  // namespace roam::graphics
