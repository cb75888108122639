#pragma once
/// \file
/// Looks of surfaces: normals, texture coordinates, colours and transparency.

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace roam::reader {

/// Red, green, blue and opacity; 255 means 1.
using Colour = std::array<std::uint8_t, 4>;
inline constexpr Colour white{255, 255, 255, 255};

/// The look of a vertex. Members that the file does not state keep these defaults.
struct VertexLook {
  glm::vec3 normal{0.0f};   ///< of any length; zero if there is none
  glm::vec2 texture{0.0f};  ///< coordinates in the image, (0, 0) at its lower left corner
  Colour colour = white;    ///< material and vertex colour multiplied
};

/// The number of an image in Textures.
using TextureId = std::uint32_t;
inline constexpr TextureId no_texture = std::numeric_limits<TextureId>::max();

enum class Transparency : std::uint8_t {
  none,        ///< opaque, whatever the opacity of the image
  by_texture,  ///< blended where the image is translucent
  mask,        ///< texels with an opacity below the cutoff are not drawn
  blend
};

/// The look that triangles drawn together share.
struct Look {
  TextureId texture = no_texture;
  TextureId gloss_texture = no_texture;  ///< as in glTF: roughness is green, metalness is blue
  TextureId emission_texture = no_texture;
  Transparency transparency = Transparency::none;
  float cutoff = 0.5f;                       ///< for mask
  float roughness = 1.0f, metalness = 0.0f;  ///< 0..1
  Colour emission{};                         ///< the colour in which it shines by itself
  auto operator<=>(const Look&) const = default;

  /// The first of its images.
  [[nodiscard]] TextureId image() const {
    if (texture != no_texture) return texture;
    return gloss_texture != no_texture ? gloss_texture : emission_texture;
  }
};

/// Converts from 0..1. A NaN gives 0.
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
