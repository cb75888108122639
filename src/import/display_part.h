#pragma once
/// \file
/// A piece of a scene as it is to be seen: plain values, checked one by one where they come from another process.

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <vector>

#include "roam/math.h"

namespace roam {

/// What a texel is. Grey, red, green, blue and opacity have a byte each; the others are blocks of 4 x 4 texels (S3TC).
enum class DisplayTexels : std::uint8_t { grey, grey_alpha, rgb, rgba, dxt1, dxt1_alpha, dxt3, dxt5 };
/// How an image goes on beyond its edges.
enum class DisplayWrap : std::uint8_t { repeat, clamp, mirror };

struct DisplayTexture {
  static constexpr std::uint32_t side_limit = 16384;  ///< texels

  std::uint32_t width = 0, height = 0;
  DisplayTexels texels = DisplayTexels::rgb;
  DisplayWrap across = DisplayWrap::repeat, up = DisplayWrap::repeat;
  std::uint32_t levels = 1;         ///< 1, or all of them, each half of the one before, down to one texel
  std::vector<std::uint8_t> bytes;  ///< level after level, each with its lowest row first and nothing between rows

  /// What such a texture takes.
  [[nodiscard]] static std::uint64_t bytes_of(DisplayTexels texels, std::uint32_t width, std::uint32_t height,
                                              std::uint32_t levels = 1);
  /// How many levels there are down to one texel.
  [[nodiscard]] static std::uint32_t all_levels(std::uint32_t width, std::uint32_t height);
};

/// What is seen through.
enum class DisplayCover : std::uint8_t {
  opaque,
  blended,  ///< mixed with what lies behind by its opacity
  cut       ///< texels whose opacity is below the cutoff are not there
};

struct DisplayLook {
  static constexpr std::uint32_t no_texture = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t texture = no_texture;  ///< index in DisplayPart::textures
  DisplayCover cover = DisplayCover::opaque;
  float cutoff = 0.5f;  ///< 0..1
};

/// Triangles that are drawn together, at most 16,384 that lie together.
struct DisplayGeometry {
  std::uint32_t group = 0;  ///< in which it is shown
  std::uint32_t look = 0;   ///< index in DisplayPart::looks
  Vec3 cell{0.0};           ///< added to each position; the same bits for neighbours, so that edges meet
  std::vector<glm::vec3> positions;
  std::vector<std::array<std::uint8_t, 4>> colours;  ///< of each position: material times vertex colour
  std::vector<glm::vec3> normals;                    ///< of each position; empty where the file has none
  std::vector<glm::vec2> coordinates;                ///< of each position where there is a texture, else empty
  std::vector<std::uint16_t> indices;                ///< of the positions, three a triangle
};

/// What is shown in a range of distance or of size: a group of the same part, or a page that is still to be read.
struct DisplayLevel {
  static constexpr std::size_t page_limit = 4096;  ///< bytes

  float from = 0.0f, to = 0.0f;
  std::uint32_t group = 0;  ///< 0: a page
  std::string page;         ///< what PageReader::read is to be given
};

/// A node whose levels come and go with the place of the eye.
struct DisplayPages {
  std::uint32_t group = 0;  ///< in which it is shown
  Vec3 center{0.0};
  float radius = 0.0f;
  bool by_pixels = false;            ///< ranges are pixels on the screen, else metres from the eye
  std::vector<DisplayLevel> levels;  ///< groups first
};

/// A piece of a scene, ready to be drawn. Groups are the nodes of a tree: group 0 is always shown, each other group is
/// a level of one DisplayPages. What is in a group comes after the level that it is.
struct DisplayPart {
  /// Coordinates are scene - origin; the same in all parts of one read_display, and in the pages of these.
  Vec3 origin{0.0};
  Box bounds;  ///< of what it holds, in the frame of the scene; of pages as the files state them
  std::uint64_t triangles = 0;
  std::uint32_t source = 0;  ///< which of the paths it is of
  std::vector<DisplayTexture> textures;
  std::vector<DisplayLook> looks;
  std::vector<DisplayGeometry> geometries;
  std::uint32_t groups = 1;
  std::vector<DisplayPages> pages;

  /// About what its nodes take where it is drawn, beside the lists that they hold.
  [[nodiscard]] std::uint64_t node_bytes() const;
  /// The same with these lists.
  [[nodiscard]] std::uint64_t bytes() const;
};

}  // namespace roam
