#pragma once
/// \file
/// Appearance of surfaces and sky.
///
/// One program draws every scene: colour = vertex colour x texture, on both sides of every face. The light suits
/// interiors: a soft lamp at the eye, a sky brighter than the ground, and a weak sun. So floor, walls and ceiling of
/// one colour differ, and nothing is black. Photogrammetry (textured, without normals) is not lit, because its pictures
/// contain light already. If the model has a wall twice with opposite normals, the side that faces the eye is visible.
///
///     osg::ref_ptr<osg::Group> scene = roam::graphics::make_scene_group();
///     frame.space()->addChild(roam::graphics::make_sky());
///     frame.space()->addChild(scene);
///     scene->addChild(node);   // between two frames

#include <optional>
#include <osg/Group>
#include <osg/Node>
#include <osg/StateSet>
#include <osg/ref_ptr>
#include <span>

#include "roam/math.h"

namespace roam::graphics {

/// The define (StateSet::setDefine) of textured surfaces.
inline constexpr const char* textured_define = "ROAM_TEXTURED";

/// As in glTF 2.0, 3.9.2: 0..1 each.
struct Gloss {
  float roughness = 1.0f;  ///< 0: a mirror of the sky and the ground
  float metalness = 0.0f;
};

/// A surface's material. Its colours are those of its vertices.
struct Surface {
  bool textured = false;          ///< with an image on texture unit 0, which the caller sets
  bool blended = false;           ///< over the background, by its opacity
  std::optional<float> cutoff{};  ///< pixels with a smaller opacity are not drawn
  std::optional<Gloss> gloss{};   ///< none: dull, no metal
};

/// Makes geometries below `state` look as `surface` says.
void apply(const Surface& surface, osg::StateSet& state);

/// The group for scenes drawn as described above; up is +z. Every geometry below must have colours and normals. A
/// single zero normal means that each face uses its own. States other than opaque, untextured ones are made by apply().
[[nodiscard]] osg::ref_ptr<osg::Group> make_scene_group();

/// Hides every point p with dot(normal, p) > distance.
struct SectionPlane {
  Vec3 normal{0.0, 0.0, 1.0};  ///< of length 1
  double distance = 0.0;       ///< metres
  bool operator==(const SectionPlane&) const = default;
};

inline constexpr std::size_t most_section_planes = 6;

/// Hides what one of the planes hides, in the frame of the scene group; nothing without planes. Call it between two
/// frames, with at most most_section_planes.
void set_section(osg::Group& scene, std::span<const SectionPlane> planes);

/// A gradient from the ground over the horizon to the zenith, dark enough for white objects and light enough for black
/// ones. It has no bounds.
[[nodiscard]] osg::ref_ptr<osg::Node> make_sky();

}  // namespace roam::graphics
