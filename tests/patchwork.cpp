// What a patchwork holds: what is expected, comes, fails, and takes the place of something coarser.

#include "roam/patchwork.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "walker_scenes.h"

namespace {

using roam::Body;
using roam::Box;
using roam::Mesh;
using roam::PatchId;
using roam::Patchwork;
using roam::Vec3;
using roam::World;

const Box unit{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
const Body ball{0.25, 0.0};

/// A board over the unit square at the height z.
World board(double z, const char* name = "board") {
  Mesh m;
  m.name = name;
  scenes::add_floor(m, 0.0, 0.0, 1.0, 1.0, z);
  return scenes::build(m);
}

/// Half of it: the left one, or the right one.
World half_board(double z, bool right) {
  Mesh m;
  m.name = right ? "right" : "left";
  scenes::add_floor(m, right ? 0.5 : 0.0, 0.0, right ? 1.0 : 0.5, 1.0, z);
  return scenes::build(m);
}

/// The height at which a ball that falls beside the middle is stopped, less its radius; -1 if it is not. Says by what.
double stopped_at(const Patchwork& space, double x, std::string* by = nullptr) {
  const auto s = space.sweep(ball, {x, 0.5, 3.0}, {0.0, 0.0, -4.0});
  if (!s.hit) return -1.0;
  if (by) *by = space.object_name(s.triangle);
  return 3.0 - 4.0 * s.time - ball.radius;
}

constexpr double stored = 3e-3;  // metres: margin, storing and sweep tolerance together

TEST(Patchwork, IsFreeWhereNothingIsExpected) {
  Patchwork space;
  EXPECT_FALSE(space.update());
  EXPECT_FALSE(space.sweep(ball, {0.0, 0.0, 0.0}, {1e6, 0.0, 0.0}).hit);
  EXPECT_FALSE(space.clearance(ball, {0.0, 0.0, 0.0}, 1000.0).found);
  EXPECT_TRUE(space.bounds().empty());
  EXPECT_EQ(space.object_name(0), "");
  EXPECT_EQ(space.object_name(~0ULL), "");
}

TEST(Patchwork, RefusesWhatAWorldRefuses) {
  const Patchwork space;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)space.sweep(ball, {nan, 0.0, 0.0}, Vec3(0.0)), roam::Error);
  EXPECT_THROW((void)space.sweep(ball, Vec3(0.0), {2e6, 0.0, 0.0}), roam::Error);
  EXPECT_THROW((void)space.sweep({-1.0, 0.0}, Vec3(0.0), Vec3(0.0)), roam::Error);
  EXPECT_THROW((void)space.clearance(ball, Vec3(0.0), 2000.0), roam::Error);
  roam::Contact contact;
  EXPECT_THROW((void)space.contacts(ball, Vec3(0.0), Vec3(0.0), nan, {&contact, 1}), roam::Error);
}

TEST(Patchwork, WhatIsExpectedIsUnknownAndSolidFromTheNextUpdateOn) {
  Patchwork space;
  const PatchId patch = space.expect(unit);
  EXPECT_EQ(stopped_at(space, 0.5), -1.0);
  EXPECT_TRUE(space.update());
  EXPECT_FALSE(space.update());
  EXPECT_EQ(space.stats().unknown, 1u);
  EXPECT_EQ(space.stats().coming, 1u);
  const auto s = space.sweep(ball, {0.5, 0.5, 3.0}, {0.0, 0.0, -4.0});
  ASSERT_TRUE(s.hit);
  EXPECT_TRUE(s.unknown);
  EXPECT_EQ(s.normal, Vec3(0.0, 0.0, 1.0));
  EXPECT_NEAR(3.0 - 4.0 * s.time, 1.25 + Patchwork::margin, 1e-5);
  EXPECT_EQ(Patchwork::patch(s.triangle), patch);
  EXPECT_EQ(space.object_name(s.triangle), "not loaded yet");
  EXPECT_EQ(space.bounds().upper, unit.upper);
}

