#pragma once
/// \file
/// Triangles out of other people's files.
///
///     const roam::ImportedScene scene = roam::import_scene("mine.dae");
///     const roam::World world = roam::World::build(scene.meshes);
///     for (const std::string& note : scene.report.notes) std::cerr << note << "\n";
///
/// Library target roam::import. It links no reader: files are opened by the program `roam-reader`, which runs as a
/// child with limits on memory and time and answers through a pipe. A file that makes a reader crash, hang or eat
/// memory therefore costs a roam::Error, not the program. docs/importing.md lists the formats and what is kept.
///
/// The reader is looked for at: ImportOptions::reader; the environment variable ROAM_READER; `roam-reader` beside the
/// running program; `../libexec/roam/roam-reader` from there; the place it was installed to (as configured, and as the
/// package is now); `../libexec/roam` from the folders of PATH.
///
/// Coordinates are those of the file. Nothing is shifted, rotated or scaled unless ImportOptions say so, with two
/// exceptions: glTF, whose y axis is up by definition, is turned so that +z is up; and a second folder of
/// photogrammetry tiles is placed relative to the first by the difference of their SRSOrigins, which a note tells.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/mesh.h"

namespace roam {

/// The axis of a file that points up. Reading turns it to +z by a proper rotation:
/// x: (x, y, z) -> (-z, y, x);  y: (x, y, z) -> (x, -z, y);  z: as it is.
enum class UpAxis : std::uint8_t { x, y, z };
/// The length of 1 in a file: metre, centimetre, millimetre, international foot (0.3048 m), inch (0.0254 m).
enum class LengthUnit : std::uint8_t { m, cm, mm, ft, in };

/// "x", "y" or "z"; anything else throws roam::Error.
[[nodiscard]] UpAxis parse_up_axis(std::string_view text);
/// "m", "cm", "mm", "ft" or "in"; anything else throws roam::Error.
[[nodiscard]] LengthUnit parse_length_unit(std::string_view text);
/// How many metres one unit is; exact.
[[nodiscard]] double metres_per(LengthUnit unit);

/// How far an import has come.
struct ImportProgress {
  std::filesystem::path path;     ///< the file or folder being read, as it was passed
  std::uint64_t bytes_read = 0;   ///< of bytes_total; stands still while a foreign reader works on one large file
  std::uint64_t bytes_total = 0;  ///< size of all files and folders that were passed; grows while they are counted
  std::uint64_t triangles = 0;    ///< received so far
};

/// What an import may be told. The defaults suit files in metres with z up.
struct ImportOptions {
  std::optional<UpAxis> up{};       ///< unset: y for glTF, z for everything else
  LengthUnit unit = LengthUnit::m;  ///< multiplies every coordinate by metres_per(unit)
  /// Leaves out objects whose name, or an ancestor's, matches one of these shell patterns (fnmatch: * ? [a-z], case
  /// counts, * matches / too). Names are those of Mesh::name: of what has none in its file, the file's without its
  /// extension ("dungeon" of dungeon.ply).
  std::vector<std::string> ignore{};
  std::uint64_t memory_limit = 8ull << 30;  ///< bytes, >= 64 MiB: of the reader's memory, and of the meshes it sends
  double silence_limit = 120.0;  ///< seconds, > 0: a reader that reports nothing for so long, plus 1 s for each 4 MB
                                 ///< of its file, has hung and is ended; so is one that has not read the file
                                 ///< after five times as long, plus 1 s for each 33 kB that it has read
  /// Folders that files of the scene may refer to, besides the one that the scene's file lies in, or that is the scene.
  /// References that lead elsewhere are left out and counted (ImportReport::outside_references).
  std::vector<std::filesystem::path> allow{};
  std::filesystem::path reader{};  ///< the program roam-reader; empty: looked for as told above
  /// Called from the calling thread at least twice a second. Returning false ends the reader and throws Cancelled.
  std::function<bool(const ImportProgress&)> progress{};
};

/// An object that was left out as a whole or in part.
struct LeftOutObject {
  std::string name;
  std::uint64_t vertices = 0;   ///< that are not finite or beyond coordinate_limit (1e9 m); 0 where ignored
  std::uint64_t triangles = 0;  ///< that had such a corner, or that belong to an ignored object
};

/// Where the scene's frame lies in the world, as metadata.xml of the first folder of tiles says: world = scene +
/// origin.
struct Georeference {
  std::string srs;  ///< spatial reference system, e.g. "EPSG:32632" or "ENU:46.2,8.1"
  Vec3 origin{0.0};
};

/// The walls around the process that reads files, as far as the kernel has them. SECURITY.md says what each one
/// stops.
struct Confinement {
  int landlock = 0;                ///< version of Landlock that keeps it to the scene's files; 0: the kernel has none
  bool system_calls = false;       ///< seccomp: no program, process, network or change of a file; no code comes in
  bool no_new_privileges = false;  ///< no_new_privs
  bool limits = false;             ///< memory, file size, descriptors
  bool empty_folder = false;       ///< its current folder is empty and stays so
};

/// What was read and what was not. Lists of names stop at name_limit entries; counts do not.
struct ImportReport {
  static constexpr std::size_t name_limit = 100;

