#pragma once
/// \file
/// A plan beside the picture: lines seen from above, the body with its gaze, and its trail. North (+y) is up.
///
///     PlanPanel plan(frame);
///     plan.set_lines({.base = {4e6, 5e6}, .walls = {...}});
///     plan.set_view({.size = PlanSize::small, .centre = {4e6 + 3, 5e6}, .half = 12.0, .yaw = 0.0});
///
/// The panel is at the right edge and scales with the window. Use it between frames, from the thread that calls
/// viewer.frame().

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <osg/Group>
#include <osg/MatrixTransform>
#include <osg/ref_ptr>
#include <string>
#include <vector>

#include "graphics/frame.h"
#include "graphics/lettering.h"
#include "graphics/plate.h"

namespace roam::graphics {

/// none: it is not drawn.
enum class PlanSize : std::uint8_t { none, small, large };

/// A new cut. Points in pairs, metres from `base`.
struct PlanLines {
  glm::dvec2 base{0.0};
  std::vector<glm::vec2> walls{}, below{};  ///< at body height; lower
};

/// A named place.
struct PlanPlace {
  glm::dvec2 at{0.0};  ///< metres
  std::string name;    ///< UTF-8
  bool operator==(const PlanPlace&) const = default;
};

/// The part that is shown. It may change in each frame.
struct PlanView {
  PlanSize size = PlanSize::none;
  glm::dvec2 centre{0.0};  ///< of the panel, where the body is; metres
  double half = 12.0;      ///< metres from the centre to the panel's edge, > 0
  double yaw = 0.0;        ///< radians, see osgRoam::Manipulator
  bool is_coming = false;  ///< the lines are still to come, which the panel says
};

class PlanPanel {
 public:
  explicit PlanPanel(Frame& frame);
  ~PlanPanel();  ///< removes it from the picture
  PlanPanel(const PlanPanel&) = delete;
  PlanPanel& operator=(const PlanPanel&) = delete;

  void set_lines(const PlanLines& lines);
  /// Points in pairs, metres from the base of the lines.
  void set_trail(const std::vector<glm::vec2>& trail);
  /// A way, and its part beyond what stops the body; metres, from the base of the lines.
  void set_way(const std::vector<glm::vec2>& open, const std::vector<glm::vec2>& barred);
  void set_places(const std::vector<PlanPlace>& places);
  void set_view(const PlanView& view);
  /// The metres at a point of the picture, x and y in [-1, 1]; none outside of the panel.
  [[nodiscard]] std::optional<glm::dvec2> at(double x, double y) const;
  /// Its rectangle in the picture, pixels; empty when it is not shown.
  [[nodiscard]] Rectangle place() const;

 private:
  void lay_out();
  void lay_out_places();
  void move_places();

  Frame& frame_;
  PlanView view_;
  glm::dvec2 base_{0.0};
  int width_ = 0, height_ = 0;  ///< pixels that it is laid out for
  double laid_half_ = 0.0;
  PlanSize laid_size_ = PlanSize::none;
  osg::ref_ptr<osg::Group> parent_, group_, sheet_, legend_, coming_;
  osg::ref_ptr<osg::MatrixTransform> map_, body_;
  osg::ref_ptr<osg::Group> lines_, trail_, way_, names_;
  std::vector<PlanPlace> places_;
  std::vector<osg::ref_ptr<Text>> texts_;  ///< of the places
};

}  // namespace roam::graphics
