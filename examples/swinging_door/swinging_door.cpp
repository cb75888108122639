// A swinging door. A person walks to the shut door. It swings open, away from the person, who goes through. Then it
// shuts: it pushes the person out of its way, and stops if there is no room to push the person to.
#include <roam/instances.h>
#include <roam/move_instances.h>
#include <roam/walker.h>
#include <roam/world.h>

#include <cstdio>
#include <memory>
#include <numbers>

namespace {

using roam::Vec3;

void add_box(roam::Mesh& mesh, const Vec3& lower, const Vec3& upper) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.emplace_back(i & 1 ? upper.x : lower.x, i & 2 ? upper.y : lower.y, i & 4 ? upper.z : lower.z);
  }
  constexpr std::uint32_t sides[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                         {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
  for (const auto& s : sides) {
    mesh.triangles.push_back({first + s[0], first + s[1], first + s[2]});
    mesh.triangles.push_back({first + s[0], first + s[2], first + s[3]});
  }
}

}  // namespace

int main() {
  // Two rooms, and a doorway 1 m wide between them: from y = 0 to y = 1 in the wall at x = 0.
  roam::Mesh house{.name = "house"};
  add_box(house, {-6.0, -4.0, -0.2}, {6.0, 4.0, 0.0});
  add_box(house, {-0.1, -4.0, 0.0}, {0.1, 0.0, 3.0});
  add_box(house, {-0.1, 1.0, 0.0}, {0.1, 4.0, 3.0});
  const roam::World rooms = roam::World::build({&house, 1});

  // The door leaf, with its hinge at the origin of its own world.
  roam::Mesh leaf{.name = "leaf"};
  add_box(leaf, {-0.02, 0.02, 0.01}, {0.02, 0.98, 2.1});
  roam::Instances scene(rooms);
  const roam::ObjectId door = scene.add(std::make_shared<roam::World>(roam::World::build({&leaf, 1})), {}, "door");

  roam::Walker person(scene, {.radius = 0.3}, roam::Mode::walk, {-3.0, 0.5, 1.0});
  roam::Walker* const people[] = {&person};
  constexpr double dt = 1.0 / 60.0;
  // Turns the door at `turning` rad/s while the person walks at `wish` m/s. Returns how many times a person stopped the
  // door.
  const auto run = [&](double seconds, double turning, const Vec3& wish) {
    int stops = 0;
    for (double t = 0.0; t < seconds; t += dt) {
      scene.set_velocity(door, {.turning = turning});
      stops += static_cast<int>(roam::move_instances(scene, people, dt).size());
      person.step({.velocity = wish}, dt);
    }
    return stops;
  };

  run(3.0, 0.0, {1.4, 0.0, 0.0});
  const roam::StepReport& report = person.report();
  const roam::ObjectId met = report.contacts.empty() ? roam::no_object : report.contacts.back().object;
  std::printf("shut: the person is %s at x = %.2f\n", met == door ? "stopped by the door" : "not stopped",
              person.position().x);
  run(1.5, -0.5 * std::numbers::pi / 1.5, {0.0, 0.0, 0.0});  // a quarter turn in 1.5 s
  run(2.0, 0.0, {1.4, 0.0, 0.0});
  std::printf("open: the person came to x = %.2f\n", person.position().x);
  run(1.6, 0.0, {-1.4, 0.0, 0.0});  // walk back into the doorway
  const int stops = run(1.5, 0.5 * std::numbers::pi / 1.5, {0.0, 0.0, 0.0});
  std::printf("shut again: the person was moved to x = %.2f, the door stands at %.0f degrees%s\n", person.position().x,
              scene.pose(door).heading * 180.0 / std::numbers::pi, stops > 0 ? ", stopped" : "");
  return person.held() ? 1 : 0;
}
