// Random walks and flights through a patchwork whose patches come late, in random order, coarse and fine, or not at
// all. Brute force judges every step against what is in use at that moment.

#include "roam/patchwork.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numbers>
#include <vector>

#include "walker_judged.h"

namespace {

using namespace scenes;
using roam::Box;
using roam::PatchId;
using roam::Patchwork;

constexpr int tiles = 8;         // along x and y; the finest are one tile, then 2 by 2, then 4 by 4
constexpr double width = 4.0;    // metres, of a tile
constexpr double ceiling = 4.0;  // metres

/// One patch of the landscape, the Mesh that it holds, and what the test does with it.
struct Tile {
  Box where;
  Mesh mesh;
  int parent = -1;
  PatchId id = PatchId::none;
  bool delivered = false;
};

/// Boxes that stand about on a floor. What is coarse has larger ones, smaller ones, and lacks some.
struct Landscape {
  std::vector<Tile> all;  ///< each after the one that it refines

  Landscape(Random& random, const Vec3& origin, bool coarse) {
    std::vector<Box> boxes;
    for (int i = 0; i < tiles * tiles * 2; ++i) {
      const Vec3 at(width * (i / 2 / tiles), width * (i / 2 % tiles), 0.0);
      const Vec3 lower = at + Vec3(random.between(0.4, 2.5), random.between(0.4, 2.5), 0.0);
      const Vec3 size(random.between(0.1, 1.0), random.between(0.1, 1.0), random.between(0.1, 3.0));
      boxes.push_back({origin + lower, origin + lower + size});
    }
    for (int span = coarse ? 4 : 1; span > 0; span /= 2) {
      for (int i = 0; i < tiles; i += span) {
        for (int j = 0; j < tiles; j += span) add(random, origin, boxes, i, j, span, coarse);
      }
    }
  }

  void add(Random& random, const Vec3& origin, const std::vector<Box>& boxes, int i, int j, int span, bool coarse) {
    Tile tile;
    tile.mesh.name = "tile";
    const Vec3 lower = origin + Vec3(width * i, width * j, 0.0), size(width * span, width * span, ceiling);
    tile.where = {lower, lower + size};
    add_floor(tile.mesh, lower.x, lower.y, lower.x + size.x, lower.y + size.y, lower.z);
    for (const Box& box : boxes) {
      const Vec3 c = box.center();
      if (c.x < lower.x || c.y < lower.y || c.x >= lower.x + size.x || c.y >= lower.y + size.y) continue;
      if (span > 1 && random.chance(0.3)) continue;
      const double more = span > 1 ? random.between(-0.04, 0.2) : 0.0;
      const Vec3 grown(more, more, std::max(0.0, more));
      add_box(tile.mesh, box.lower - Vec3(grown.x, grown.y, 0.0), box.upper + grown);
    }
    if (coarse && span < 4) {
      for (std::size_t k = 0; k < all.size(); ++k) {
        const Box& above = all[k].where;
        const Vec3 c = tile.where.center();
        const bool inside = c.x > above.lower.x && c.x < above.upper.x && c.y > above.lower.y && c.y < above.upper.y;
        if (inside && above.size().x > 1.5 * size.x) tile.parent = static_cast<int>(k);  // the last is the smallest
      }
    }
    all.push_back(std::move(tile));
  }

  void expect_all(Patchwork& space) {
    for (Tile& t : all) {
      t.id = space.expect(t.where, t.parent < 0 ? PatchId::none : all[static_cast<std::size_t>(t.parent)].id);
    }
  }
  void deliver(Patchwork& space, Tile& tile) const {
    space.deliver(tile.id, build(tile.mesh));
    tile.delivered = true;
  }

