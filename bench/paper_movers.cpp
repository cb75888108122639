#include "paper_movers.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>

#include "node_controller.h"
#include "roam/import.h"
#include "roam/pager.h"
#include "roam/size_learner.h"
#include "roam/store.h"
#include "roam/walker.h"
#include "roam/world.h"
#include "wasm_driver.h"

namespace roam::bench {
namespace {

constexpr double dt = 1.0 / paper_rate;
constexpr double gravity = 9.81;  // m/s2
constexpr int most_slides = 4;

/// A walker and its space.
struct Walk {
  std::shared_ptr<const Space> space;
  std::shared_ptr<Pager> pager;  // null for a world
  std::optional<Walker> walker;
  std::optional<SizeLearner> learner;  // on adapting ways
  double radius = 0.0;                 // the least on the last step, m
};

Mover mover_of(const std::shared_ptr<Walk>& walk) {
  Mover mover;
  mover.place = [walk](const Way& way) {
    constexpr double longest_wait = 60.0;  // s, for the surroundings of the start
    if (walk->pager) (void)walk->pager->wait(way.body(), way.from, Vec3(0.0), longest_wait);
    const WalkerSettings settings =
        way.height > 0.0 ? WalkerSettings::person(way.radius, way.height) : WalkerSettings::sphere(way.radius);
    walk->walker.emplace(*walk->space, settings, way.walking ? Mode::walk : Mode::fly, way.from);
    walk->learner.reset();
    if (!way.adapting) return;
    Profile profile;
    profile.radius = way.radius;
    profile.height = 2.0 * way.radius;
    walk->learner.emplace(profile);
  };
  mover.step = [walk](const Vec3& velocity) {
    const StepReport& report = walk->walker->step({.velocity = velocity}, dt);
    walk->radius = report.radius;
    for (const Segment& corner : report.segments) walk->radius = std::min(walk->radius, corner.radius);
    if (walk->learner) {
      if (const auto lesson = walk->learner->watch(*walk->walker, velocity, dt)) {
        walk->learner->take(*walk->walker, *lesson);
      }
    }
    return walk->walker->position();
  };
  mover.radius = [walk] { return walk->radius; };
  if (walk->pager) {
    mover.rest = [walk](double seconds) {
      const Walker& walker = *walk->walker;
      (void)walk->pager->wait(walker.body(), walker.position(), walker.velocity(), seconds);
    };
  }
  return mover;
}

/// PhysX's capsule controller, nearly a sphere, in a node process.
Mover physx_in_node(const PaperScene& scene, const std::string& wasm) {
  FloatMesh mesh;
  read_tiles(scene, [&](const FloatMesh& tile) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size() / 3);
    mesh.vertices.insert(mesh.vertices.end(), tile.vertices.begin(), tile.vertices.end());
    for (const std::uint32_t corner : tile.indices) mesh.indices.push_back(first + corner);
  });
  return node_controller(mesh, "physx", wasm, paper_shift);
}

/// Moves a body as far as it can go; the touch that stopped it.
using AdvanceBy = std::function<std::optional<Touch>(double radius, Vec3& place, const Vec3& motion)>;

/// Slides along what it touches, `slides` motions a step at most. A walking body also falls.
Mover sliding(AdvanceBy advance, int slides, const Vec3& shift) {
  struct State {
    Way way;
    Vec3 place{0.0};
    double falling = 0.0;  // m/s
  };
  const auto state = std::make_shared<State>();
  Mover mover;
  mover.place = [state, shift](const Way& way) { *state = {way, way.from + shift, 0.0}; };
  mover.step = [state, shift, slides, advance = std::move(advance)](const Vec3& velocity) {
    Vec3 rest = velocity * dt;
    for (int i = 0; i < slides && glm::length(rest) > 1e-9; ++i) {
      const Vec3 before = state->place;
      const auto touch = advance(state->way.radius, state->place, rest);
      if (!touch) break;
      rest -= state->place - before;
      rest -= std::min(0.0, glm::dot(rest, touch->normal)) * touch->normal;
      if (glm::dot(rest, velocity) <= 0.0) break;
    }
    if (state->way.walking) {
      state->falling += gravity * dt;
      if (advance(state->way.radius, state->place, {0.0, 0.0, -state->falling * dt})) state->falling = 0.0;
    }
    return state->place - shift;
  };
  return mover;
}

}  // namespace

Mover roam_in(std::shared_ptr<const Space> space) {
  const auto walk = std::make_shared<Walk>();
  walk->space = std::move(space);
  return mover_of(walk);
}

Mover roam_in_memory(const PaperScene& scene) {
  return roam_in(std::make_shared<World>(World::build(import_scene(scene.scene).meshes)));
}

