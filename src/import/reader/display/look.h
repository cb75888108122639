#pragma once
/// \file
/// How surfaces look: what the readers tell of it beside the shape.

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace roam::reader {

/// Red, green, blue and opacity, 255 for 1.
using Colour = std::array<std::uint8_t, 4>;
inline constexpr Colour white{255, 255, 255, 255};

/// A vertex beside its place. What a file does not say is left as it is here.
struct VertexLook {
  glm::vec3 normal{0.0f};   ///< of any length; zero where there is none
  glm::vec2 texture{0.0f};  ///< coordinates in the image, (0, 0) at its lower left corner
  Colour colour = white;    ///< material and vertex colour multiplied
};

/// Number of an image known to Textures.
using TextureId = std::uint32_t;
inline constexpr TextureId no_texture = std::numeric_limits<TextureId>::max();

enum class Transparency : std::uint8_t {
  none,        ///< opaque, whatever the image's fourth channel says
  by_texture,  ///< blended where the image is translucent
  mask,        ///< texels below the cutoff are not there
  blend
};

/// What triangles that are drawn together have in common.
struct Look {
  TextureId texture = no_texture;
  Transparency transparency = Transparency::none;
  float cutoff = 0.5f;  ///< for mask
  auto operator<=>(const Look&) const = default;
};

/// From 0..1; what is not a number is 0.
inline std::uint8_t colour_byte(double value) {
  return static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(value > 0.0 ? value : 0.0, 0.0, 1.0)));
}

/// The product of two colours.
inline Colour operator*(const Colour& a, const Colour& b) {
  Colour product;
  for (std::size_t i = 0; i < 4; ++i) product[i] = static_cast<std::uint8_t>((a[i] * b[i] + 127) / 255);
  return product;
}

}  // namespace roam::reader
