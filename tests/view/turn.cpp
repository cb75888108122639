// The key that turns the scene: the session ends for another one, and the profile keeps the frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "roam/profile.h"
#include "scenes/frame.h"
#include "view_driven.h"

namespace {

using namespace roam;
using namespace roam::app;

TEST(NextFrame, IsTheLikelyOneOrAQuarterTurnOn) {
  SceneFrame frame{UpAxis::z, LengthUnit::cm};
  EXPECT_EQ(next_frame(frame, UpAxis::minus_y), (SceneFrame{UpAxis::minus_y, LengthUnit::cm}));
  std::vector<UpAxis> seen;
  for (int i = 0; i < 6; ++i) {
    const UpAxis before = frame.up;
    frame = next_frame(frame, std::nullopt);
    EXPECT_NE(static_cast<int>(frame.up) % 3, static_cast<int>(before) % 3) << "a quarter turn";
    EXPECT_EQ(std::count(seen.begin(), seen.end(), frame.up), 0);
    seen.push_back(frame.up);
  }
  EXPECT_EQ(frame, (SceneFrame{UpAxis::z, LengthUnit::cm}));
}

TEST(Turn, EndsTheSessionAndIsKept) {
  DrivenSession d;
  d.write_scene();
  d.begin();
  EXPECT_FALSE(d.session->turned());
  d.session->run("turn");
  EXPECT_FALSE(d.session->frame());
  ASSERT_TRUE(d.session->turned());
  EXPECT_STREQ(to_string(d.session->turned()->up), "y");
  EXPECT_EQ(find_frame(d.options.scene.scenes), d.session->turned());
  EXPECT_FALSE(find_profile(d.options.scene.scenes));
}

TEST(Turn, IsNotKeptWithoutAProfile) {
  DrivenSession d;
  const std::string scene = d.write_scene();
  d.options.scene.no_profile = true;
  d.begin();
  d.session->run("turn");
  EXPECT_TRUE(d.session->turned());
  EXPECT_FALSE(std::filesystem::exists(scene + ".roam.json"));
}

TEST(Turn, IsRefusedWhileSomethingIsWritten) {
  DrivenSession d;
  d.write_scene();
  d.options.trace = d.folder.file("t.csv");
  d.begin();
  d.session->run("turn");
  EXPECT_FALSE(d.session->turned());
  EXPECT_TRUE(contains(d.hud(), "is not turned")) << d.hud();
}

}  // namespace
