// Builds the store of a scene, unless it is up to date, and walks a path through it with 16 MB of memory for collision.
#include <roam/pager.h>
#include <roam/path_file.h>
#include <roam/route.h>
#include <roam/store_build.h>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: walk_a_store SCENE STORE PATH\n");
    return 2;
  }
  try {
    roam::StoreBuildOptions options;
    options.scene = {argv[1]};
    options.output = argv[2];
    const roam::StoreBuildReport built = roam::build_store(options);
    std::printf("%s\n", built.unchanged ? "up to date" : "built");

    roam::Pager pager(roam::Store::open(argv[2]), {.memory = 16ull << 20});
    const auto waypoints = roam::positions(roam::load_path(argv[3]));
    roam::WalkerSettings person;
    roam::Walker walker(pager, person, roam::Mode::walk, waypoints.front());
    // Between steps, puts loaded tiles into use. Where the body needs tiles that are not loaded yet, it waits for them.
    const roam::RouteResult walked = roam::follow(walker, pager, waypoints);
    const roam::PagerStats stats = pager.stats();
    std::printf("%s after %.1f m, %.0f MB of memory\n", roam::to_string(walked.outcome), walked.length,
                static_cast<double>(stats.memory) / (1 << 20));
    return walked.outcome == roam::Outcome::reached ? 0 : 3;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "walk_a_store: %s\n", error.what());
    return 1;
  }
}
