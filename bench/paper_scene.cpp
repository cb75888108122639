#include "paper_scene.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <glm/geometric.hpp>

#include "cli/interrupt.h"
#include "math/boxes.h"
#include "roam/error.h"
#include "roam/generate.h"
#include "roam/import.h"
#include "roam/store_build.h"

namespace roam::bench {
namespace {

namespace fs = std::filesystem;

constexpr double paper_reach = 20.0;  // m from the ways: a scene without triangles there is a different scene

/// By the ball around the triangle's box.
bool near(const std::vector<Way>& ways, const Triangle& triangle) {
  const Box box = box_around(triangle);
  const Vec3 middle = box.center();
  const double reach = paper_reach + 0.5 * glm::length(box.upper - box.lower);
  return std::any_of(ways.begin(), ways.end(), [&](const Way& way) {
    const Vec3 along = way.to - way.from;
    const double part = std::clamp(glm::dot(middle - way.from, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::distance(middle, way.from + part * along) <= reach;
  });
}

bool near(const std::vector<Way>& ways, const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (near(ways, mesh.triangle(i))) return true;
  }
  return false;
}

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

LaidOut lay_out(const PaperOptions& options, const std::set<Reads>& read, const std::string& folder) {
  const auto start = std::chrono::steady_clock::now();
  LaidOut laid;
  laid.scene.memory = 64ull << 20;
  laid.scene.tiles = folder + "/tiles";
  laid.scene.store = folder + "/scene.roam";
  fs::create_directory(laid.scene.tiles);
  TileWriter osgb(laid.scene.tiles);
  std::function<void(const Mesh&)> write_for_ogre;
#ifdef ROAM_BENCH_OGRE
  if (read.contains(Reads::ogre)) write_for_ogre = ogre_tile_writer(laid.scene.tiles);
#endif
  const std::vector<Way> ways = paper_ways(options.radius, options.split_radius);
  bool anything_near = false;
  const auto take = [&](const Mesh& mesh) {
    app::stop_if_interrupted();
    laid.triangles += mesh.triangles.size();
    anything_near = anything_near || near(ways, mesh);
    ++laid.scene.tile_count;
    if (read.contains(Reads::osgb)) osgb.add(mesh);
    if (write_for_ogre) write_for_ogre(mesh);
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
    stream_laid_out(laid.scene, take);
    laid.title = fmt::format("{}, {} triangles", fs::path(options.scene).filename().string(), laid.triangles);
  }
  if (!anything_near) {
    throw Error(
        "the scene has nothing near the three paths of the paper's Table 1: it must be at their coordinates, "
        "metres, z up");
  }
  if (read.contains(Reads::osgb)) osgb.finish();
  if (read.contains(Reads::store)) {
    StoreBuildOptions build;
    build.scene = {laid.scene.scene};
    build.output = laid.scene.store;
    build.progress = goes_on;
    build_store(build);
  }
  laid.prepared = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return laid;
}

void stream_laid_out(const PaperScene& scene, const std::function<void(const Mesh&)>& take) {
  ImportOptions import_options;
  import_options.progress = [](const auto&) { return !app::interrupted(); };
  const fs::path path = scene.scene;
  stream_scene({&path, 1}, import_options, [&](const Mesh& piece, bool) { take(piece); });
}

}  // namespace roam::bench