  /// What is in use, as a mesh: the triangles of the patches, and the sides of the unknown boxes.
  [[nodiscard]] Mesh in_use(const Patchwork& space) const {
    Mesh mesh;
    for (const Tile& t : all) {
      if (!space.object_name(static_cast<std::uint64_t>(t.id) << 32).empty()) {
        for (std::size_t i = 0; i < t.mesh.triangles.size(); ++i) {
          const roam::Triangle corner = t.mesh.triangle(i);
          add_triangle(mesh, corner[0], corner[1], corner[2]);
        }
      } else if (unknown(space, t)) {
        add_box(mesh, t.where.lower, t.where.upper);
      }
    }
    return mesh;
  }
  [[nodiscard]] static bool unknown(const Patchwork& space, const Tile& tile) {
    const auto c = space.clearance({0.0, 0.0}, tile.where.center(), 0.0);
    return c.unknown && Patchwork::patch(c.triangle) == tile.id;
  }
};

struct PatchTally {
  long moved = 0, waited = 0, held = 0, went_on = 0, refined = 0, delayed = 0;
};

struct Wanderer {
  Random& random;
  double heading = 0.0;

  Vec3 velocity(const Walker& w) {
    if (w.report().blocked || random.chance(0.03)) heading = random.between(0.0, 2.0 * std::numbers::pi);
    const double speed = random.chance(0.7) ? random.between(0.5, 5.0) : random.between(5.0, 50.0);
    return {speed * std::cos(heading), speed * std::sin(heading), random.between(-2.0, 2.0)};
  }
};

/// Everything comes in random order while the body is under way; a tenth fails and comes at the end.
void roam_while_it_loads(Random& random, const Vec3& origin, const WalkerSettings& settings, Mode mode,
                         PatchTally& tally) {
  Landscape land(random, origin, true);
  Patchwork space;
  land.expect_all(space);
  space.update();
  const double side = width * tiles;
  Walker w(space, settings, mode, origin + Vec3(random.between(1.0, side - 1.0), random.between(1.0, side - 1.0), 1.5));
  Mesh mesh = land.in_use(space);
  Judge judge(mesh);
  Wanderer wanderer{random};
  std::vector<std::size_t> order(land.all.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = i;
    std::swap(order[i], order[random.bits() % (i + 1)]);
  }
  std::size_t next = 0;
  bool waited = false, late = false;
  for (int step = 0; step < 900; ++step) {
    if (next < order.size() && random.chance(0.2)) {
      Tile& tile = land.all[order[next++]];
      if (random.chance(0.1)) {
        space.fail(tile.id, "lost");
      } else {
        land.deliver(space, tile);
      }
    }
    if (step == 700) {
      late = true;
      for (Tile& t : land.all) {
        if (!t.delivered) land.deliver(space, t);
      }
    }
    const auto patches = space.stats().patches;
    if (space.update(w.body(), w.position())) {
      tally.refined += space.stats().patches > patches + 1;
      mesh = land.in_use(space);
      judge = Judge(mesh);
    }
    tally.delayed += space.stats().waiting > 0;
    const StepReport& r = w.step({wanderer.velocity(w), random.chance(0.01), random.chance(0.02)}, frame);
    tally.waited += r.met_unknown;
    tally.held += r.held;
    if (w.held()) {
      // In the middle of a wall it is held as in any space.
      ASSERT_TRUE(r.met_unknown || judge.distance(w.body(), w.position(), 1.0) < settings.radius + 2e-3);
    } else {
      tally.moved += r.to != r.from;
      tally.went_on += waited && !r.met_unknown;
      ASSERT_GE(margin(judge, r, settings.radius), 0.0) << "step " << step;
      for (const roam::Segment& c : r.segments) {
        for (const Tile& t : land.all) {
          const Vec3 apart = glm::max(t.where.lower - c.position, c.position - t.where.upper);
          ASSERT_FALSE(std::max({apart.x, apart.y, apart.z}) < 0.0 && Landscape::unknown(space, t)) << "inside";
        }
      }
    }
    waited = r.met_unknown;
    ASSERT_FALSE(late && step > 701 && r.met_unknown);
    const bool gone = w.position().x < origin.x - 1.0 || w.position().x > origin.x + side + 1.0 ||
                      w.position().y < origin.y - 1.0 || w.position().y > origin.y + side + 1.0 ||
                      w.position().z > origin.z + 6.0 || w.position().z < origin.z;
    if (gone || (w.held() && !r.met_unknown)) {
      w.place(origin + Vec3(random.between(1.0, side - 1.0), random.between(1.0, side - 1.0), 1.5));
    }
  }
  EXPECT_EQ(space.stats().unknown, 0u);
}

TEST(WalkerPatchwork, IsNeverNearerThanItsRadiusToWhatIsInUseNorInsideTheUnknown) {
  PatchTally tally;
  std::uint64_t seed = 70;
  for (const Vec3 origin : {Vec3(0.0), Vec3(6.4e6, -6.4e6, 3e3)}) {
    for (const WalkerSettings& settings : {WalkerSettings{}, WalkerSettings::sphere(0.35)}) {
      for (const Mode mode : {Mode::fly, Mode::walk}) {
        for (int round = 0; round < 8; ++round) {
          Random random(++seed);
          roam_while_it_loads(random, origin, settings, mode, tally);
          if (testing::Test::HasFatalFailure()) FAIL() << "seed " << seed;
        }
      }
    }
  }
  // No proof unless it moved, waited, was held, went on, and saw coarse give way to fine, at once and delayed.
  EXPECT_GT(tally.moved, 5000);
  EXPECT_GT(tally.waited, 500);
  EXPECT_GT(tally.held, 100);
  EXPECT_GT(tally.went_on, 50);
  EXPECT_GT(tally.refined, 50);
  EXPECT_GT(tally.delayed, 20);
}

TEST(WalkerPatchwork, NeverPassesAWallOfAFineSceneThatHasNotComeYet) {
  long moved = 0, waited = 0;
  for (std::uint64_t seed = 91; seed < 99; ++seed) {
    Random random(seed);
    Landscape land(random, Vec3(0.0), false);
    Mesh whole;
    for (const Tile& t : land.all) {
      for (std::size_t i = 0; i < t.mesh.triangles.size(); ++i) {
        const roam::Triangle corner = t.mesh.triangle(i);
        add_triangle(whole, corner[0], corner[1], corner[2]);
      }
    }
    const Judge judge(whole);
    Patchwork space;
    land.expect_all(space);
    const double side = width * tiles;
    space.deliver(land.all[27].id, build(land.all[27].mesh));
    land.all[27].delivered = true;
    space.update();
    const WalkerSettings settings = seed % 2 == 0 ? WalkerSettings{} : WalkerSettings::sphere(0.35);
    Walker w(space, settings, seed % 4 < 2 ? Mode::fly : Mode::walk, land.all[27].where.lower + Vec3(0.4, 0.4, 1.0));
    ASSERT_FALSE(w.held());
    Wanderer wanderer{random};
    for (int step = 0; step < 1500; ++step) {
      Tile& tile = land.all[random.bits() % land.all.size()];
      if (!tile.delivered && random.chance(0.1)) land.deliver(space, tile);
      space.update(w.body(), w.position());
      const StepReport& r = w.step({wanderer.velocity(w)}, frame);
      ASSERT_FALSE(w.held());
      ASSERT_GE(margin(judge, r, settings.radius), 0.0) << "step " << step << " seed " << seed;
      moved += r.to != r.from;
      waited += r.met_unknown;
      const Vec3 p = w.position();
      if (p.x < 0.0 || p.y < 0.0 || p.x > side || p.y > side || p.z > ceiling || p.z < 0.0) {
        w.place(land.all[27].where.lower + Vec3(0.4, 0.4, 1.0));
      }
    }
  }
  EXPECT_GT(moved, 5000);
  EXPECT_GT(waited, 200);
}

}  // namespace
