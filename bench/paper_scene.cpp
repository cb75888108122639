#include "paper_scene.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <glm/geometric.hpp>

#include "interrupt.h"
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
  explicit Neighbourhood(std::vector<Way> ways) : ways_(std::move(ways)) {}

  void add(const Mesh& mesh) {
    Mesh kept{.name = mesh.name, .vertices = {}, .triangles = {}};
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const Triangle triangle = mesh.triangle(i);
      if (!near(triangle)) continue;
      const auto first = static_cast<std::uint32_t>(kept.vertices.size());
      kept.vertices.insert(kept.vertices.end(), triangle.begin(), triangle.end());
      kept.triangles.push_back({first, first + 1, first + 2});
    }
    if (!kept.triangles.empty()) kept_.push_back(std::move(kept));
  }

  /// What was kept is gone afterwards.
  [[nodiscard]] std::shared_ptr<const Reference> judge() && {
    if (kept_.empty()) {
      throw Error(
          "the scene has nothing near the three paths of the paper's Table 1: it must be at their coordinates, "
          "metres, z up");
    }
    const std::vector<Mesh> kept = std::move(kept_);
    return std::make_shared<Reference>(kept);
  }

 private:
  /// By the ball around the triangle's box: some that are farther off are kept too, and none that is nearer is not.
  [[nodiscard]] bool near(const Triangle& triangle) const {
    Box box;
    for (const Vec3& v : triangle) box.include(v);
    const Vec3 middle = box.center();
    const double reach = paper_reach + 0.5 * glm::length(box.upper - box.lower);
    return std::any_of(ways_.begin(), ways_.end(), [&](const Way& way) {
      const Vec3 along = way.to - way.from;
      const double part = std::clamp(glm::dot(middle - way.from, along) / glm::dot(along, along), 0.0, 1.0);
      return glm::distance(middle, way.from + part * along) <= reach;
    });
  }

  std::vector<Way> ways_;
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
    app::stop_if_interrupted();
    laid.triangles += mesh.triangles.size();
    tiles.add(mesh);
    near.add(mesh);
  };
  const auto goes_on = [](const auto&) { return !app::interrupted(); };
  fmt::print(stderr, "laying out the scene in {}\n", folder);
  if (options.scene.empty()) {
    laid.scene.scene = folder + "/scene.ply";
    const generate::Scene gallery = generate::gallery({.triangles = options.triangles});
    gallery.stream(take, goes_on);
    generate::write_scene(gallery, laid.scene.scene, goes_on);
    laid.title = fmt::format("the made gallery, {} triangles", laid.triangles);
  } else {
    laid.scene.scene = options.scene;
    ImportOptions import;
    import.progress = goes_on;
    for (const Mesh& mesh : import_scene(options.scene, import).meshes) take(mesh);
    laid.title = fmt::format("{}, {} triangles", fs::path(options.scene).filename().string(), laid.triangles);
  }
  laid.near = std::move(near).judge();
  laid.scene.tile_count = tiles.finish();
  StoreBuildOptions build;
  build.scene = {laid.scene.scene};
  build.output = laid.scene.store;
  build.progress = goes_on;
  build_store(build);
  laid.prepared = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return laid;
}

}  // namespace roam::bench
