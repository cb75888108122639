#include "scenes/surveyed.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "cli/exit_status.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/tell.h"
#include "measure/room.h"
#include "process/free_memory.h"
#include "scenes/web_options.h"
#include "store/meshes.h"
#include "store/read_ahead.h"

namespace roam::app {
namespace {

/// Bytes for each triangle of a store here, at most: its corners, the same again for floor, both indexes and their
/// construction.
constexpr std::uint64_t bytes_a_triangle = 400;

/// The remedy if a part of a store cannot be read.
std::string help_against(const std::string& what, const std::string& store) {
  if (!Store::is_address(store)) {
    return fmt::format("name the scene itself, or mend the store by `roam verify {} --repair SCENE`", store);
  }
  const bool is_damage = what.find(store::wrong_checksum) != std::string::npos;
  return is_damage ? "verify the published folder, remove its damaged files, and publish again"
                   : "try again when the web server answers";
}

std::vector<Mesh> read_store(const Store& store, std::vector<TriangleId>& numbers) {
  const StoreInfo& info = store.info();
  const std::uint64_t needed = info.triangles * bytes_a_triangle;
  const auto free = process::free_memory();
  if (free && needed > *free) {
    throw Error(
        store.name(),
        fmt::format("its {} triangles take about {}B when they are surveyed, and {}B are free; survey the part of the "
                    "scene that matters, or take a machine with more memory",
                    info.triangles, short_count(static_cast<double>(needed)), short_count(static_cast<double>(*free))));
  }
  Mesh mesh;
  mesh.vertices.reserve(3 * info.triangles);
  mesh.triangles.reserve(info.triangles);
  Progress progress("reading " + store.name(), "triangles");
  numbers.reserve(info.triangles);
  const auto take = [&](std::span<const Triangle> triangles, std::span<const TriangleId> ids) {
    store::append(mesh, triangles);
    numbers.insert(numbers.end(), ids.begin(), ids.end());
    progress.at(mesh.triangles.size(), info.triangles);
  };
  store.for_each_triangle(info.bounds, take, [&](const std::string& what) {
    // An unknown part would look like a hole in the floor, or like a missing door.
    throw Error::at(store.name(), fmt::format("{}; {}", what, help_against(what, store.name())));
  });
  std::vector<Mesh> meshes;
  meshes.push_back(std::move(mesh));
  return meshes;
}

}  // namespace

void add_surveyed_to(CLI::App& verb, SceneOptions& options) {
  verb.add_option("SCENE", options.scenes,
                  "Files, folders of photogrammetry tiles, or a store or its address; several files make one scene")
      ->required()
      ->type_name("");
  options.add_reading_to(verb);
  verb.get_option("--memory")->description("Memory for reading a scene (default: 8G), e.g. 1G");
  add_web_options(verb, *verb.get_option("SCENE"), options.web);
}

Surveyed survey_scene(const SceneOptions& options, double slope_degrees) {
  std::vector<Mesh> meshes;
  SceneIdentity identity;
  std::shared_ptr<const Store> store;
  std::vector<TriangleId> numbers;
  if (options.name_a_store()) {
    options.demand_store_alone();
    store = Store::open(options.scenes.front(), options.manifest_memory(), options.web);
    identity = identity_of(store->info());
    meshes = read_store(*store, numbers);
  } else {
    meshes = read_scene(options).meshes;
    tell_doubted_up(options, meshes);
    identity = identity_of(meshes);
  }
  stop_if_interrupted();
  BuildOptions how;
  how.threads = options.threads;
  how.lossless = true;
  Progress progress("surveying", "triangles");
  how.progress = [&](double share) {
    const auto done = static_cast<double>(identity.triangles) * share;
    return progress.goes_on(static_cast<std::uint64_t>(done), identity.triangles);
  };
  return {Survey::build(std::move(meshes), how, slope_degrees), std::move(identity), std::move(store),
          std::move(numbers)};
}

std::string Surveyed::name(TriangleId triangle) const {
  const std::uint64_t objects = store ? store->info().objects : survey.world().stats().objects;
  if (triangle == no_triangle || objects <= 1) return {};
  return store ? store->source(numbers.at(triangle)).object : survey.world().object_name(triangle);
}

std::pair<std::string, std::string> Surveyed::names_at(const Vec3& point, const Vec3& direction, double width) const {
  const auto ends = measure::at_ends(survey.world(), point, direction, width);
  return {name(ends[0]), name(ends[1])};
}

void check_spacing(const Surveyed& scene, double spacing, double width) {
  constexpr double usual = 0.2;       // m
  constexpr double overlooked = 0.7;  // of the spacing: smaller openings may be overlooked
  const Box bounds = scene.survey.world().bounds();
  if (bounds.empty() || spacing <= usual) return;
  const Vec3 size = bounds.size();
  const double longest = std::max({size.x, size.y, size.z});
  if (spacing > 0.5 * longest) {
    throw UsageError(
        fmt::format("--spacing {:g}", spacing),
        fmt::format("the scene is {:.3g} m long, so hardly a place would be looked at; {:g} m suits most scenes",
                    longest, usual));
  }
  if (overlooked * spacing > width) {
    tell(
        fmt::format("note: with --spacing {:g} openings under {:.2g} m may be overlooked; to find those of {:.2g} m "
                    "say --spacing {:.2g} or less",
                    spacing, overlooked * spacing, width, std::floor(100.0 * width / overlooked) / 100.0));
  }
}

}  // namespace roam::app
