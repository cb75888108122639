#pragma once
/// \file
/// The shapes of an opening's plan and section, cut out of the scene: in metres, before anything is painted.

#include <span>
#include <string>
#include <vector>

#include "draw/cut.h"
#include "draw/opening.h"

namespace roam::draw {

/// The plan's metres count from the opening's middle, and so do the section's to the right. Its heights are the
/// scene's.
struct OpeningDrawing {
  Turn turn;  ///< the level part of the direction lies to the right
  Frame plan;
  Frame section;          ///< to the plan's scale
  double cut = 0.0;       ///< height of the plan
  bool is_level = true;   ///< the width has a level part, which the plan shows
  Point body{0.0};        ///< of the body's axis in the plan
  Point half_width{0.0};  ///< from the middle of the measured width to one end, in the section
  PlanCut plan_cut;
  std::vector<Segment> above;  ///< cut of a surface above the plan, if a height was measured
  std::vector<Segment> section_cut;
  std::vector<Polyline> floor;  ///< areas of the plan; none if there are too many triangles for a drawing
  std::vector<Polyline> faces;  ///< areas of the section: walls within the opening's depth, seen along the way
};

/// Both panels are `width` pixels wide, with the opening, the body and some room around both. All areas turn one way.
/// Throws roam::Cancelled after Ctrl-C.
[[nodiscard]] OpeningDrawing drawing_of(const OpeningView& opening, std::span<const Mesh> meshes, double width);

/// Cuts a whole scene and shows the progress of drawing `what`. Throws roam::Cancelled after Ctrl-C.
[[nodiscard]] Cuts cut_out(const std::string& what, std::span<const Mesh> meshes, const Turn& turn,
                           std::span<const PlanView> views, std::span<const Stretch> section);

}  // namespace roam::draw
