#include "roam/import.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "import/assembler.h"
#include "import/find_reader.h"
#include "import/read_all.h"
#include "math/floating_point.h"

namespace roam {
namespace {

namespace fs = std::filesystem;

struct NamedUnit {
  std::string_view name;
  double metres;
};
constexpr std::array<NamedUnit, 5> units{{{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"ft", 0.3048}, {"in", 0.0254}}};
constexpr std::array<const char*, 6> axes{"x", "y", "z", "-x", "-y", "-z"};

std::uint64_t bytes_of(const std::vector<Mesh>& meshes) {
  std::uint64_t bytes = 0;
  for (const Mesh& mesh : meshes) {
    bytes += mesh.vertices.size() * sizeof(Vec3) + mesh.triangles.size() * sizeof(mesh.triangles[0]);
  }
  return bytes;
}

}  // namespace

const char* to_string(UpAxis up) { return axes[static_cast<std::size_t>(up)]; }

UpAxis parse_up_axis(std::string_view text) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (axes[i] == text) return static_cast<UpAxis>(i);
  }
  throw Error(fmt::format("'{}' is no axis; give x, y, z, -x, -y or -z.", text));
}

LengthUnit parse_length_unit(std::string_view text) {
  for (std::size_t i = 0; i < units.size(); ++i) {
    if (units[i].name == text) return static_cast<LengthUnit>(i);
  }
  throw Error(fmt::format("'{}' is no unit of length; give m, cm, mm, ft or in.", text));
}

double metres_per(LengthUnit unit) { return units[static_cast<std::size_t>(unit)].metres; }

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
