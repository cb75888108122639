// What instruction_counts.sh runs under callgrind: a fixed scene and fixed queries, one function a row. What a row asks
// does not depend on what was answered before, but for the walkers' steps, which are rows of their own.

#include <hwy/targets.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <numbers>
#include <span>
#include <string_view>
#include <vector>

#include "clutter.h"
#include "roam/walker.h"
#include "roam/world.h"

namespace {

using clutter::Random;
using roam::Vec3;

struct Query {
  roam::Body body;
  Vec3 from{0.0};
  Vec3 motion{0.0};
};
using Queries = std::span<const Query>;

constexpr double width = 48.0, height = 4.0, cell = 0.4;  // m: of the hall and of its triangles
constexpr double wave = 0.3, roughness = 0.03;            // m: of its floor and its ceiling
constexpr double pillar = 0.6;                            // m: radius

void add_sheet(roam::Mesh& mesh, double z, Random& random) {
  constexpr int cells = static_cast<int>(width / cell);
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (int y = 0; y <= cells; ++y) {
    for (int x = 0; x <= cells; ++x) {
      mesh.vertices.push_back(
          {x * cell, y * cell,
           z + wave * std::sin(0.3 * x) * std::cos(0.2 * y) + random.between(-roughness, roughness)});
    }
  }
  for (std::uint32_t y = 0; y < cells; ++y) {
    for (std::uint32_t x = 0; x < cells; ++x) {
      const std::uint32_t a = first + y * (cells + 1) + x, b = a + 1, c = a + cells + 1, d = c + 1;
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
    }
  }
}

void add_pillar(roam::Mesh& mesh, double x, double y) {
  constexpr std::uint32_t sides = 16, rings = 12;
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t ring = 0; ring <= rings; ++ring) {
    for (std::uint32_t side = 0; side < sides; ++side) {
      const double angle = 2.0 * std::numbers::pi * side / sides;
      mesh.vertices.push_back(
          {x + pillar * std::cos(angle), y + pillar * std::sin(angle), (height + 1.0) * ring / rings - 0.5});
    }
  }
  for (std::uint32_t ring = 0; ring < rings; ++ring) {
    for (std::uint32_t side = 0; side < sides; ++side) {
      const std::uint32_t a = first + ring * sides + side, b = first + ring * sides + (side + 1) % sides;
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, b + sides}, {a, b + sides, a + sides}});
    }
  }
}

/// A rough hall with pillars: 69,888 triangles.
roam::Mesh hall() {
  roam::Mesh mesh;
  Random random(1);
  add_sheet(mesh, 0.0, random);
  add_sheet(mesh, height, random);
  for (double y = 3.0; y < width; y += 6.0) {
    for (double x = 3.0; x < width; x += 12.0) add_pillar(mesh, x, y);
  }
  return mesh;
}

Vec3 free_place(const roam::World& world, const roam::Body& body, Random& random) {
  constexpr double apart = 0.01;  // m
  for (;;) {
    const Vec3 place{random.between(1.0, width - 1.0), random.between(1.0, width - 1.0), random.between(0.2, height)};
    if (world.clearance(body, place, apart).distance >= apart) return place;
  }
}

enum class Kind { sphere, capsule, ray };

std::vector<Query> anywhere(const roam::World& world, int count, Kind kind) {
  Random random(2);
  std::vector<Query> queries;
  for (int i = 0; i < count; ++i) {
    Query q;
    q.body = kind == Kind::capsule ? roam::Body::capsule(0.3, 1.8) : roam::Body{random.between(0.2, 1.0), 0.0};
    if (kind == Kind::ray) q.body = {0.0, 0.0};
    q.from = free_place(world, q.body, random);
    q.motion = random.direction() * (kind == Kind::ray ? 30.0 : random.between(0.05, 2.0));
    queries.push_back(q);
  }
  return queries;
}

/// Steps of walkers that rise and sink on straight ways, into floor, ceiling and pillars and out again.
std::vector<Query> along_ways(int walkers, int steps) {
  Random random(3);
  std::vector<Query> queries;
  for (int w = 0; w < walkers; ++w) {
    const roam::Body body{random.between(0.3, 0.5), 0.0};
    const double step = random.between(1.5, 50.0) / 60.0, angle = random.between(0.0, 2.0 * std::numbers::pi);
    const auto place = [&](int i) {
      const double far = std::min(step * i, 0.4 * width);
      return Vec3{0.5 * width + far * std::cos(angle), 0.5 * width + far * std::sin(angle),
                  0.5 * height + (0.5 * height - body.radius) * std::sin(0.4 * far)};
    };
    for (int i = 0; i < steps; ++i) queries.push_back({body, place(i), place(i + 1) - place(i)});
  }
  return queries;
}

/// Something of every answer, so that no query can be left out.
double kept = 0.0;

void sweep_all(const roam::World& world, Queries queries) {
  for (const Query& q : queries) kept += world.sweep(q.body, q.from, q.motion).time;
}

void clear_all(const roam::World& world, Queries queries) {
  for (const Query& q : queries) kept += world.clearance(q.body, q.from, 1.0).distance;
}