TEST(Patchwork, ABodyInWhatIsUnknownIsEmbeddedAndShownTheShortestWayOut) {
  Patchwork space;
  (void)space.expect(unit);
  space.update();
  const auto s = space.sweep(ball, {0.5, 0.1, 0.6}, {0.0, 1.0, 0.0});
  ASSERT_TRUE(s.hit);
  EXPECT_TRUE(s.unknown);
  EXPECT_EQ(s.time, 0.0);
  EXPECT_EQ(s.normal, Vec3(0.0, -1.0, 0.0));
  EXPECT_NEAR(s.distance, -(0.1 + ball.radius + Patchwork::margin), 1e-9);
  const auto c = space.clearance(ball, {0.5, 0.1, 0.6}, 1.0);
  EXPECT_TRUE(c.found && c.unknown);
  EXPECT_NEAR(c.distance, s.distance, 1e-12);
}

TEST(Patchwork, WhatIsDeliveredTakesThePlaceOfTheUnknownAtTheNextUpdate) {
  Patchwork space;
  const PatchId patch = space.expect(unit);
  space.update();
  const auto before = space.sweep(ball, {0.5, 0.5, 3.0}, {0.0, 0.0, -4.0}).triangle;
  space.deliver(patch, board(0.25));
  EXPECT_NEAR(stopped_at(space, 0.5), 1.0, stored);
  const auto revision = space.revision();
  EXPECT_TRUE(space.update(ball, {0.5, 0.5, 5.0}));
  EXPECT_GT(space.revision(), revision);
  std::string by;
  EXPECT_NEAR(stopped_at(space, 0.5, &by), 0.25, stored);
  EXPECT_EQ(by, "board");
  EXPECT_EQ(space.object_name(before), "");
  EXPECT_EQ(space.stats().patches, 1u);
  EXPECT_EQ(space.stats().unknown, 0u);
  EXPECT_EQ(space.stats().coming, 0u);
  EXPECT_EQ(space.stats().triangles, 2u);
  EXPECT_GT(space.stats().bytes, 0u);
}

TEST(Patchwork, AnEmptyWorldIsAnAnswer) {
  Patchwork space;
  const PatchId patch = space.expect(unit);
  space.deliver(patch, World());
  EXPECT_TRUE(space.update());
  EXPECT_EQ(stopped_at(space, 0.5), -1.0);
  EXPECT_EQ(space.stats().patches, 1u);
}

TEST(Patchwork, WhatFailsStaysSolidSaysWhyAndMayStillCome) {
  Patchwork space;
  const PatchId patch = space.expect(unit);
  space.fail(patch, "the file is damaged");
  space.fail(patch, "the disk is gone");
  space.update();
  std::string by;
  EXPECT_NEAR(stopped_at(space, 0.5, &by), 1.0, stored);
  EXPECT_EQ(by, "the disk is gone");
  EXPECT_EQ(space.stats().failed, 1u);
  EXPECT_EQ(space.stats().unknown, 1u);
  EXPECT_EQ(space.stats().coming, 0u);
  space.deliver(patch, board(0.5));
  EXPECT_TRUE(space.update());
  EXPECT_NEAR(stopped_at(space, 0.5), 0.5, stored);
  EXPECT_EQ(space.stats().failed, 0u);
}

TEST(Patchwork, RefusesWhatItWasNotToldOf) {
  Patchwork space;
  EXPECT_THROW(space.deliver(PatchId::none, World()), roam::Error);
  EXPECT_THROW(space.deliver(PatchId{1}, World()), roam::Error);
  EXPECT_THROW(space.fail(PatchId{7}, "why"), roam::Error);
  EXPECT_THROW((void)space.expect(unit, PatchId{1}), roam::Error);
  EXPECT_THROW((void)space.expect(Box{}), roam::Error);
  EXPECT_THROW((void)space.expect(Box{{0.0, 0.0, 0.0}, {1e300, 1.0, 1.0}}), roam::Error);
  const PatchId patch = space.expect(unit);
  space.deliver(patch, World());
  EXPECT_THROW(space.deliver(patch, World()), roam::Error);
  EXPECT_THROW(space.fail(patch, "too late"), roam::Error);
}

/// A coarse board at 0.5, refined by two halves at 0.25.
struct Refined {
  Patchwork space;
  PatchId coarse = space.expect(unit);
  PatchId left = space.expect(unit, coarse), right = space.expect(unit, coarse);
};

