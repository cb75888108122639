// What training and probing answer in real scenes, against what was measured in them by hand.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "import_files.h"
#include "roam/import.h"
#include "roam/probe.h"
#include "roam/route.h"
#include "roam/train.h"
#include "words/training.h"

namespace roam::test {
namespace {

using words::answer;

Survey survey_of(const std::string& file, const ImportOptions& reading) {
  return Survey::build(import_scene(test_data() / file, reading).meshes, {.lossless = true, .progress = {}});
}

TEST(RealAnswers, DoorsOfAnOfficeAreAsWideAsMeasuredByHand) {
  ROAM_NEEDS_TEST_DATA();
  const Survey office = survey_of("building/willowgarage_visual.dae", {.unit = LengthUnit::in});
  struct Door {
    Vec3 from, to, middle;
    double width;
  };
  const std::array<Door, 4> doors{{{{13.5, 1.5, 1.0}, {13.5, 3.8, 1.0}, {15.17, 3.02, 0.0}, 0.876},
                                   {{33.5, 25.4, 1.0}, {38.0, 25.4, 1.0}, {35.75, 25.4, 0.0}, 0.812},
                                   {{46.5, 25.5, 1.0}, {42.0, 25.0, 1.0}, {44.86, 25.17, 0.0}, 0.812},
                                   {{15.7, 12.5, 1.0}, {19.0, 12.5, 1.0}, {16.95, 12.53, 0.0}, 1.3}}};
  for (const Door& door : doors) {
    const ProbeAnswer answer = probe(office, {.from = door.from, .to = door.to}, {.radius = 0.3, .height = 1.9});
    EXPECT_TRUE(answer.passable) << door.width;
    ASSERT_TRUE(answer.limit) << door.width;
    EXPECT_EQ(answer.limit->kind, ProbeLimit::Kind::door);
    EXPECT_NEAR(answer.limit->size, door.width, 0.01);
    EXPECT_LT(std::hypot(answer.limit->point.x - door.middle.x, answer.limit->point.y - door.middle.y), 0.15);
  }
}

TEST(RealAnswers, AnOfficeWithAPorchNeedsNoDisc) {
  ROAM_NEEDS_TEST_DATA();
  const Training t = train(survey_of("building/willowgarage_visual.dae", {.unit = LengthUnit::in}), {.height = 1.8});
  EXPECT_TRUE(t.feasible) << answer(t);
  EXPECT_EQ(t.support_radius, 0.0) << answer(t);
  ASSERT_TRUE(t.largest);
  EXPECT_NEAR(*t.largest, 12 * 0.0254, 1e-3) << answer(t);
}

TEST(RealAnswers, TheDiscForTheGapInAScannedFloorCarriesOverItAndASmallerOneFalls) {
  ROAM_NEEDS_TEST_DATA();
  const Survey room = survey_of("scan/icl_nuim_living_room_kt2.ply", {.up = UpAxis::y});
  const Training t = train(room, {.height = 1.8});
  EXPECT_TRUE(t.feasible) << answer(t);
  const std::array<Vec3, 4> over_the_gap{
      {{2.1, 1.43, -0.42}, {2.9, 1.43, -0.42}, {2.9, 1.9, -0.42}, {2.2, 1.9, -0.42}}};
  const auto goes = [&](double foot) {
    WalkerSettings body;
    body.radius = t.radius;
    body.height = 1.8;
    body.support_radius = foot;
    Walker walker(room.world(), body, Mode::walk, over_the_gap.front());
    return follow(walker, over_the_gap).outcome;
  };
  EXPECT_EQ(goes(t.support_radius), Outcome::reached) << answer(t);
  EXPECT_EQ(goes(0.85), Outcome::fell) << "as large as the gap is not enough";
  EXPECT_EQ(goes(0.0), Outcome::fell);
}

}  // namespace
}  // namespace roam::test
