#pragma once
/// \file
/// OpenSceneGraph nodes made of the plain values that a reader sends.

#include <functional>
#include <memory>
#include <osg/Geometry>
#include <osg/Group>
#include <osg/ref_ptr>
#include <string>

#include "import/display_part.h"
#include "view/page_lod.h"
#include "view/scene_objects.h"

namespace roam::app {

struct TextureQuality {
  float anisotropy = 8.0f;  ///< samples along a surface seen at a flat angle; 1 for software rendering
};

/// Gives a page (DisplayLevel::page) its name for OpenSceneGraph's pager.
using NamePage = std::function<std::string(const std::string& page)>;

/// The nodes of a part, as the scene group of graphics expects them, in the part's frame: the scene's - origin. Its
/// objects are added to `objects`, and those that are hidden there are not drawn; see show_objects. Its pages keep
/// `rules`.
[[nodiscard]] osg::ref_ptr<osg::Group> make_node(const DisplayPart& part, const TextureQuality& quality,
                                                 const NamePage& name_page, SceneObjects& objects,
                                                 const std::shared_ptr<PageRules>& rules);

/// The triangles alone, in the frame of their cell.
[[nodiscard]] osg::ref_ptr<osg::Geometry> make_geometry(const DisplayGeometry& geometry);

}  // namespace roam::app