TEST(Patchwork, FinerPatchesReplaceTheCoarseOneWhenAllOfThemAreThere) {
  Refined r;
  r.space.deliver(r.coarse, board(0.5));
  EXPECT_TRUE(r.space.update());
  EXPECT_EQ(r.space.stats().coming, 2u);
  r.space.deliver(r.left, half_board(0.25, false));
  EXPECT_FALSE(r.space.update());
  EXPECT_NEAR(stopped_at(r.space, 0.2), 0.5, stored);
  r.space.deliver(r.right, half_board(0.25, true));
  EXPECT_TRUE(r.space.update());
  EXPECT_NEAR(stopped_at(r.space, 0.2), 0.25, stored);
  EXPECT_NEAR(stopped_at(r.space, 0.8), 0.25, stored);
  EXPECT_EQ(r.space.stats().patches, 2u);
}

TEST(Patchwork, ACoarsePatchStaysWhileOneThatRefinesItHasFailed) {
  Refined r;
  r.space.deliver(r.coarse, board(0.5));
  r.space.deliver(r.left, half_board(0.25, false));
  r.space.fail(r.right, "missing");
  r.space.update();
  EXPECT_NEAR(stopped_at(r.space, 0.2), 0.5, stored);
  EXPECT_EQ(r.space.stats().failed, 1u);
  EXPECT_EQ(r.space.stats().unknown, 0u);
  r.space.deliver(r.right, half_board(0.25, true));
  EXPECT_TRUE(r.space.update());
  EXPECT_NEAR(stopped_at(r.space, 0.2), 0.25, stored);
}

TEST(Patchwork, FinerPatchesMayComeBeforeWhatTheyRefine) {
  Refined r;
  r.space.deliver(r.left, half_board(0.25, false));
  r.space.update();
  EXPECT_NEAR(stopped_at(r.space, 0.2), 1.0, stored);  // all of the box is unknown still
  r.space.deliver(r.right, half_board(0.25, true));
  r.space.update();
  EXPECT_NEAR(stopped_at(r.space, 0.2), 0.25, stored);
  r.space.deliver(r.coarse, board(0.5));  // too late: dropped
  EXPECT_FALSE(r.space.update());
  EXPECT_NEAR(stopped_at(r.space, 0.2), 0.25, stored);
  EXPECT_EQ(r.space.stats().patches, 2u);
  EXPECT_EQ(r.space.stats().coming, 0u);
}

TEST(Patchwork, ARefinementWaitsUntilTheBodyIsFreeInIt) {
  Refined r;
  r.space.deliver(r.coarse, board(0.5));
  r.space.update();
  r.space.deliver(r.left, half_board(0.8, false));
  r.space.deliver(r.right, half_board(0.8, true));
  const Vec3 caught(0.2, 0.5, 0.9);  // free above the coarse board, but not above the fine one
  ASSERT_GT(r.space.clearance(ball, caught, 1.0).distance, 0.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(r.space.update(ball, caught));
    EXPECT_EQ(r.space.stats().waiting, 2u);
    EXPECT_NEAR(stopped_at(r.space, 0.2), 0.5, stored);
  }
  EXPECT_TRUE(r.space.update(ball, {0.2, 0.5, 1.2}));
  EXPECT_EQ(r.space.stats().waiting, 0u);
  EXPECT_NEAR(stopped_at(r.space, 0.2), 0.8, stored);
}

TEST(Patchwork, ABodyThatDoesNotFitAnywayHoldsNothingUp) {
  Refined r;
  r.space.deliver(r.coarse, board(0.5));
  r.space.update();
  r.space.deliver(r.left, half_board(0.6, false));
  r.space.deliver(r.right, half_board(0.6, true));
  EXPECT_TRUE(r.space.update(ball, {0.2, 0.5, 0.55}));
}

TEST(Patchwork, ABodyAtRestOnTheCoarseFloorLetsTheSameFineFloorIn) {
  for (int i = 0; i < 40; ++i) {
    const double z = 0.3 + 1.7e-4 * i;  // at any height of the grids that floors are stored on
    Refined r;
    Mesh wide;  // and the new one on a coarser grid than the old one
    scenes::add_floor(wide, -31.0 - 0.37 * i, -29.0, 30.0, 31.0 + 0.11 * i, z);
    r.space.deliver(r.coarse, board(z));
    r.space.update();
    const double skin = 1e-4 + 2.0 * r.space.largest_error();
    const auto s = r.space.sweep(ball, {0.2, 0.5, 3.0}, {0.0, 0.0, -4.0});
    const Vec3 at_rest(0.2, 0.5, 3.0 - 4.0 * s.time + skin);
    r.space.deliver(r.left, scenes::build(wide));
    r.space.deliver(r.right, World());
    EXPECT_TRUE(r.space.update(ball, at_rest)) << z;
    EXPECT_GT(r.space.clearance(ball, at_rest, 1.0).distance, 0.0);
  }
}

