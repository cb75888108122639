#pragma once
/// \file
/// The buffers of a Frame, and their use during drawing.

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <osg/Camera>
#include <osg/GLExtensions>
#include <osg/Image>
#include <osg/Referenced>
#include <string>
#include <vector>

#include "graphics/composite.h"
#include "graphics/frame.h"

namespace roam::graphics {

/// Runs in the drawing thread, as callbacks of the viewer's camera: begin before the scene is drawn, resolve after it,
/// and finish after everything that lies over it. The buffers follow the camera's viewport and the quality. If the
/// driver cannot give the samples, there is one a pixel; if it cannot give the effects either, there are none; if it
/// cannot give even that, nothing is drawn and all requests fail.
class Frame::Pipeline : public osg::Referenced {
 public:
  /// `headless` only affects the advice in messages.
  Pipeline(bool reversed_depth, int samples, Quality quality, bool headless)
      : reversed_depth_(reversed_depth),
        headless_(headless),
        wished_samples_(samples),
        samples_(samples),
        quality_(quality) {}

  /// Makes `camera` draw through this pipeline.
  void attach(osg::Camera& camera);

  [[nodiscard]] bool reversed_depth() const { return reversed_depth_; }
  [[nodiscard]] int wished_samples() const { return wished_samples_; }
  /// Samples of the last frame. Any thread.
  [[nodiscard]] int samples() const { return samples_; }
  /// Whether the driver cannot give what the last frame should have had. Any thread.
  [[nodiscard]] bool lacks_samples() const { return lacks_samples_; }
  [[nodiscard]] bool lacks_effects() const { return lacks_effects_; }
  /// Any thread. Takes effect with the next frame.
  void set_quality(Quality quality) { quality_ = quality; }
  void set_edges(bool shown) { edges_ = shown; }
  /// The height of the picture of which the next frames draw parts that no window shows; 0: they draw it whole.
  void set_whole_height(int pixels) { whole_height_ = pixels; }
  [[nodiscard]] Quality quality() const { return quality_; }
  [[nodiscard]] bool edges() const { return edges_; }
  void set_timed(bool timed) { timed_ = timed; }
  /// The times of the last timed frame. Call it from the drawing thread.
  [[nodiscard]] const FrameTimes& times() const { return times_; }
  /// The quality of the next frame: full if a full picture is requested. Any thread.
  [[nodiscard]] Quality next_quality();

  /// Of the last frame's effects. Call it from the drawing thread.
  [[nodiscard]] int passes() const { return plan_.effects.any() ? composite_.passes() : 0; }

  using Done = std::function<void(osg::ref_ptr<osg::Image>)>;
  using Failed = std::function<void(const std::string&)>;
  /// Any thread.
  void request(bool with_hud, Finish finish, Done done, Failed failed);

 private:
  /// A framebuffer object and its attachments; 0 for those that it does not have.
  struct Buffers {
    GLuint frame = 0;
    GLuint color = 0;
    GLuint depth = 0;
    bool textures = false;
  };
  /// What decides on the buffers.
  struct Plan {
    int width = 0, height = 0, samples = 1;
    Effects effects;
    bool operator==(const Plan&) const = default;
  };
  enum class Depth : std::uint8_t { none, kept };
  struct Request {
    bool with_hud;
    Finish finish;
    Done done;
    Failed failed;
  };

  void begin(osg::RenderInfo& info);
  void resolve(osg::RenderInfo& info);
  void finish(osg::RenderInfo& info);

  [[nodiscard]] bool is_full_requested();
  /// The plan of this frame.
  [[nodiscard]] Plan plan_for(int width, int height);
  void resize(osg::GLExtensions& gl, const Plan& plan);
  /// Makes all buffers anew. If the driver refuses, leaves none and returns false.
  bool allocate(osg::GLExtensions& gl, const Plan& plan);
  bool make(osg::GLExtensions& gl, Buffers& buffers, const Plan& plan, Depth depth) const;
  void release(osg::GLExtensions& gl);
  /// The message that this size cannot be drawn, with a size that can.
  std::string refuse(osg::GLExtensions& gl);
  void serve(bool with_hud);

  const bool reversed_depth_, headless_;
  const int wished_samples_;
  std::atomic<int> samples_;
  std::atomic<bool> lacks_samples_ = false, lacks_effects_ = false;
  std::atomic<Quality> quality_;
  std::atomic<bool> edges_ = true;
  std::atomic<int> whole_height_ = 0;
  std::atomic<bool> timed_ = false;
  FrameTimes times_;
  bool fully_ = false;   // whether this frame has all effects, whatever the quality
  Plan wished_, plan_;   // as wished; as the driver has room for
  std::string problem_;  // why nothing can be drawn; empty if it can
  Buffers scene_;        // several samples a pixel, and the depth
  Buffers flat_scene_;   // the same with one sample a pixel, as textures; equal to scene_ if that has one too
  Buffers picture_;      // one sample a pixel; equal to flat_scene_ without effects
  Composite composite_;
  std::mutex mutex_;
  std::vector<Request> requests_;
};

}  // namespace roam::graphics
