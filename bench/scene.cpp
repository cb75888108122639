#include "scene.h"

#include <filesystem>

#include "math/boxes.h"
#include "roam/error.h"
#include "roam/generate.h"
#ifdef ROAM_BENCH_READS_FILES
#include "roam/import.h"
#endif

namespace roam::bench {
namespace {

std::vector<Mesh> read(const std::string& file, [[maybe_unused]] const std::function<bool()>& goes_on) {
#ifdef ROAM_BENCH_READS_FILES
  ImportOptions options;
  if (goes_on) options.progress = [&](const ImportProgress&) { return goes_on(); };
  return import_scene(file, options).meshes;
#else
  throw Error("cannot read '" + file +
              "': this build has no readers; choose gallery, terrain or city, or configure with -DROAM_TOOLS=ON");
#endif
}

void center_at(std::vector<Mesh>& meshes, const Vec3& origin) {
  Box box;
  for (const Mesh& mesh : meshes) box.include(box_around(mesh.vertices));
  const Vec3 shift = origin - box.center();
  for (Mesh& mesh : meshes) {
    for (Vec3& v : mesh.vertices) v += shift;
  }
}

}  // namespace

bool is_made(const std::string& scene) { return scene == "gallery" || scene == "terrain" || scene == "city"; }

std::uint64_t Scene::triangles() const {
  std::uint64_t count = 0;
  for (const Mesh& mesh : meshes) count += mesh.triangles.size();
  return count;
}

Scene make_scene(const SceneChoice& choice, const std::function<bool()>& goes_on) {
  Scene scene;
  generate::Progress progress;
  if (goes_on) progress = [&](std::uint64_t) { return goes_on(); };
  if (choice.scene == "gallery") {
    scene.meshes = generate::collect(generate::gallery({.triangles = choice.triangles}), progress);
  } else if (choice.scene == "terrain") {
    scene.meshes = generate::collect(generate::terrain({.triangles = choice.triangles}), progress);
  } else if (choice.scene == "city") {
    scene.meshes = generate::collect(generate::city({.triangles = choice.triangles}), progress);
  } else {
    scene.meshes = read(choice.scene, goes_on);
  }
  center_at(scene.meshes, choice.origin);
  scene.name =
      std::filesystem::path(choice.scene).filename().string() + ", " + std::to_string(scene.triangles()) + " triangles";
  if (choice.origin != Vec3(0.0)) {
    scene.name += ", centre at (" + std::to_string(choice.origin.x) + ", " + std::to_string(choice.origin.y) + ", " +
                  std::to_string(choice.origin.z) + ") m";
  }
  return scene;
}

}  // namespace roam::bench
