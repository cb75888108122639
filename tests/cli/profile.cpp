// The profile beside a scene, taken by roam walk and roam view on their own, and refused where it is not of the scene.
#include "roam/profile.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "door_rooms.h"
#include "messages.h"
#include "program.h"

namespace {

using Json = nlohmann::json;

Json parsed(const ProgramResult& result) { return Json::parse(result.out, nullptr, false); }

/// A room with a door 0.5 m wide, and a profile beside it.
struct Trained {
  TestFolder folder;
  std::string scene = folder.write("room.obj", door_obj(0.5));
  std::string file = folder.file("room.obj.roam.json");
  std::string path = folder.write("p.path", "2 0 0.9\n6 0 0.9\n");
  roam::Profile profile;

  Trained() {
    setenv("XDG_CONFIG_HOME", folder.file("none").c_str(), 1);
    const Json info = parsed(run_program(ROAM_PROGRAM, {"info", scene, "--json"}));
    profile.scene.hash = info["hash"];
    profile.scene.triangles = info["triangles"];
    for (int k = 0; k < 3; ++k) {
      profile.scene.bounds.lower[k] = info["bounds"]["min"][static_cast<std::size_t>(k)];
      profile.scene.bounds.upper[k] = info["bounds"]["max"][static_cast<std::size_t>(k)];
    }
    profile.radius = 0.25;
    profile.height = 1.7;
    profile.step = 0.2;
    save();
  }
  void save() const { roam::save_profile(profile, file); }
  void change_scene() const { (void)folder.write("room.obj", door_obj(0.51)); }

