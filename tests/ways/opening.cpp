// What a blocked body does not fit through, and what would carry it.
#include "roam/opening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "motion/carrying.h"
#include "roam/walker.h"
#include "train_scenes.h"

namespace {

using roam::Opening;
using roam::Vec3;
using roam::Walker;

const Vec3 ahead{1.0, 0.0, 0.0};

/// A person without a crouch, as it stands after walking along the corridor for some seconds.
struct Person {
  explicit Person(const CorridorOptions& options, double radius = 0.3)
      : survey(corridor(options)), walker(survey.world(), settings(radius), roam::Mode::walk, {1.0, 0.0, 0.91}) {}
  static roam::WalkerSettings settings(double radius) {
    roam::WalkerSettings settings;
    settings.radius = radius;
    settings.height = settings.crouch_height = 1.8;
    return settings;
  }
  void walk(double seconds) {
    for (int i = 0; i < 60.0 * seconds; ++i) walker.step({.velocity = 1.4 * ahead}, 1.0 / 60.0);
  }
  roam::Survey survey;
  Walker walker;
};

TEST(MeasuredOpening, IsTheDoorThatIsTooNarrow) {
  for (const double width : {0.2, 0.4, 0.55}) {
    SCOPED_TRACE(width);
    Person person({.door = width});
    person.walk(8.0);
    ASSERT_TRUE(person.walker.report().blocked);
    const auto opening = roam::measure_opening(person.walker, ahead);
    ASSERT_TRUE(opening);
    EXPECT_EQ(opening->kind, Opening::Kind::door);
    EXPECT_EQ(std::string(to_string(opening->kind)), "door");
    EXPECT_NEAR(opening->width, width, 0.01);
    EXPECT_NEAR(std::abs(opening->direction.y), 1.0, 1e-3);
    EXPECT_NEAR(opening->point.x, 7.0, 0.01);
    EXPECT_NEAR(opening->point.y, 0.0, 0.02);
  }
}

TEST(MeasuredOpening, IsTheLintelThatIsTooLow) {
  Person person({.door = 1.5, .lintel = 1.6});
  person.walk(8.0);
  ASSERT_TRUE(person.walker.report().blocked);
  const auto opening = roam::measure_opening(person.walker, ahead);
  ASSERT_TRUE(opening);
  EXPECT_EQ(opening->kind, Opening::Kind::lintel);
  EXPECT_NEAR(opening->width, 1.6, 0.02);
  EXPECT_NEAR(std::abs(opening->direction.z), 1.0, 1e-3);
}

TEST(MeasuredOpening, IsNoneBeforeAClosedWallAndAlongNoLevelWay) {
  Person closed({});
  closed.walk(10.0);
  ASSERT_TRUE(closed.walker.report().blocked);
  EXPECT_FALSE(roam::measure_opening(closed.walker, ahead));
  Person door({.door = 0.4});
  door.walk(8.0);
  EXPECT_FALSE(roam::measure_opening(door.walker, {0.0, 0.0, -1.0}));
}

TEST(Carrying, IsOfADiscThatIsLargerThanHalfTheGap) {
  CorridorOptions options;
  options.split = 0.9;
  Person person(options);
  static_cast<void>(person.walker.resize(0.3, 0.6));
  while (person.walker.position().x < 3.0) person.walk(1.0 / 60.0);
  ASSERT_TRUE(person.walker.report().bridging);
  EXPECT_EQ(roam::carrying(person.walker, 0.5), roam::Carrying::yes);
  EXPECT_EQ(roam::carrying(person.walker, 0.4), roam::Carrying::no);
}

TEST(FreeDisc, FitsIntoAGapThatIsAsWide) {
  CorridorOptions options;
  options.split = 0.9;
  const roam::Survey survey = corridor(options);
  const Vec3 axis(3.0, 0.0, 0.0);
  const roam::FloorPlane floor{axis};
  EXPECT_EQ(roam::carrying(survey.world(), floor, {0.44, 45.0, 0.3}, axis), roam::Carrying::no);
  EXPECT_EQ(roam::carrying(survey.world(), floor, {0.46, 45.0, 0.3}, axis), roam::Carrying::yes);
}

}  // namespace
