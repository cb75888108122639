#pragma once
/// \file
/// How surfaces and sky look.
///
/// One program draws every scene: colour = vertex colour x texture, on both sides of every face. The light
/// is made for being inside: a soft lamp at the eye, a sky that is brighter than the ground, and a weak sun, so that
/// floor, walls and ceiling of one colour differ and nothing is black. Photogrammetry (textured, without normals) is
/// shown as it is: its pictures have their light already. Of a wall that is in the model twice, with opposite normals,
/// the side that faces the eye is seen.
///
///     osg::ref_ptr<osg::Group> scene = roam::graphics::make_scene_group();
///     frame.space()->addChild(roam::graphics::make_sky());
///     frame.space()->addChild(scene);
///     scene->addChild(node);   // between two frames

#include <osg/Group>
#include <osg/Node>
#include <osg/ref_ptr>

namespace roam::graphics {

/// Said (StateSet::setDefine) of what has a texture on unit 0.
inline constexpr const char* textured_define = "ROAM_TEXTURED";

/// The group below which scenes are drawn as told above; up is +z. Every geometry below has colours, and normals; one
/// zero normal for all says to take each face's own. States say no more than a texture on unit 0, with textured_define,
/// blending and an alpha test.
[[nodiscard]] osg::ref_ptr<osg::Group> make_scene_group();

/// A quiet gradient from the ground over the horizon to the zenith, dark enough for white things and light enough for
/// black ones. Has no size: it changes no bounds.
[[nodiscard]] osg::ref_ptr<osg::Node> make_sky();

}  // namespace roam::graphics
