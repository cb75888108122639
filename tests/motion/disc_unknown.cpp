// A support disc and unknown space, which is solid: it carries, and the report says that it does. And a disc that is
// not moved is asked once.

#include <gtest/gtest.h>

#include <cmath>

#include "roam/collector.h"
#include "roam/patchwork.h"
#include "support_scenes.h"

namespace {

using namespace scenes;
using roam::Box;
using roam::PatchId;
using roam::Patchwork;

Mesh floor_between(double x0, double x1, double z) {
  Mesh m;
  add_floor(m, x0, -10.0, x1, 10.0, z);
  return m;
}

void deliver(Patchwork& space, PatchId patch, const Mesh& mesh) { space.deliver(patch, build(mesh)); }

/// A floor that ends at x = 0 with a shaft of 1 m behind it, and then a box of which nothing has come.
struct HalfASplit {
  Patchwork space;
  PatchId near = space.expect({{-20.0, -10.0, -0.1}, {0.0, 10.0, 0.1}});
  PatchId bottom = space.expect({{-20.0, -10.0, -51.0}, {20.0, 10.0, -50.0}});
  PatchId far = space.expect({{1.0, -10.0, -3.0}, {20.0, 10.0, 0.0}});

  HalfASplit() {
    deliver(space, near, floor_between(-20.0, 0.0, 0.0));
    deliver(space, bottom, floor_between(-20.0, 20.0, -50.0));
    space.update();
  }
  void step(Walker& w, double speed) {
    space.update(w.body(), w.position());
    w.step({{speed, 0.0, 0.0}}, frame);
  }
  /// To the middle of the split.
  void walk_out(Walker& w) {
    for (int i = 0; i < 240 && w.position().x < 0.5; ++i) step(w, 1.0);
  }
};

TEST(DiscUnknown, IsCarriedByWhatMayBeFloorAndSaysSo) {
  HalfASplit split;
  Walker w(split.space, person(0.51), Mode::walk, {-1.0, 0.0, 0.95});
  EXPECT_FALSE(w.report().met_unknown);
  split.walk_out(w);
  for (int i = 0; i < 30; ++i) {
    split.step(w, 0.0);
    EXPECT_TRUE(w.report().bridging);
    EXPECT_TRUE(w.report().met_unknown);
    EXPECT_TRUE(w.report().has(EventKind::met_unknown));
    EXPECT_NEAR(w.feet().z, 0.0, near_ground);
  }
  deliver(split.space, split.far, floor_between(1.0, 20.0, 0.0));
  split.step(w, 0.0);
  EXPECT_TRUE(w.report().bridging) << "the far side is as near as it might have been";
  EXPECT_FALSE(w.report().met_unknown);
}

TEST(DiscUnknown, FallsWhenThereTurnsOutToBeNoFloor) {
  HalfASplit split;
  Walker w(split.space, person(0.51), Mode::walk, {-1.0, 0.0, 0.95});
  split.walk_out(w);
  ASSERT_TRUE(w.report().bridging);
  deliver(split.space, split.far, floor_between(1.0, 20.0, -2.0));
  bool fell = false;
  for (int i = 0; i < 60; ++i) {
    split.step(w, 0.0);
    fell |= w.report().has(EventKind::fell);
    EXPECT_FALSE(w.report().met_unknown);
  }
  EXPECT_TRUE(fell);
}

TEST(DiscUnknown, OfFloorAloneIsCarriedAsIfAllWereKnown) {
  HalfASplit split;
  deliver(split.space, split.far, floor_between(1.0, 20.0, 0.0));
  (void)split.space.expect({{-20.0, 5.0, 3.0}, {20.0, 10.0, 6.0}});
  Walker w(split.space, person(0.51), Mode::walk, {-1.0, 0.0, 0.95});
  split.walk_out(w);
  EXPECT_TRUE(w.report().bridging);
  EXPECT_FALSE(w.report().met_unknown);
}

TEST(DiscUnknown, IsNotCarriedByWhatLiesTooDeepOrTooHigh) {
  // A shaft of 4 m: far too wide for the foot, but for what is not known over or under it.
  for (const Box& box : {Box{{-20.0, -10.0, -2.0}, {20.0, 10.0, -0.5}}, Box{{-20.0, -10.0, 1.9}, {20.0, 10.0, 3.0}}}) {
    Patchwork space;
    Mesh floors = floor_between(-20.0, 0.0, 0.0);
    add_floor(floors, 4.0, -10.0, 20.0, 10.0, 0.0);
    deliver(space, space.expect({{-20.0, -10.0, -0.1}, {20.0, 10.0, 0.1}}), floors);
    deliver(space, space.expect({{-20.0, -10.0, -9.0}, {20.0, 10.0, -8.0}}), floor_between(-20.0, 20.0, -8.0));
    (void)space.expect(box);
    space.update();
    Walker w(space, person(1.8), Mode::walk, {-1.0, 0.0, 0.95});
    for (int i = 0; i < 180 && w.position().x < 0.8; ++i) {
      w.step({{1.0, 0.0, 0.0}}, frame);
      ASSERT_FALSE(w.report().bridging) << box.lower.z;
    }
    for (int i = 0; i < 120; ++i) w.step({}, frame);
    EXPECT_NEAR(w.feet().z, box.upper.z < 0.0 ? -0.5 : -8.0, near_ground);
    EXPECT_EQ(w.report().met_unknown, box.upper.z < 0.0) << "it stands on what is not known";
  }
}

TEST(DiscUnknown, DoesNotTakeTheTopOfABoxForThePlaneOfTheFloor) {
  Patchwork space;
  Mesh floors = floor_between(-20.0, 0.0, 0.0);
  add_floor(floors, 2.0, -10.0, 20.0, 10.0, 0.0);
  deliver(space, space.expect({{-20.0, -10.0, -0.1}, {20.0, 10.0, 0.1}}), floors);
  (void)space.expect({{0.0, -10.0, -1.0}, {1.0, 10.0, 0.2}});  // a step up, and behind it a split of 1 m
  space.update();
  Walker w(space, person(0.52), Mode::walk, {-1.0, 0.0, 0.95});
  double highest = 0.0, over_the_split = 1.0;
  for (int i = 0; i < 400 && w.position().x < 3.0; ++i) {
    w.step({{1.0, 0.0, 0.0}}, frame);
    highest = std::max(highest, w.feet().z);
    if (w.position().x > 1.45 && w.position().x < 1.9) over_the_split = std::min(over_the_split, w.feet().z);
  }
  EXPECT_GT(w.position().x, 2.9);
  EXPECT_NEAR(highest, 0.2, near_ground);
  EXPECT_NEAR(over_the_split, 0.0, near_ground);
}

TEST(DiscUnknown, WaitsWhereItWasPutUntilTheRimsAreKnown) {
  for (const bool floors : {true, false}) {
    Patchwork space;
    const PatchId left = space.expect({{-20.0, -10.0, -9.0}, {0.0, 10.0, 0.0}});
    const PatchId right = space.expect({{1.0, -10.0, -9.0}, {20.0, 10.0, 0.0}});
    deliver(space, space.expect({{-20.0, -10.0, -51.0}, {20.0, 10.0, -50.0}}), floor_between(-20.0, 20.0, -50.0));
    space.update();
    Walker w(space, person(0.52), Mode::walk, {0.5, 0.0, 0.85});
    for (int i = 0; i < 60; ++i) {
      w.step({}, frame);
      EXPECT_TRUE(w.report().met_unknown && w.report().bridging);
      EXPECT_NEAR(w.feet().z, -0.05, near_ground);
    }
    deliver(space, left, floor_between(-20.0, 0.0, floors ? 0.0 : -8.9));
    deliver(space, right, floor_between(1.0, 20.0, floors ? 0.0 : -8.9));
    space.update();
    for (int i = 0; i < 30; ++i) w.step({}, frame);
    EXPECT_EQ(w.report().bridging, floors);
    EXPECT_FALSE(w.report().met_unknown);
    if (floors) {
      EXPECT_NEAR(w.feet().z, 0.0, near_ground);
    } else {
      EXPECT_LT(w.feet().z, -1.0);
    }
  }
}

TEST(DiscUnknown, WhoFallsIsNotHeldByWhatIsBesideTheWay) {
  Patchwork space;
  for (const double x : {-20.0, 1.0}) (void)space.expect({{x, -10.0, 2.0}, {x + 20.0, 10.0, 4.0}});
  for (const double x : {-20.0, 1.0}) {
    deliver(space, space.expect({{x, -10.0, -9.0}, {x + 20.0, 10.0, 0.0}}), floor_between(x, x + 20.0, 0.0));
  }
  space.update();
  Walker w(space, person(0.52), Mode::walk, {0.5, 0.0, 8.0});
  for (int i = 0; i < 120; ++i) w.step({}, frame);
  EXPECT_TRUE(w.report().bridging);
  EXPECT_FALSE(w.report().met_unknown);
  EXPECT_NEAR(w.feet().z, 0.0, near_ground) << "it came down where the floor is";
}

/// A world that counts looks for floor, and may not say when it changes.
class Counting final : public roam::Space {
 public:
  explicit Counting(const Mesh& mesh) : world(build(mesh)) {}
  [[nodiscard]] roam::SpaceFacts facts() const override {
    roam::SpaceFacts facts = world.facts();
    facts.revision = tells ? std::optional(changes) : std::nullopt;
    return facts;
  }
  [[nodiscard]] roam::Object object(roam::TriangleId triangle) const override { return world.object(triangle); }

