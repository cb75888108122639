// A person walks over a floor while another thread delivers its tiles, as from a network. A tile is solid until it has
// come: the person waits before it.
#include <roam/patchwork.h>
#include <roam/route.h>

#include <chrono>
#include <cstdio>
#include <thread>
#include <vector>

namespace {

constexpr int count = 4;
constexpr double size = 5.0;  // of a tile, metres

roam::World tile(int i) {
  const double x0 = size * i, x1 = x0 + size;
  const roam::Mesh floor{"floor", {{x0, -2, 0}, {x1, -2, 0}, {x1, 2, 0}, {x0, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  return roam::World::build({&floor, 1});
}

}  // namespace

int main() {
  roam::Patchwork space;
  std::vector<roam::PatchId> tiles;
  for (int i = 0; i < count; ++i) tiles.push_back(space.expect({{size * i, -2, -1}, {size * (i + 1), 2, 3}}));
  space.update();  // from now on the tiles are unknown; before, all is free

  std::thread loader([&] {
    for (int i = 0; i < count; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      space.deliver(tiles[i], tile(i));
    }
  });
  const std::vector<roam::Vec3> path{{1, 0, 1}, {19, 0, 1}};
  roam::Walker walker(space, {}, roam::Mode::walk, path.front());
  // Updates the space between steps, and waits for tiles that the person needs.
  const roam::RouteResult walked = roam::follow(walker, space, path, {.speed = 10.0});
  loader.join();

  const roam::PatchworkStats stats = space.stats();
  std::printf("%s after %.1f m, over %llu of %d tiles\n", roam::to_string(walked.outcome), walked.length,
              static_cast<unsigned long long>(stats.patches), count);
  return walked.outcome == roam::Outcome::reached ? 0 : 3;
}
