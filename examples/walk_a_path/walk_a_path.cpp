// A person 1.8 m high walks along a path file through a scene file: `roam walk` in one page.
#include <roam/import.h>
#include <roam/path_file.h>
#include <roam/route.h>
#include <roam/world.h>

#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: walk_a_path SCENE PATH\n");
    return 2;
  }
  try {
    const roam::ImportedScene scene = roam::import_scene(argv[1]);
    for (const std::string& note : scene.report.notes) std::fprintf(stderr, "%s\n", note.c_str());
    const roam::World world = roam::World::build(scene.meshes);

    const std::vector<roam::Vec3> path = roam::positions(roam::load_path(argv[2]));

    roam::Walker walker(world, {.radius = 0.3, .height = 1.8}, roam::Mode::walk, path.front());
    const roam::RouteResult result = roam::follow(walker, path, {.speed = 5.0});
    std::printf("%s after %.1f m, never nearer than %.4f m to anything\n", roam::to_string(result.outcome),
                result.length, result.least_axis_clearance);
    if (result.blocked_at) {
      std::printf("blocked by \"%s\"\n", world.object_name(result.blocked_at->triangle).c_str());
    }
    return result.outcome == roam::Outcome::reached ? 0 : 3;
  } catch (const roam::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
