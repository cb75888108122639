#pragma once
/// \file
/// The cuts and panels of a picture of an opening: pure numbers, before anything is drawn.

#include <span>
#include <vector>

#include "draw/frames.h"
#include "draw/opening.h"
#include "draw/panel.h"

namespace roam::draw {

/// The panels of one opening. The plan's metres count from the opening's middle; the section's heights are the scene's.
struct OpeningLayout {
  Turn turn;  ///< the level part of the direction lies to the right
  Frame plan;
  Frame section;
  double cut = 0.0;      ///< height of the plan
  double below = 0.0;    ///< of the paler cut; equal to `cut`: none
  double above = 0.0;    ///< height of the cut of a surface above the plan, drawn dashed; 0: none
  bool is_level = true;  ///< the width has a level part, which the plan shows
  Point body{0.0};       ///< of the body's axis in the plan, metres from the opening's middle
};

/// Two panels of one scale, `width` pixels wide, with the opening, the body and some room around both.
[[nodiscard]] OpeningLayout lay_out(const OpeningView& opening, double width);

/// The floor around the opening, as areas of the plan in pixels. None when flying, or if there are too many triangles
/// for a drawing.
[[nodiscard]] std::vector<Polyline> floor_around(std::span<const Mesh> meshes, const OpeningView& opening,
                                                 const OpeningLayout& layout, const Map& map);

/// The walls within the depth of the opening, seen along the way: areas of the section in pixels, all turning one way.
/// None if the section lies along the way, or if there are too many for a drawing.
[[nodiscard]] std::vector<Polyline> faces_beside(std::span<const Mesh> meshes, const OpeningView& opening,
                                                 const OpeningLayout& layout, const Map& map);

/// How far a body carried by the rims of a crack sinks into it, metres; 0 if it falls through.
[[nodiscard]] double sunk(const OpeningView& opening);

/// A capsule from the side, around the upright axis; metres.
[[nodiscard]] Polyline upright_capsule(double radius, double bottom, double height);

}  // namespace roam::draw
