// A moving platform: it lifts a person, carries the person over a pit, and turns. Meanwhile the person walks and jumps.
#include <roam/instances.h>
#include <roam/move_instances.h>
#include <roam/walker.h>
#include <roam/world.h>

#include <cstdio>
#include <memory>

namespace {

using roam::Vec3;

void add_floor(roam::Mesh& mesh, double x0, double x1, double z) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (const Vec3& v : {Vec3(x0, -5.0, z), Vec3(x1, -5.0, z), Vec3(x1, 5.0, z), Vec3(x0, 5.0, z)}) {
    mesh.vertices.push_back(v);
  }
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

}  // namespace

int main() {
  // Two banks with a pit of 20 m between them; the far bank is 2 m higher.
  roam::Mesh banks{.name = "banks"};
  add_floor(banks, -10.0, 0.0, 0.0);
  add_floor(banks, 0.0, 20.0, -30.0);
  add_floor(banks, 20.0, 30.0, 2.0);
  const roam::World valley = roam::World::build({&banks, 1});

  roam::Mesh plate{.name = "plate",
                   .vertices = {{-1.5, -1.5, 0.0}, {1.5, -1.5, 0.0}, {1.5, 1.5, 0.0}, {-1.5, 1.5, 0.0}},
                   .triangles = {{0, 1, 2}, {0, 2, 3}}};
  roam::Instances scene(valley);
  const roam::ObjectId platform = scene.add(std::make_shared<roam::World>(roam::World::build({&plate, 1})),
                                            {.position = {1.6, 0.0, 0.0}}, "platform");

  roam::Walker person(scene, {.radius = 0.3}, roam::Mode::walk, {-3.0, 0.0, 1.0});
  roam::Walker* const people[] = {&person};
  constexpr double dt = 1.0 / 60.0;
  const auto run = [&](double seconds, const roam::Velocity& velocity, const roam::WalkerInput& input) {
    scene.set_velocity(platform, velocity);
    for (double t = 0.0; t < seconds; t += dt) {
      roam::move_instances(scene, people, dt);
      person.step(input, dt);
    }
  };

  run(3.3, {}, {.velocity = {1.4, 0.0, 0.0}});  // walk onto the platform
  std::printf("on board: %s\n", person.stance().object == platform ? "yes" : "no");
  run(2.0, {.linear = {0.0, 0.0, 1.0}}, {});
  std::printf("lifted to z = %.2f\n", person.feet().z);
  run(2.0, {.linear = {4.2, 0.0, 0.0}}, {.jump = true});
  run(2.0, {.linear = {4.2, 0.0, 0.0}}, {});
  std::printf("carried to x = %.2f, by ground that moves at %.1f m/s\n", person.position().x,
              person.report().ground_velocity.x);
  run(2.0, {.turning = 0.8}, {});
  run(2.0, {}, {.velocity = {1.4, 0.0, 0.0}});  // walk off the platform, onto the far bank
  const bool across = person.stance().footing == roam::Footing::ground && person.position().x > 20.0;
  std::printf("across: %s, z = %.2f\n", across ? "yes" : "no", person.feet().z);
  return across ? 0 : 1;
}
