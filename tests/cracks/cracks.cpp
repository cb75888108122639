// The lower end: what is a crack of a floor and how wide, and what only looks like one.

#include "cracks/cracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "floor_cases.h"
#include "seeded_gallery.h"

namespace {

using namespace roam;
using namespace floors;
using cracks::CrackOptions;
using cracks::find_cracks;
using cracks::FoundCrack;

constexpr double moved_tolerance = 2e-4;  ///< m, of radii in a scene that was moved, turned, split or doubled

Survey survey_of(Mesh mesh, bool lossless = true) {
  return Survey::build({std::move(mesh)}, {.threads = 1, .lossless = lossless}, 50.0);
}

std::vector<double> radii(const std::vector<FoundCrack>& cracks, Crack::Kind kind) {
  std::vector<double> all;
  for (const FoundCrack& crack : cracks) {
    if (crack.kind == kind) all.push_back(crack.radius);
  }
  return all;
}

void expect_radii(const std::vector<double>& found, const std::vector<double>& made, double tolerance) {
  EXPECT_EQ(found.size(), made.size()) << testing::PrintToString(found);
  for (std::size_t i = 0; i < std::min(found.size(), made.size()); ++i) EXPECT_NEAR(found[i], made[i], tolerance);
}

void expect_made(const FloorCase& c, const std::vector<FoundCrack>& found, double tolerance) {
  expect_radii(radii(found, Crack::Kind::crack), c.cracks, tolerance);
  expect_radii(radii(found, Crack::Kind::step_down), c.steps_down, tolerance);
  EXPECT_EQ(!radii(found, Crack::Kind::open_drop).empty(), c.has_drop);
  for (const FoundCrack& crack : found) {
    EXPECT_FALSE(crack.rim.empty());
    EXPECT_NEAR(std::hypot(crack.direction.x, crack.direction.y), 1.0, 1e-12);
  }
}

/// A case at another place and turned about z, with its triangles made over by `remade`.
FloorCase placed(const FloorCase& c, const Vec3& shift, double degrees) {
  const double a = degrees * std::numbers::pi / 180.0, cosine = std::cos(a), sine = std::sin(a);
  FloorCase other = c;
  for (Vec3& v : other.mesh.vertices) v = shift + Vec3(cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, v.z);
  other.is_reached = [=, inner = c.is_reached](const Vec3& foot) {
    const Vec3 p = foot - shift;
    return inner({cosine * p.x + sine * p.y, -sine * p.x + cosine * p.y, p.z});
  };
  return other;
}

/// Every triangle in four by the middles of its sides.
Mesh split(const Mesh& mesh) {
  Mesh finer;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle t = mesh.triangle(i);
    const Vec3 a = 0.5 * (t[0] + t[1]), b = 0.5 * (t[1] + t[2]), c = 0.5 * (t[2] + t[0]);
    scenes::add_triangle(finer, t[0], a, c);
    scenes::add_triangle(finer, a, t[1], b);
    scenes::add_triangle(finer, c, b, t[2]);
    scenes::add_triangle(finer, a, b, c);
  }
  return finer;
}

class FloorCases : public testing::TestWithParam<FloorCase> {};

TEST_P(FloorCases, HaveTheCracksTheyWereMadeWith) {
  const FloorCase& c = GetParam();
  expect_made(c, find_cracks(survey_of(c.mesh), {.threads = 1}, c.is_reached), c.tolerance);
}

TEST_P(FloorCases, AreTheSameFarFromTheOriginAndTurned) {
  for (const auto& [shift, degrees] : {std::pair{Vec3(-13739.0, 253.0, 182.0), 37.0}, {Vec3(1e5, -1e5, 50.0), 111.0}}) {
    SCOPED_TRACE(degrees);
    const FloorCase c = placed(GetParam(), shift, degrees);
    expect_made(c, find_cracks(survey_of(c.mesh), {}, c.is_reached), std::max(c.tolerance, moved_tolerance));
  }
}

