#pragma once
/// \file
/// The points of a section's box that the mouse drags: the middle of each side, and the middle of the box.

#include <array>
#include <optional>

#include "graphics/overlay.h"
#include "view/pick.h"

namespace roam::app {

/// 0 to 5: lower x, upper x, lower y, ... upper z; 6: the middle.
using Grip = std::size_t;
inline constexpr Grip grip_count = 7, middle_grip = 6;

[[nodiscard]] Vec3 place_of(Grip grip, const Box& box);

/// The grip that is drawn at a point of the picture, the nearest to the eye of several.
[[nodiscard]] std::optional<Grip> grip_at(const Box& box, const CameraView& camera, double x, double y);

/// The box after a grip was dragged from one point of the picture to another. A side moves along its normal, the middle
/// across the view. No side becomes shorter than `least` metres.
[[nodiscard]] Box dragged(const Box& box, Grip grip, const Sightline& from, const Sightline& to, const Vec3& ahead,
                          double least);

/// The box with one side moved outwards by some metres; the middle: all sides.
[[nodiscard]] Box grown_at(Grip grip, const Box& box, double by, double least);

/// The box and its grips, for drawing.
[[nodiscard]] graphics::BoxMark mark_of(const Box& box, const CameraView& camera, std::optional<Grip> held);

}  // namespace roam::app
