#pragma once
/// \file
/// One function a family of formats. Each reads a whole file or folder into the sink, or throws roam::Error with the
/// file's name and the line or byte at which it is wrong.

#include <filesystem>

#include "import/reader/mesh_sink.h"
#include "import/reader/scene_files.h"

namespace roam::reader {

/// Wavefront OBJ, every digit kept.
void read_obj(const std::filesystem::path& path, MeshSink& sink);
/// STL, ascii and binary, every digit kept.
void read_stl(const std::filesystem::path& path, MeshSink& sink);
/// Stanford PLY, ascii and binary of both byte orders, every digit kept.
void read_ply(const std::filesystem::path& path, MeshSink& sink);

/// What OpenSceneGraph reads: ive, osg, osgb, osgt, 3ds, flt, ac and what else its plugins know.
void read_osg(const std::filesystem::path& path, SceneFiles& files, MeshSink& sink);
/// A folder of photogrammetry tiles.
void read_tiles(const std::filesystem::path& folder, SceneFiles& files, MeshSink& sink,
                const ReadingSettings& settings);

/// What assimp reads and the others do not: glb, gltf, fbx, ifc and others. `extension` is lower case without the dot.
void read_assimp(const std::filesystem::path& path, const std::string& extension, SceneFiles& files, MeshSink& sink);

/// Reports the files that a .gltf file names as its buffers, in the order of their names. Reads the text once and keeps
/// nothing of it.
void list_gltf_buffers(const std::filesystem::path& path, SceneFiles& files, MeshSink& sink);

}  // namespace roam::reader