TEST_P(FloorCases, AreTheSameSplitFlippedDoubledAndInAnyOrder) {
  FloorCase c = GetParam();
  c.mesh = split(c.mesh);
  scenes::Random random(7);
  std::vector<std::array<std::uint32_t, 3>>& triangles = c.mesh.triangles;
  for (std::size_t i = 0, n = triangles.size(); i < n; ++i) {
    if (random.chance(0.3)) triangles.push_back(triangles[i]);
    if (random.chance(0.5)) std::swap(triangles[i][1], triangles[i][2]);
  }
  for (std::size_t i = triangles.size(); i > 1; --i) std::swap(triangles[i - 1], triangles[random.bits() % i]);
  expect_made(c, find_cracks(survey_of(c.mesh), {}, c.is_reached), std::max(c.tolerance, moved_tolerance));
}

INSTANTIATE_TEST_SUITE_P(Cracks, FloorCases, testing::ValuesIn(floor_cases()),
                         [](const auto& tested) { return tested.param.name; });

TEST(Cracks, AreAsWideInASurveyThatStoresTo2Millimetres) {
  for (const FloorCase& c : floor_cases()) {
    SCOPED_TRACE(c.name);
    expect_made(c, find_cracks(survey_of(c.mesh, false), {}, c.is_reached), std::max(c.tolerance, moved_tolerance));
  }
}

TEST(Cracks, ArePitsForSmallFeetToo) {
  for (const double foot : {0.3, 0.4, 0.6, 0.8}) {
    SCOPED_TRACE(foot);
    const Survey survey = survey_of(holed({rectangle(3.0, 2.0, 5.0, 4.0)}));
    const auto found =
        find_cracks(survey, {.support_max = foot, .threads = 1}, [](const Vec3& p) { return p.z > -0.35; });
    EXPECT_TRUE(radii(found, Crack::Kind::crack).empty());
    EXPECT_FALSE(radii(found, Crack::Kind::open_drop).empty());
  }
}

TEST(Cracks, OfSeededGalleriesAreTheSplitsTheyWereMadeWith) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    const seeded::Gallery gallery = seeded::gallery(seed);
    std::vector<double> made;
    for (const seeded::Split& s : gallery.splits) made.push_back(0.5 * s.width);
    std::sort(made.rbegin(), made.rend());
    const auto found = find_cracks(survey_of(gallery.mesh), {}, [](const Vec3& foot) { return foot.z > -0.35; });
    expect_radii(radii(found, Crack::Kind::crack), made, 2e-5);
  }
}

TEST(Cracks, LieInTheMiddleAndKnowTheirDirectionAndRim) {
  const FloorCase c = straight_split("", 0.6, 2.0, 30.0);
  const auto found = find_cracks(survey_of(c.mesh), {}, c.is_reached);
  ASSERT_EQ(found.size(), 1u);
  const double a = std::numbers::pi / 6.0;
  const Vec3 across(std::cos(a), std::sin(a), 0.0), along(-std::sin(a), std::cos(a), 0.0), middle(4.03, 3.01, 0.0);
  const auto from_middle = [&](const Vec3& p) { return across.x * (p.x - middle.x) + across.y * (p.y - middle.y); };
  EXPECT_NEAR(from_middle(found[0].point), 0.0, 2e-5);
  EXPECT_NEAR(found[0].point.z, 0.0, 1e-9);
  EXPECT_NEAR(found[0].direction.x, across.x, 1e-6);
  EXPECT_NEAR(found[0].direction.y, across.y, 1e-6);
  // Along both rims, no gap wider than the spacing of the samples, up to the walls.
  for (const double side : {-0.3, 0.3}) {
    std::vector<double> places;
    for (const Vec3& p : found[0].rim) {
      if (std::abs(from_middle(p) - side) < 1e-9) places.push_back(along.x * p.x + along.y * p.y);
    }
    std::sort(places.begin(), places.end());
    ASSERT_FALSE(places.empty());
    for (std::size_t i = 1; i < places.size(); ++i) EXPECT_LE(places[i] - places[i - 1], 0.1 + 1e-9);
    EXPECT_NEAR(places.back() - places.front(), short_side / std::cos(a), 0.25);
  }
}

