// roam view learns the size of the body: what it offers, what it takes, and what it keeps.
#include <gtest/gtest.h>

#include "door_rooms.h"
#include "roam/profile.h"
#include "view_driven.h"

namespace {

using namespace roam;
using namespace roam::app;

/// Before a door that is too narrow, in the middle of a room.
class BeforeADoor : public DrivenSession {
 public:
  explicit BeforeADoor(bool adapt) {
    file = write_scene(door_obj(0.6));
    options.at = {6, 0, 0.95, 0};
    options.body.radius = 0.4;
    options.body.height = 1.8;
    options.adapt = adapt;
    options.verify = true;
    begin();
  }
  [[nodiscard]] std::uint64_t violations() {
    const ViewReport report = finish();
    return verify(report.meshes, report.pieces).violations;
  }

  std::string file;
};

TEST(Adapt, TakesASmallerBodyAtTheDoorAndKeepsIt) {
  BeforeADoor d(true);
  d.press('w');
  d.run(12.0);
  EXPECT_GT(d.place().x, 12.0);
  const std::optional<Profile> kept = find_profile(d.file);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->method, "roaming");
  EXPECT_DOUBLE_EQ(kept->radius, 0.4);
  ASSERT_EQ(kept->regions.size(), 1u);
  EXPECT_NEAR(kept->regions[0].radius, 0.29, 0.01);
  EXPECT_EQ(d.violations(), 0u);
}

TEST(Adapt, SaysWhichSizeIsOnAndWhy) {
  BeforeADoor d(true);
  d.press('w');
  ASSERT_TRUE(d.until([&] { return d.session->roamer().walker()->body().radius < 0.4; }));
  EXPECT_TRUE(contains(d.hud(), "radius 0.29 m")) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "opening 0.60 m wide")) << d.hud();
  d.run(8.0);
  EXPECT_TRUE(contains(d.hud(), "radius 0.40 m")) << d.hud();
}

TEST(Adapt, OnlyOffersItWhereNobodyAskedToLearn) {
  BeforeADoor d(false);
  d.press('w');
  d.run(6.0);
  EXPECT_LT(d.place().x, 10.0);
  EXPECT_TRUE(contains(d.hud(), "Y takes it: opening 0.60 m wide")) << d.hud();
  EXPECT_FALSE(find_profile(d.file));
  d.tap('y');
  d.run(6.0);
  EXPECT_GT(d.place().x, 12.0);
  EXPECT_TRUE(find_profile(d.file));
  EXPECT_FALSE(contains(d.hud(), "takes it")) << d.hud();
}

TEST(Adapt, WritesNothingOverAProfileOfAnotherBody) {
  Profile trained;
  trained.radius = 0.25;
  trained.height = 1.7;
  trained.scene.hash = std::string(32, '0');
  trained.scene.triangles = 1;
  trained.scene.bounds = {{0, 0, 0}, {1, 1, 1}};
  // The profile comes after the options were read: as that of another session would.
  BeforeADoor d(true);
  save_profile(trained, profile_path(d.file));
  d.session.reset();
  d.begin();
  d.press('w');
  d.run(12.0);
  EXPECT_GT(d.place().x, 12.0);
  EXPECT_DOUBLE_EQ(find_profile(d.file)->radius, 0.25);
}

}  // namespace
