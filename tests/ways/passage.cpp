// How wide the way between two places is, against scenes whose answer is known by construction.
#include "roam/passage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "roam/route.h"
#include "seeded_gallery.h"

namespace {

using namespace scenes;
using roam::Mode;
using roam::Opening;
using roam::Passage;
using roam::PassageOptions;
using roam::Survey;

constexpr double passage_error = 2e-4;  // m
const PassageOptions tall_person{.height = 1.9};

Survey surveyed(const Mesh& mesh) {
  return Survey::build({mesh}, {.threads = 1, .lossless = true, .progress = {}}, 50.0);
}

Passage widest(const Mesh& mesh, const Vec3& from, const Vec3& to, const PassageOptions& options = tall_person) {
  return roam::widest_way(surveyed(mesh), from, to, options);
}
Passage widest(const seeded::Gallery& g, const PassageOptions& options = tall_person) {
  return widest(g.mesh, g.from, g.to, options);
}

/// A room from x = 0 to 10, y = -2 to 2, 2.6 m high.
Mesh long_room() {
  Mesh m;
  add_box(m, {0.0, -2.0, 0.0}, {10.0, 2.0, 2.6});
  return m;
}
constexpr Vec3 room_end{1.5, 0.0, 0.0}, room_other_end{8.5, 0.0, 0.0};

/// A wall across the room at x = 5 with an opening from `low` to `high` (y), up to `top`.
void add_doorway(Mesh& m, double low, double high, double top, double x = 5.0, double y0 = -2.0, double y1 = 2.0) {
  add_wall(m, x, y0, x, low, 0.0, 2.6);
  add_wall(m, x, high, x, y1, 0.0, 2.6);
  if (top < 2.6) add_wall(m, x, low, x, high, top, 2.6);
}

TEST(Passage, IsHalfTheNarrowestDoorOfFiftySeededGalleries) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const seeded::Gallery g = seeded::gallery(seed);
    const Passage p = widest(g);
    ASSERT_TRUE(p.found) << seed;
    EXPECT_TRUE(p.limited) << seed;
    EXPECT_NEAR(p.radius, g.upper(), passage_error) << seed;
    ASSERT_TRUE(p.opening) << seed;
    const auto& door = *std::min_element(g.doors.begin(), g.doors.end(),
                                         [](const auto& a, const auto& b) { return a.width < b.width; });
    EXPECT_EQ(p.opening->kind, Opening::Kind::door) << seed;
    EXPECT_NEAR(p.opening->width, door.width, 2.0 * passage_error) << seed;
    EXPECT_LT(std::hypot(p.opening->point.x - door.point.x, p.opening->point.y - door.point.y),
              0.5 * door.thickness + 0.01)
        << seed;
    EXPECT_GT(std::abs(p.opening->direction.x * door.across.x + p.opening->direction.y * door.across.y), 0.999) << seed;
  }
}

TEST(Passage, IsTheSameForTheSphereThatRollsOverSills) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const seeded::Gallery g = seeded::gallery(seed);
    const Passage p = widest(g, {});
    EXPECT_NEAR(p.radius, g.upper(), passage_error) << seed;
  }
}

/// How a body of a share of the widest radius fares along the answered way through the doors of a gallery.
roam::Outcome walked(const seeded::Gallery& g, const PassageOptions& options, double share) {
  const Survey survey = surveyed(g.mesh);
  const Passage p = roam::widest_way(survey, g.from, g.to, options);
  roam::WalkerSettings settings = roam::WalkerSettings::sphere(share * p.radius);
  if (options.height > 0.0) {
    settings = {};
    settings.radius = share * p.radius;
    settings.height = options.height;
  }
  std::vector<Vec3> centres = p.way;
  for (Vec3& c : centres) c.z += 0.5 * settings.height;
  roam::Walker walker(survey.world(), settings, Mode::walk, centres.front());
  return roam::follow(walker, centres).outcome;
}

TEST(Passage, LeadsAWalkerThatIsALittleSlimmerAndNoneThatIsALittleWider) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const seeded::Gallery g = seeded::build(seeded::gallery(seed).doors, {});
    EXPECT_EQ(walked(g, tall_person, 0.97), roam::Outcome::reached) << seed;
    EXPECT_EQ(walked(g, tall_person, 1.02), roam::Outcome::blocked) << seed;
  }
}

