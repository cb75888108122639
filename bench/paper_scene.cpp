#include "paper_scene.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <glm/geometric.hpp>

#include "roam/error.h"
#include "roam/generate.h"
#include "roam/import.h"
#include "roam/store_build.h"

namespace roam::bench {
namespace {

namespace fs = std::filesystem;

/// Keeps of each mesh what is near the ways.
class Neighbourhood {
 public:
  explicit Neighbourhood(const std::vector<Way>& ways) {
    for (const Way& way : ways) {
      Box box;
      box.include(way.from);
      box.include(way.to);
      // Whoever falls or is pushed aside is judged, too; the split is 14 m deep.
      box.lower -= Vec3(paper_reach);
      box.upper += Vec3(paper_reach);
      boxes_.push_back(box);
    }
  }

  void add(const Mesh& mesh) {
    Mesh kept{.name = mesh.name, .vertices = {}, .triangles = {}};
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      Box box;
      for (const Vec3& v : mesh.triangle(i)) box.include(v);
      const bool near = std::any_of(boxes_.begin(), boxes_.end(), [&](const Box& b) {
        return box.lower.x <= b.upper.x && box.upper.x >= b.lower.x && box.lower.y <= b.upper.y &&
               box.upper.y >= b.lower.y && box.lower.z <= b.upper.z && box.upper.z >= b.lower.z;
      });
      if (!near) continue;
      const auto first = static_cast<std::uint32_t>(kept.vertices.size());
      for (const Vec3& v : mesh.triangle(i)) kept.vertices.push_back(v);
      kept.triangles.push_back({first, first + 1, first + 2});
    }
    if (!kept.triangles.empty()) kept_.push_back(std::move(kept));
  }

  [[nodiscard]] std::shared_ptr<const Reference> judge() const {
    if (kept_.empty()) {
      throw Error(
          "the scene has nothing near the three paths of the paper's Table 1: it must be at their coordinates, "
          "metres, z up");
    }
    return std::make_shared<Reference>(kept_);
  }

 private:
  std::vector<Box> boxes_;
  std::vector<Mesh> kept_;
};

}  // namespace

ScratchFolder::ScratchFolder(const std::string& parent) {
  const fs::path folder = parent.empty() ? fs::temp_directory_path() : fs::path(parent);
  std::string name = (folder / "roam-bench-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) {
    throw Error("cannot make a folder in " + folder.string() + "; name another by --scratch");
  }
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

LaidOut lay_out(const PaperOptions& options, const std::string& folder) {
  const auto start = std::chrono::steady_clock::now();
  LaidOut laid;
  laid.scene.memory = 64ull << 20;
  laid.scene.tiles = folder + "/tiles";
  laid.scene.store = folder + "/scene.roam";
  fs::create_directory(laid.scene.tiles);
  TileWriter tiles(laid.scene.tiles);
  Neighbourhood near(paper_ways(options.radius, options.split_radius));
  const auto take = [&](const Mesh& mesh) {
    laid.triangles += mesh.triangles.size();
    tiles.add(mesh);
    near.add(mesh);
  };
  fmt::print(stderr, "laying out the scene in {}\n", folder);
  if (options.scene.empty()) {
    laid.scene.scene = folder + "/scene.ply";
    const generate::Scene gallery = generate::gallery({.triangles = options.triangles});
    gallery.stream(take);
    generate::write_scene(gallery, laid.scene.scene);
    laid.title = fmt::format("the made gallery, {} triangles", laid.triangles);
  } else {
    laid.scene.scene = options.scene;
    for (const Mesh& mesh : import_scene(options.scene).meshes) take(mesh);
    laid.title = fmt::format("{}, {} triangles", fs::path(options.scene).filename().string(), laid.triangles);
  }
  laid.near = near.judge();
  laid.scene.tile_count = tiles.finish();
  StoreBuildOptions build;
  build.scene = {laid.scene.scene};
  build.output = laid.scene.store;
  build_store(build);
  laid.prepared = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return laid;
}

}  // namespace roam::bench
