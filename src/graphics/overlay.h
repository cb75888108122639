#pragma once
/// \file
/// What the collision knows, drawn in the scene: for understanding it and for pictures.
///
/// What is behind a wall shines through faintly. All places are in the frame of the scene graph, which is the scene
/// minus one origin: subtract that from places of the scene.

#include <array>
#include <optional>
#include <osg/ref_ptr>
#include <vector>

#include "graphics/frame.h"
#include "roam/math.h"

namespace roam::graphics {

/// A sphere (height == 2 * radius) or an upright capsule.
struct BodyMark {
  Vec3 centre{0.0};     ///< metres, scene minus origin
  double radius = 0.0;  ///< metres, > 0
  double height = 0.0;  ///< metres, whole; less than 2 * radius counts as that
  bool held = false;    ///< drawn in the colour of warnings
};

/// Where the body touches or touched.
struct ContactMark {
  Vec3 point{0.0};   ///< metres, scene minus origin
  Vec3 normal{0.0};  ///< away from the wall, length 1; drawn 0.3 m long
};

/// What may be drawn. Nothing by default.
struct Marks {
  std::optional<BodyMark> body{};
  std::vector<ContactMark> contacts{};
  std::vector<std::array<Vec3, 3>> triangles{};  ///< corners, metres, scene minus origin
};

/// Draws marks and a trail in a frame. Use it from the thread that calls viewer.frame(), between frames.
class Overlay {
 public:
  explicit Overlay(Frame& frame);
  ~Overlay();  ///< takes it out of the picture
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  void set_marks(const Marks& marks);
  /// The way that was recorded; `point` in metres, scene minus origin. Points can be added at 60 Hz for hours: only the
  /// last piece is sent anew.
  void add_to_trail(const Vec3& point);
  /// The next point begins a new line: after a teleport.
  void break_trail();
  void clear_trail();

 private:
  class Trail;
  osg::ref_ptr<osg::Group> parent_, group_, marks_;
  osg::ref_ptr<Trail> trail_;
};

}  // namespace roam::graphics