TEST(Passage, LeadsASphereLikewise) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const seeded::Gallery g = seeded::build(seeded::gallery(seed).doors, {});
    EXPECT_EQ(walked(g, {}, 0.97), roam::Outcome::reached) << seed;
    EXPECT_EQ(walked(g, {}, 1.02), roam::Outcome::blocked) << seed;
  }
}

TEST(Passage, AnswersAWayThatBruteForceFindsFree) {
  for (std::uint64_t seed = 20; seed < 26; ++seed) {
    const seeded::Gallery g = seeded::build(seeded::gallery(seed).doors, {});
    const Passage p = widest(g);
    ASSERT_GE(p.way.size(), 2U);
    const Judge judge(g.mesh);
    const double half = 0.5 * (tall_person.height - tall_person.step);
    const roam::Body body{p.radius - 5e-4, half - p.radius};
    const Vec3 above(0.0, 0.0, tall_person.step + half);
    double length = 0.0;
    for (std::size_t i = 1; i < p.way.size(); ++i) {
      const Vec3 motion = p.way[i] - p.way[i - 1];
      EXPECT_GE(judge.over(body, p.way[i - 1] + above, motion, 1.0), body.radius - 1e-6) << seed;
      length += std::sqrt(motion.x * motion.x + motion.y * motion.y + motion.z * motion.z);
    }
    EXPECT_NEAR(p.length, length, 1e-9);
    EXPECT_LT(length, 1.1 * (g.to.x - g.from.x)) << "no zigzag";
  }
}

TEST(Passage, GrowsNeverNarrowerWithAWiderDoor) {
  double before = 0.0;
  for (const double width : {0.30, 0.31, 0.38, 0.5, 0.501, 0.62, 0.77, 0.9, 1.2, 1.5, 1.59}) {
    Mesh m = long_room();
    add_doorway(m, 0.3 - 0.5 * width, 0.3 + 0.5 * width, 2.6);
    const Passage p = widest(m, room_end, room_other_end);
    EXPECT_NEAR(p.radius, 0.5 * width, passage_error);
    EXPECT_GE(p.radius, before);
    before = p.radius;
  }
}

TEST(Passage, DoesNotDependOnWhereTheSceneLiesOrHowItIsMeshed) {
  for (std::uint64_t seed = 100; seed < 103; ++seed) {
    const seeded::Gallery g = seeded::gallery(seed);
    const double radius = widest(g).radius;
    const auto same = [&](const seeded::Gallery& other, const char* what) {
      EXPECT_NEAR(widest(other).radius, radius, passage_error) << seed << " " << what;
    };
    same(seeded::moved(g, {-13739.0, 253.0, 182.0}), "moved");
    same(seeded::moved(g, {1e5, -1e5, 1e5}), "moved far");
    same(seeded::turned(g, 0.5), "turned");
    same(seeded::turned(g, 2.2), "turned on");
    same(seeded::reordered(g, seed), "reordered");
    same(seeded::flipped(g, seed), "flipped");
    same(seeded::doubled(g), "doubled");
    same(seeded::split(g, seed), "split");
  }
}

TEST(Passage, IsTheSameBothWays) {
  for (std::uint64_t seed = 200; seed < 206; ++seed) {
    const seeded::Gallery g = seeded::gallery(seed);
    EXPECT_NEAR(widest(g.mesh, g.from, g.to).radius, widest(g.mesh, g.to, g.from).radius, 0.25 * passage_error) << seed;
  }
}

TEST(Passage, TakesTheWiderOfTwoDoorsAlsoWhereTheLatticePrefersTheOther) {
  // The narrower one lies on the lattice that the start sets, the wider one half a spacing off it.
  Mesh m = long_room();
  add_wall(m, 5.0, -2.0, 5.0, -1.4, 0.0, 2.6);
  add_wall(m, 5.0, -0.8, 5.0, 0.7, 0.0, 2.6);
  add_wall(m, 5.0, 1.32, 5.0, 2.0, 0.0, 2.6);
  for (const Vec3& end : {Vec3(8.5, 0.1, 0.0), Vec3(5.4, -1.1, 0.0)}) {  // the other one just behind the narrower
    const Passage p = widest(m, {1.5, 0.1, 0.0}, end);
    EXPECT_NEAR(p.radius, 0.31, passage_error);
    ASSERT_TRUE(p.opening);
    EXPECT_NEAR(p.opening->point.y, 1.01, 0.01);
  }
}

