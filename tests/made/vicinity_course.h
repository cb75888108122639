#pragma once
/// \file
/// Bodies that move in small steps, as those with a Vicinity do, and the queries that they make.

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "clutter.h"
#include "judged_queries.h"
#include "roam/space.h"
#include "world/nearby.h"
#include "world/vicinity.h"

namespace course {

using roam::Body;
using roam::Impact;
using roam::Mesh;
using roam::Space;
using roam::Vec3;
using roam::Vicinity;

inline Impact sweep_in(const Space& space, Vicinity& vicinity, const Body& body, const Vec3& from, const Vec3& motion) {
  return roam::Nearby::sweep(space, vicinity, {body, from, motion});
}
inline double gap_in(const Space& space, Vicinity& vicinity, const Body& body, const Vec3& from, const Vec3& motion,
                     double reach) {
  return roam::Nearby::gap_bound(space, vicinity, {body, from, motion}, reach);
}

/// Compares bits, not values: -0 is not 0.
inline bool same(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }
inline bool same(const Vec3& a, const Vec3& b) { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }
inline bool same(const Impact& a, const Impact& b) {
  return a.hit == b.hit && same(a.time, b.time) && same(a.point, b.point) && same(a.normal, b.normal) &&
         a.feature == b.feature && same(a.distance, b.distance) && a.triangle == b.triangle && a.unknown == b.unknown;
}

struct Course {
  int steps = 1000;
  bool on_foot = false;  ///< level steps, with a short downward query after each; else near surfaces, in all directions
  int restart_each = 120;
  double largest = 0.5;  ///< metres: radius
};

/// A sphere or a capsule.
inline Body some_body(clutter::Random& random, double largest) {
  return {random.between(0.02, 1.0) * largest, random.engine() % 3 == 0 ? 0.0 : random.between(0.0, 1.8) * largest};
}

/// A place where a body barely touches a triangle of the mesh.
inline Vec3 beside(clutter::Random& random, const Mesh& mesh, const Body& body) {
  const roam::Triangle t = mesh.triangle(random.engine() % mesh.triangles.size());
  const double u = random.unit(), v = random.unit() * (1.0 - u);
  const Vec3 out = random.direction();
  return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]) + (body.radius + random.between(0.0, 0.1)) * out +
         Vec3(0.0, 0.0, std::copysign(body.half_height, out.z));
}

/// Moves on through the mesh. Calls `asker.gap_bound(body, from, motion, reach)` and `asker.sweep(body, from, motion)`.
template <class Asker>
void go(clutter::Random& random, const Mesh& mesh, const Course& course, Asker& asker) {
  constexpr double skin = 3e-3;
  Body body;
  Vec3 at(0.0), ahead(0.0), wall(0.0);
  int stuck = 2;
  for (int i = 0; i < course.steps && !testing::Test::HasFatalFailure(); ++i) {
    if (stuck > 1 || i % course.restart_each == 0) {
      body = some_body(random, course.largest);
      at = beside(random, mesh, body);
      ahead = random.direction();
      stuck = 0;
    }
    if (random.engine() % 40 == 0) body.half_height *= 0.5;
    if (random.engine() % 30 == 0) ahead = random.direction();
    Vec3 direction = ahead + 0.2 * random.direction() - 0.2 * wall;
    if (course.on_foot) direction.z = 0.0;
    const double length = random.engine() % 20 == 0 ? random.between(0.05, 0.19) : random.between(1e-4, 0.05);
    const Vec3 motion = length / std::max(0.05, glm::length(direction)) * direction;
    const auto sweep = [&](const Vec3& way) {
      const Impact s = asker.sweep(body, at, way);
      at += s.time * way;
      if (!s.hit) return s;
      at += skin * s.normal;
      stuck = s.time == 0.0 ? stuck + 1 : 0;
      return s;
    };
    const double gap = asker.gap_bound(body, at, motion, random.engine() % 4 == 0 ? 0.25 : random.between(0.0, 0.25));
    if (gap > 0.1 && random.engine() % 2 == 0) {
      at += motion;
    } else if (const Impact s = sweep(motion); s.hit) {
      wall = s.normal;
      ahead = s.time > 0.0 ? ahead - glm::dot(ahead, wall) * wall : random.direction();
    }
    if (course.on_foot) (void)sweep(Vec3(0.0, 0.0, -random.between(0.01, 0.08)));
  }
}

/// Statistics of a course.
struct Tally {
  long sweeps = 0, hits = 0, touching = 0, gaps = 0, near = 0;
  long kept = 0;      ///< queries answered by the vicinity
  long left = 0;      ///< other queries: the surroundings were too much for it
  long gathered = 0;  ///< how often the vicinity was collected again
  long tiles = 0;     ///< queries with a vicinity of more than one tile
  long nodes = 0;     ///< queries with a vicinity of more entries than a node has children
  long pages = 0;     ///< queries with a vicinity of more than one index

  [[nodiscard]] long asked() const { return sweeps + gaps; }
};

/// Queries a space with a vicinity, and has each result judged.
class Judged {
 public:
  Vicinity vicinity;
  Tally tally;

  Judged(const Space& space, const Mesh& mesh, bool lossless)
      : space_(&space), judge_(mesh), farthest_(lossless ? judged::farthest_lossless : judged::farthest_off) {}

  /// From now on uses another space, of the same triangles or of others.
  void turn_to(const Space& space) { space_ = &space; }

  Impact sweep(const Body& body, const Vec3& from, const Vec3& motion) {
    const Impact s = sweep_in(*space_, vicinity, body, from, motion);
    SCOPED_TRACE(testing::Message() << "sweep " << tally.sweeps << " after " << tally.gaps << " gaps");
    judged::judge_sweep(s, body, from, motion, farthest_, judge_);
    const Impact without = space_->sweep(body, from, motion);
    [&] { ASSERT_LE(std::abs(s.time - without.time) * glm::length(motion), judged::along(motion, without)); }();
    ++tally.sweeps;
    tally.hits += s.hit ? 1 : 0;
    tally.touching += s.hit && s.time == 0.0 ? 1 : 0;
    note();
    return s;
  }
  double gap_bound(const Body& body, const Vec3& from, const Vec3& motion, double reach) {
    const double bound = gap_in(*space_, vicinity, body, from, motion, reach);
    SCOPED_TRACE(testing::Message() << "gap " << tally.gaps << " after " << tally.sweeps << " sweeps");
    judged::judge_gap(bound, body, from, motion, reach, judge_);
    ++tally.gaps;
    tally.near += bound > 0.0 && bound < reach ? 1 : 0;
    note();
    return bound;
  }

 private:
  void note() {
    const Vicinity::State& kept = *vicinity.state();
    if (!(kept.box.lower == last_.lower && kept.box.upper == last_.upper)) ++tally.gathered;
    last_ = kept.box;
    ++(kept.complete ? tally.kept : tally.left);
    if (!kept.complete) return;
    tally.tiles += kept.roots.count > 1 ? 1 : 0;
    int inner = 0;
    bool pages = false;
    for (int i = 0; i < kept.roots.count; ++i) {
      const roam::index::Root& root = kept.roots.root[static_cast<std::size_t>(i)];
      inner += root.node.inner_count;
      pages = pages || root.owner != kept.roots.root[0].owner;
    }
    tally.nodes += inner > 0 ? 1 : 0;
    tally.pages += pages ? 1 : 0;
  }

  const Space* space_;
  judged::NearJudge judge_;
  double farthest_;
  roam::Box last_;
};

}  // namespace course
