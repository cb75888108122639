#pragma once
/// \file
/// One function for each family of formats. Each reads a whole file or folder into the sink. It throws roam::Error with
/// the file's name and the line or byte of the fault.

#include <filesystem>

#include "import/reader/mesh_sink.h"
#include "import/reader/scene_files.h"

namespace roam::reader {

/// Wavefront OBJ, in full precision.
void read_obj(const std::filesystem::path& path, MeshSink& sink);
/// STL, ASCII and binary, in full precision.
void read_stl(const std::filesystem::path& path, MeshSink& sink);
/// Stanford PLY, ASCII and binary in both byte orders, in full precision.
void read_ply(const std::filesystem::path& path, MeshSink& sink);

/// Formats of OpenSceneGraph: ive, osg, osgb, osgt, 3ds, flt, ac and others with a plugin.
void read_osg(const std::filesystem::path& path, SceneFiles& files, MeshSink& sink);
/// A folder of photogrammetry tiles.
void read_tiles(const std::filesystem::path& folder, SceneFiles& files, MeshSink& sink,
                const ReadingSettings& settings);

/// glTF, plain or compressed. Version 2.0 is read here, 1.0 by assimp. `extension` is that of read_assimp.
void read_gltf(const std::filesystem::path& path, const std::string& extension, SceneFiles& files, MeshSink& sink);
/// 3D Tiles: a tileset.json, the folder that holds it, or one tile (b3dm, i3dm, cmpt).
void read_tileset(const std::filesystem::path& path, SceneFiles& files, MeshSink& sink,
                  const ReadingSettings& settings);

/// Formats that only assimp reads: fbx, ifc and others, and glTF 1.0. `extension` is lower case without the dot.
void read_assimp(const std::filesystem::path& path, const std::string& extension, SceneFiles& files, MeshSink& sink);

}  // namespace roam::reader