TEST(Passage, IsNotLimitedWhereNothingIsNarrow) {
  const Passage p = widest(long_room(), room_end, room_other_end, {.height = 1.9, .widest = 0.6});
  EXPECT_TRUE(p.found);
  EXPECT_FALSE(p.limited);
  EXPECT_EQ(p.radius, 0.6);
  EXPECT_FALSE(p.opening);
  EXPECT_TRUE(p.complete);
}

TEST(Passage, OfATallBodyIsWhatItsHeightLeavesAboveTheKnee) {
  const Passage p = widest(long_room(), room_end, room_other_end, {.height = 1.5});
  EXPECT_FALSE(p.limited);
  EXPECT_DOUBLE_EQ(p.radius, 0.6);
  EXPECT_TRUE(p.proven);
}

TEST(Passage, EndsAtAClosedWallAndSaysWhere) {
  Mesh m = long_room();
  add_wall(m, 5.0, -2.0, 5.0, 2.0, 0.0, 2.6);
  const Passage p = widest(m, room_end, room_other_end);
  EXPECT_FALSE(p.found);
  EXPECT_EQ(p.radius, 0.0);
  EXPECT_TRUE(p.way.empty());
  ASSERT_TRUE(p.opening);
  EXPECT_NEAR(p.opening->point.x, 5.0, 0.2);
}

