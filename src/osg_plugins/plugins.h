#pragma once
/// \file
/// Which plugins of OpenSceneGraph this process loads.
///
/// OpenSceneGraph looks for a plugin when a file's name, or a class inside a file, calls for one. It looks in folders
/// that the environment names, and at last in the current folder. A scene could bring a plugin of its own that way. So
/// load the plugins that are wanted first, and then close the door.

#include <functional>
#include <osgDB/Options>
#include <string>
#include <string_view>

namespace roam::osg_plugins {

/// Loads osgdb_NAME from the folder where OpenSceneGraph's package keeps its plugins, and from nowhere else. Returns
/// whether it is there. Call it before close_door.
bool load(std::string_view name);

/// Finds a file that another file, or a plugin, names. Returns its path; empty where there is none.
using FindFile = std::function<std::string(const std::string& name, const osgDB::Options* options)>;

/// From now on OpenSceneGraph loads no library in this process, whatever a file names. Files are found by `find`.
void close_door(FindFile find);

}  // namespace roam::osg_plugins
