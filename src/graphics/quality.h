#pragma once
/// \file
/// Qualities of drawing: the passes that follow the scene.

#include <cstdint>

namespace roam::graphics {

/// full: several samples a pixel, shadows and gloss (sun.h), ambient occlusion, edges, smoothing. For cards and stills.
/// light: one sample a pixel and light_effects.
/// plain: the scene alone.
enum class Quality : std::uint8_t { full, light, plain };

/// The passes between the scene and the picture.
struct Effects {
  bool occlusion = false;  ///< ambient occlusion: corners and gaps are darker
  bool edges = false;      ///< thin lines along outlines and convex edges
  bool smoothing = false;  ///< smooth edges in the finished picture, whatever the number of samples
  [[nodiscard]] bool any() const { return occlusion || edges || smoothing; }
  bool operator==(const Effects&) const = default;
};

inline constexpr Effects full_effects{true, true, true};
inline constexpr Effects light_effects{true, true, false};

}  // namespace roam::graphics
