#pragma once
/// \file
/// Loading of OpenSceneGraph's plugins.
///
/// OpenSceneGraph looks for a plugin when the name of a file, or a class in it, requires one. It searches folders that
/// the environment names, and then the current folder. A scene could bring a plugin of its own that way. Therefore load
/// the required plugins first, then close the door.

#include <functional>
#include <osgDB/Options>
#include <string>
#include <string_view>

namespace roam::osg_plugins {

/// Loads osgdb_NAME from the folder of OpenSceneGraph's package, and from nowhere else. Returns whether it is there.
/// Call it before close_door.
bool load(std::string_view name);

/// Finds a file that another file or a plugin names. Returns its path; empty if there is none.
using FindFile = std::function<std::string(const std::string& name, const osgDB::Options* options)>;

/// From now on OpenSceneGraph loads no library in this process, whatever a file names. `find` finds all files.
void close_door(FindFile find);

}  // namespace roam::osg_plugins
