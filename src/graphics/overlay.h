#pragma once
/// \file
/// Collision data drawn in the scene: body, contacts, triangles, measured points and lines.
///
/// Walls do not hide it completely: hidden parts are drawn faintly. All positions are in the frame of the scene graph,
/// which is the scene minus one origin; subtract that from positions in the scene.

#include <array>
#include <optional>
#include <osg/ref_ptr>
#include <string>
#include <vector>

#include "graphics/frame.h"
#include "roam/math.h"

namespace roam::graphics {

/// A sphere (height == 2 * radius) or an upright capsule.
struct BodyMark {
  Vec3 centre{0.0};     ///< metres, scene minus origin
  double radius = 0.0;  ///< metres, > 0
  double height = 0.0;  ///< metres; a value below 2 * radius counts as 2 * radius
  bool held = false;    ///< drawn in the colour of warnings
  bool inside = false;  ///< the eye is in it: only a ring at its feet is drawn
};

/// A present or past contact of the body.
struct ContactMark {
  Vec3 point{0.0};   ///< metres, scene minus origin
  Vec3 normal{0.0};  ///< away from the wall, length 1; drawn 0.3 m long
};

/// A point that the mouse drags; nothing hides it.
struct GripMark {
  Vec3 at{0.0};         ///< metres, scene minus origin
  double radius = 0.1;  ///< metres
  bool held = false;    ///< drawn lighter
};

/// The edges of a box, and points to drag.
struct BoxMark {
  Box box;  ///< metres, scene minus origin
  std::vector<GripMark> grips;
};

/// A text at a place. The overlay does not draw it: see Hud::set_labels().
struct LabelMark {
  Vec3 at{0.0};  ///< metres, scene minus origin
  std::string text;
};

/// The marks to draw. Empty by default.
struct Marks {
  std::optional<BodyMark> body{};
  std::vector<ContactMark> contacts{};
  std::vector<std::array<Vec3, 3>> triangles{};  ///< corners, metres, scene minus origin
  std::vector<std::array<Vec3, 2>> lines{};      ///< measured lengths: ends, metres, scene minus origin
  std::vector<std::array<Vec3, 2>> way{};        ///< a way that a body goes: likewise
  std::vector<std::array<Vec3, 2>> barred{};     ///< a way beyond what stops the body: likewise
  std::vector<Vec3> points{};                    ///< measured points, metres, scene minus origin
  std::vector<LabelMark> labels{};
  std::optional<BoxMark> box{};
};

/// Draws marks in a frame, with lines that get wider with it. Use it from the thread that calls viewer.frame(), between
/// frames.
class Overlay {
 public:
  explicit Overlay(Frame& frame);
  ~Overlay();  ///< removes it from the picture
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  void set_marks(const Marks& marks);

 private:
  Frame& frame_;
  float line_width_ = 0.0f;  ///< pixels
  osg::ref_ptr<osg::Group> parent_, group_, marks_, grips_;
};

}  // namespace roam::graphics
