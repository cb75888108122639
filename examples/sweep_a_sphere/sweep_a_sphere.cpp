// A sphere of radius 0.3 m flies down a corridor 2 m wide until it meets the end wall. Then the program steps back 0.1
// m and queries the clearance there.
#include <roam/world.h>

#include <cstdio>

namespace {

/// An upright rectangle above the line from (x0, y0) to (x1, y1).
roam::Mesh wall(const char* name, double x0, double y0, double x1, double y1, double height) {
  return {name, {{x0, y0, 0}, {x1, y1, 0}, {x1, y1, height}, {x0, y0, height}}, {{0, 1, 2}, {0, 2, 3}}};
}

}  // namespace

int main() {
  const roam::Mesh corridor[] = {wall("left", 0, 1, 20, 1, 3), wall("right", 0, -1, 20, -1, 3),
                                 wall("end", 20, -1, 20, 1, 3)};
  const roam::World world = roam::World::build(corridor);
  const roam::Body body{.radius = 0.3};

  const roam::Vec3 from{1, 0, 1.5};
  const roam::Vec3 motion{100, 0, 0};
  const roam::Impact hit = world.sweep(body, from, motion);
  if (!hit.hit) {
    std::printf("nothing in the way\n");
    return 1;
  }
  const roam::Vec3 stop = from + hit.time * motion;
  std::printf("stops at x = %.3f m, before \"%s\"\n", stop.x, world.object_name(hit.triangle).c_str());

  const roam::Clearance room = world.clearance(body, stop + 0.1 * hit.normal, 5.0);
  std::printf("after a step of 0.1 m back, at least %.3f m are free around it\n", room.distance);
  return 0;
}
