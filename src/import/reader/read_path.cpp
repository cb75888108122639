#include "import/reader/read_path.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "import/reader/file_bytes.h"
#include "import/reader/file_names.h"
#include "import/reader/format_table.h"
#include "import/reader/formats.h"
#include "import/reader/osg_files.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// A format that users may try, with advice.
struct Unsupported {
  std::string_view extension;
  std::string_view advice;
};
constexpr std::array<Unsupported, 9> unsupported{
    {{"pnts", "point clouds have no surface; make a mesh of it first"},
     {"tif", "elevation rasters are not read yet; convert it to a mesh in OBJ or PLY"},
     {"tiff", "elevation rasters are not read yet; convert it to a mesh in OBJ or PLY"},
     {"las", "point clouds have no surface; make a mesh of it first"},
     {"laz", "point clouds have no surface; make a mesh of it first"},
     {"e57", "point clouds have no surface; make a mesh of it first"},
     {"gml", "CityGML is not read yet; convert it to glTF, OBJ or PLY"},
     {"rvt", "Revit's own format is closed; export IFC or FBX from it"},
     {"dwg", "AutoCAD's own format is closed; export DXF or FBX from it"}}};

std::string known_extensions() {
  std::string list;
  for (const Format& format : formats) list += (list.empty() ? "" : ", ") + std::string(format.extension);
  return list;
}

/// Refuses stand-ins for files, such as pointers of Git LFS, which no reader needs to see.
void refuse_stand_ins(const fs::path& path) {
  FileBytes bytes(path, [](std::uint64_t) {});
  constexpr std::string_view lfs_pointer = "version https://git-lfs.github.com/spec/";
  const std::string_view start = bytes.window(lfs_pointer.size());
  if (start.empty()) throw Error(path.string(), "this file is empty; copy or export it again.");
  if (start.starts_with(lfs_pointer)) {
    throw Error(path.string(),
                "this is a Git LFS pointer, not the file itself; run 'git lfs pull' in the clone that it comes from.");
  }
}

/// The tileset in a folder that is no folder of OSGB tiles; empty if there is none.
fs::path tileset_in(const fs::path& folder) {
  std::error_code none;
  const fs::path tileset = folder / "tileset.json";
  const bool is_tileset =
      !fs::exists(fs::symlink_status(folder / "Data", none)) && fs::is_regular_file(fs::symlink_status(tileset, none));
  return is_tileset ? tileset : fs::path();
}

/// The tileset at the root of an archive. Throws if there is none. For a part of it nothing is searched, so that the
/// directory of the archive need not be read.
fs::path tileset_in_archive(const fs::path& archive, const SceneFiles& files, bool is_part) {
  fs::path tileset = archive / "tileset.json";
  if (is_part || !files.find(tileset).empty()) return tileset;
  throw Error(archive.string(),
              "this archive has no tileset.json at its root, so it is none of 3D Tiles; unpack it, and give the scene "
              "in it.");
}

}  // namespace

void load_libraries(const std::string& name, bool images) {
  const fs::path path(name);
  std::error_code none;
  const bool folder = fs::is_directory(path, none);
  const Format* format = folder ? nullptr : format_of(extension_of(path));
  const bool osg = (folder && tileset_in(path).empty()) || (format != nullptr && format->family == Family::osg);
  if (osg) load_osg_plugins(folder ? "" : extension_of(path));
  if (images) load_image_plugins();
  if (osg || images) close_osg_door();
}

void read_path(const std::string& name, SceneFiles& files, MeshSink& sink, const ReadingSettings& settings) {
  const fs::path path(name);
  if (fs::is_directory(path)) {
    const fs::path tileset = tileset_in(path);
    return tileset.empty() ? read_tiles(path, files, sink, settings) : read_tileset(tileset, files, sink, settings);
  }
  // A part of a tileset depends on its content and its place, not on the tileset's other tiles.
  const bool is_part = !settings.tile.empty();
  if ((is_part ? files.find(path) : files.open(path)).empty()) {
    throw Error(name, "this is not a file that can be read; a scene is a file or a folder.");
  }
  refuse_stand_ins(path);
  const std::string extension = extension_of(path);
  if (const Format* format = format_of(extension)) {
    if (is_archive_name(path)) return read_tileset(tileset_in_archive(path, files, is_part), files, sink, settings);
    if (format->family == Family::tileset) return read_tileset(path, files, sink, settings);
    if (settings.only_list) return;
    // The library of Inventor opens the files that a scene names by itself.
    if (extension == "iv") files.report_unseen();
    switch (format->family) {
      case Family::obj:
        return read_obj(path, sink);
      case Family::stl:
        return read_stl(path, sink);
      case Family::ply:
        return read_ply(path, sink);
      case Family::osg:
        return read_osg(path, files, sink);
      case Family::gltf:
        return read_gltf(path, extension, files, sink);
      case Family::assimp:
        return read_assimp(path, extension, files, sink);
      case Family::tileset:
        break;
    }
  }
  for (const Unsupported& format : unsupported) {
    if (format.extension == extension) throw Error(name, fmt::format("{}.", format.advice));
  }
  throw Error(name,
              fmt::format("roam knows no reader for '.{}' files. It reads {}, and folders of OSGB tiles or 3D Tiles.",
                          extension, known_extensions()));
}

}  // namespace roam::reader
