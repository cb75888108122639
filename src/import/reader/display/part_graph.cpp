#include "import/reader/display/part_graph.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "import/reader/display/texels.h"

namespace roam::reader {
namespace {

/// Metres: size of the grid cells to which chunks are relative. Neighbours in one cell have equal floats at a common
/// edge, so that no background shines through. Within a cell, floats are precise to 8 micrometres.
constexpr double cell_size = 256.0;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

Vec3 cell_around(const Vec3& place) {
  Vec3 cell;
  for (int k = 0; k < 3; ++k) cell[k] = 0.0 + cell_size * std::round(place[k] / cell_size);
  return cell;
}

/// Fills in the arrays of a chunk of triangles. `index_of` has an entry for each vertex of the surface; all are `none`
/// before and after.
void fill(DisplayGeometry& geometry, const Surface& surface, std::span<const std::uint32_t> triangles, const Vec3& zero,
          bool normals, bool textured, std::vector<std::uint32_t>& index_of) {
  std::vector<std::uint32_t> used;
  geometry.indices.reserve(3 * triangles.size());
  for (const std::uint32_t t : triangles) {
    for (const std::uint32_t corner : surface.triangles[t]) {
      if (index_of[corner] == none) {
        index_of[corner] = static_cast<std::uint32_t>(used.size());
        used.push_back(corner);
      }
      geometry.indices.push_back(static_cast<std::uint16_t>(index_of[corner]));
    }
  }
  geometry.positions.reserve(used.size());
  geometry.colours.reserve(used.size());
  if (normals) geometry.normals.reserve(used.size());
  if (textured) geometry.coordinates.reserve(used.size());
  for (const std::uint32_t i : used) {
    index_of[i] = none;
    geometry.positions.emplace_back(surface.vertices[i] - zero);
    const VertexLook& look = surface.looks[i];
    geometry.colours.push_back(look.colour);
    if (normals) {
      // In double, because the square of a float may overflow a float.
      const glm::dvec3 n(look.normal);
      geometry.normals.emplace_back(n / glm::length(n));
    }
    if (textured) {
      const glm::vec2 at = look.texture;
      geometry.coordinates.push_back(std::isfinite(at.x) && std::isfinite(at.y) ? at : glm::vec2(0.0f));
    }
  }
}

}  // namespace

PartGraph::PartGraph(Textures& textures, const Vec3& origin) : textures_(textures) { part_.origin = origin; }

void PartGraph::add(const Surface& surface, const Look& look, bool normals, std::uint32_t group,
                    std::span<const std::string> objects) {
  const std::uint32_t number = number_of(look);
  const bool textured = part_.looks[number].has_image();
  bytes_ += surface.bytes();
  part_.triangles += surface.triangles.size();
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> index_of(surface.vertices.size(), none);
  for (const std::span<const std::uint32_t> chunk : cut_into_chunks(surface, order)) {
    Box box;
    for (const std::uint32_t t : chunk) {
      for (const std::uint32_t corner : surface.triangles[t]) box.include(surface.vertices[corner]);
    }
    part_.bounds.include(box);
    DisplayGeometry geometry;
    geometry.group = group;
    geometry.look = number;
    geometry.cell = cell_around(box.center() - part_.origin);
    fill(geometry, surface, chunk, part_.origin + geometry.cell, normals, textured, index_of);
    geometry.runs = runs_of(surface, chunk, objects);
    part_.geometries.push_back(std::move(geometry));
  }
}

std::vector<DisplayRun> PartGraph::runs_of(const Surface& surface, std::span<const std::uint32_t> chunk,
                                           std::span<const std::string> objects) {
  std::vector<DisplayRun> runs;
  auto next = surface.runs.begin();
  for (const std::uint32_t triangle : chunk) {
    if (runs.empty() || (next != surface.runs.end() && triangle >= next->first)) {
      while (next != surface.runs.end() && triangle >= next->first) ++next;
      const std::string& name = objects[std::prev(next)->object];
      const auto [at, is_new] = objects_.try_emplace(name, static_cast<std::uint32_t>(part_.objects.size()));
      if (is_new) part_.objects.push_back(name);
      if (runs.empty() || runs.back().object != at->second) runs.push_back({at->second, 0});
    }
    ++runs.back().triangles;
  }
  return runs;
}

std::size_t PartGraph::add_pages(DisplayPages&& pages, const Box& box) {
  pages.center = pages.center - part_.origin;
  part_.bounds.include(box);
  part_.pages.push_back(std::move(pages));
  return part_.pages.size() - 1;
}

PartGraph::Loaded PartGraph::load(TextureId texture, Content content) {
  if (texture == no_texture) return {};
  const auto [at, is_new] = loaded_.try_emplace({textures_.first_of(texture), content});
  Loaded& loaded = at->second;
  if (!is_new) return loaded;
  const bool gloss = content == Content::gloss;
  const osg::ref_ptr<osg::Image> image = textures_.load(texture);
  if (image == nullptr || (gloss && image->isCompressed())) return loaded;
  loaded.number = static_cast<std::uint32_t>(part_.textures.size());
  loaded.translucent = image->isImageTranslucent();
  part_.textures.push_back(gloss ? gloss_of(*image) : texels_of(*image));
  const Wrapping wrapping = textures_.wrapping(texture);
  part_.textures.back().across = wrapping.across;
  part_.textures.back().up = wrapping.up;
  bytes_ += part_.textures.back().bytes.size();
  return loaded;
}

std::uint32_t PartGraph::number_of(const Look& look) {
  const auto [at, is_new] = looks_.try_emplace(look, static_cast<std::uint32_t>(part_.looks.size()));
  if (!is_new) return at->second;
  const Loaded texture = load(look.texture, Content::colours);
  const bool textured = texture.number != DisplayLook::no_texture;
  DisplayLook shown;
  shown.texture = texture.number;
  shown.gloss_texture = load(look.gloss_texture, Content::gloss).number;
  shown.emission_texture = load(look.emission_texture, Content::colours).number;
  // Without its image, a factor would make a mirror of a whole wall.
  if (look.gloss_texture == no_texture || shown.gloss_texture != DisplayLook::no_texture) {
    shown.roughness = look.roughness;
    shown.metalness = look.metalness;
  }
  if (look.emission_texture == no_texture || shown.emission_texture != DisplayLook::no_texture) {
    std::copy_n(look.emission.begin(), shown.emission.size(), shown.emission.begin());
  }
  shown.cutoff = look.cutoff;
  if (look.transparency == Transparency::mask && textured) shown.cover = DisplayCover::cut;
  if (look.transparency == Transparency::blend ||
      (look.transparency == Transparency::by_texture && texture.translucent)) {
    shown.cover = DisplayCover::blended;
  }
  part_.looks.push_back(shown);
  return at->second;
}

}  // namespace roam::reader