TEST(Passage, DoesNotJoinRoomsThatLieApart) {
  Mesh m = long_room(), other = long_room();
  shift(other, {20.0, 0.0, 0.0});
  m.vertices.insert(m.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (auto t : other.triangles) m.triangles.push_back({t[0] + 24, t[1] + 24, t[2] + 24});
  for (auto& t : m.triangles)
    for (auto& v : t) ASSERT_LT(v, m.vertices.size());
  const Passage p = widest(m, room_end, room_other_end + Vec3(20.0, 0.0, 0.0));
  EXPECT_FALSE(p.found);
  EXPECT_TRUE(p.complete);
}

TEST(Passage, PassesUnderALintelOnlyWhatIsLower) {
  Mesh m = long_room();
  add_doorway(m, -0.6, 0.6, 1.85);
  EXPECT_FALSE(widest(m, room_end, room_other_end).found);
  EXPECT_NEAR(widest(m, room_end, room_other_end, {.height = 1.84}).radius, 0.6, passage_error);
}

TEST(Passage, OfASphereUnderALintelIsHalfItsHeight) {
  Mesh m = long_room();
  add_doorway(m, -1.0, 1.0, 0.9);
  const Passage p = widest(m, room_end, room_other_end, {});
  EXPECT_NEAR(p.radius, 0.45, passage_error);
  ASSERT_TRUE(p.opening);
  EXPECT_EQ(p.opening->kind, Opening::Kind::lintel);
}

TEST(Passage, GoesOverAKerbAndNotOverALowWall) {
  for (const double height : {0.05, 0.15, 0.28, 0.35, 0.5}) {
    Mesh m = long_room();
    add_box(m, {4.8, -2.0, 0.0}, {5.2, 2.0, height});
    const Passage p = widest(m, room_end, room_other_end, {.height = 1.8});
    EXPECT_EQ(p.found, height < 0.3) << height;
    EXPECT_FALSE(p.found && p.limited) << height;
  }
}

TEST(Passage, ClimbsStairsAndIsNotNarrowerForThem) {
  Mesh m;
  add_floor(m, 0.0, -2.0, 4.0, 2.0, 0.0);
  const double rise = 0.17, tread = 0.28;
  for (int i = 0; i < 10; ++i) {
    const double x = 4.0 + tread * i;
    add_wall(m, x, -2.0, x, 2.0, rise * i, rise * (i + 1));
    add_floor(m, x, -2.0, x + tread, 2.0, rise * (i + 1));
  }
  add_floor(m, 4.0 + 10 * tread, -2.0, 10.0, 2.0, 10 * rise);
  for (const double y : {-2.0, 2.0}) add_wall(m, 0.0, y, 10.0, y, 0.0, 5.0);
  const Passage p = widest(m, room_end, {8.5, 0.0, 1.7}, {.height = 1.8});
  ASSERT_TRUE(p.found);
  EXPECT_FALSE(p.limited);
  EXPECT_NEAR(p.way.back().z, 1.7, 0.01);
}

TEST(Passage, OfASphereClimbsNoMoreThanItsRadius) {
  // A sphere that fits the door is lower than its sill.
  Mesh m = long_room();
  add_doorway(m, -0.12, 0.12, 2.6);
  add_box(m, {4.95, -0.12, 0.0}, {5.05, 0.12, 0.2});
  EXPECT_FALSE(widest(m, room_end, room_other_end, {}).found);
  EXPECT_NEAR(widest(m, room_end, room_other_end, {.height = 1.8}).radius, 0.12, passage_error);
}

TEST(Passage, IsBoundedAndProvenByWhatFitsAtItsEnds) {
  const Vec3 narrow(0.4, 0.0, 0.0);
  for (const auto& [from, to] : {std::pair{narrow, room_other_end}, {room_other_end, narrow}}) {
    const Passage p = widest(long_room(), from, to);
    EXPECT_NEAR(p.radius, 0.4, passage_error);
    EXPECT_LE(p.radius, p.bound);
    EXPECT_TRUE(p.limited);
    EXPECT_TRUE(p.proven);
    EXPECT_NEAR(p.bound, 0.4, passage_error);
  }
}

TEST(Passage, TakesEndsDownToTheFloorAndAwayFromWalls) {
  Mesh m = long_room();
  add_doorway(m, -0.4, 0.4, 2.6);
  const Passage p = widest(m, {1.5, 0.0, 1.7}, {9.99, 0.0, 1.7});
  ASSERT_TRUE(p.found);
  EXPECT_NEAR(p.way.front().z, 0.0, 1e-3);
  EXPECT_LT(p.way.back().x, 9.951);
}

TEST(Passage, IsLookedForOnceWhereTheWallBesideAnEndDecides) {
  int searches = 0;
  PassageOptions sphere;
  sphere.progress = [&](std::uint64_t) {
    ++searches;
    return true;
  };
  const Vec3 beside_wall{8.5, 1.69, 0.0};  // nearer to it than any place of the lattice that is taken
  const Passage p = widest(long_room(), room_end, beside_wall, sphere);
  ASSERT_TRUE(p.found && p.limited);
  EXPECT_NEAR(p.radius, 0.31, passage_error);
  EXPECT_LT(searches, 10) << "a way round what stands beside the end was looked for again and again";
}

TEST(Passage, RefusesAnEndWithinAWall) {
  Mesh m = long_room();
  add_box(m, {4.96, -2.0, 0.0}, {5.04, 2.0, 2.6});
  EXPECT_THROW(static_cast<void>(widest(m, room_end, {5.0, 0.0, 0.0})), roam::Error);
  EXPECT_THROW(static_cast<void>(widest(m, room_end, {50.0, 0.0, 0.0})), roam::Error);
  EXPECT_THROW(static_cast<void>(widest(m, {NAN, 0.0, 0.0}, room_other_end)), roam::Error);
  EXPECT_THROW(static_cast<void>(widest(m, room_end, room_other_end, {.height = 0.2})), roam::Error);
  EXPECT_THROW(static_cast<void>(widest(m, room_end, room_other_end, {.narrowest = 2.0})), roam::Error);
}

TEST(Passage, SaysThatAnEndLiesFartherOffThanItsLatticeReaches) {
  Mesh m;
  add_floor(m, -1.0, -2.0, 1101.0, 2.0, 0.0);
  const Survey survey = Survey::build({m}, {.threads = 1, .lossless = true, .progress = {}});
  const Passage p = widest_way(survey, {0.0, 0.0, 1.0}, {1100.0, 0.0, 1.0}, {.height = 1.8, .spacing = 0.001});
  EXPECT_FALSE(p.found);
  EXPECT_FALSE(p.complete);
}

TEST(Passage, SaysWhenItWasEndedEarly) {
  const Passage few = widest(long_room(), room_end, room_other_end, {.height = 1.9, .most_places = 50});
  EXPECT_FALSE(few.complete);
  EXPECT_FALSE(few.found);
  PassageOptions stopped = tall_person;
  stopped.progress = [](std::uint64_t) { return false; };
  EXPECT_FALSE(widest(long_room(), room_end, room_other_end, stopped).complete);
}

}  // namespace