  roam::World world;
  std::uint64_t changes = 0;
  bool tells = true;
  mutable int asked = 0;

 protected:
  [[nodiscard]] roam::FirstImpact find_first(const roam::Query& query, roam::Vicinity*) const override {
    return Space::find_first_of(world, query, nullptr);
  }
  void find_near(const roam::Query& query, roam::Collector& collector, roam::Vicinity*) const override {
    asked += collector.kind() == roam::Collector::Kind::floor_clearance ? 1 : 0;
    Space::find_near_of(world, query, collector, nullptr);
  }
};

/// Over the middle of a split of 1.25 m, at rest.
Walker standing_over_it(const Counting& space) {
  Walker w(space, person(0.645), Mode::walk, {-0.7, 0.0, 0.95});
  for (int i = 0; i < 240 && w.position().x < 0.6; ++i) w.step({{1.0, 0.0, 0.0}}, frame);
  for (int i = 0; i < 3; ++i) w.step({}, frame);
  EXPECT_TRUE(w.report().bridging);
  return w;
}

TEST(DiscAtRest, LooksForADiscOnce) {
  const Counting space(split(1.25));
  Walker w = standing_over_it(space);
  space.asked = 0;
  for (int i = 0; i < 60; ++i) {
    w.step({}, frame);
    EXPECT_TRUE(w.report().bridging);
  }
  EXPECT_EQ(space.asked, 0);
  w.step({{0.1, 0.0, 0.0}}, frame);
  EXPECT_GT(space.asked, 10) << "it has moved";
}

TEST(DiscAtRest, LooksAgainWhenAnythingHasChanged) {
  Counting space(split(1.25));
  Walker w = standing_over_it(space);
  space.asked = 0;
  w.resize(0.3, 0.7);
  w.step({}, frame);
  EXPECT_GT(space.asked, 1) << "another disc";
  w.step({}, frame);
  space.asked = 0;
  w.step({{}, false, true}, frame);
  EXPECT_GT(space.asked, 1) << "crouched";
  w.step({{}, false, true}, frame);
  space.asked = 0;
  w.place({0.6, 0.0, 0.95});
  EXPECT_GT(space.asked, 1) << "placed";
  w.step({}, frame);
  w.step({}, frame);
  space.world = build(split(3.0));
  ++space.changes;
  w.step({}, frame);
  EXPECT_FALSE(w.report().bridging) << "the far side has gone";
}

TEST(DiscAtRest, LooksEachTimeWhereChangesAreNotTold) {
  Counting space(split(1.25));
  space.tells = false;
  Walker w = standing_over_it(space);
  space.asked = 0;
  w.step({}, frame);
  EXPECT_GT(space.asked, 10);
  space.world = build(split(3.0));
  w.step({}, frame);
  EXPECT_FALSE(w.report().bridging);
}

}  // namespace
