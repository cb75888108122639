// Where memory runs out, a made scene is whole, or the call throws and leaves the file as it was. Instrumented builds
// have an operator new of their own.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "fallible_calls.h"
#include "import_files.h"
#include "roam/generate.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

TEST(GenerateAllocations, ASceneIsMadeAndWrittenWholeOrNotWhereverOneFails) {
  using namespace roam::generate;
  const roam::test::TemporaryFolder folder;
  const std::filesystem::path file = folder.write("scene.ply", "as it was");
  const auto text_of = [&] {
    const Spare spare;
    std::ifstream in(file);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const auto made = [](const roam::generate::Scene& scene) {
    std::uint64_t triangles = 0;
    roam::Vec3 sum(0.0);
    scene.stream([&](const roam::Mesh& mesh) {
      triangles += mesh.triangles.size();
      for (const roam::Vec3& v : mesh.vertices) sum += v;
    });
    return std::string(Bits() << triangles << sum << scene.objects());
  };
  const TerrainOptions small{.triangles = 10'000};
  fail_calls({
      {.name = "gallery", .bits = [&] { return made(gallery({.triangles = 10'000})); }, .dense = 30, .steps = 5},
      {.name = "terrain", .bits = [&] { return made(terrain(small)); }, .dense = 30, .steps = 6},
      {.name = "city", .bits = [&] { return made(city({.triangles = 10'000})); }, .dense = 30, .steps = 5},
      {.name = "write_scene",
       .bits =
           [&] {
             write_scene(terrain(small), file);
             return std::string();
           },
       .after =
           [&](bool failed) {
             const std::string text = text_of();
             EXPECT_TRUE(failed ? text == "as it was" : text.size() > 100'000);
             EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
             std::ofstream(file) << "as it was";
           },
       .dense = 30,
       .steps = 6},
  });
}

}  // namespace
#endif
