#pragma once
/// \file
/// A scene as it is to be seen, made by the child process roam-reader in OpenSceneGraph's binary format.
///
///     roam::DisplayReport report = roam::read_display(paths, options, [&](roam::DisplayPart&& part) {
///       std::istringstream bytes(part.osgb);
///       auto read = osgDB::Registry::instance()->getReaderWriterForExtension("osgb")->readNode(bytes);
///       give(read.getNode(), part);   // to the thread that draws
///       return !closed;
///     });
///
/// The same readers, options and checks as import_scene: every triangle that it gives is in exactly one part, and
/// nothing else is. Pages are the exception: see below.
///
/// What a part holds. Its root is an osg::Group of osg::MatrixTransforms (pure translations, in doubles) over
/// osg::Geometry nodes of up to 16,384 triangles that lie together, so that what is out of sight is not drawn. Each has
///   - vertices (floats near zero: the transform says where) and one osg::DrawElementsUShort of triangles;
///   - colours per vertex, four normalized bytes: material times vertex colour of the file, white where there is none.
///     There is no osg::Material: textured or not, what is seen is this colour times the texture;
///   - normals per vertex, or none where the file has none;
///   - texture coordinates on unit 0 and a StateSet with an osg::Texture2D on unit 0 whose image is inside the part,
///     or neither;
///   - where it is seen through: GL_BLEND and the transparent bin; where holes are cut by the texture: osg::AlphaFunc
///     and GL_ALPHA_TEST. No other state: no lighting, no culling, no shaders, no blending functions.
/// Vertex buffer objects are on and display lists off. Images have at most 4096 texels a side. Geometry of one texture
/// comes in one part as far as it takes no more than 64 MB, so that a texture is seldom sent twice; a part has about 8
/// MB else.
///
/// Pages. Tiles and OpenSceneGraph files that refer to pages which exist are not opened here but handed on: the part's
/// root is a group of osg::MatrixTransforms (up axis, unit, offset of the folder, minus origin), each over one
/// osg::PagedLOD with an absolute file name, that the viewer's own osgDB::DatabasePager reads. What it reads is as the
/// file has it: materials, any colour binding or none, display lists, StateSets of its own. ImportOptions::ignore does
/// not reach it, which a note says.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "roam/import.h"
#include "roam/math.h"

namespace roam {

/// A piece of a scene, ready to be drawn.
struct DisplayPart {
  std::string osgb;  ///< a file in OpenSceneGraph's binary format, images inside; its coordinates are scene - origin
  Vec3 origin{0.0};  ///< the same in all parts of one read_display
  Box bounds;        ///< of what it holds, in the frame of the scene; of pages as the files state them
  std::uint64_t triangles = 0;  ///< 0 for pages
  bool paged = false;           ///< whether it holds pages
};

/// What there is to be seen and what is missing of it.
struct DisplayReport {
  /// Zero, or, for a scene that begins more than 10 km away from it, a place near its first triangles.
  Vec3 origin{0.0};
  Box bounds;  ///< of all parts, in the frame of the scene
  std::uint64_t parts = 0;
  std::uint64_t triangles = 0;         ///< of all parts; those of pages are not counted
  std::uint64_t textures = 0;          ///< images that were read; those of pages are not counted
  std::uint64_t missing_textures = 0;  ///< images that are absent or unreadable; what they cover is shown without
  std::vector<std::string> missing_texture_files;  ///< at most ImportReport::name_limit
  bool paged = false;                              ///< whether any part holds pages
  /// What import_scene says of the same files, but for `vertices`, which is 0; of pages only what their roots tell.
  /// Its notes also name files of materials that are absent, and images that are shown smaller.
  ImportReport import;
  /// Whole sentences for the user about what is not seen as it should be. What import_scene says of the same files is
  /// in import.notes, not here.
  std::vector<std::string> notes;
};

/// Reads files and folders for showing. Blocks, and calls `take` from the calling thread with each part as it comes;
/// a slow `take` holds the reader up, nothing piles up. When `take` or options.progress returns false, the reader is
/// ended and roam::Cancelled thrown. May be called from several threads at once.
///
/// Throws roam::Error in the cases and with the sentences of import_scene. Parts that came before stay good.
DisplayReport read_display(std::span<const std::filesystem::path> paths, const ImportOptions& options,
                           const std::function<bool(DisplayPart&&)>& take);

}  // namespace roam
