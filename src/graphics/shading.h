#pragma once
/// \file
/// Appearance of surfaces and sky.
///
/// One program draws every scene: colour = vertex colour x texture, on both sides of every face. The light suits
/// interiors: a soft lamp at the eye, a sky brighter than the ground, and a weak sun. So floor, walls and ceiling of
/// one colour differ, and nothing is black. Sun (sun.h) adds shadows, and light that suits the open. Photogrammetry
/// (textured, without normals) is not lit, because its pictures contain light already. If the model has a wall twice
/// with opposite normals, the side that faces the eye is visible. Where Sun draws in Quality::full, smooth surfaces and
/// metals mirror the sun, the lamp, and the brightness of sky and ground or of a room; no other surfaces.
///
///     osg::ref_ptr<osg::Group> scene = roam::graphics::make_scene_group();
///     frame.space()->addChild(roam::graphics::make_sky());
///     frame.space()->addChild(scene);
///     scene->addChild(node);   // between two frames

#include <array>
#include <optional>
#include <osg/Group>
#include <osg/Node>
#include <osg/StateSet>
#include <osg/ref_ptr>
#include <span>

#include "roam/math.h"
#include "roam/space.h"

namespace roam::graphics {

/// The define (StateSet::setDefine) of textured surfaces.
inline constexpr const char* textured_define = "ROAM_TEXTURED";

/// Texture units. Those of materials are set by the caller, with setTextureAttribute.
inline constexpr unsigned picture_unit = 0, shadow_unit = 1, gloss_unit = 2, emission_unit = 3;

/// As in glTF 2.0, section 3.9.2.
struct Gloss {
  float roughness = 1.0f;  ///< 0 (a mirror) .. 1 (dull, even if metal)
  float metalness = 0.0f;  ///< 0..1: a metal mirrors in its own colour
  bool by_image = false;   ///< both are multiplied with those of gloss_unit: luminance and alpha
};

/// The light that a surface sends out by itself.
struct Emission {
  std::array<float, 3> color{};  ///< red, green, blue, 0..1
  bool by_image = false;         ///< multiplied with that of emission_unit
};

/// A surface's material. Its colours are those of its vertices.
struct Surface {
  bool textured = false;          ///< with an image on picture_unit
  bool blended = false;           ///< over the background, by its opacity
  std::optional<float> cutoff{};  ///< pixels with a smaller opacity are not drawn
  std::optional<Gloss> gloss{};   ///< none: dull
  std::optional<Emission> emission{};
};

/// Towards the sun, of length 1.
[[nodiscard]] Vec3 sun_direction();

/// Texels along a side of one of the sun's maps of shadows.
inline constexpr int shadow_map_side = 1024;

/// Makes geometries below `state` look as `surface` says.
void apply(const Surface& surface, osg::StateSet& state);

/// The group for scenes drawn as described above; up is +z. Every geometry below must have colours and normals. A
/// single zero normal means that each face uses its own. States other than opaque, untextured ones are made by apply().
[[nodiscard]] osg::ref_ptr<osg::Group> make_scene_group();

inline constexpr std::size_t most_section_planes = 12;

/// Hides all points of the half spaces, in the frame of the scene group; nothing without any. Call it between two
/// frames, with at most most_section_planes.
void set_section(osg::Group& scene, std::span<const HalfSpace> hidden);

/// A gradient from the ground over the horizon to the zenith, dark enough for white objects and light enough for black
/// ones. It has no bounds.
[[nodiscard]] osg::ref_ptr<osg::Node> make_sky();

}  // namespace roam::graphics
