#pragma once
/// \file
/// OpenSceneGraph's file reading, kept to geometry on local disks.

#include <filesystem>
#include <osg/Node>
#include <osg/ref_ptr>

#include "import/reader/mesh_sink.h"

namespace roam::reader {

/// Prepares osgDB for this process: no images unless they are wanted, no files from networks, no files that read each
/// other without end; each file that is read or missing is told to `sink`. Call once, before read_osg_file; `sink`
/// must outlive all reading, and have parts where images are wanted, because these know where to look.
void prepare_osg(MeshSink& sink, bool images);

/// Reads one file; null when it is absent or unreadable. An absent one counts as a missing page unless it is
/// the `main` one.
[[nodiscard]] osg::ref_ptr<osg::Node> read_osg_file(const std::filesystem::path& path, bool main);

/// Reads a file that was read before, this time with its images, and tells nobody again. They stay wanted.
[[nodiscard]] osg::ref_ptr<osg::Node> read_again_with_images(const std::filesystem::path& path);

/// The last thing that osgDB complained about; empty when it did not.
[[nodiscard]] std::string last_osg_complaint();

}  // namespace roam::reader
