// What a patchwork holds: what is expected, comes, and fails.

#include <limits>

#include "clutter.h"
#include "patchwork_boards.h"

namespace {

using namespace boards;

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
  const auto revision = space.facts().revision;
  EXPECT_TRUE(space.update(ball, {0.5, 0.5, 5.0}));
  EXPECT_GT(space.facts().revision, revision);
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

TEST(Patchwork, AnUpdateThatIsRefusedLosesNothing) {
  Patchwork space;
  const PatchId patch = space.expect(unit);
  space.deliver(patch, board(0.5));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(space.update(ball, {nan, 0.0, 0.0}), roam::Error);
  EXPECT_THROW(space.update({-1.0, 0.0}, {0.5, 0.5, 3.0}), roam::Error);
  EXPECT_THROW(space.update(ball, {0.5, 0.5, 3.0}, {0.0, nan, 0.0}), roam::Error);
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

TEST(Patchwork, WhatIsForgottenIsUnknownAndMayComeAgain) {
  Patchwork space;
  const PatchId patch = space.expect(unit);
  EXPECT_THROW(space.forget(patch), roam::Error);  // it has not come
  EXPECT_THROW(space.forget(PatchId{7}), roam::Error);
  space.deliver(patch, board(0.25));
  space.update();
  const std::uint64_t bytes = space.stats().bytes;
  space.forget(patch);
  EXPECT_THROW(space.forget(patch), roam::Error);  // it is forgotten
  EXPECT_NEAR(stopped_at(space, 0.5), 0.25, stored);
  EXPECT_TRUE(space.update());
  EXPECT_NEAR(stopped_at(space, 0.5), 1.0, stored);
  EXPECT_TRUE(space.sweep(ball, {0.5, 0.5, 3.0}, {0.0, 0.0, -4.0}).unknown);
  EXPECT_EQ(space.stats().patches, 0u);
  EXPECT_EQ(space.stats().unknown, 1u);
  EXPECT_EQ(space.stats().coming, 1u);
  EXPECT_EQ(space.stats().triangles, 0u);
  (void)space.expect({{9.0, 9.0, 9.0}, {10.0, 10.0, 10.0}});  // frees what was forgotten
  space.update();
  EXPECT_LT(space.stats().bytes, bytes);
  space.deliver(patch, board(0.75));
  EXPECT_TRUE(space.update());
  EXPECT_NEAR(stopped_at(space, 0.5), 0.75, stored);
  EXPECT_EQ(space.stats().coming, 1u);
  EXPECT_EQ(space.stats().patches, 1u);
}

TEST(Patchwork, ForgetsNothingThatTheBodyIsIn) {
  clutter::Random random(46);
  for (int i = 0; i < 300; ++i) {
    const Body body{random.between(0.01, 1.0), i % 4 == 0 ? 0.0 : random.between(0.0, 2.0)};
    SCOPED_TRACE(testing::Message() << i << ": " << body.radius << ", " << body.half_height);
    Patchwork space;
    const PatchId patch = space.expect(unit);
    space.deliver(patch, board(0.25));
    space.update();
    space.forget(patch);
    // In it, at one of its six sides, and away from there.
    Vec3 place(random.unit(), random.unit(), random.unit());
    EXPECT_FALSE(space.update(body, place));
    const int axis = i % 3;
    const double away = random.unit() < 0.5 ? -1.0 : 1.0;
    place[axis] = 0.5 + away * (0.5 + body.radius + (axis == 2 ? body.half_height : 0.0));
    EXPECT_FALSE(space.update(body, place));
    EXPECT_NEAR(stopped_at(space, 0.5), 0.25, stored);
    place[axis] += away * 3.0 * Patchwork::margin;
    EXPECT_TRUE(space.update(body, place));
    EXPECT_NEAR(stopped_at(space, 0.5), 1.0, stored);
    EXPECT_TRUE(space.fits(body, place));
  }
}

TEST(Patchwork, WhatIsDeliveredAgainBeforeItIsForgottenTakesItsPlace) {
  Patchwork space;
  const PatchId patch = space.expect(unit);
  space.deliver(patch, board(0.25));
  space.update();
  space.forget(patch);
  EXPECT_FALSE(space.update(ball, {0.5, 0.5, 0.6}));
  space.deliver(patch, board(0.75));
  EXPECT_TRUE(space.update(ball, {0.5, 0.5, 5.0}));
  EXPECT_NEAR(stopped_at(space, 0.5), 0.75, stored);
  EXPECT_EQ(space.stats().patches, 1u);
  EXPECT_EQ(space.stats().coming, 0u);
  EXPECT_FALSE(space.update(ball, {0.5, 0.5, 5.0}));
}

TEST(Patchwork, ForgetsAFinerPatchThatWaitsAndNoneThatIsReplaced) {
  Patchwork space;
  const PatchId coarse = space.expect(unit), finer = space.expect(unit, coarse), other = space.expect(unit, coarse);
  space.deliver(coarse, board(0.25));
  space.deliver(finer, board(0.5));
  space.update();
  space.forget(finer);
  space.deliver(other, board(0.75));
  space.update();
  EXPECT_NEAR(stopped_at(space, 0.5), 0.25, stored);  // the finer ones are not all there
  space.deliver(finer, board(0.5));
  space.update();
  EXPECT_NEAR(stopped_at(space, 0.5), 0.75, stored);
  space.forget(coarse);
  EXPECT_FALSE(space.update());
  EXPECT_NEAR(stopped_at(space, 0.5), 0.75, stored);
  EXPECT_EQ(space.stats().coming, 0u);
}

TEST(Patchwork, CountsAFailureThatComesBeforeThePatchIsForgotten) {
  Patchwork space;
  const PatchId patch = space.expect(unit);
  space.deliver(patch, board(0.25));
  space.update();
  space.forget(patch);
  space.fail(patch, "lost");
  EXPECT_FALSE(space.update(ball, {0.5, 0.5, 0.6}));
  EXPECT_EQ(space.stats().coming, 0u);
  EXPECT_EQ(space.stats().failed, 0u);
  EXPECT_TRUE(space.update(ball, {0.5, 0.5, 5.0}));
  EXPECT_EQ(space.stats().coming, 0u);
  EXPECT_EQ(space.stats().failed, 1u);
  EXPECT_EQ(space.stats().unknown, 1u);
}

}  // namespace