TEST(Patchwork, WhatIsUnknownIsReplacedWhateverTheBody) {
  Refined r;
  r.space.update();
  const Vec3 place(0.2, 0.5, 1.4);
  ASSERT_GT(r.space.clearance(ball, place, 1.0).distance, 0.0);
  // What comes sticks out of the box that was announced: to wait for the body could be to wait for ever.
  r.space.deliver(r.left, half_board(1.3, false));
  r.space.deliver(r.right, half_board(1.3, true));
  EXPECT_TRUE(r.space.update(ball, place));
  EXPECT_LT(r.space.clearance(ball, place, 1.0).distance, 0.0);
}

TEST(Patchwork, ABodyCaughtInTwoPatchesIsToldOfTheDeepest) {
  for (const bool turned : {false, true}) {
    Patchwork space;
    const PatchId first = space.expect(unit), second = space.expect(unit);
    space.deliver(turned ? second : first, board(0.2, "shallow"));
    space.deliver(turned ? first : second, board(0.7, "deep"));
    space.update();
    const auto s = space.sweep(ball, {0.5, 0.5, 0.4}, {0.3, 0.0, 0.0});  // 0.05 m into the one
    ASSERT_TRUE(s.hit);
    EXPECT_EQ(space.object_name(s.triangle), "shallow");
    const auto d = space.sweep(ball, {0.5, 0.5, 0.55}, {0.3, 0.0, 0.0});  // 0.1 m into the other alone
    EXPECT_EQ(space.object_name(d.triangle), "deep");
    const auto both = space.sweep({0.4, 0.0}, {0.5, 0.5, 0.5}, {0.3, 0.0, 0.0});  // 0.1 m and 0.2 m
    ASSERT_TRUE(both.hit);
    EXPECT_EQ(both.time, 0.0);
    EXPECT_EQ(space.object_name(both.triangle), "deep");
    EXPECT_NEAR(both.distance, -0.2, stored);
  }
}

TEST(Patchwork, WhatIsRefinedTwiceShowsTheFinestThatTheBodyIsFreeIn) {
  Refined r;
  const PatchId finest[2] = {r.space.expect(unit, r.left), r.space.expect(unit, r.left)};
  r.space.deliver(r.coarse, board(0.5));
  r.space.update();
  r.space.deliver(finest[0], half_board(0.1, false));
  r.space.deliver(r.right, half_board(0.25, true));
  r.space.update();
  EXPECT_NEAR(stopped_at(r.space, 0.2), 0.5, stored);
  // The left half never comes, but all that refines it does.
  r.space.deliver(finest[1], World());
  EXPECT_TRUE(r.space.update());
  EXPECT_NEAR(stopped_at(r.space, 0.2), 0.1, stored);
  EXPECT_NEAR(stopped_at(r.space, 0.8), 0.25, stored);
  EXPECT_EQ(r.space.stats().patches, 3u);
}

TEST(Patchwork, NobodyWaitsForALevelThatIsSkipped) {
  for (const int late : {0, 1, 2}) {
    Refined r;
    const PatchId finest = r.space.expect(unit, r.left);
    r.space.deliver(r.coarse, board(0.5));
    r.space.deliver(r.right, half_board(0.25, true));
    r.space.update();
    EXPECT_EQ(r.space.stats().coming, 2u);
    r.space.deliver(finest, half_board(0.1, false));
    EXPECT_TRUE(r.space.update());
    EXPECT_NEAR(stopped_at(r.space, 0.2), 0.1, stored);
    EXPECT_EQ(r.space.stats().coming, 0u) << "the left half is not needed any more";
    // It may still come, or fail, or both; that changes nothing.
    if (late > 0) r.space.fail(r.left, "missing");
    if (late != 1) r.space.deliver(r.left, half_board(0.25, false));
    EXPECT_FALSE(r.space.update());
    EXPECT_EQ(r.space.stats().coming, 0u);
    EXPECT_EQ(r.space.stats().failed, late == 1 ? 1u : 0u);
  }
}

