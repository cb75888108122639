// A mesh becomes a world, and a body moves in it: never through, whatever the mesh, the body and the steps.
#include <cmath>
#include <optional>

#include "fuzz.h"
#include "roam/error.h"
#include "walker_scenes.h"

namespace fuzz {
namespace {

using roam::Mesh;
using roam::Mode;
using roam::Vec3;
using roam::WalkerSettings;

/// A coordinate in steps of `unit`. Now and then a double of any bits.
double coordinate(Values& values, std::uint8_t kind, double unit) {
  if (kind == 255) return values.take<double>();
  return unit * values.take<std::int16_t>();
}

/// Powers of two from 2^-12 to 2^3 metres.
double unit_of(std::uint8_t kind) { return std::ldexp(1.0, kind % 16 - 12); }

double between(double least, double most, std::uint8_t share) { return least * std::pow(most / least, share / 255.0); }

Vec3 origin_of(std::uint8_t kind) {
  constexpr double far[] = {0.0, 0.0, -13739.0, 6.4e6};
  return Vec3(far[kind % 4], kind / 4 % 2 == 0 ? 0.0 : -far[kind % 4], far[kind / 8 % 4]);
}

/// Vertices, each with a kind: a new one, or one of the last ones, perhaps moved by a step. Then triangles.
Mesh mesh_of(Values& values, const Vec3& origin) {
  Mesh mesh;
  const std::size_t vertices = 3 + values.take<std::uint8_t>() % 46, triangles = values.take<std::uint8_t>() % 64;
  for (std::size_t i = 0; i < vertices; ++i) {
    const auto kind = values.take<std::uint8_t>();
    Vec3 v = kind < 64 || i == 0 ? origin : mesh.vertices[i - 1 - kind % (i < 4 ? i : 4)];
    for (int k = 0; k < 3; ++k) v[k] += coordinate(values, kind, unit_of(kind));
    mesh.vertices.push_back(v);
  }
  for (std::size_t i = 0; i < triangles; ++i) {
    std::array<std::uint32_t, 3> corners{};
    for (std::uint32_t& corner : corners) {
      const auto number = values.take<std::uint8_t>();
      corner = number == 255 ? values.take<std::uint32_t>() : static_cast<std::uint32_t>(number % vertices);
    }
    mesh.triangles.push_back(corners);
  }
  return mesh;
}

WalkerSettings settings_of(Values& values) {
  WalkerSettings s;
  s.radius = between(0.001, 250.0, values.take<std::uint8_t>());
  const auto tall = values.take<std::uint8_t>();
  s.height = tall < 64 ? 2.0 * s.radius : between(2.0 * s.radius, 500.0 + 2.0 * s.radius, tall);
  s.eye = 0.9 * s.height;
  s.step = 0.5 * s.height * (values.take<std::uint8_t>() / 255.0);
  s.slope_degrees = 89.0 * (values.take<std::uint8_t>() / 255.0);
  const auto disc = values.take<std::uint8_t>();
  if (disc >= 128) s.support_radius = s.radius * between(1.0, 8.0, disc);
  s.crouch_height = s.height * (0.25 + values.take<std::uint8_t>() / 255.0);
  s.gravity = values.take<std::uint8_t>() / 16.0;
  return s;
}

void judge(const scenes::Judge& triangles, const roam::Walker& walker, const roam::StepReport& report) {
  for (int k = 0; k < 3; ++k) demand(std::isfinite(walker.position()[k]), "the body is nowhere");
  // Nothing is promised about a body that does not fit where it is.
  if (walker.mode() == Mode::ghost || report.held) return;
  if (const double margin = scenes::margin(triangles, report); margin < 0.0) {
    fail("a step through a triangle, by " + std::to_string(margin) + " m");
  }
}

/// A sweep from where the body is.
void judge_sweep(const roam::World& world, const scenes::Judge& triangles, const roam::Body& body, const Vec3& from,
                 const Vec3& motion) {
  constexpr double slack = 1e-6;  // metres: the promise of Space
  const roam::Impact impact = world.sweep(body, from, motion);
  demand(impact.time >= 0.0 && impact.time <= 1.0, "a time out of range");
  demand(impact.hit || impact.time == 1.0, "a miss before the end");
  if (impact.hit && impact.time == 0.0) return;
  const double nearest = triangles.over(body, from, impact.time * motion, body.radius + 0.01);
  demand(nearest >= body.radius - slack, "a sweep through a triangle");
}

void run_walk(Bytes input) {
  Values values(input);
  const auto flags = values.take<std::uint8_t>();
  const Vec3 origin = origin_of(values.take<std::uint8_t>());
  const Mesh mesh = mesh_of(values, origin);
  const WalkerSettings settings = settings_of(values);
  std::optional<roam::World> world;
  std::optional<roam::Walker> walker;
  const auto near = [&](double unit) {
    return Vec3(unit * values.take<std::int16_t>(), unit * values.take<std::int16_t>(),
                unit * values.take<std::int16_t>());
  };
  const Vec3 start = origin + near(1.0 / 256.0);
  if (!complaint([&] { world.emplace(scenes::build(mesh, flags % 2 != 0)); }).empty()) return;
  const Mode mode = flags / 2 % 2 == 0 ? Mode::walk : Mode::fly;
  if (!complaint([&] { walker.emplace(*world, settings, mode, start); }).empty()) return;
  const scenes::Judge triangles(mesh);
  judge(triangles, *walker, walker->report());
  constexpr int most_steps = 64;
  for (int i = 0; i < most_steps && !values.empty(); ++i) {
    const auto what = values.take<std::uint8_t>();
    const double speed = between(0.01, 1e5, values.take<std::uint8_t>());
    const double dt = between(1e-5, 10.0, values.take<std::uint8_t>());
    const Vec3 way(values.take<std::int8_t>() / 127.0, values.take<std::int8_t>() / 127.0,
                   values.take<std::int8_t>() / 127.0);
    const roam::WalkerInput wish{speed * way, what / 16 % 4 == 1, what / 64 % 4 == 1};
    const auto act = [&]() -> const roam::StepReport& {
      switch (what % 16) {
        case 1:
          return walker->place(start + speed * way);
        case 2:
          return walker->set_mode(what / 16 % 3 == 0 ? Mode::ghost : what / 16 % 3 == 1 ? Mode::walk : Mode::fly);
        case 3:
          walker->resize(settings.radius * between(0.25, 4.0, what), settings.support_radius);
          break;
        case 4:
          judge_sweep(*world, triangles, walker->body(), walker->position(), speed * dt * way);
          break;
        default:
          break;
      }
      return walker->step(wish, dt);
    };
    // A size out of range is refused.
    if (!complaint([&] { judge(triangles, *walker, act()); }).empty()) return;
  }
}

/// Appends values as Values::take reads them.
template <class... T>
void put(std::string& input, T... values) {
  (input.append(reinterpret_cast<const char*>(&values), sizeof(values)), ...);
}

/// A floor of 20 m by 20 m, a wall, and a board over the floor; then steps ahead.
std::string walk_seed(std::uint8_t flags, std::uint8_t origin, std::uint8_t radius, std::uint8_t tall) {
  std::string input;
  put(input, flags, origin);
  constexpr std::uint8_t unit = 4;  // 2^-8 m
  const std::int16_t m = 256;
  const std::int16_t corners[12][3] = {{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0},  // floor
                                       {2, -10, 0},   {2, 10, 0},   {2, 10, 4},  {2, -10, 4},   // wall
                                       {-4, -10, 1},  {-3, -10, 1}, {-3, 10, 1}, {-4, 10, 1}};  // board
  put(input, std::uint8_t{12 - 3}, std::uint8_t{6});
  for (const auto& c : corners) {
    put(input, unit);
    for (const std::int16_t x : c) put(input, static_cast<std::int16_t>(x * m));
  }
  for (std::uint8_t quad = 0; quad < 12; quad += 4) {
    for (const std::uint8_t k : {0, 1, 2, 0, 2, 3}) put(input, static_cast<std::uint8_t>(quad + k));
  }
  for (const std::uint8_t setting :
       {radius, tall, std::uint8_t{85}, std::uint8_t{128}, std::uint8_t{0}, std::uint8_t{90}, std::uint8_t{157}}) {
    put(input, setting);
  }
  put(input, std::int16_t{0}, std::int16_t{0}, static_cast<std::int16_t>(m));
  for (std::uint8_t i = 0; i < 24; ++i) {
    put(input, static_cast<std::uint8_t>(i < 12 ? 0 : i), static_cast<std::uint8_t>(60 + 4 * i), std::uint8_t{128},
        static_cast<std::int8_t>(i % 3 == 0 ? -127 : 127), static_cast<std::int8_t>(8 * i),
        static_cast<std::int8_t>(-i));
  }
  return input;
}

std::vector<std::string> walk_seeds() {
  std::vector<std::string> all;
  for (const std::uint8_t flags : {0, 1, 2}) {
    for (const std::uint8_t origin : {0, 2, 11}) {
      all.push_back(walk_seed(flags, origin, 117, 130));  // a person
      all.push_back(walk_seed(flags, origin, 100, 0));    // a ball
    }
  }
  return all;
}

const Known walk_target({"walk", run_walk, walk_seeds});

}  // namespace
}  // namespace fuzz
