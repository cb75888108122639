// A world of a few triangles, judged by all of them.

#include "roam/world.h"

#include <algorithm>
#include <limits>

#include "generated.h"
#include "judged_queries.h"
#include "oracle.h"

namespace {

using generated::Scene;
using judged::nearest_allowed;
using roam::Body;
using roam::Vec3;
using roam::World;

struct Asked {
  Scene scene;
  std::vector<generated::Motion> motions;  ///< relative to the place of the scene
};

std::ostream& operator<<(std::ostream& out, const Asked& asked) {
  out << asked.scene;
  for (const auto& m : asked.motions) out << "\n  " << m;
  return out;
}

/// Scenes of 8 m, and motions past corners; both shrink to one.
rc::Gen<Asked> asked() {
  return rc::gen::apply(
      [](const Scene& scene, std::vector<generated::Motion> motions) {
        for (std::size_t i = 0; i < motions.size() && !scene.triangles.empty(); ++i) {
          motions[i].from += scene.triangles[i % scene.triangles.size()][0];
        }
        return Asked{scene, motions};
      },
      generated::scene(4.0, 40),
      rc::gen::scale(0.12,
                     rc::gen::container<std::vector<generated::Motion>>(rc::gen::scale(8.0, generated::motion(2.0)))));
}

/// The axis' least distance to all triangles over [0, t] of a motion.
double least(const roam::Mesh& mesh, const Body& body, const Vec3& from, const Vec3& motion, double t) {
  long double all = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    all = std::min(all, oracle::least_distance(body, from, motion, t, mesh.triangle(i)));
  }
  return static_cast<double>(all);
}

/// Calls `judge(world, mesh, farthest, motion)` for each motion of a case, in the scene's frame.
template <class Judge>
void check(int cases, const Judge& judge) {
  generated::check(cases, [&] {
    const Asked c = *asked();
    const roam::Mesh mesh = c.scene.mesh();
    const World world = World::build({&mesh, 1}, {.threads = 1, .lossless = c.scene.lossless, .progress = {}});
    for (generated::Motion m : c.motions) {
      m.from += c.scene.place;
      judge(world, mesh, c.scene.lossless ? judged::farthest_lossless : judged::farthest_off, m);
    }
  });
}

TEST(WorldProperties, SweepsAreNeitherLateNorEarly) {
  int hits = 0, in_touch = 0, all = 0;
  check(1500, [&](const World& world, const roam::Mesh& mesh, double farthest, const generated::Motion& m) {
    const roam::Impact s = world.sweep(m.body, m.from, m.motion);
    ++all;
    hits += s.hit && s.time > 0.0;
    in_touch += s.hit && s.time == 0.0;
    if (!s.hit || s.time > 0.0) {
      RC_ASSERT(least(mesh, m.body, m.from, m.motion, s.time) >= m.body.radius - nearest_allowed);
    }
    if (s.hit) {
      const roam::Triangle touched = mesh.triangle(static_cast<std::size_t>(s.triangle));
      const auto distance = oracle::distance_on_the_way(m.body, m.from, m.motion, s.time, touched);
      RC_ASSERT(static_cast<double>(distance) <= m.body.radius + farthest);
    } else {
      RC_ASSERT(s.time == 1.0);
    }
  });
  EXPECT_GE(hits, all / 5);
  EXPECT_GE(in_touch, all / 50);
}

TEST(WorldProperties, ClearanceAndGapsAreLowerBoundsAndTight) {
  check(1500, [](const World& world, const roam::Mesh& mesh, double farthest, const generated::Motion& m) {
    const double reach = *generated::number(0.0, 3.0);
    const double gap = least(mesh, m.body, m.from, m.motion, 1.0) - m.body.radius;
    const roam::Clearance near = world.clearance(m.body, m.from, m.motion, reach);
    const double bound = world.gap_bound(m.body, m.from, m.motion, reach);
    if (gap > -m.body.radius + farthest) {  // the axis meets no stored triangle: depth is distance
      RC_ASSERT(near.distance <= std::max(gap, 0.0) + nearest_allowed);
      RC_ASSERT(bound <= std::max(gap, 0.0) + nearest_allowed);
      RC_ASSERT(!near.found || near.distance >= gap - farthest);
    }
    RC_ASSERT(near.found || (near.distance == reach && gap >= reach - farthest));
    if (bound == reach) {
      RC_ASSERT(gap >= reach - nearest_allowed);
    } else {
      RC_ASSERT(gap <= std::max(bound, 0.0) * (8.0 / 7.0) + farthest);
    }
  });
}

TEST(WorldProperties, ContactsAreAllTrianglesWithinReach) {
  check(1500, [](const World& world, const roam::Mesh& mesh, double farthest, const generated::Motion& m) {
    const double reach = *generated::number(0.0, 3.0);
    std::vector<roam::Contact> contacts(mesh.triangles.size() + 1);
    contacts.resize(world.contacts(m.body, m.from, m.motion, reach, contacts));
    std::vector<int> times(mesh.triangles.size());
    for (const roam::Contact& contact : contacts) ++times[static_cast<std::size_t>(contact.triangle)];
    for (std::size_t t = 0; t < times.size(); ++t) {
      const double gap =
          static_cast<double>(oracle::least_distance(m.body, m.from, m.motion, 1.0, mesh.triangle(t))) - m.body.radius;
      RC_ASSERT(times[t] <= 1);
      RC_ASSERT(times[t] == 1 || gap >= reach - nearest_allowed);
      RC_ASSERT(times[t] == 0 || gap <= reach + farthest);
    }
    RC_ASSERT(std::is_sorted(contacts.begin(), contacts.end(),
                             [](const auto& a, const auto& b) { return a.distance < b.distance; }));
  });
}

}  // namespace