Mover roam_in_store(const PaperScene& scene) {
  const auto walk = std::make_shared<Walk>();
  walk->pager = std::make_shared<Pager>(Store::open(scene.store), PagerOptions{.memory = scene.memory});
  walk->space = walk->pager;
  return mover_of(walk);
}

Mover roam_sweep(const PaperScene& scene) {
  const auto world = std::make_shared<World>(World::build(import_scene(scene.scene).meshes));
  return collide_and_slide(
      [world](double radius, const Vec3& from, const Vec3& motion) -> std::optional<Touch> {
        const Impact impact = world->sweep({.radius = radius}, from, motion);
        if (!impact.hit) return std::nullopt;
        return Touch{impact.time, impact.normal};
      },
      Vec3(0.0));
}

Mover collide_and_slide(Sweep sweep, const Vec3& shift, double skin) {
  // Moves to the contact of the sweep, less the skin.
  return sliding(
      [sweep = std::move(sweep), skin](double radius, Vec3& place, const Vec3& motion) {
        const double length = glm::length(motion);
        std::optional<Touch> touch;
        if (length > 0.0) touch = sweep(radius, place, motion);
        place += (touch ? std::max(0.0, touch->time - skin / length) : 1.0) * motion;
        return touch;
      },
      most_slides, shift);
}

Mover go_or_stay(Blocked blocked, const Vec3& shift) {
  return sliding(
      [blocked = std::move(blocked)](double radius, Vec3& place, const Vec3& motion) {
        if (blocked(radius, place, motion)) return std::optional<Touch>(Touch{});
        place += motion;
        return std::optional<Touch>();
      },
      1, shift);
}

std::vector<PaperRow> paper_rows(const std::string& wasm) {
  std::vector<PaperRow> rows{
      {"roam", "roam", "Walker in a World, all in memory", {}, Reads::file, roam_in_memory},
      {"roam-store", "roam, from a store", "Walker in a Pager over a store", {}, Reads::store, roam_in_store},
      {"roam-sweep",
       "roam, sweep and slide",
       "World::sweep and the slide of the rows below, in place of Walker",
       {},
       Reads::file,
       roam_sweep},
      {"paper",
       "the paper's method",
       "box intersector, equations (1)-(6), slide; OpenSceneGraph, all in memory",
       {},
       Reads::osgb,
       [](const PaperScene& scene) { return paper_method(scene, Graph::loaded); }},
      {"paper-kdtree",
       "the paper's method, KdTree",
       "the same with a KdTree a geometry",
       {},
       Reads::osgb,
       [](const PaperScene& scene) { return paper_method(scene, Graph::with_kd_trees); }},
      {"paper-paged",
       "the paper's method, paged",
       "the same over PagedLOD, pages read when they are met",
       {},
       Reads::osgb,
       [](const PaperScene& scene) { return paper_method(scene, Graph::paged); }},
      {"polytope",
       "polytope",
       "osgUtil::PolytopeIntersector, go or stay; all in memory",
       {},
       Reads::osgb,
       [](const PaperScene& scene) { return polytope_method(scene, Graph::loaded); }},
      {"polytope-kdtree",
       "polytope, KdTree",
       "the same with a KdTree a geometry",
       {},
       Reads::osgb,
       [](const PaperScene& scene) { return polytope_method(scene, Graph::with_kd_trees); }},
#ifdef ROAM_BENCH_BULLET
      {"osg-bullet",
       "OSG + Bullet",
       "read by OpenSceneGraph; sweep of a sphere in Bullet, slide; all in memory",
       {},
       Reads::osgb,
       [](const PaperScene& scene) { return bullet_sweep(scene, read_tiles); }},
#else
      {"osg-bullet", "OSG + Bullet", {}, "install libbullet-dev and build again"},
#endif
#ifdef ROAM_BENCH_OGRE
      {"ogre-bullet",
       "OGRE + Bullet",
       "loaded by OGRE from its own files; sweep of a sphere in Bullet, slide; all in memory",
       {},
       Reads::ogre,
       [](const PaperScene& scene) { return bullet_sweep(scene, read_ogre_tiles); }},
#else
      {"ogre-bullet", "OGRE + Bullet", {}, "install libogre-1.12-dev and libbullet-dev and build again"},
#endif
      {"physx", "PhysX controller (WASM)",
       "npm physx-js-webidl under node: PxCapsuleController of a height of 2 mm, timed around its move()",
       wasm_package_missing("physx-js-webidl", wasm)},
      {"unity", "Unity3D", {}, "it cannot be run without its maker's leave"},
  };
  for (PaperRow& row : rows) {
    if (row.name != "physx" || !row.missing.empty()) continue;
    row.load = [wasm](const PaperScene& scene) { return physx_in_node(scene, wasm); };
  }
  return rows;
}

}  // namespace roam::bench
