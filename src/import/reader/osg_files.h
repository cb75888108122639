#pragma once
/// \file
/// OpenSceneGraph's file reading, kept to the formats that roam reads and to the files of the scene.

#include <filesystem>
#include <osg/Node>
#include <osg/ref_ptr>
#include <string>

#include "import/reader/mesh_sink.h"
#include "import/reader/scene_files.h"

namespace roam::reader {

/// Loads the plugins that a file with this extension may need, and the classes that it may name. An empty extension
/// stands for photogrammetry tiles.
void load_osg_plugins(const std::string& extension);

/// Loads the plugins that decode images.
void load_image_plugins();

/// Lets OpenSceneGraph load nothing more, and find no file but those of the scene. Call it before a file is read.
void close_osg_door();

/// Prepares reading: no images unless they are wanted, no file outside of the scene, no files that read each other
/// without end; each file that is read or missing is reported to `sink`. Call once, before read_osg_file; `sink` and
/// `files` must outlive all reading, and `sink` have parts where images are wanted, because these know where to look.
void prepare_osg(MeshSink& sink, SceneFiles& files, bool images);

/// Reads one file; null when it is absent or unreadable. An absent one counts as a missing page unless it is
/// the `main` one.
[[nodiscard]] osg::ref_ptr<osg::Node> read_osg_file(const std::filesystem::path& path, bool main);

/// Reads a file that was read before, this time with its images, and reports nothing again. They stay wanted.
[[nodiscard]] osg::ref_ptr<osg::Node> read_again_with_images(const std::filesystem::path& path);

/// The last thing that osgDB complained about; empty when it did not.
[[nodiscard]] std::string last_osg_complaint();

}  // namespace roam::reader