  std::uint64_t files = 0;                 ///< that were opened and read, pages and external references included
  std::uint64_t vertices = 0;              ///< of all meshes
  std::uint64_t triangles = 0;             ///< of all meshes
  std::uint64_t bad_vertices = 0;          ///< left out: not finite, or beyond 1e9 m
  std::uint64_t bad_triangles = 0;         ///< left out: they have a bad vertex, or an index beyond the vertices
  std::uint64_t ignored_triangles = 0;     ///< left out by ImportOptions::ignore
  std::uint64_t missing_pages = 0;         ///< files that a scene refers to and that are absent or unreadable
  std::uint64_t outside_references = 0;    ///< left out: they lead out of the scene's folder; see ImportOptions::allow
  std::optional<Confinement> confinement;  ///< of the reader; of several readers the parts that all of them had
  std::vector<LeftOutObject> bad_objects;
  std::vector<LeftOutObject> ignored_objects;
  std::vector<std::string> missing_page_files;
  std::vector<std::string> outside_files;
  std::optional<Georeference> georeference;
  /// Whole sentences for the user: everything above that is not as it should be, an up axis or unit that the file
  /// states and that was not applied, patterns of `ignore` that matched nothing. Empty when all is well.
  std::vector<std::string> notes;
};

/// What was imported. Meshes come in the order of the paths and, within one, of the file; their triangles in the order
/// of the file, polygons fanned from their first corner, quads as 0,1,2 and 0,2,3. Points and segments are kept.
struct ImportedScene {
  std::vector<Mesh> meshes;
  ImportReport report;
};

/// Reads files and folders (a folder of photogrammetry: the one that holds Data/Tile_*/Tile_*.osgb) into one scene.
/// The same input gives the same bits (except for damaged files in which a foreign reader reads beyond its data).
/// Blocks; may be called from several threads at once, each with its own reader.
///
/// Throws roam::Error when a path is missing, of no known format, malformed, gives no triangle, makes its reader
/// crash, or needs more memory or time than allowed; the message names the file, the cause and what to do.
/// Throws roam::Cancelled when the progress callback says so. No child process is left behind either way.
[[nodiscard]] ImportedScene import_scene(std::span<const std::filesystem::path> paths, const ImportOptions& options = {});

/// The same for a list that is written out: import_scene({"mine.dae", "shaft.obj"}).
[[nodiscard]] ImportedScene import_scene(std::initializer_list<std::filesystem::path> paths, const ImportOptions& options = {});

/// The same for one path.
[[nodiscard]] ImportedScene import_scene(const std::filesystem::path& path, const ImportOptions& options = {});

/// Takes a scene piece by piece, in the order of import_scene: at most piece_triangles triangles and the vertices that
/// they use. `continues`: the piece goes on with the object of the piece before. The mesh is only valid during the
/// call. Exceptions pass through, and end the reader.
using PieceSink = std::function<void(const Mesh& piece, bool continues)>;
inline constexpr std::uint64_t piece_triangles = 65'536;

/// The same triangles as import_scene, in the same order, in bounded memory: this process and its reader together take
/// no more than options.memory_limit (>= 64 MiB), however large an OBJ, PLY or STL file, or a folder of tiles, is.
/// What does not fit the reader's memory it keeps in unnamed files in the folder for temporary files (TMPDIR, else
/// /tmp); roam::Error says when there is no room. Formats that only foreign readers read (glTF, Collada, FBX, IFC,
/// single files of OpenSceneGraph) must fit, and throw roam::Error as import_scene does where they do not.
///
/// Where a piece ends depends on the triangles alone, so that the pieces are the same for any memory and on any
/// machine. The report is that of import_scene but for `vertices`, which counts those of the pieces: what two pieces
/// share, each has. Throws what import_scene throws; pieces that came before stay good.
ImportReport stream_scene(std::span<const std::filesystem::path> paths, const ImportOptions& options,
                          const PieceSink& sink);

/// A part of a scene that can be read on its own: a file, or one tile (Data/Tile_x/Tile_x.osgb and its pages) of a
/// folder of photogrammetry. The parts of a scene, one after the other, are the scene.
struct ScenePart {
  std::string name;                     ///< unique among the parts, the same wherever the scene's folders lie; UTF-8,
                                        ///< in which %XX stands for a byte of a file's name that is none
  std::filesystem::path path;           ///< as it was passed to scene_parts
  std::string tile;                     ///< name of the tile in the folder; empty for a file
  std::optional<Georeference> frame{};  ///< of the first folder, into which this part is placed
  /// What the part is read from, as far as one can tell without reading: absolute, sorted; of a tile all files of its
  /// own folder and last metadata.xml, which says where it lies; empty where the tile is missing.
  std::vector<std::filesystem::path> files{};
  std::uint64_t bytes = 0;  ///< of these files
};

/// The parts of a scene, in order: the paths', and within a folder first the tiles whose root is missing, which have no
/// files, then the others by name. Opens no scene file but reads folders and their metadata.xml; options.progress ends
/// it by false. Throws as import_scene does for missing paths, unknown formats, folders in different reference systems.
[[nodiscard]] std::vector<ScenePart> scene_parts(std::span<const std::filesystem::path> paths,
                                                 const ImportOptions& options = {});

/// Reads one part, with a reader of its own. A tile that is missing, or has no triangle, gives no piece and is no
/// error; the report counts the missing page. Of a tile it is not said which patterns of ImportOptions::ignore match
/// nothing.
ImportReport stream_part(const ScenePart& part, const ImportOptions& options, const PieceSink& sink);

/// The walls that hold on this machine, as a reader says that reads nothing. Throws roam::Error when it cannot be run.
[[nodiscard]] Confinement reader_confinement(const ImportOptions& options = {});

/// Tells the library where the package that the program was built with keeps its reader. Called by this header itself
/// in programs that find_package(roam) built; nothing to call by hand.
bool know_package_reader(const char* program) noexcept;

#ifdef ROAM_PACKAGE_READER
[[maybe_unused]] static const bool package_reader_is_known = know_package_reader(ROAM_PACKAGE_READER);
#endif

}  // namespace roam
