#pragma once
/// \file
/// Import of scene files: triangles out of OBJ, PLY, STL, glTF, 3D Tiles, FBX, IFC, OpenSceneGraph files and more.
///
///     const roam::ImportedScene scene = roam::import_scene("mine.dae");
///     const roam::World world = roam::World::build(scene.meshes);
///     for (const std::string& note : scene.report.notes) std::cerr << note << "\n";
///
/// Target roam::import. The child process `roam-reader` parses the files behind limits on memory, time and rights
/// (SECURITY.md). A file that makes it crash or hang costs a roam::Error, not the program. docs/importing.md lists the
/// formats.
///
/// The reader is looked for in this order: ImportOptions::reader; the environment variable ROAM_READER; beside the
/// running program; in `../libexec/roam` from there; in the folder of its installation; in `../libexec/roam` from the
/// folders of PATH.
///
/// Coordinates are those of the file, except that glTF is turned from y up to z up, a second folder of photogrammetry
/// tiles is shifted into the frame of the first by their SRSOrigins, and Earth-centred 3D Tiles are moved to a local
/// frame. ImportOptions can turn and scale.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/mesh.h"
#include "roam/scene_frame.h"

namespace roam {

/// Progress of an import.
struct ImportProgress {
  std::filesystem::path path;     ///< the file or folder being read, as passed
  std::uint64_t bytes_read = 0;   ///< of bytes_total
  std::uint64_t bytes_total = 0;  ///< of all files; grows while they are counted
  std::uint64_t triangles = 0;    ///< received so far
};

/// Options of an import. The defaults suit files in metres with z up.
struct ImportOptions {
  std::optional<UpAxis> up{};       ///< unset: y for glTF, z for everything else
  LengthUnit unit = LengthUnit::m;  ///< coordinates are multiplied by metres_per(unit)
  bool through_link = true;         ///< whether a path itself may be a symbolic link; the folders above always may
  /// Shell patterns (fnmatch; case counts, * matches / too). Objects are left out if their Mesh::name or an ancestor's
  /// name matches. An object without a name has the file's name without its extension.
  std::vector<std::string> ignore{};
  std::uint64_t memory_limit = 8ull << 30;  ///< bytes, >= least_memory: of the reader, and of the meshes it sends
  /// Seconds, > 0. A reader is ended if it reports nothing for so long, plus 1 s for each 4 MB of its file; or if it is
  /// not done after five times as long, plus 1 s for each 33 kB that it has read.
  double silence_limit = 120.0;
  /// Folders that the scene may refer to, besides its own. References that lead elsewhere are left out and counted in
  /// ImportReport::outside_references.
  std::vector<std::filesystem::path> allow{};
  std::filesystem::path reader{};  ///< the program roam-reader; empty: looked for as above
  /// Called from the calling thread at least twice a second. Returning false ends the reader and throws Cancelled.
  std::function<bool(const ImportProgress&)> progress{};
  static constexpr std::uint64_t least_memory = 64ull << 20;
};

/// The frame of a scene: that of the options; without ImportOptions::up, y is up in glTF and z in every other format.
/// None if the formats of `paths` differ in this. Reads no file.
[[nodiscard]] std::optional<SceneFrame> frame_of(std::span<const std::filesystem::path> paths,
                                                 const ImportOptions& options = {});

/// An object that was left out, wholly or partly.
struct LeftOutObject {
  std::string name;
  std::uint64_t vertices = 0;   ///< not finite, or beyond coordinate_limit (1e9 m); 0 for an ignored object
  std::uint64_t triangles = 0;  ///< with such a vertex, or of an ignored object
};

/// Place of the scene on the Earth: position in `srs` = position in the scene + origin. From metadata.xml of the first
/// folder of tiles, or the local frame of the first Earth-centred tileset.
struct Georeference {
  std::string srs;  ///< spatial reference system, e.g. "EPSG:32632" or "ENU:46.2,8.1"
  Vec3 origin{0.0};
};

/// The walls around a reader that this kernel supports. SECURITY.md describes each.
struct Confinement {
  int landlock = 0;                ///< ABI version of Landlock; 0: not supported
  bool system_calls = false;       ///< seccomp
  bool no_new_privileges = false;  ///< no_new_privs
  bool limits = false;             ///< memory, file size, descriptors
  bool empty_folder = false;       ///< its current folder is empty
};

/// Result of an import: counts, and everything left out. Lists have at most name_limit entries; counts are complete.
struct ImportReport {
  static constexpr std::size_t name_limit = 100;