TEST(Cracks, AreOneHoweverLong) {
  Mesh mesh;
  for (const double y : {0.0, 1.4}) scenes::add_floor(mesh, 0.0, y, 30.0, y + 1.0, 0.0);
  for (const double y : {0.0, 2.4}) scenes::add_wall(mesh, 0.0, y, 30.0, y, -2.0, 2.0);
  for (const double x : {0.0, 30.0}) scenes::add_wall(mesh, x, 0.0, x, 2.4, -2.0, 2.0);
  const auto found = find_cracks(survey_of(mesh), {}, anywhere);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].radius, 0.2, 2e-5);
  EXPECT_EQ(found[0].rim.size(), 2u * 300u);
}

TEST(Cracks, KnowTheDiscThatThinBodiesNeedBesideAWall) {
  const double lattice = 0.035, nearest = 0.045;  // m: spacing, and how near to a wall the smallest body comes
  for (const FloorCase& c : floor_cases()) {
    SCOPED_TRACE(c.name);
    for (const FoundCrack& crack : find_cracks(survey_of(c.mesh), {}, c.is_reached))
      EXPECT_GE(crack.support_radius, crack.radius);
  }
  const Survey along = survey_of(holed({rectangle(0.0, 0.0, long_side, 0.5)}));
  const auto beside = find_cracks(along, {}, [](const Vec3& foot) { return foot.z > -0.35; });
  ASSERT_EQ(beside.size(), 1u);
  EXPECT_NEAR(beside[0].support_radius, 0.5 - nearest, lattice);
  const auto across = find_cracks(survey_of(straight_split("", 0.5, 2.0, 0.0).mesh), {},
                                  [](const Vec3& foot) { return foot.z > -0.35; });
  ASSERT_EQ(across.size(), 1u);
  EXPECT_NEAR(across[0].support_radius, 0.25, 2e-5);
}

TEST(Cracks, NarrowerThanTheSmallestBodyAreNotLookedFor) {
  const FloorCase c = straight_split("", 0.18, 2.0, 0.0);
  EXPECT_EQ(find_cracks(survey_of(c.mesh), {.smallest = 0.09}, c.is_reached).size(), 1u);
  EXPECT_TRUE(find_cracks(survey_of(c.mesh), {.smallest = 0.095}, c.is_reached).empty());
}

TEST(Cracks, AreOpenDropsFromTheLargestDiscOn) {
  const FloorCase c = straight_split("", 1.0, 2.0, 0.0);
  const Survey survey = survey_of(c.mesh);
  const auto wide = find_cracks(survey, {.support_max = 0.51}, c.is_reached);
  ASSERT_EQ(wide.size(), 1u);
  EXPECT_EQ(wide[0].kind, Crack::Kind::crack);
  const auto open = find_cracks(survey, {.support_max = 0.49}, c.is_reached);
  ASSERT_EQ(open.size(), 1u);
  EXPECT_EQ(open[0].kind, Crack::Kind::open_drop);
  EXPECT_EQ(open[0].radius, 0.49);
}

TEST(Cracks, AreDeeperThanAStep) {
  const FloorCase c{.name = "", .mesh = channel(0.5, 0.25)};
  EXPECT_TRUE(find_cracks(survey_of(c.mesh), {.step = 0.26}, c.is_reached).empty());
  EXPECT_EQ(find_cracks(survey_of(c.mesh), {.step = 0.2, .knee = 0.2}, [](const Vec3& f) { return f.z > -0.1; }).size(),
            1u);
}

