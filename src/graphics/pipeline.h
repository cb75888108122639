#pragma once
/// \file
/// The buffers of a Frame, and their use during drawing.

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

/// Runs in the drawing thread, as callbacks of the viewer's camera: begin before the scene is drawn, resolve after it,
/// and finish after everything that lies over it. The buffers follow the camera's viewport. If the driver has no memory
/// for the samples, there is one sample a pixel. If it has none for that either, nothing is drawn and all requests
/// fail.
class Frame::Pipeline : public osg::Referenced {
 public:
  /// `headless` only affects the advice in messages.
  Pipeline(bool reversed_depth, int samples, bool headless)
      : reversed_depth_(reversed_depth), headless_(headless), wished_samples_(samples), samples_(samples) {}

  /// Makes `camera` draw through this pipeline.
  void attach(osg::Camera& camera);

  [[nodiscard]] bool reversed_depth() const { return reversed_depth_; }
  [[nodiscard]] int wished_samples() const { return wished_samples_; }
  /// Samples of the last frame. Any thread.
  [[nodiscard]] int samples() const { return samples_; }

  using Done = std::function<void(osg::ref_ptr<osg::Image>)>;
  using Failed = std::function<void(const std::string&)>;
  /// Any thread.
  void request(bool with_hud, Done done, Failed failed);

 private:
  /// A framebuffer object and its attachments; 0 for those that it does not have.
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
  /// Makes all buffers anew. If the driver refuses, leaves none and returns false.
  bool allocate(osg::GLExtensions& gl, int width, int height, int samples);
  bool make(osg::GLExtensions& gl, Buffers& buffers, int width, int height, int samples, bool with_depth) const;
  void release(osg::GLExtensions& gl);
  /// The message that this size cannot be drawn, with a size that can.
  std::string refuse(osg::GLExtensions& gl);
  void serve(bool with_hud);

  const bool reversed_depth_, headless_;
  const int wished_samples_;
  std::atomic<int> samples_;
  int width_ = 0, height_ = 0;
  std::string problem_;  // why nothing can be drawn; empty if it can
  Buffers scene_;        // several samples a pixel, and the depth
  Buffers picture_;      // one sample a pixel; equal to scene_ if that has one too
  std::mutex mutex_;
  std::vector<Request> requests_;
};

}  // namespace roam::graphics