void step_all(roam::Walker& walker, int steps, double speed) {
  for (int i = 0; i < steps; ++i) {
    const double angle = 0.02 * i;
    kept += walker.step({.velocity = speed * Vec3{std::cos(angle), std::sin(angle), 0.1}}, 1.0 / 60.0).axis_clearance;
  }
}

}  // namespace

// The rows. callgrind finds them by their names.
#define ROAM_ROW extern "C" __attribute__((noinline)) void

ROAM_ROW row_build(roam::World& world, const roam::Mesh& mesh) {
  world = roam::World::build({&mesh, 1}, {.threads = 1, .progress = {}});
}
ROAM_ROW row_sweep_lossless(const roam::World& world, Queries queries) { sweep_all(world, queries); }
ROAM_ROW row_clearance_lossless(const roam::World& world, Queries queries) { clear_all(world, queries); }
ROAM_ROW row_sweep_random(const roam::World& world, Queries queries) { sweep_all(world, queries); }
ROAM_ROW row_sweep_coherent(const roam::World& world, Queries queries) { sweep_all(world, queries); }
ROAM_ROW row_sweep_capsule(const roam::World& world, Queries queries) { sweep_all(world, queries); }
ROAM_ROW row_ray(const roam::World& world, Queries queries) { sweep_all(world, queries); }
ROAM_ROW row_ray_short(const roam::World& world, Queries queries) { sweep_all(world, queries); }
ROAM_ROW row_clearance(const roam::World& world, Queries queries) { clear_all(world, queries); }
ROAM_ROW row_clearance_of_way(const roam::World& world, Queries queries) {
  for (const Query& q : queries) kept += world.clearance(q.body, q.from, q.motion, 1.0).distance;
}
ROAM_ROW row_contacts(const roam::World& world, Queries queries) {
  roam::Contact contacts[32];
  for (const Query& q : queries) kept += double(world.contacts(q.body, q.from, Vec3(0.0), 0.05, contacts));
}
/// Floor within a band about the start: most triangles around are steep, or at other heights.
ROAM_ROW row_floor(const roam::World& world, Queries queries) {
  const roam::Floor floor{.slope_degrees = 45.0, .band = 0.25};
  for (const Query& q : queries) {
    roam::Floor here = floor;
    here.point = q.from;
    kept += world.floor_clearance({0.0, here.band}, q.from, 0.85, here).distance;
  }
}
ROAM_ROW row_walker_step_on_foot(roam::Walker& walker, int steps) { step_all(walker, steps, 1.4); }
ROAM_ROW row_walker_step_flying(roam::Walker& walker, int steps) { step_all(walker, steps, 20.0); }

int main() try {
  // Callgrind knows no wider one, and narrower ones take other paths.
  if ((hwy::SupportedTargets() & HWY_AVX2) == 0) {
    std::puts("skipped: this machine has no AVX2");
    return 0;
  }
  hwy::SetSupportedTargetsForTest(HWY_AVX2);
  hwy::GetChosenTarget().DeInit();

  // The rows' names and how often each asks, for whoever reads the counts.
  const auto row = [](std::string_view name, std::size_t count) {
    std::printf("%.*s %zu\n", static_cast<int>(name.size()), name.data(), count);
  };
  const roam::Mesh mesh = hall();
  roam::World world;
  row("build", mesh.triangles.size());
  row_build(world, mesh);

  const std::vector<Query> spheres = anywhere(world, 2000, Kind::sphere), ways = along_ways(40, 75),
                           capsules = anywhere(world, 1000, Kind::capsule), rays = anywhere(world, 2000, Kind::ray);
  row("sweep_random", spheres.size());
  row_sweep_random(world, spheres);
  row("sweep_coherent", ways.size());
  row_sweep_coherent(world, ways);
  row("sweep_capsule", capsules.size());
  row_sweep_capsule(world, capsules);
  row("ray", rays.size());
  row_ray(world, rays);
  std::vector<Query> short_rays = ways;
  for (Query& q : short_rays) q.body = {0.0, 0.0};
  row("ray_short", short_rays.size());
  row_ray_short(world, short_rays);
  row("clearance", spheres.size());
  row_clearance(world, spheres);
  row("clearance_of_way", spheres.size());
  row_clearance_of_way(world, spheres);
  row("contacts", ways.size());
  row_contacts(world, ways);
  row("floor", spheres.size());
  row_floor(world, spheres);

  const roam::World lossless = roam::World::build({&mesh, 1}, {.threads = 1, .lossless = true, .progress = {}});
  row("sweep_lossless", ways.size());
  row_sweep_lossless(lossless, ways);
  row("clearance_lossless", spheres.size());
  row_clearance_lossless(lossless, spheres);

  constexpr int steps = 600;
  const Vec3 start{0.5 * width, 0.5 * width, 0.5 * height};
  roam::Walker person(world, {}, roam::Mode::walk, start);
  row("walker_step_on_foot", steps);
  row_walker_step_on_foot(person, steps);
  roam::Walker sphere(world, roam::WalkerSettings::sphere(0.4), roam::Mode::fly, start);
  row("walker_step_flying", steps);
  row_walker_step_flying(sphere, steps);
  return std::isfinite(kept) ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
