#pragma once
/// \file
/// Where a picture of an opening is cut and what it shows there: pure numbers, before anything is drawn.

#include <span>
#include <vector>

#include "draw/frames.h"
#include "draw/opening.h"
#include "draw/panel.h"

namespace roam::draw {

/// The panels of one opening. The plan's metres are counted from the opening's middle, the section's heights are the
/// scene's.
struct OpeningLayout {
  Turn turn;  ///< the level part of the direction lies to the right
  Frame plan;
  Frame section;
  double cut = 0.0;      ///< height of the plan
  double below = 0.0;    ///< of what is drawn paler; `cut`: nothing is
  double above = 0.0;    ///< height at which what hangs over the plan is cut, drawn in dashes; 0: nothing is
  bool is_level = true;  ///< the width has a level part, which the plan shows
  Point body{0.0};       ///< of the body's axis in the plan, metres from the opening's middle
};

/// Two panels of one scale, `width` pixels wide, that show the opening, the body and some room around both.
[[nodiscard]] OpeningLayout lay_out(const OpeningView& opening, double width);

/// The floor on which one stands there, as areas of the plan in pixels. None when flying, and where there are more
/// triangles of it than a drawing should hold.
[[nodiscard]] std::vector<Polyline> floor_around(std::span<const Mesh> meshes, const OpeningView& opening,
                                                 const OpeningLayout& layout, const Map& map);

/// What stands within the depth of the opening, seen along the way: areas of the section in pixels, all turning one
/// way. None where the section lies along the way, and where there are more than a drawing should hold.
[[nodiscard]] std::vector<Polyline> faces_beside(std::span<const Mesh> meshes, const OpeningView& opening,
                                                 const OpeningLayout& layout, const Map& map);

/// How far a body that is carried by the rims of a crack sinks into it, metres; 0 for one that falls through.
[[nodiscard]] double sunk(const OpeningView& opening);

/// A capsule from the side, about the upright axis; metres.
[[nodiscard]] Polyline upright_capsule(double radius, double bottom, double height);

}  // namespace roam::draw
