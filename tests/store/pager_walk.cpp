// Bodies on their way through stores that are larger than the memory of the pager: every free step is judged by brute
// force over the triangles around it, and nobody is ever in something unknown because something went.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "clutter.h"
#include "pager_made.h"
#include "walker_judged.h"

namespace {

using namespace scenes;
using roam::Pager;

/// A long corridor with bends and boxes, 1.5 m by 2.5 m at its narrowest, of many small triangles; and things far off.
Mesh maze(std::uint64_t seed) {
  Random random(seed);
  Mesh m;
  m.name = "maze";
  const auto fine_wall = [&](double ax, double ay, double bx, double by) {
    const int pieces = std::max(1, static_cast<int>(std::hypot(bx - ax, by - ay) / 0.5));
    for (int i = 0; i < pieces; ++i) {
      const double s = double(i) / pieces, t = double(i + 1) / pieces;
      for (int k = 0; k < 6; ++k) {
        add_wall(m, ax + s * (bx - ax), ay + s * (by - ay), ax + t * (bx - ax), ay + t * (by - ay), 0.5 * k,
                 0.5 * (k + 1));
      }
    }
  };
  constexpr int cells = 40;
  constexpr double width = 5.0;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const double x = width * i, y = width * j;
      for (int k = 0; k < 10; ++k) {
        for (int l = 0; l < 10; ++l) {
          add_floor(m, x + 0.5 * k, y + 0.5 * l, x + 0.5 * (k + 1), y + 0.5 * (l + 1), 0.0);
        }
      }
      if (random.chance(0.35)) fine_wall(x, y, x + width, y);
      if (random.chance(0.35)) fine_wall(x, y, x, y + width);
      if (random.chance(0.2)) {
        const Vec3 at(x + random.between(1.0, 3.0), y + random.between(1.0, 3.0), 0.0);
        add_box(m, at, at + Vec3(random.between(0.2, 1.0), random.between(0.2, 1.0), random.between(0.2, 2.5)));
      }
    }
  }
  const double side = cells * width;
  fine_wall(0.0, 0.0, side, 0.0);
  fine_wall(side, 0.0, side, side);
  fine_wall(side, side, 0.0, side);
  fine_wall(0.0, side, 0.0, 0.0);
  return m;
}

/// The triangles of a mesh by squares.
class Squares {
 public:
  explicit Squares(const Mesh& mesh) : mesh_(mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      roam::Box box;
      for (const Vec3& v : mesh.triangle(i)) box.include(v);
      each_of(box, [&](Square square) { triangles_[square].push_back(i); });
    }
  }

  /// All that the margin of a step depends on.
  [[nodiscard]] Mesh around(const roam::StepReport& step) const {
    roam::Box box;
    box.include(step.from);
    box.include(step.to);
    double reach = std::max(step.radius, step.axis_clearance);
    for (const roam::Segment& c : step.segments) {
      box.include(c.position);
      reach = std::max({reach, c.radius, c.axis_clearance});
    }
    box.lower -= Vec3(reach + 0.01);
    box.upper += Vec3(reach + 0.01);
    std::set<std::size_t> near;
    each_of(box, [&](Square square) {
      const auto found = triangles_.find(square);
      if (found != triangles_.end()) near.insert(found->second.begin(), found->second.end());
    });
    Mesh part;
    for (const std::size_t i : near) {
      const roam::Triangle t = mesh_.triangle(i);
      add_triangle(part, t[0], t[1], t[2]);
    }
    return part;
  }

 private:
  using Square = std::pair<int, int>;

  template <class Use>
  static void each_of(const roam::Box& box, const Use& use) {
    constexpr double side = 2.0;
    const auto number = [](double at) { return static_cast<int>(std::floor(at / side)); };
    for (int i = number(box.lower.x); i <= number(box.upper.x); ++i) {
      for (int j = number(box.lower.y); j <= number(box.upper.y); ++j) use({i, j});
    }
  }

  const Mesh& mesh_;
  std::map<Square, std::vector<std::size_t>> triangles_;
};

struct Maze {
  explicit Maze(const char* name, std::uint64_t seed) : folder(name), mesh(maze(seed)), squares(mesh) {
    made::store(folder.path(), {&mesh, 1}, {.page_tiles = 12, .tile_triangles = 1500});
    bytes = std::make_shared<made::TroubledBytes>(folder.path());
    store = roam::store::open_store(bytes, "maze");
  }
  made::Folder folder;
  Mesh mesh;
  Squares squares;
  std::shared_ptr<made::TroubledBytes> bytes;
  std::shared_ptr<const roam::Store> store;
};

struct Course {
  Mode mode = Mode::walk;
  double speed = 1.4;
  int steps = 2000;
  int teleport_each = 0;  ///< steps; 0: never
  int resize_each = 0;    ///< steps; 0: never
  int us = 200;           ///< of the clock, that a step takes
};

struct WalkTally {
  double length = 0.0;
  long held = 0, slowed = 0, embedded = 0, resized = 0;
};