  [[nodiscard]] ProgramResult walk(const std::vector<std::string>& more = {}, const std::string& what = "") const {
    std::vector<std::string> arguments{"walk", what.empty() ? scene : what, "--path", path, "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(ROAM_PROGRAM, arguments);
  }
  [[nodiscard]] ProgramResult view(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{"view",   scene, "--headless", "--size", "160x120",
                                       "--time", "0.1", "--json",     "--at",   "2,0,0.9"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(ROAM_PROGRAM, arguments);
  }
};

TEST(ProfileOfWalk, IsTakenOnItsOwn) {
  const Trained trained;
  const ProgramResult result = trained.walk();
  EXPECT_EQ(result.status, 0) << result.err;
  const Json report = parsed(result);
  EXPECT_EQ(report["radius"], 0.25);
  EXPECT_EQ(report["height"], 1.7);
  EXPECT_EQ(report["profile"], trained.file);
  EXPECT_TRUE(contains(result.err, trained.file)) << result.err;
}

TEST(ProfileOfWalk, IsToldWithTheStepAndTheSlopeThatAreNotTheUsualOnes) {
  Trained trained;
  std::string told = trained.walk().err;
  EXPECT_TRUE(contains(told, "height 1.7 m, step 0.2 m\n")) << told;
  trained.profile.step = roam::WalkerSettings{}.step;
  trained.profile.slope_degrees = 80.0;
  trained.save();
  told = trained.walk().err;
  EXPECT_TRUE(contains(told, "height 1.7 m, slope 80 degrees\n")) << told;
}

TEST(ProfileOfWalk, IsOverruledByARadiusInAll) {
  const Trained trained;
  const ProgramResult result = trained.walk({"--radius", "0.3"});
  const Json report = parsed(result);
  EXPECT_EQ(report["radius"], 0.3);
  EXPECT_EQ(report["height"], 1.8);
  EXPECT_TRUE(report["profile"].is_null());
  EXPECT_FALSE(contains(result.err, ".roam.json")) << result.err;
}

TEST(ProfileOfWalk, IsChangedByOtherOptionsInThatAlone) {
  const Trained trained;
  const Json report = parsed(trained.walk({"--height", "1.5"}));
  EXPECT_EQ(report["radius"], 0.25);
  EXPECT_EQ(report["height"], 1.5);
  EXPECT_EQ(report["profile"], trained.file);
}

TEST(ProfileOfWalk, IsLeftOutOnDemand) {
  const Trained trained;
  const Json report = parsed(trained.walk({"--no-profile"}));
  EXPECT_EQ(report["radius"], 0.3);
  EXPECT_TRUE(report["profile"].is_null());
}

TEST(ProfileOfWalk, IsRefusedOnAChangedScene) {
  const Trained trained;
  trained.change_scene();
  const ProgramResult result = trained.walk();
  EXPECT_EQ(result.status, 1);
  for (const char* part : {"room.obj.roam.json is not of", "roam train", "--no-profile"}) {
    EXPECT_TRUE(contains(result.err, part)) << result.err;
  }
  EXPECT_EQ(parsed(result)["error"]["where"], trained.file) << result.out;
  EXPECT_EQ(trained.walk({"--no-profile"}).status, 0);
  EXPECT_EQ(trained.walk({"--radius", "0.3"}).status, 0);
}

TEST(ProfileOfWalk, ThatCannotBeReadIsNamed) {
  const Trained trained;
  (void)trained.folder.write("room.obj.roam.json", "{\"roam_profile\": 7}");
  const ProgramResult result = trained.walk();
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, trained.file) && contains(result.err, "--no-profile")) << result.err;
  EXPECT_EQ(trained.walk({"--no-profile"}).status, 0);
}

TEST(ProfileOfWalk, GivesWayToABodyThatAPathSays) {
  const Trained trained;
  (void)trained.folder.write("p.path",
                             "# roam: mode walk radius 0.2 height 1.6 eye 1.5 step 0.3 slope 45\n2 0 0.9\n6 0 0.9\n");
  EXPECT_EQ(parsed(trained.walk())["radius"], 0.2);
  EXPECT_TRUE(parsed(trained.walk())["profile"].is_null());
  (void)trained.folder.write("p.path",
                             "# roam: mode walk radius 0.25 height 1.7 eye 1.5 step 0.2 slope 45\n2 0 0.9\n6 0 0.9\n");
  EXPECT_EQ(parsed(trained.walk())["profile"], trained.file);
}

TEST(ProfileOfWalk, OfTheSceneIsThatOfItsStore) {
  const Trained trained;
  const std::string store = trained.scene + ".roam";
  ASSERT_EQ(run_program(ROAM_PROGRAM, {"build", trained.scene, "-o", store}).status, 0);
  const ProgramResult result = trained.walk({}, store);
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(parsed(result)["profile"], trained.file);
  EXPECT_EQ(parsed(result)["radius"], 0.25);
  roam::Profile other = trained.profile;
  other.scene.triangles += 1;
  roam::save_profile(other, trained.file);
  EXPECT_EQ(trained.walk({}, store).status, 1);
}

TEST(ProfileOfWalk, ThatWasTrainedForFlyingIsNotUsedOnFoot) {
  Trained trained;
  trained.profile.mode = roam::Mode::fly;
  trained.save();
  const ProgramResult result = trained.walk();
  EXPECT_EQ(parsed(result)["radius"], 0.3);
  EXPECT_TRUE(contains(result.err, "trained for flying")) << result.err;
  EXPECT_EQ(parsed(trained.walk({"--mode", "fly"}))["radius"], 0.25);
}

TEST(ProfileOfWalk, MakesTheBodySmallerInItsRegions) {
  Trained trained;
  trained.profile.radius = 0.3;
  trained.save();
  (void)trained.folder.write("p.path", "2 0 0.9\n18 0 0.9\n");
  EXPECT_EQ(parsed(trained.walk())["outcome"], "blocked");
  trained.profile.regions = {{{{9.0, -2.0, -0.1}, {11.0, 2.0, 3.0}}, 0.2, 0.0, "door 0.5 m wide"}};
  trained.save();
  const std::string certificate = trained.folder.file("certificate");
  const ProgramResult result = trained.walk({"--verify", "--certify", certificate});
  EXPECT_EQ(parsed(result)["outcome"], "reached") << result.out;
  EXPECT_EQ(parsed(result)["violations"], 0);
  const ProgramResult checked = run_program(ROAM_PROGRAM, {"check", certificate, trained.scene, "--json"});
  EXPECT_EQ(checked.status, 0) << checked.out;
  EXPECT_EQ(parsed(checked)["sizes"].size(), 2U) << checked.out;
}

TEST(ProfileOfWalk, SaysWhatTheBodyNeedsAsItIsInARegion) {
  Trained trained;
  trained.profile.radius = 0.3;
  trained.profile.regions = {{{{9.0, -2.0, -0.1}, {11.0, 2.0, 3.0}}, 0.28, 0.0, "too wide for the door"}};
  trained.save();
  (void)trained.folder.write("p.path", "2 0 0.9\n18 0 0.9\n");
  const Json report = parsed(trained.walk());
  EXPECT_EQ(report["outcome"], "blocked");
  EXPECT_TRUE(contains(report["why"], "the body needs 0.560 m across")) << report["why"];
}

TEST(ProfileOfView, IsTakenOnItsOwnAndOverruled) {
  const Trained trained;
  const ProgramResult result = trained.view();
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(parsed(result)["radius"], 0.25);
  EXPECT_EQ(parsed(result)["height"], 1.7);
  EXPECT_EQ(parsed(result)["profile"], trained.file);
  EXPECT_TRUE(contains(result.err, trained.file)) << result.err;
  EXPECT_EQ(parsed(trained.view({"--radius", "0.3"}))["height"], 1.8);
  EXPECT_EQ(parsed(trained.view({"--no-profile"}))["height"], 1.8);
}

TEST(ProfileOfView, IsRefusedOnAChangedScene) {
  const Trained trained;
  trained.change_scene();
  const ProgramResult result = trained.view();
  EXPECT_EQ(result.status, 1) << result.out;
  EXPECT_TRUE(contains(result.err, "is not of") && contains(result.err, "--no-profile")) << result.err;
  EXPECT_EQ(trained.view({"--no-profile"}).status, 0);
}

}  // namespace
