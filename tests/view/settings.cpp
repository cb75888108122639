// The settings of roam view.
#include "view/settings.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "messages.h"
#include "program.h"
#include "view/bookmarks.h"
#include "view/commands.h"

namespace {

using namespace roam;
using namespace roam::app;

TEST(ViewSettings, TakeEveryEntry) {
  const TestFolder folder;
  const ViewSettings s = read_settings(folder.write("s.json", R"({
    // comments are allowed
    "keys": {"forward": ["Z", "Up"], "jump": "Space"}, "mouse": {"sensitivity": 2, "invert_y": true},
    "body": {"radius": 0.2, "height": 1.6, "eye": 1.4, "step": 0.2, "slope": 30},
    "speed": 3, "easing": 0, "fov": 80, "hud": "minimal", "picture_scale": 4, "tile_error": 2.5})"));
  EXPECT_EQ(s.keys.at("forward"), (std::vector<std::string>{"Z", "Up"}));
  EXPECT_EQ(s.keys.at("jump"), std::vector<std::string>{"Space"});
  EXPECT_EQ(s.sensitivity, 2.0);
  EXPECT_EQ(s.invert_y, true);
  EXPECT_EQ(s.radius, 0.2);
  EXPECT_EQ(s.height, 1.6);
  EXPECT_EQ(s.eye, 1.4);
  EXPECT_EQ(s.step, 0.2);
  EXPECT_EQ(s.slope, 30.0);
  EXPECT_EQ(s.speed, 3.0);
  EXPECT_EQ(s.easing, 0.0);
  EXPECT_EQ(s.fov, 80.0);
  EXPECT_EQ(s.hud, HudMode::minimal);
  EXPECT_EQ(s.picture_scale, 4.0);
  EXPECT_EQ(s.tile_error, 2.5);
}

TEST(ViewSettings, NameFileAndEntryOfWhatIsWrong) {
  const TestFolder folder;
  const auto error = [&](const std::string& text) {
    const std::string file = folder.write("s.json", text);
    const std::string what = error_of([&] { static_cast<void>(read_settings(file)); });
    EXPECT_TRUE(contains(what, file)) << what;
    return what;
  };
  EXPECT_TRUE(contains(error(R"({"mouse": {"sensitivity": "fast"}})"), "\"mouse.sensitivity\" must be a number"));
  EXPECT_TRUE(contains(error(R"({"body": {"radius": -1}})"), "\"body.radius\""));
  EXPECT_TRUE(contains(error(R"({"tile_error": -1})"), "\"tile_error\""));
  EXPECT_TRUE(contains(error(R"({"hud": "big"})"), "\"hud\" must be \"plain\", \"full\", \"minimal\" or \"off\""));
  EXPECT_TRUE(contains(error(R"({"speeed": 1})"), "\"speeed\" is not known; there are: keys, mouse"));
  const std::string secret(100, 's');
  EXPECT_FALSE(contains(error(R"({")" + secret + R"(": 1})"), secret.substr(0, 24)));
  EXPECT_TRUE(contains(error(R"({"keys": {"jump": 3}})"), "\"keys.jump\" must be the name of a key"));
  EXPECT_TRUE(contains(error("{"), "is no JSON"));
  EXPECT_TRUE(contains(error("[]"), "one JSON object"));
  EXPECT_TRUE(contains(error_of([] { static_cast<void>(find_settings("/nowhere/s.json")); }), "/nowhere/s.json"));
}

TEST(ViewSettings, StandInTheFolderOfTheXdgRules) {
  const TestFolder folder;
  setenv("HOME", folder.file("home").c_str(), 1);
  setenv("XDG_CONFIG_HOME", folder.file("config").c_str(), 1);
  EXPECT_EQ(settings_folder(), folder.file("config/roam"));
  setenv("XDG_CONFIG_HOME", "not/absolute", 1);
  EXPECT_EQ(settings_folder(), folder.file("home/.config/roam"));
  EXPECT_TRUE(find_settings({}).keys.empty());
  std::filesystem::create_directories(folder.file("home/.config/roam"));
  folder.write("home/.config/roam/settings.json", R"({"fov": 70})");
  EXPECT_EQ(find_settings({}).fov, 70.0);
  unsetenv("XDG_CONFIG_HOME");
}

TEST(ViewSettings, GiveCommandsOtherKeysOrSayWhyNot) {
  osgRoam::Controls controls;
  controls.add("forward", "W", "goes", osgRoam::Controls::Kind::held);
  ViewSettings settings;
  settings.file = "s.json";
  settings.keys = {{"forward", {"Z", "Up"}}};
  set_up(controls, settings);
  EXPECT_EQ(osgRoam::Controls::keyText(*controls.find("forward")), "Z, Up");
  EXPECT_TRUE(contains(key_table(controls), "forward"));
  EXPECT_TRUE(contains(key_table(controls), "Z, Up"));

  osgRoam::Controls others;
  others.add("forward", "W", "goes", osgRoam::Controls::Kind::held);
  settings.keys = {{"forward", {"H"}}};
  const std::string what = error_of([&] { set_up(others, settings); });
  EXPECT_TRUE(contains(what, "s.json") && contains(what, "help")) << what;
}

TEST(ViewSettings, NameTheEntryOfAKeyAndLeaveTheDigitsToTheCameras) {
  const auto error = [](const std::string& command, const std::string& key) {
    osgRoam::Controls controls;
    controls.add("forward", "W", "goes", osgRoam::Controls::Kind::held);
    ViewSettings settings;
    settings.file = "s.json";
    settings.keys = {{"bookmark", {"J"}}, {command, {key}}};
    return error_of([&] { set_up(controls, settings); });
  };
  EXPECT_TRUE(contains(error("forward", "NoSuchKey"), "s.json: the entry \"keys.forward\": "));
  EXPECT_FALSE(contains(error("forward", "NoSuchKey"), "line"));
  EXPECT_TRUE(contains(error("fly_away", "Z"), "s.json: the entry \"keys.fly_away\": there is no such command"));
  EXPECT_TRUE(contains(error("cameras", "Z"), "s.json: the entry \"keys.cameras\" is no command"));
  for (const char* key : {"1", "8", "Ctrl+2"}) {
    const std::string what = error("forward", key);
    EXPECT_TRUE(contains(what, "\"cameras\" and \"forward\"")) << key << ": " << what;
  }
  EXPECT_EQ(error("forward", "9"), "");
  EXPECT_EQ(error("forward", "#"), "");
}

TEST(Settings, SayThatAFolderIsNoFile) {
  const TestFolder folder;
  std::filesystem::create_directories(folder.file("roam.json"));
  const std::string settings = error_of([&] { static_cast<void>(read_settings(folder.file("roam.json"))); });
  EXPECT_TRUE(contains(settings, folder.file("roam.json") + ": Is a directory; name a file")) << settings;
  const std::string bookmarks =
      error_of([&] { static_cast<void>(Bookmarks(folder.file("roam.json"), {"mine.obj"}, {})); });
  EXPECT_TRUE(contains(bookmarks, folder.file("roam.json") + ": Is a directory; name a file")) << bookmarks;
}

}  // namespace
