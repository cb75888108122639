#pragma once
/// \file
/// A part of a scene for display: plain values. Those from another process are checked one by one.

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

/// Format of a texel. Grey, red, green, blue and opacity have one byte each. The others are blocks of 4 x 4 texels
/// (S3TC).
enum class DisplayTexels : std::uint8_t { grey, grey_alpha, rgb, rgba, dxt1, dxt1_alpha, dxt3, dxt5 };
/// How an image continues beyond its edges.
enum class DisplayWrap : std::uint8_t { repeat, clamp, mirror };

struct DisplayTexture {
  static constexpr std::uint32_t side_limit = 16384;  ///< texels

  std::uint32_t width = 0, height = 0;
  DisplayTexels texels = DisplayTexels::rgb;
  DisplayWrap across = DisplayWrap::repeat, up = DisplayWrap::repeat;
  std::uint32_t levels = 1;         ///< 1, or all levels down to one texel, each half of the one before
  std::vector<std::uint8_t> bytes;  ///< level after level, each from its lowest row, without padding

  /// The bytes of a texture.
  [[nodiscard]] static std::uint64_t bytes_of(DisplayTexels texels, std::uint32_t width, std::uint32_t height,
                                              std::uint32_t levels = 1);
  /// The number of levels down to one texel.
  [[nodiscard]] static std::uint32_t all_levels(std::uint32_t width, std::uint32_t height);
};

/// Transparency of a surface.
enum class DisplayCover : std::uint8_t {
  opaque,
  blended,  ///< mixed with the background by its opacity
  cut       ///< texels with an opacity below the cutoff are not drawn
};

struct DisplayLook {
  static constexpr std::uint32_t no_texture = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t texture = no_texture;  ///< index in DisplayPart::textures; multiplied with the colours
  DisplayCover cover = DisplayCover::opaque;
  float cutoff = 0.5f;     ///< 0..1
  float roughness = 1.0f;  ///< 0 (a mirror) .. 1 (dull)
  float metalness = 0.0f;  ///< 0..1
  /// Holds roughness as grey and metalness as opacity; they multiply the two values above.
  std::uint32_t gloss_texture = no_texture;
  std::array<std::uint8_t, 3> emission{};       ///< the colour in which it shines by itself
  std::uint32_t emission_texture = no_texture;  ///< multiplied with the emission

  [[nodiscard]] bool has_image() const;
};

/// Triangles of one object that follow each other in a geometry.
struct DisplayRun {
  std::uint32_t object = 0;  ///< index in DisplayPart::objects
  std::uint32_t triangles = 0;
};

/// At most 16,384 triangles that lie close together and are drawn together.
struct DisplayGeometry {
  std::uint32_t group = 0;  ///< the group that contains it
  std::uint32_t look = 0;   ///< index in DisplayPart::looks
  Vec3 cell{0.0};           ///< added to each position; the same bits for neighbours, so that edges meet
  std::vector<glm::vec3> positions;
  std::vector<std::array<std::uint8_t, 4>> colours;  ///< one for each position: material times vertex colour
  std::vector<glm::vec3> normals;                    ///< one for each position; empty if the file has none
  std::vector<glm::vec2> coordinates;                ///< one for each position; empty without a texture
  std::vector<std::uint16_t> indices;                ///< into positions, three for each triangle
  std::vector<DisplayRun> runs;                      ///< of all triangles, in their order; empty: objects unknown
};

/// What is shown in a range of distance or size: a group of the same part, or a page still to be read.
struct DisplayLevel {
  static constexpr std::size_t page_limit = 4096;  ///< bytes

  float from = 0.0f, to = 0.0f;
  std::uint32_t group = 0;  ///< 0: a page
  std::string page;         ///< the argument of PageReader::read
};

/// The measure of the ranges of levels.
enum class DisplayMeasure : std::uint8_t {
  metres,  ///< from the eye to the centre
  pixels,  ///< of the sphere on the screen
  error    ///< `error` on the screen, as a multiple of the error that the viewer allows
};

/// A node whose levels change with the position of the eye.
struct DisplayPages {
  std::uint32_t group = 0;  ///< the group that contains it
  Vec3 center{0.0};
  float radius = 0.0f;
  DisplayMeasure measure = DisplayMeasure::metres;
  std::vector<DisplayLevel> levels;  ///< groups first
  float error = 0.0f;                ///< metres: what is wrong with the first level, at most
  glm::vec3 half{
      0.0f};  ///< of the box around the centre to which the distance of the error is measured: half its sides
};

/// A part of a scene, ready to be drawn. Groups are the nodes of a tree. Group 0 is always shown; each other group is a
/// level of one DisplayPages. The contents of a group come after the DisplayPages that has it as a level.
struct DisplayPart {
  /// Between the names of an object's ancestors and its own.
  static constexpr char name_separator = '\x1f';
  static constexpr std::size_t name_limit = 4096;  ///< bytes of an object's names

  /// Coordinates are scene - origin. Equal in all parts of one read_display, and in their pages.
  Vec3 origin{0.0};
  Box bounds;  ///< in the frame of the scene; those of pages are as the files state them
  std::uint64_t triangles = 0;
  std::uint32_t source = 0;        ///< the index of the path that it is from
  std::uint64_t missing = 0;       ///< of a page: files that it refers to and that are absent or damaged
  std::vector<std::string> notes;  ///< of a page: sentences for the user
  std::vector<DisplayTexture> textures;
  std::vector<DisplayLook> looks;
  std::vector<std::string> objects;  ///< names, the outermost ancestor's first; empty names are left out
  std::vector<DisplayGeometry> geometries;
  std::uint32_t groups = 1;
  std::vector<DisplayPages> pages;

  /// Bytes that a node takes in the display: a geometry of OpenSceneGraph with its arrays and buffers; other nodes take
  /// less. Bytes of an object's name without its letters.
  static constexpr std::uint64_t node_cost = 2048, name_cost = 256;
  /// Approximate bytes of its nodes in the display, without the lists in this part.
  [[nodiscard]] std::uint64_t node_bytes() const;
  /// The same, plus the bytes of these lists.
  [[nodiscard]] std::uint64_t bytes() const;
};

}  // namespace roam
