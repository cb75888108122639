// What takes the place of something coarser in a patchwork, when, and around which body it waits.

#include <malloc.h>

#include "patchwork_boards.h"

namespace {

using namespace boards;

/// A coarse board at 0.5, refined by two halves at 0.25.
struct Refined {
  Patchwork space;
  PatchId coarse = space.expect(unit);
  PatchId left = space.expect(unit, coarse), right = space.expect(unit, coarse);
};

TEST(PatchworkLevels, FinerPatchesReplaceTheCoarseOneWhenAllOfThemAreThere) {
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

TEST(PatchworkLevels, ACoarsePatchStaysWhileOneThatRefinesItHasFailed) {
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

TEST(PatchworkLevels, FinerPatchesMayComeBeforeWhatTheyRefine) {
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

TEST(PatchworkLevels, ARefinementWaitsUntilTheBodyIsFreeInIt) {
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

TEST(PatchworkLevels, ABodyThatDoesNotFitAnywayHoldsNothingUp) {
  Refined r;
  r.space.deliver(r.coarse, board(0.5));
  r.space.update();
  r.space.deliver(r.left, half_board(0.6, false));
  r.space.deliver(r.right, half_board(0.6, true));
  EXPECT_TRUE(r.space.update(ball, {0.2, 0.5, 0.55}));
}

TEST(PatchworkLevels, ABodyAtRestOnTheCoarseFloorLetsTheSameFineFloorIn) {
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

TEST(PatchworkLevels, WhatIsUnknownIsReplacedWhateverTheBody) {
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

TEST(PatchworkLevels, ABodyCaughtInTwoPatchesIsToldOfTheDeepest) {
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

TEST(PatchworkLevels, WhatIsRefinedTwiceShowsTheFinestThatTheBodyIsFreeIn) {
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

TEST(PatchworkLevels, NobodyWaitsForALevelThatIsSkipped) {
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
    EXPECT_EQ(r.space.stats().failed, 0u);
  }
}

TEST(PatchworkLevels, WhatFailedIsNotMissedOnceFinerOnesTakeItsPlace) {
  for (const bool comes_late : {false, true}) {
    Refined r;
    const PatchId finest = r.space.expect(unit, r.left);
    r.space.deliver(r.coarse, board(0.5));
    r.space.deliver(r.right, half_board(0.25, true));
    r.space.fail(r.left, "missing");
    r.space.update();
    EXPECT_EQ(r.space.stats().failed, 1u);
    EXPECT_EQ(r.space.stats().coming, 1u);
    r.space.deliver(finest, half_board(0.1, false));
    EXPECT_TRUE(r.space.update());
    EXPECT_NEAR(stopped_at(r.space, 0.2), 0.1, stored);
    EXPECT_EQ(r.space.stats().failed, 0u);
    if (comes_late) r.space.deliver(r.left, half_board(0.25, false));
    EXPECT_FALSE(r.space.update());
    EXPECT_EQ(r.space.stats().failed, 0u);
    EXPECT_EQ(r.space.stats().coming, 0u);
  }
}

TEST(PatchworkLevels, WhatHasBeenReplacedTakesNoMemory) {
  roam::Patchwork space;
  const auto refine = [&](PatchId last, int times) {
    for (int i = 0; i < times; ++i) {
      const PatchId next = space.expect(unit, last);
      space.deliver(next, World());
      EXPECT_TRUE(space.update());
      last = next;
    }
    return last;
  };
  const PatchId first = space.expect(unit);
  space.deliver(first, World());
  const PatchId early = refine(first, 1000);
  const auto before = ::mallinfo2().uordblks;
  const PatchId last = refine(early, 20'000);
  EXPECT_LT(::mallinfo2().uordblks - before, 20'000u * 16) << "a few bytes for its number, not the patch itself";
  EXPECT_EQ(space.stats().patches, 1u);
  // Numbers of long ago are known for what they are.
  EXPECT_EQ(space.object_name(static_cast<roam::TriangleId>(first) << 32), "");
  EXPECT_THROW(space.deliver(first, World()), roam::Error);
  const PatchId late = space.expect(unit, first);
  EXPECT_TRUE(space.update());
  EXPECT_EQ(space.stats().unknown, 1u) << "what refines one that is gone stands alone";
  space.fail(late, "missing");
  refine(last, 1);
  EXPECT_EQ(space.stats().failed, 1u);
}

TEST(PatchworkLevels, WhereTheFinestCatchesTheBodyWhatLiesBetweenIsShown) {
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

TEST(PatchworkLevels, WhatIsExpectedForAReplacedPatchStandsAlone) {
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

TEST(PatchworkLevels, AChainOfAnyLengthIsNoRecursionOfThatDepth) {
  Patchwork space;
  constexpr int length = 300'000;
  PatchId patch = PatchId::none;
  for (int i = 0; i < length; ++i) patch = space.expect(unit, patch);
  space.deliver(patch, board(0.25));
  space.update();
  // All but the last, and those that it replaced, are unknown.
  EXPECT_NEAR(stopped_at(space, 0.2), 1.0, stored);
  EXPECT_EQ(space.stats().unknown, static_cast<std::uint64_t>((length - 1) / Patchwork::most_levels));
  EXPECT_EQ(space.stats().patches, 1u);
}

TEST(PatchworkLevels, TheMemoryOfWhatWasReplacedIsFreedByTheNextDelivery) {
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
