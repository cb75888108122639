// Where memory runs out in the program that imports a scene, the call throws, no reader is left, and the next call
// reads the scene whole. Instrumented builds have an operator new of their own.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>

#include "fallible_calls.h"
#include "import_files.h"
#include "roam/import.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

std::string bits_of(const roam::Mesh& mesh, Bits& bits) {
  bits << mesh.name;
  for (const roam::Vec3& v : mesh.vertices) bits << v;
  for (const auto& t : mesh.triangles) bits << t;
  return {};
}

void expect_no_child(bool /*failed*/) {
  int status = 0;
  EXPECT_TRUE(::waitpid(-1, &status, WNOHANG) == -1 && errno == ECHILD);
}

TEST(ImportAllocations, ASceneIsReadWholeOrNotWhereverOneFails) {
  const roam::test::TemporaryFolder folder;
  const std::filesystem::path file =
      folder.write("a scene.obj",
                   "o a wall with a name that is too long\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                   "f 1 2 3\no a floor with a name that is too long\nf 1 2 4\nf 2 3 4\n");
  const std::array<std::filesystem::path, 1> files{file};
  fail_calls({
      {.name = "import_scene",
       .bits =
           [&] {
             const roam::ImportedScene scene = roam::import_scene(files);
             Bits bits;
             for (const roam::Mesh& mesh : scene.meshes) bits_of(mesh, bits);
             for (const std::string& note : scene.report.notes) bits << note;
             return std::string(bits << scene.report.triangles);
           },
       .after = expect_no_child,
       .dense = 24,
       .steps = 6},
      {.name = "stream_scene",
       .bits =
           [&] {
             Bits bits;
             roam::stream_scene(files, {}, [&](const roam::Mesh& piece, bool continues) {
               bits << continues;
               bits_of(piece, bits);
             });
             return std::string(bits);
           },
       .after = expect_no_child,
       .dense = 24,
       .steps = 6},
      {"import_scene of no file",
       [&] { return refusal_of([&] { static_cast<void>(roam::import_scene("/nowhere/there/is/a/scene.obj")); }); }},
  });
}

}  // namespace
#endif
