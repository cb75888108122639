#pragma once
/// \file
/// What is drawn of the plain values that a reader sends.

#include <functional>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/ref_ptr>
#include <string>

#include "import/display_part.h"

namespace roam::app {

/// How images are drawn.
struct TextureQuality {
  float anisotropy = 8.0f;  ///< samples along a surface that is seen at a flat angle; 1 where the processor draws
};

/// Gives a page (DisplayLevel::page) the name by which OpenSceneGraph's pager asks for it.
using NamePage = std::function<std::string(const std::string& page)>;

/// The nodes of a part, as the scene group of graphics wants them. It has the part's frame: the scene's - origin.
[[nodiscard]] osg::ref_ptr<osg::Group> make_node(const DisplayPart& part, const TextureQuality& quality,
                                                 const NamePage& name_page);

/// The triangles alone, in the frame of their cell.
[[nodiscard]] osg::ref_ptr<osg::Geometry> make_geometry(const DisplayGeometry& geometry);

}  // namespace roam::app