TEST(Cracks, DoNotGrowWhereSomeOfThemIsFilled) {
  const auto widest = [](const Mesh& mesh) {
    const auto found = find_cracks(survey_of(mesh), {}, [](const Vec3& foot) { return foot.z > -0.35; });
    double most = 0.0;
    for (const FoundCrack& crack : found) most = std::max(most, crack.radius);
    return most;
  };
  const Mesh whole = holed({strip(4.0, 3.0, 0.5, 15.0), strip(4.0, 3.0, 0.6, 80.0)});
  const double most = widest(whole);
  scenes::Random random(3);
  int narrower = 0;
  for (int i = 0; i < 25; ++i) {
    Mesh filled = whole;
    const Vec3 at(random.between(3.6, 4.4), random.between(2.6, 3.4), random.between(-0.02, 0.02));
    const double half_x = random.between(0.02, 0.5), half_y = random.between(0.02, 0.5);
    scenes::add_floor(filled, at.x - half_x, at.y - half_y, at.x + half_x, at.y + half_y, at.z);
    const double left = widest(filled);
    EXPECT_LE(left, most + 2e-5) << i;
    narrower += left < most - 0.01 ? 1 : 0;
  }
  EXPECT_GT(narrower, 5);
}

TEST(Cracks, AreTheSameBitsForAnyNumberOfThreads) {
  for (const FloorCase& c : floor_cases()) {
    SCOPED_TRACE(c.name);
    const Survey survey = survey_of(c.mesh);
    const auto one = find_cracks(survey, {.threads = 1}, c.is_reached);
    const auto many = find_cracks(survey, {.threads = 0}, c.is_reached);
    ASSERT_EQ(one.size(), many.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].kind, many[i].kind);
      EXPECT_EQ(one[i].radius, many[i].radius);
      EXPECT_EQ(one[i].point, many[i].point);
      EXPECT_EQ(one[i].direction, many[i].direction);
      EXPECT_EQ(one[i].rim, many[i].rim);
    }
  }
}

TEST(Cracks, TellHowFarTheyAreAndEndWhenTold) {
  const FloorCase c = straight_split("", 0.5, 2.0, 12.0, 0.05);
  const Survey survey = survey_of(c.mesh);
  double last = 0.0;
  EXPECT_EQ(find_cracks(survey, {}, c.is_reached,
                        [&](double done) {
                          EXPECT_GE(done, last);
                          last = done;
                          return true;
                        })
                .size(),
            1u);
  EXPECT_EQ(last, 1.0);
}

TEST(Cracks, ThatWereFoundWhenToldToEndAreAnswered) {
  const FloorCase c = straight_split("", 0.5, 2.0, 12.0, 0.05);
  const Survey survey = survey_of(c.mesh);
  for (const double until : {0.8, 0.81, 0.9}) {
    int asked_again = 0;
    bool told = false, while_measuring = false;
    const auto found = find_cracks(survey, {}, c.is_reached, [&](double done) {
      if (told) ++asked_again;
      told = told || done >= until;
      while_measuring = while_measuring || (done > 0.8 && done < 1.0);
      return !told;
    });
    EXPECT_EQ(asked_again, 0) << until;
    EXPECT_EQ(while_measuring, until > 0.8) << until;
    // What was not flooded any more may be told apart from what was.
    ASSERT_GE(found.size(), 1u) << until;
    for (const FoundCrack& crack : found) {
      EXPECT_EQ(crack.kind, Crack::Kind::crack);
      EXPECT_NEAR(crack.radius, 0.25, 5e-3) << until;
      EXPECT_FALSE(crack.rim.empty());
    }
  }
}

TEST(Cracks, AreNoneWhereThereIsNoFloor) {
  EXPECT_TRUE(find_cracks(survey_of({}), {}, anywhere).empty());
  Mesh wall;
  scenes::add_wall(wall, 0.0, 0.0, 4.0, 0.0, 0.0, 3.0);
  EXPECT_TRUE(find_cracks(survey_of(wall), {}, anywhere).empty());
}

}  // namespace
