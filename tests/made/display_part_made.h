#pragma once
/// \file
/// A part of a scene for display, and what a viewer relies on.

#include <cmath>
#include <utility>
#include <vector>

#include "import/display_part.h"

namespace roam::test {

/// A part with everything that there is: images, looks, groups, geometries of all kinds, pages.
inline DisplayPart full_part() {
  DisplayPart part;
  part.origin = {1000, 0, 0};
  part.bounds = {{999, 0, 0}, {1001, 1, 1}};
  part.textures.push_back(
      {2, 3, DisplayTexels::rgb, DisplayWrap::repeat, DisplayWrap::clamp, 1, std::vector<std::uint8_t>(18, 7)});
  part.textures.push_back({8, 4, DisplayTexels::dxt5, DisplayWrap::mirror, DisplayWrap::repeat, 4,
                           std::vector<std::uint8_t>(DisplayTexture::bytes_of(DisplayTexels::dxt5, 8, 4, 4), 9)});
  constexpr std::uint32_t none = DisplayLook::no_texture;
  part.looks = {{none, DisplayCover::opaque, 0.5f, 0.25f, 1.0f, none, {255, 128, 0}, none},
                {0, DisplayCover::cut, 0.25f},
                {none, DisplayCover::blended, 0.5f, 1.0f, 1.0f, 1, {1, 1, 1}, 0}};
  part.groups = 3;
  for (std::uint32_t i = 0; i < 3; ++i) {
    DisplayGeometry geometry;
    geometry.group = i;
    geometry.look = i;
    geometry.cell = {256, 0, 0};
    geometry.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    geometry.colours.assign(4, {1, 2, 3, 4});
    if (i == 1) geometry.normals.assign(4, {0, 0, 1});
    if (i > 0) geometry.coordinates.assign(4, {0.5f, 0.25f});
    geometry.indices = {0, 1, 2, 0, 2, 3};
    if (i == 1) geometry.runs = {{1, 1}, {0, 1}};
    part.geometries.push_back(geometry);
  }
  part.objects = {"wall", "door"};
  part.triangles = 6;
  part.pages.push_back({0, {1, 2, 3}, 5.0f, DisplayMeasure::pixels, {{0, 100, 1, {}}, {100, 1e30f, 0, "a page"}}});
  part.pages.push_back(
      {1, {1, 2, 3}, 2.0f, DisplayMeasure::metres, {{0, 50, 2, {}}, {0, 10, 0, "one"}, {5, 20, 0, "two"}}});
  return part;
}

/// Whether the part is as DisplayPart promises, checked by other code.
inline bool is_valid(const DisplayPart& part) {
  bool valid = part.groups > 0;
  for (const DisplayTexture& t : part.textures) {
    const std::size_t bytes[] = {1, 2, 3, 4};
    valid = valid && t.width > 0 && t.height > 0 && t.width <= 16384 && t.height <= 16384 && t.levels <= 15;
    if (t.texels < DisplayTexels::dxt1 && t.levels == 1) {
      valid = valid && t.bytes.size() == std::size_t{t.width} * t.height * bytes[static_cast<int>(t.texels)];
    } else {
      valid = valid && t.bytes.size() * 16 >= std::size_t{t.width} * t.height * 8;
    }
  }
  for (const DisplayLook& look : part.looks) {
    for (const std::uint32_t image : {look.texture, look.gloss_texture, look.emission_texture}) {
      valid = valid && (image == DisplayLook::no_texture || image < part.textures.size());
    }
    for (const float share : {look.cutoff, look.roughness, look.metalness}) {
      valid = valid && share >= 0.0f && share <= 1.0f;
    }
  }
  std::uint64_t triangles = 0;
  for (const DisplayGeometry& g : part.geometries) {
    valid = valid && g.group < part.groups && g.look < part.looks.size() && g.indices.size() % 3 == 0;
    valid = valid && g.colours.size() == g.positions.size();
    valid = valid && (g.normals.empty() || g.normals.size() == g.positions.size());
    if (!valid) return false;
    const bool textured = part.looks[g.look].has_image();
    valid = valid && g.coordinates.size() == (textured ? g.positions.size() : 0);
    for (const std::uint16_t i : g.indices) valid = valid && i < g.positions.size();
    for (const glm::vec3& p : g.positions) {
      for (int k = 0; k < 3; ++k) valid = valid && std::abs(g.cell[k] + double(p[k])) <= 4e9;
    }
    for (const glm::vec3& n : g.normals) valid = valid && std::isfinite(n.x) && std::isfinite(n.y);
    std::size_t in_runs = 0;
    for (const DisplayRun& run : g.runs) {
      valid = valid && run.object < part.objects.size();
      in_runs += run.triangles;
    }
    valid = valid && (g.runs.empty() || in_runs == g.indices.size() / 3);
    triangles += g.indices.size() / 3;
  }
  std::vector<int> shown(part.groups, 0);
  for (const DisplayPages& pages : part.pages) {
    valid = valid && pages.group < part.groups && pages.radius >= 0.0f && std::isfinite(pages.radius);
    valid = valid && pages.error >= 0.0f && std::isfinite(pages.error) && std::isfinite(pages.half.x + pages.half.z);
    for (const DisplayLevel& level : pages.levels) {
      valid = valid && level.group < part.groups && level.page.size() <= 4096 && !std::isnan(level.from);
      valid = valid && (level.group == 0) != level.page.empty();
      if (valid && level.group != 0) ++shown[level.group];
    }
  }
  for (std::size_t i = 1; i < shown.size(); ++i) valid = valid && shown[i] == 1;
  return valid && triangles == part.triangles;
}

}  // namespace roam::test
