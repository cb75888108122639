#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <unordered_map>

#include "roam/import.h"

namespace roam {
namespace {

namespace fs = std::filesystem;

void cut(const Mesh& mesh, const PieceSink& sink) {
  Mesh piece;
  piece.name = mesh.name;
  for (std::size_t begin = 0; begin < mesh.triangles.size(); begin += piece_triangles) {
    const std::size_t end = std::min<std::size_t>(mesh.triangles.size(), begin + piece_triangles);
    std::unordered_map<std::uint32_t, std::uint32_t> index;
    piece.vertices.clear();
    piece.triangles.clear();
    for (std::size_t i = begin; i < end; ++i) {
      std::array<std::uint32_t, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto [at, added] = index.emplace(mesh.triangles[i][k], static_cast<std::uint32_t>(piece.vertices.size()));
        if (added) piece.vertices.push_back(mesh.vertices[mesh.triangles[i][k]]);
        corners[k] = at->second;
      }
      piece.triangles.push_back(corners);
    }
    sink(piece, begin > 0);
  }
}

}  // namespace

ImportReport stream_scene(std::span<const fs::path> paths, const ImportOptions& options, const PieceSink& sink) {
  const Scene scene = import_scene(paths, options);
  for (const Mesh& mesh : scene.meshes) cut(mesh, sink);
  return scene.report;
}

std::vector<ScenePart> scene_parts(std::span<const fs::path> paths, const ImportOptions&) {
  std::vector<ScenePart> parts;
  std::set<std::string> names;
  for (const fs::path& path : paths) {
    if (!fs::exists(path)) throw Error(path.string() + ": there is no such file or folder. Check the spelling.");
    const fs::path name = fs::absolute(path).lexically_normal();
    const std::string own = (name.has_filename() ? name : name.parent_path()).filename().string();
    ScenePart part;
    part.path = path;
    const auto add = [&](const std::string& wished) {
      part.name = wished;
      for (int i = 2; !names.insert(part.name).second; ++i) part.name = fmt::format("{} ({})", wished, i);
      part.bytes = 0;
      for (const fs::path& file : part.files) part.bytes += fs::file_size(file);
      parts.push_back(part);
    };
    if (!fs::is_directory(path)) {
      part.files = {path};
      add(own);
      continue;
    }
    std::vector<fs::path> folders;
    for (const auto& entry : fs::directory_iterator(path / "Data")) {
      const fs::path root = entry.path() / (entry.path().filename().string() + ".osgb");
      if (fs::exists(root)) folders.push_back(entry.path());
    }
    std::sort(folders.begin(), folders.end());
    for (const fs::path& folder : folders) {
      part.tile = folder.filename().string();
      part.files.clear();
      for (const auto& entry : fs::directory_iterator(folder)) part.files.push_back(entry.path());
      std::sort(part.files.begin(), part.files.end());
      add(own + "/" + part.tile);
    }
  }
  return parts;
}

ImportReport stream_part(const ScenePart& part, const ImportOptions& options, const PieceSink& sink) {
  const fs::path path = part.tile.empty() ? part.path : part.path / "Data" / part.tile / (part.tile + ".osgb");
  return stream_scene(std::span(&path, 1), options, sink);
}

}  // namespace roam
