#include "import/display_part.h"

#include <algorithm>
#include <bit>

namespace roam {

std::uint64_t DisplayTexture::bytes_of(DisplayTexels texels, std::uint32_t width, std::uint32_t height,
                                       std::uint32_t levels) {
  // Bytes of a texel, or of a block of texels.
  constexpr std::uint64_t unit_bytes[] = {1, 2, 3, 4, 8, 8, 16, 16};
  const std::uint32_t side = texels >= DisplayTexels::dxt1 ? 4 : 1;
  std::uint64_t bytes = 0;
  for (std::uint32_t level = 0; level < levels; ++level) {
    const std::uint64_t columns = (std::max(width >> level, 1u) + side - 1) / side;
    const std::uint64_t rows = (std::max(height >> level, 1u) + side - 1) / side;
    bytes += columns * rows * unit_bytes[static_cast<std::size_t>(texels)];
  }
  return bytes;
}

std::uint32_t DisplayTexture::all_levels(std::uint32_t width, std::uint32_t height) {
  return static_cast<std::uint32_t>(std::bit_width(std::max(width, height)));
}

bool DisplayLook::has_image() const {
  return texture != no_texture || gloss_texture != no_texture || emission_texture != no_texture;
}

std::uint64_t DisplayPart::node_bytes() const {
  std::uint64_t nodes = textures.size() + looks.size() + geometries.size() + groups;
  for (const DisplayPages& node : pages) nodes += 1 + node.levels.size();
  return node_cost * nodes + name_cost * objects.size();
}

std::uint64_t DisplayPart::bytes() const {
  std::uint64_t sum = node_bytes();
  for (const DisplayTexture& texture : textures) sum += texture.bytes.size();
  for (const DisplayGeometry& g : geometries) {
    sum += g.positions.size() * (sizeof(glm::vec3) + 4) + g.normals.size() * sizeof(glm::vec3) +
           g.coordinates.size() * sizeof(glm::vec2) + g.indices.size() * sizeof(std::uint16_t) +
           g.runs.size() * sizeof(DisplayRun);
  }
  for (const std::string& name : objects) sum += name.size();
  return sum;
}

}  // namespace roam