TEST(Patchwork, WhereTheFinestCatchesTheBodyWhatLiesBetweenIsShown) {
  Refined r;
  const PatchId finest = r.space.expect(unit, r.left);
  r.space.deliver(r.coarse, board(0.5));
  r.space.update();
  r.space.deliver(finest, half_board(0.8, false));
  r.space.deliver(r.left, half_board(0.25, false));
  r.space.deliver(r.right, half_board(0.25, true));
  EXPECT_TRUE(r.space.update(ball, {0.2, 0.5, 0.9}));
  EXPECT_NEAR(stopped_at(r.space, 0.2), 0.25, stored);
  EXPECT_EQ(r.space.stats().waiting, 1u);
  EXPECT_TRUE(r.space.update(ball, {0.2, 0.5, 2.0}));
  EXPECT_NEAR(stopped_at(r.space, 0.2), 0.8, stored);
}

TEST(Patchwork, WhatIsExpectedForAReplacedPatchStandsAlone) {
  Refined r;
  r.space.deliver(r.left, half_board(0.25, false));
  r.space.deliver(r.right, half_board(0.25, true));
  r.space.update();
  const PatchId late = r.space.expect(unit, r.coarse);
  EXPECT_TRUE(r.space.update());
  EXPECT_NEAR(stopped_at(r.space, 0.2), 1.0, stored);
  r.space.deliver(late, World());
  r.space.update();
  EXPECT_NEAR(stopped_at(r.space, 0.2), 0.25, stored);
}

TEST(Patchwork, AnUpdateThatIsRefusedLosesNothing) {
  Patchwork space;
  const PatchId patch = space.expect(unit);
  space.deliver(patch, board(0.5));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(space.update(ball, {nan, 0.0, 0.0}), roam::Error);
  EXPECT_THROW(space.update({-1.0, 0.0}, {0.5, 0.5, 3.0}), roam::Error);
  EXPECT_TRUE(space.update(ball, {0.5, 0.5, 3.0}));
  EXPECT_NEAR(stopped_at(space, 0.5), 0.5, stored);
  EXPECT_THROW(space.update(ball, {nan, 0.0, 0.0}), roam::Error) << "whether or not there is anything to take";
}

TEST(Patchwork, TriangleNumbersStayWithTheirPatch) {
  Patchwork space;
  const PatchId first = space.expect(unit);
  const PatchId second = space.expect({{10.0, 0.0, 0.0}, {11.0, 1.0, 1.0}});
  space.deliver(first, board(0.5, "first"));
  space.update();
  const auto id = space.sweep(ball, {0.9, 0.4, 3.0}, {0.0, 0.0, -4.0}).triangle;
  EXPECT_EQ(Patchwork::patch(id), first);
  EXPECT_LT(Patchwork::triangle_in_patch(id), 2u);
  Mesh far;
  far.name = "second";
  scenes::add_floor(far, 10.0, 0.0, 11.0, 1.0, 0.5);
  space.deliver(second, scenes::build(far));
  space.update();
  EXPECT_EQ(space.sweep(ball, {0.9, 0.4, 3.0}, {0.0, 0.0, -4.0}).triangle, id);
  EXPECT_EQ(space.object_name(id), "first");
  const auto other = space.sweep(ball, {10.9, 0.4, 3.0}, {0.0, 0.0, -4.0}).triangle;
  EXPECT_EQ(Patchwork::patch(other), second);
  EXPECT_EQ(space.object_name(other), "second");
  EXPECT_EQ(space.object_name(id + 2), "");
}

TEST(Patchwork, TheMemoryOfWhatWasReplacedIsFreedByTheNextDelivery) {
  Refined r;
  Mesh rich;
  for (int i = 0; i < 3000; ++i) scenes::add_floor(rich, 0.0, 0.0, 1.0, 1.0, 0.5 + 1e-5 * i);
  r.space.deliver(r.coarse, scenes::build(rich));
  r.space.update();
  const auto with_coarse = r.space.stats().bytes;
  r.space.deliver(r.left, World());
  r.space.deliver(r.right, World());
  r.space.update();
  EXPECT_GE(r.space.stats().bytes, with_coarse);  // not freed by the thread of the body
  r.space.deliver(r.space.expect(unit), World());
  r.space.update();
  EXPECT_LT(r.space.stats().bytes, with_coarse / 10);
}

}  // namespace
