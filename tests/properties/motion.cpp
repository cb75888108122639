// A walker in a few triangles over a floor, at any commands, judged by all triangles.

#include "generated.h"
#include "walker_scenes.h"

namespace {

using generated::Scene;
using roam::Mode;
using roam::Vec3;
using roam::Walker;

struct Command {
  enum class Kind : std::uint8_t { step, jump, crouch, fly, walk, resize, put } kind = Kind::step;
  Vec3 velocity{0.0};  ///< m/s; of `put`: where, in the scene
  double dt = 0.0;     ///< s; of `resize`: the radius, m
};

std::ostream& operator<<(std::ostream& out, const Command& c) {
  constexpr const char* names[] = {"step", "jump", "crouch", "fly", "walk", "resize", "put"};
  return out << names[static_cast<int>(c.kind)] << ' ' << generated::text(c.velocity) << ' ' << roam::number_text(c.dt);
}

struct Walk {
  Scene scene;
  bool flies = false, ball = false;
  Vec3 start{0.0};
  std::vector<Command> commands;
};

std::ostream& operator<<(std::ostream& out, const Walk& w) {
  out << (w.ball ? "a ball " : "a person ") << (w.flies ? "flies" : "walks") << " from " << generated::text(w.start)
      << ", " << w.scene;
  for (const Command& c : w.commands) out << "\n  " << c;
  return out;
}

rc::Gen<Command> command() {
  using enum Command::Kind;
  return rc::gen::apply(
      [](Command::Kind kind, const Vec3& velocity, double fast, double dt) {
        if (kind == put) return Command{kind, velocity, 0.0};
        if (kind == resize) return Command{kind, Vec3(0.0), 0.125 + 0.125 * dt};
        return Command{kind, fast * velocity, dt};
      },
      rc::gen::weightedElement<Command::Kind>(
          {{20, step}, {1, jump}, {1, crouch}, {1, fly}, {1, walk}, {1, resize}, {1, put}}),
      generated::point(3.0), rc::gen::element(1.0, 1.0, 1.0, 0.01, 100.0),
      rc::gen::oneOf(rc::gen::just(0x1p-6), generated::number(0.0, 1.0)));
}

rc::Gen<Walk> walk() {
  return rc::gen::apply(
      [](const Scene& scene, bool flies, bool ball, const Vec3& start, const std::vector<Command>& commands) {
        return Walk{scene, flies, ball, start, commands};
      },
      generated::scene(3.0, 30), rc::gen::arbitrary<bool>(), rc::gen::arbitrary<bool>(), generated::point(3.0),
      rc::gen::container<std::vector<Command>>(command()));
}

/// The generated triangles over a floor.
roam::Mesh mesh_of(const Scene& scene) {
  roam::Mesh mesh = scene.mesh();
  const auto& [x, y, z] = std::array{scene.place.x, scene.place.y, scene.place.z};
  scenes::add_floor(mesh, x - 8.0, y - 8.0, x + 8.0, y + 8.0, z - 3.0);
  return mesh;
}

void obey(Walker& walker, const Command& c, const Vec3& middle) {
  using enum Command::Kind;
  switch (c.kind) {
    case fly:
      walker.set_mode(Mode::fly);
      break;
    case walk:
      walker.set_mode(Mode::walk);
      break;
    case resize:
      walker.resize(c.dt, 0.0);
      break;
    case put:
      walker.place(middle + c.velocity);
      break;
    default:
      walker.step({.velocity = c.velocity, .jump = c.kind == jump, .crouch = c.kind == crouch}, c.dt);
  }
}

TEST(MotionProperties, EachPieceIsFreeWhateverIsCommanded) {
  long steps = 0, moved = 0;
  generated::check(500, [&] {
    const Walk w = *walk();
    const roam::Mesh mesh = mesh_of(w.scene);
    const roam::World world = scenes::build(mesh, w.scene.lossless);
    const scenes::Judge judge(mesh);
    const roam::WalkerSettings settings = w.ball ? roam::WalkerSettings::sphere(0.25) : roam::WalkerSettings{};
    Walker walker(world, settings, w.flies ? Mode::fly : Mode::walk, w.scene.place + w.start);
    for (const Command& c : w.commands) {
      obey(walker, c, w.scene.place);
      if (walker.held()) continue;  // it was put where it does not fit
      RC_ASSERT(scenes::margin(judge, walker.report()) >= 0.0);
      ++steps;
      moved += walker.report().length() > 0.0;
    }
  });
  EXPECT_GE(2 * moved, steps);
}

TEST(MotionProperties, ACopyGoesTheSameWay) {
  generated::check(200, [] {
    const Walk w = *walk();
    const roam::Mesh mesh = mesh_of(w.scene);
    const roam::World world = scenes::build(mesh, w.scene.lossless);
    Walker walker(world, {}, w.flies ? Mode::fly : Mode::walk, w.scene.place + w.start);
    std::size_t copied = *rc::gen::inRange<std::size_t>(0, w.commands.size() + 1);
    for (std::size_t i = 0; i < copied; ++i) obey(walker, w.commands[i], w.scene.place);
    Walker copy = walker;
    for (; copied < w.commands.size(); ++copied) {
      obey(walker, w.commands[copied], w.scene.place);
      obey(copy, w.commands[copied], w.scene.place);
      RC_ASSERT(generated::text(copy.position()) == generated::text(walker.position()));
      RC_ASSERT(generated::text(copy.velocity()) == generated::text(walker.velocity()));
      RC_ASSERT(copy.report().least_axis_clearance == walker.report().least_axis_clearance);
    }
  });
}

}  // namespace