/// Free steps are judged. Who was free does not come to be in the unknown by an update.
WalkTally walk(Maze& maze, Pager& pager, const Course& course, std::uint64_t seed) {
  Random random(seed);
  WalkTally tally;
  Walker w(pager, {}, course.mode, {42.5, 42.5, 1.0});
  double heading = 1.0;
  for (int i = 0; i < course.steps; ++i) {
    if (w.report().blocked || random.chance(0.02)) heading = random.between(0.0, 2.0 * std::numbers::pi);
    if (course.teleport_each > 0 && i % course.teleport_each == course.teleport_each - 1) {
      w.place({random.between(2.0, 198.0), random.between(2.0, 198.0), 1.0});
    }
    if (course.resize_each > 0 && i % course.resize_each == 0) {
      const double radius = w.settings().radius;
      w.resize(random.between(0.1, 0.6), 0.0);
      tally.resized += w.settings().radius != radius ? 1 : 0;
    }
    const Vec3 before = w.position();
    const double rise = course.mode == Mode::fly ? 1.3 - before.z : 0.0;
    w.step({.velocity = {course.speed * std::cos(heading), course.speed * std::sin(heading), rise}}, frame);
    tally.held += w.held() ? 1 : 0;
    tally.slowed += w.report().has(EventKind::slowed) ? 1 : 0;
    tally.length += glm::length(w.position() - before);
    if (!w.held()) {
      const Mesh near = maze.squares.around(w.report());
      EXPECT_FALSE(near.triangles.empty()) << "there is a floor everywhere";
      const Judge judge(near);
      const double least =
          course.resize_each > 0 ? margin(judge, w.report()) : margin(judge, w.report(), w.settings().radius);
      EXPECT_GE(least, 0.0) << i;
      if (testing::Test::HasFailure()) return tally;
    }
    const bool free = pager.clearance(w.body(), w.position(), 0.01).distance > 0.0;
    (void)pager.update(w.body(), w.position(), w.velocity());
    if (free && !(pager.clearance(w.body(), w.position(), 0.01).distance > -1e-6)) ++tally.embedded;
    std::this_thread::sleep_for(std::chrono::microseconds(course.us));
  }
  return tally;
}

TEST(PagerWalk, OnFootInLittleMemory) {
  Maze maze("pager_on_foot", 1);
  ASSERT_GT(maze.store->info().resident_bytes, 2u << 20);
  Pager pager(maze.store, {.memory = Pager::least_memory});
  const WalkTally tally = walk(maze, pager, {.steps = 2000}, 5);
  EXPECT_EQ(tally.embedded, 0);
  EXPECT_GT(tally.length, 20.0);
}

TEST(PagerWalk, AtFiftyMetresASecondInLittleMemory) {
  for (const std::uint64_t seed : {2, 3}) {
    Maze maze("pager_fast", seed);
    Pager pager(maze.store, {.memory = Pager::least_memory, .loaders = static_cast<int>(seed) - 1});
    const WalkTally tally =
        walk(maze, pager, {.mode = seed == 2 ? Mode::fly : Mode::walk, .speed = 50.0, .steps = 1500, .us = 300}, seed);
    EXPECT_EQ(tally.embedded, 0);
    EXPECT_GT(tally.length, 200.0);
  }
}

TEST(PagerWalk, WithSlowReadsTheBodyGoesSlowlyAndNeverThrough) {
  Maze maze("pager_slow", 4);
  maze.bytes->delay_us = 20'000;
  Pager pager(maze.store, {.memory = Pager::least_memory});
  const WalkTally tally = walk(maze, pager, {.speed = 50.0, .steps = 1000, .us = 500}, 4);
  EXPECT_EQ(tally.embedded, 0);
  EXPECT_GT(tally.slowed, 0);
  EXPECT_GT(tally.length, 5.0);
}

TEST(PagerWalk, InAnotherSizeAgainAndAgain) {
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    Maze maze("pager_sizes", 6);
    Pager pager(maze.store, {.memory = Pager::least_memory});
    const WalkTally tally = walk(maze, pager, {.mode = mode, .speed = 15.0, .steps = 1000, .resize_each = 7}, 7);
    EXPECT_EQ(tally.embedded, 0);
    EXPECT_GT(tally.length, 20.0);
    EXPECT_GT(tally.resized, 30);
    EXPECT_GT(pager.stats().loads, 20U);
  }
}

TEST(PagerWalk, PutAnywhereAgainAndAgain) {
  Maze maze("pager_teleports", 5);
  Pager pager(maze.store, {.memory = Pager::least_memory, .loaders = 2});
  const WalkTally tally = walk(maze, pager, {.speed = 5.0, .steps = 2500, .teleport_each = 60, .us = 500}, 6);
  EXPECT_EQ(tally.embedded, 0);
  EXPECT_GT(tally.length, 20.0);

  // From one end to the other and back at once: by then the loading threads want to let go first what was left.
  const roam::Body body{0.3, 0.6};
  const Vec3 here(4.5, 4.5, 1.0), there(195.5, 195.5, 1.0);
  int free = 0;
  for (int i = 0; i < 8; ++i) {
    ASSERT_TRUE(pager.wait(body, here, Vec3(0.0), 60.0));
    (void)pager.update(body, there, Vec3(0.0));
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    if (!(pager.clearance(body, here, 0.01).distance > 0.0)) continue;
    ++free;
    (void)pager.update(body, here, Vec3(0.0));
    ASSERT_GT(pager.clearance(body, here, 0.01).distance, 0.0) << i;
  }
  EXPECT_GT(free, 4);
  EXPECT_GT(pager.stats().evictions, 20U);
}

}  // namespace
