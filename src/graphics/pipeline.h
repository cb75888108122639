#pragma once
/// \file
/// The buffers of a Frame, and what happens to them while OpenGL draws.

#include <functional>
#include <mutex>
#include <osg/Camera>
#include <osg/GLExtensions>
#include <osg/Image>
#include <osg/Referenced>
#include <vector>

#include "graphics/frame.h"

namespace roam::graphics {

/// Runs in the thread that draws, as callbacks of the viewer's camera: begin before the scene is drawn, resolve after
/// it, finish after everything that lies over it. The buffers follow the camera's viewport by themselves.
class Frame::Pipeline : public osg::Referenced {
 public:
  Pipeline(bool reversed_depth, int samples) : reversed_depth_(reversed_depth), samples_(samples) {}

  /// Makes `camera` draw through this.
  void attach(osg::Camera& camera);

  [[nodiscard]] bool reversed_depth() const { return reversed_depth_; }
  [[nodiscard]] int samples() const { return samples_; }

  using Done = std::function<void(osg::ref_ptr<osg::Image>)>;
  /// May be called from any thread.
  void request(bool with_display, Done done);

 private:
  /// A framebuffer object and what is attached to it; 0 where it is not.
  struct Buffers {
    GLuint frame = 0;
    GLuint color = 0;
    GLuint depth = 0;
  };
  struct Request {
    bool with_display;
    Done done;
  };

  void begin(osg::RenderInfo& info);
  void resolve(osg::RenderInfo& info);
  void finish(osg::RenderInfo& info);

  void resize(osg::GLExtensions& gl, int width, int height);
  bool allocate(osg::GLExtensions& gl, Buffers& buffers, int samples, bool with_depth) const;
  static void release(osg::GLExtensions& gl, Buffers& buffers);
  void serve(bool with_display);

  const bool reversed_depth_;
  const int samples_;
  int width_ = 0, height_ = 0;
  Buffers scene_;    // several samples a pixel, and the depth
  Buffers picture_;  // one sample a pixel; the same as scene_ where that has no more
  std::mutex mutex_;
  std::vector<Request> requests_;
};

}  // namespace roam::graphics
