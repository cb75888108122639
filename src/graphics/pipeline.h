#pragma once
/// \file
/// The buffers of a Frame, and what happens to them while OpenGL draws.

#include <atomic>
#include <functional>
#include <mutex>
#include <osg/Camera>
#include <osg/GLExtensions>
#include <osg/Image>
#include <osg/Referenced>
#include <string>
#include <vector>

#include "graphics/frame.h"

namespace roam::graphics {

/// Runs in the thread that draws, as callbacks of the viewer's camera: begin before the scene is drawn, resolve after
/// it, finish after everything that lies over it. The buffers follow the camera's viewport by themselves. Where the
/// driver has no room for the samples, there is one a pixel; where it has none for that, nothing is drawn and all
/// requests fail.
class Frame::Pipeline : public osg::Referenced {
 public:
  /// `headless`: only the advice in messages depends on it.
  Pipeline(bool reversed_depth, int samples, bool headless)
      : reversed_depth_(reversed_depth), headless_(headless), wished_samples_(samples), samples_(samples) {}

  /// Makes `camera` draw through this.
  void attach(osg::Camera& camera);

  [[nodiscard]] bool reversed_depth() const { return reversed_depth_; }
  [[nodiscard]] int wished_samples() const { return wished_samples_; }
  /// In the last frame that was drawn. From any thread.
  [[nodiscard]] int samples() const { return samples_; }

  using Done = std::function<void(osg::ref_ptr<osg::Image>)>;
  using Failed = std::function<void(const std::string&)>;
  /// May be called from any thread.
  void request(bool with_hud, Done done, Failed failed);

 private:
  /// A framebuffer object and what is attached to it; 0 where it is not.
  struct Buffers {
    GLuint frame = 0;
    GLuint color = 0;
    GLuint depth = 0;
  };
  struct Request {
    bool with_hud;
    Done done;
    Failed failed;
  };

  void begin(osg::RenderInfo& info);
  void resolve(osg::RenderInfo& info);
  void finish(osg::RenderInfo& info);

  void resize(osg::GLExtensions& gl, int width, int height);
  /// Makes all buffers anew; false, and none, where the driver refuses.
  bool allocate(osg::GLExtensions& gl, int width, int height, int samples);
  bool make(osg::GLExtensions& gl, Buffers& buffers, int width, int height, int samples, bool with_depth) const;
  void release(osg::GLExtensions& gl);
  /// Says that nothing can be drawn in this size, and in which it can.
  std::string refuse(osg::GLExtensions& gl);
  void serve(bool with_hud);

  const bool reversed_depth_, headless_;
  const int wished_samples_;
  std::atomic<int> samples_;
  int width_ = 0, height_ = 0;
  std::string problem_;  // why nothing can be drawn; empty: it can
  Buffers scene_;        // several samples a pixel, and the depth
  Buffers picture_;      // one sample a pixel; the same as scene_ where that has no more
  std::mutex mutex_;
  std::vector<Request> requests_;
};

}  // namespace roam::graphics