  std::uint64_t files = 0;                 ///< opened and read, with pages and references
  std::uint64_t vertices = 0;              ///< of all meshes
  std::uint64_t triangles = 0;             ///< of all meshes
  std::uint64_t bad_vertices = 0;          ///< left out: not finite, or beyond 1e9 m
  std::uint64_t bad_triangles = 0;         ///< left out: with a bad vertex, or an index out of range
  std::uint64_t ignored_triangles = 0;     ///< left out by ImportOptions::ignore
  std::uint64_t missing_pages = 0;         ///< files that the scene refers to and that are absent or unreadable
  std::uint64_t outside_references = 0;    ///< left out; see ImportOptions::allow
  std::optional<Confinement> confinement;  ///< of the reader; with several readers, those that all had
  std::vector<LeftOutObject> bad_objects;
  std::vector<LeftOutObject> ignored_objects;
  std::vector<std::string> missing_page_files;
  std::vector<std::string> outside_files;
  std::optional<Georeference> georeference;
  std::optional<LengthUnit> stated_unit;  ///< that the first file to state one states, and that was not applied
  /// Sentences for the user: about parts left out, an up axis or unit that the file states and that was not applied,
  /// patterns of `ignore` that matched nothing. Empty if all is well.
  std::vector<std::string> notes;
};

/// An imported scene. Meshes and triangles are in the order of the paths and files. Polygons are fans around their
/// first corner: a quad is 0,1,2 and 0,2,3. Triangles that are points or line segments are kept.
struct ImportedScene {
  std::vector<Mesh> meshes;
  ImportReport report;
};

/// Reads files and folders into one scene. A folder of photogrammetry is the one that holds Data/Tile_*/Tile_*.osgb.
/// Blocks. Thread-safe: each call has a reader of its own. The same input gives the same bits.
///
/// Throws roam::Error if a path is missing, of no known format, malformed, without triangles, crashes its reader, or
/// needs more memory or time than allowed. The message names the file, the cause and what to do. Throws roam::Cancelled
/// if `progress` returns false. No child process is left behind.
[[nodiscard]] ImportedScene import_scene(std::span<const std::filesystem::path> paths,
                                         const ImportOptions& options = {});

/// As above: import_scene({"mine.dae", "shaft.obj"}).
[[nodiscard]] ImportedScene import_scene(std::initializer_list<std::filesystem::path> paths,
                                         const ImportOptions& options = {});
/// As above, for one path.
[[nodiscard]] ImportedScene import_scene(const std::filesystem::path& path, const ImportOptions& options = {});

/// Receives a scene piece by piece, in the order of import_scene. A piece has at most piece_triangles triangles, and
/// the vertices that they use. `continues`: it belongs to the object of the piece before. The mesh is valid only during
/// the call. Exceptions end the reader and pass through.
using PieceSink = std::function<void(const Mesh& piece, bool continues)>;
inline constexpr std::uint64_t piece_triangles = 65'536;

/// Reads the same triangles as import_scene, in the same order, in bounded memory. This process and its reader together
/// take at most options.memory_limit for OBJ, PLY and STL files and folders of tiles of any size; the reader keeps the
/// rest in unnamed files in TMPDIR or /tmp. Other formats must fit into memory_limit.
///
/// Pieces are the same for any memory_limit and machine. The report is that of import_scene, except that `vertices`
/// counts a vertex once per piece that uses it. Throws as import_scene does; earlier pieces stay valid.
ImportReport stream_scene(std::span<const std::filesystem::path> paths, const ImportOptions& options,
                          const PieceSink& sink);

/// The walls that hold on this machine, reported by a reader. Throws roam::Error if the reader cannot be run.
[[nodiscard]] Confinement reader_confinement(const ImportOptions& options = {});

/// Not for users: this header calls it in programs built with find_package(roam), so that their reader is found.
bool know_package_reader(const char* program) noexcept;

#ifdef ROAM_PACKAGE_READER
[[maybe_unused]] static const bool package_reader_is_known = know_package_reader(ROAM_PACKAGE_READER);
#endif

}  // namespace roam
