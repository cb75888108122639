#include "roam/import.h"

#include <algorithm>

#include "files/extension.h"
#include "import/assembler.h"
#include "import/find_reader.h"
#include "import/read_all.h"
#include "math/floating_point.h"

namespace roam {
namespace {

namespace fs = std::filesystem;

std::uint64_t bytes_of(const std::vector<Mesh>& meshes) {
  std::uint64_t bytes = 0;
  for (const Mesh& mesh : meshes) {
    bytes += mesh.vertices.size() * sizeof(Vec3) + mesh.triangles.size() * sizeof(mesh.triangles[0]);
  }
  return bytes;
}

}  // namespace

std::optional<SceneFrame> frame_of(std::span<const fs::path> paths, const ImportOptions& options) {
  if (options.up) return SceneFrame{*options.up, options.unit};
  const auto is_gltf = [](const fs::path& path) {
    const std::string extension = files::lower_extension(path);
    return extension == ".gltf" || extension == ".glb";
  };
  const auto count = std::count_if(paths.begin(), paths.end(), is_gltf);
  if (count == 0) return SceneFrame{UpAxis::z, options.unit};
  if (static_cast<std::size_t>(count) == paths.size()) return SceneFrame{UpAxis::y, options.unit};
  return std::nullopt;
}

Confinement reader_confinement(const ImportOptions& options) {
  return reader::confinement_of(reader::find_reader(options.reader));
}

ImportedScene import_scene(std::span<const fs::path> paths, const ImportOptions& options) {
  const DefaultFloatingPoint guard;
  ImportedScene scene;
  reader::read_all(
      reader::sources(paths), options, scene.report, [&](reader::Reading& reading, std::vector<bool>& matched) {
        const std::uint64_t triangles_before = scene.report.triangles;
        const std::uint64_t mesh_bytes = options.memory_limit - std::min(options.memory_limit, bytes_of(scene.meshes));
        reader::Assembler assembler(scene, options.ignore.size(), mesh_bytes);
        reader::read_one(reading, assembler, matched);
        return scene.report.triangles > triangles_before;
      });
  return scene;
}

ImportedScene import_scene(std::initializer_list<fs::path> paths, const ImportOptions& options) {
  return import_scene(std::span(paths.begin(), paths.size()), options);
}

ImportedScene import_scene(const fs::path& path, const ImportOptions& options) {
  return import_scene(std::span(&path, 1), options);
}

}  // namespace roam
