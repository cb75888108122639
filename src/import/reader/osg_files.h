#pragma once
/// \file
/// File reading of OpenSceneGraph, restricted to the formats of roam and the files of the scene.

#include <filesystem>
#include <osg/Node>
#include <osg/ref_ptr>
#include <string>

#include "import/reader/mesh_sink.h"
#include "import/reader/scene_files.h"

namespace roam::reader {

/// Loads the plugins and classes that a file with this extension may need. An empty extension means photogrammetry
/// tiles.
void load_osg_plugins(const std::string& extension);

/// Loads the plugins that decode images.
void load_image_plugins();

/// From now on OpenSceneGraph loads no library and finds only the scene's files. Call it before reading a file.
void close_osg_door();

/// Prepares reading: reads no images unless `images`, no files outside of the scene, and no circles of files. Reports
/// each file that is read or missing to `sink`. Call it once before read_osg_file. `sink` and `files` must outlive all
/// reading. With `images`, `sink` must have parts, which find the images.
void prepare_osg(MeshSink& sink, SceneFiles& files, bool images);

/// Reads one file, and those of its proxies; null if it is absent or unreadable. An absent file counts as a missing
/// page unless it is the `main` one.
[[nodiscard]] osg::ref_ptr<osg::Node> read_osg_file(const std::filesystem::path& path, bool main);

/// The same, but reports nothing: for files that are also read by read_osg_file.
[[nodiscard]] osg::ref_ptr<osg::Node> read_osg_file_quietly(const std::filesystem::path& path);

/// Reads a file for the second time, with its images, without reporting anything again. Later files have images too.
[[nodiscard]] osg::ref_ptr<osg::Node> read_again_with_images(const std::filesystem::path& path);

/// The last message of osgDB about a failure; empty if there was none.
[[nodiscard]] std::string last_osg_complaint();

}  // namespace roam::reader
