#pragma once
/// \file
/// How surfaces and sky look.
///
/// One program draws every scene: colour = material x vertex colour x texture, on both sides of every face. The light
/// is made for being inside: a soft lamp at the eye, a sky that is brighter than the ground, and a weak sun, so that
/// floor, walls and ceiling of one colour differ and nothing is black. Photogrammetry (textured, without normals) is
/// shown as it is: its pictures have their light already. Of a wall that is in the model twice, with opposite normals,
/// the side that faces the eye is seen.
///
///     osg::ref_ptr<osg::Group> scene = roam::graphics::make_scene_group();
///     frame.space()->addChild(roam::graphics::make_sky());
///     frame.space()->addChild(scene);
///     roam::graphics::prepare(*node);   // in the loading thread
///     scene->addChild(node);            // between two frames

#include <osg/Group>
#include <osg/Node>
#include <osg/ref_ptr>
#include <osgDB/Registry>

namespace roam::graphics {

/// The group below which scenes are drawn as told above; up is +z. Everything below must have gone through prepare.
[[nodiscard]] osg::ref_ptr<osg::Group> make_scene_group();

/// A quiet gradient from the ground over the horizon to the zenith, dark enough for white things and light enough for
/// black ones. Has no size: it changes no bounds.
[[nodiscard]] osg::ref_ptr<osg::Node> make_sky();

/// Makes a graph fit for the scene group:
///   - geometry without colours becomes white, geometry without normals gets the zero normal, which tells the shader
///     to take the face's own;
///   - states lose what would break the picture: programs, depth functions, culling of back faces, lighting, fog,
///     textures without an image, texture units above 0;
///   - textures that end at their edge do so without the dark seam of OpenGL's old clamping;
///   - a material whose diffuse colour is to be replaced by vertex colours (colour mode) gets a white one.
/// Blending, alpha tests and render bins stay. What is as it should be is not touched, so a graph may be prepared
/// twice, and what several graphs share may be drawn meanwhile once it has been prepared.
///
/// Thread-safe; calls wait for each other. A graph that is being drawn must have been prepared before.
///
/// Parts of roam::read_display need it too: they may lack normals, and pages come as their files have them.
void prepare(osg::Node& graph);

/// A read callback that prepares every node that OpenSceneGraph reads with it. It asks `next` to read when there is
/// one. For scenes with pages give it to osgDB::Registry::setReadFileCallback: the pager does not pass on the
/// osgDB::Options that a scene was read with, so that one in osgDB::Options prepares what is read with these only.
[[nodiscard]] osg::ref_ptr<osgDB::ReadFileCallback> make_preparing_reader(
    osg::ref_ptr<osgDB::ReadFileCallback> next = nullptr);

}  // namespace roam::graphics
