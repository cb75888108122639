// The parts of roam view that need no window: options, settings, bookmarks.
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <cstdlib>
#include <thread>

#include "cli/exit_status.h"
#include "messages.h"
#include "program.h"
#include "roam/error.h"
#include "view/bookmarks.h"
#include "view/commands.h"
#include "view/options.h"
#include "view/path_recorder.h"
#include "view/settings.h"

namespace {

using namespace roam;
using namespace roam::app;

// ------------------------------------------------------------------------------------------------------ settings

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

// ------------------------------------------------------------------------------------------------------- options

ViewOptions of_a_scene() {
  ViewOptions options;
  options.scene.scenes = {"hall.obj"};
  return options;
}

TEST(ViewPlan, OfNobodyDescribedIsAPerson) {
  const ViewPlan plan = make_plan(of_a_scene(), {});
  EXPECT_EQ(plan.walker.radius, 0.3);
  EXPECT_EQ(plan.walker.height, 1.8);
  EXPECT_DOUBLE_EQ(plan.walker.eye, 1.5);
  EXPECT_EQ(plan.mode, Mode::walk);
}

TEST(ViewPlan, OfARadiusAloneIsAPersonAndOfASphereHasTheEyeInItsCentre) {
  ViewOptions options = of_a_scene();
  options.body.radius = 0.5;
  EXPECT_EQ(make_plan(options, {}).walker.height, 1.8);
  options.body.sphere = true;
  const ViewPlan plan = make_plan(options, {});
  EXPECT_EQ(plan.walker.height, 1.0);
  EXPECT_EQ(plan.walker.eye, 0.5);
  options.body.radius.reset();
  ViewSettings settings;
  settings.radius = 0.2;
  settings.height = 1.7;
  EXPECT_EQ(make_plan(options, settings).walker.height, 0.6);
}

TEST(ViewPlan, OfARadiusInTheSettingsIsAPerson) {
  ViewSettings settings;
  settings.radius = 0.25;
  EXPECT_EQ(make_plan(of_a_scene(), settings).walker.height, 1.8);
}

TEST(ViewPlan, OfAPathIsTheBodyOfRoamWalkWhateverTheSettingsSay) {
  ViewOptions options = of_a_scene();
  options.path = "tour.path";
  ViewSettings settings;
  settings.radius = 0.2;
  settings.height = 1.7;
  settings.speed = 9.0;
  const ViewPlan plan = make_plan(options, settings);
  EXPECT_EQ(plan.walker.radius, 0.3);
  EXPECT_EQ(plan.walker.height, 1.8);
  EXPECT_EQ(plan.walker.speed, 1.4);
}

TEST(ViewPlan, TakesFromTheSettingsWhatTheCommandLineLeavesOpen) {
  ViewSettings settings;
  settings.radius = 0.2;
  settings.height = 1.7;
  settings.speed = 2.0;
  settings.fov = 80.0;
  EXPECT_EQ(make_plan(of_a_scene(), settings).pages.allowed_error, 16.0);
  settings.tile_error = 2.5;
  ViewOptions options = of_a_scene();
  options.speed = 5.0;
  const ViewPlan plan = make_plan(options, settings);
  EXPECT_EQ(plan.walker.radius, 0.2);
  EXPECT_EQ(plan.walker.height, 1.7);
  EXPECT_EQ(plan.walker.speed, 5.0);
  EXPECT_EQ(plan.fov, 80.0);
  EXPECT_EQ(plan.pages.allowed_error, 2.5);
  options.tile_error = 0.0;
  EXPECT_EQ(make_plan(options, settings).pages.allowed_error, 0.0);
}

TEST(ViewPlan, RefusesWhatCannotBeMeant) {
  ViewOptions size = of_a_scene();
  size.size = "1280*720";
  EXPECT_THROW(static_cast<void>(make_plan(size, {})), UsageError);
  ViewOptions low = of_a_scene();
  low.body.radius = 0.5;
  low.body.height = 0.4;
  EXPECT_THROW(static_cast<void>(make_plan(low, {})), UsageError);
  ViewOptions idle = of_a_scene();
  idle.headless = true;
  EXPECT_TRUE(contains(error_of([&] { static_cast<void>(make_plan(idle, {})); }), "--screenshot"));
  ViewOptions ghost = of_a_scene();
  ghost.mode = Mode::ghost;
  ghost.path = "tour.path";
  EXPECT_THROW(static_cast<void>(make_plan(ghost, {})), UsageError);

  const TestFolder folder;
  ViewOptions over;
  over.scene.scenes = {folder.write("scene.obj", "v 0 0 0\n")};
  over.trace = over.scene.scenes[0];
  EXPECT_TRUE(contains(error_of([&] { static_cast<void>(make_plan(over, {})); }), "would overwrite the scene"));
}

TEST(ViewPlan, RefusesOutputsThatWouldReplaceOrMissSomething) {
  const TestFolder folder;
  ViewOptions options = of_a_scene();
  options.trace = folder.file("one");
  options.record_path = folder.file("./one");
  const auto error = [&](const ViewSettings& settings = {}) {
    return error_of([&] { static_cast<void>(make_plan(options, settings)); });
  };
  EXPECT_TRUE(contains(error(), "would overwrite the file of --record-path")) << error();
  options.trace = "./roam-no-such-file";
  options.record_path = "roam-no-such-file";
  EXPECT_TRUE(contains(error(), "would overwrite the file of --record-path")) << error();
  options.trace = folder.file("one");
  options.record_path.clear();
  EXPECT_EQ(error(), "");
  ViewSettings settings;
  settings.file = folder.file("one");
  EXPECT_TRUE(contains(error(settings), "would overwrite the settings"));
  options.record_path = folder.write("scene.bin", "a buffer that the scene refers to");
  EXPECT_TRUE(contains(error(), "would overwrite a file that is no path")) << error();
  PathRecorder(folder.file("way.path"), {}, Mode::walk, SceneFrame{}).close();
  options.record_path = folder.file("way.path");
  EXPECT_EQ(error(), "");
  std::filesystem::create_symlink("scene.bin", folder.file("link.path"));
  options.record_path = folder.file("link.path");
  EXPECT_TRUE(contains(error(), "would overwrite a file that is no path")) << error();
  options.record_path = folder.file("way.path");
  options.screenshot = folder.write("stone.png", "a texture");
  EXPECT_TRUE(contains(error(), "would overwrite a file that is no picture made by roam")) << error();
  options.screenshot.clear();
  options.record = folder.write("intro.mp4", "a film");
  EXPECT_TRUE(contains(error(), "would overwrite a file that is no film made by roam")) << error();
  options.record = folder.file("gone/film.mp4");
  EXPECT_TRUE(contains(error(), "there is no folder " + folder.file("gone"))) << error();
  options.record.clear();
  options.trace = folder.file("");
  EXPECT_TRUE(contains(error(), "that is a folder")) << error();
  options.trace = "-";
  EXPECT_EQ(error(), "");
}

TEST(ViewPlan, RefusesNamesOfNoPictureAndOfNoFilm) {
  ViewOptions options = of_a_scene();
  const auto error = [&] { return error_of([&] { static_cast<void>(make_plan(options, {})); }); };
  options.screenshot = "shot.xyz";
  EXPECT_TRUE(contains(error(), "--screenshot shot.xyz: a picture's name ends in .png, .jpg or .jpeg")) << error();
  options.screenshot = "shot.PNG";
  options.record = "film.avi";
  EXPECT_TRUE(contains(error(), "--record film.avi: a film's name ends in .mp4, .webm, .gif or .webp")) << error();
  options.record = "film.mp4";
  EXPECT_EQ(error(), "");
}

TEST(ViewPlan, FilmsAtARateThatTheFormatAndTheStepsAllow) {
  ViewOptions options = of_a_scene();
  const auto rate = [&](const char* file, std::optional<int> asked) {
    options.record = file;
    options.film_rate = asked;
    return make_plan(options, {}).film_rate;
  };
  EXPECT_EQ(rate("film.mp4", {}), 30);
  EXPECT_EQ(rate("film.GIF", {}), 20);
  EXPECT_EQ(rate("film.webm", 60), 60);
  EXPECT_EQ(rate("film.gif", 10), 10);
  EXPECT_TRUE(contains(error_of([&] { rate("film.mp4", 25); }), "--fps 25: take 60, 30, 20"));
  EXPECT_TRUE(contains(error_of([&] { rate("film.gif", 30); }), "hundredths of a second: take 20 or 10"));
}

TEST(ViewPlan, RefusesPlacesThatAreNotWritten) {
  for (const char* place : {"1,2", "1,2,3,4,5,6", "1,2,3,", "1,,3", "1,2,x"}) {
    CLI::App program;
    ViewOptions options;
    options.add_to(program);
    EXPECT_THROW(program.parse(std::string("scene.obj --at ") + place), CLI::ValidationError) << place;
  }
}

TEST(ViewPlan, RefusesPlacesThatNoSceneReaches) {
  ViewOptions far = of_a_scene();
  far.at = {2e9, 0, 0};
  EXPECT_TRUE(contains(error_of([&] { static_cast<void>(make_plan(far, {})); }), "--at: 2e+09"));
  ViewOptions unnamed;
  unnamed.scene.scenes = {""};
  EXPECT_TRUE(contains(error_of([&] { static_cast<void>(make_plan(unnamed, {})); }), "no name"));
}

// ----------------------------------------------------------------------------------------------------- bookmarks

TEST(Settings, SayThatAFolderIsNoFile) {
  const TestFolder folder;
  std::filesystem::create_directories(folder.file("roam.json"));
  const std::string settings = error_of([&] { static_cast<void>(read_settings(folder.file("roam.json"))); });
  EXPECT_TRUE(contains(settings, folder.file("roam.json") + ": Is a directory; name a file")) << settings;
  const std::string bookmarks =
      error_of([&] { static_cast<void>(Bookmarks(folder.file("roam.json"), {"mine.obj"}, {})); });
  EXPECT_TRUE(contains(bookmarks, folder.file("roam.json") + ": Is a directory; name a file")) << bookmarks;
}

TEST(Bookmarks, AreKeptForTheirSceneAlone) {
  const TestFolder folder;
  const std::filesystem::path file = folder.file("config/roam/bookmarks.json");
  Bookmarks mine(file, {"mine.obj"}, {});
  EXPECT_EQ(mine.add({{1, 2, 3}, 90, -5}).name, "1");
  EXPECT_EQ(mine.add({{4, 5, 6}, 0, 0}).name, "2");
  EXPECT_TRUE(Bookmarks(file, {"yours.obj"}, {}).all().empty());
  EXPECT_TRUE(Bookmarks(file, {"mine.obj"}, {.up = UpAxis::y}).all().empty());
  Bookmarks again(file, {std::filesystem::absolute("mine.obj")}, {});
  ASSERT_EQ(again.all().size(), 2u);
  EXPECT_EQ(again.find("1")->pose.position, Vec3(1, 2, 3));
  EXPECT_EQ(again.find("1")->pose.yaw, 90.0);
  EXPECT_EQ(again.find("1")->pose.pitch, -5.0);
  EXPECT_FALSE(again.find("3"));
  // Nothing is left beside the file.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file.parent_path()), {}), 1);
}

TEST(Bookmarks, AreKeptForASceneWhoseNameIsNoUtf8) {
  const TestFolder folder;
  const std::filesystem::path file = folder.file("b.json");
  Bookmarks mine(file, {"caf\xe9.obj"}, {});
  EXPECT_EQ(mine.add({{1, 2, 3}, 90, -5}).name, "1");
  EXPECT_EQ(mine.add({{4, 5, 6}, 0, 0}).name, "2");
  EXPECT_EQ(Bookmarks(file, {"caf\xe9.obj"}, {}).all().size(), 2u);
  EXPECT_TRUE(Bookmarks(file, {"caf\xe8.obj"}, {}).all().empty());
}

TEST(Bookmarks, AreGivenNames) {
  const TestFolder folder;
  const std::filesystem::path file = folder.file("b.json");
  Bookmarks mine(file, {"mine.obj"}, {});
  EXPECT_TRUE(contains(error_of([&] { mine.rename("shaft"); }), "keep one first"));
  mine.add({{1, 2, 3}, 90, -5});
  mine.rename("shaft");
  EXPECT_EQ(mine.present()->name, "shaft");
  EXPECT_EQ(mine.add({{4, 5, 6}, 0, 0}).name, "1");
  EXPECT_TRUE(contains(error_of([&] { mine.rename("shaft"); }), "another bookmark has the name shaft"));
  mine.rename("1");
  Bookmarks other(file, {"mine.obj"}, {});
  EXPECT_EQ(other.names(), "shaft, 1");
  EXPECT_EQ(other.find("shaft")->pose.position, Vec3(1, 2, 3));
  // Another session has renamed it meanwhile.
  other.rename("door");
  EXPECT_TRUE(mine.find("shaft"));
  EXPECT_TRUE(contains(error_of([&] { mine.rename("hall"); }), "no longer there"));
  EXPECT_EQ(Bookmarks(file, {"mine.obj"}, {}).names(), "door, 1");
}

TEST(Bookmarks, AreReplacedInOneChange) {
  const TestFolder folder;
  const std::string file = folder.file("b.json");
  Bookmarks mine(file, {"mine.obj"}, {});
  for (const double x : {1.0, 2.0, 3.0}) mine.add({{x, 0, 0}, 0, 0});
  Bookmarks(file, {"mine.obj"}, {}).remove("3");
  EXPECT_TRUE(contains(error_of([&] { mine.rename("1", true); }), "no longer there"));
  EXPECT_EQ(Bookmarks(file, {"mine.obj"}, {}).names(), "1, 2") << "the other one stays";
  mine.find("2");
  mine.rename("1", true);
  EXPECT_EQ(mine.names(), "1");
  EXPECT_EQ(mine.present()->pose.position.x, 2.0);
  EXPECT_EQ(Bookmarks(file, {"mine.obj"}, {}).find("1")->pose.position.x, 2.0);
}

TEST(Bookmarks, OfAnotherFrameAreNotTakenButKnown) {
  const TestFolder folder;
  const std::filesystem::path file = folder.file("b.json");
  const SceneFrame turned{UpAxis::minus_y, LengthUnit::cm};
  Bookmarks(file, {"mine.obj"}, turned).add({{1, 2, 3}, 90, -5});
  Bookmarks plain(file, {"mine.obj"}, {});
  EXPECT_FALSE(plain.find("1"));
  EXPECT_EQ(plain.frame_elsewhere("1"), turned);
  EXPECT_FALSE(plain.frame_elsewhere("2"));
  EXPECT_TRUE(Bookmarks(file, {"mine.obj"}, turned).find("1"));
}

TEST(Bookmarks, OfAnOldFileAreOfTheFrameWithoutOptions) {
  const TestFolder folder;
  const std::string file =
      folder.write("b.json",
                   "[{\"scene\": [\"/house.glb\"], \"up\": \"\", \"unit\": \"m\", \"bookmarks\": [{\"name\": "
                   "\"1\", \"position\": [1, 2, 3]}]}]");
  const SceneFrame gltf{.up = UpAxis::y};
  EXPECT_TRUE(Bookmarks(file, {"/house.glb"}, gltf, gltf).find("1"));
  EXPECT_EQ(Bookmarks(file, {"/house.glb"}, {}, gltf).frame_elsewhere("1"), gltf);
}

TEST(Bookmarks, KeepWhatAnotherSessionHasWrittenMeanwhile) {
  const TestFolder folder;
  Bookmarks one(folder.file("b.json"), {"mine.obj"}, {});
  Bookmarks two(folder.file("b.json"), {"mine.obj"}, {});
  one.add({{1, 0, 0}, 0, 0});
  EXPECT_EQ(two.add({{2, 0, 0}, 0, 0}).name, "2");
  EXPECT_EQ(two.all().size(), 2u);
}

TEST(Bookmarks, KeepWhatAnotherSessionWritesAtTheSameTime) {
  const TestFolder folder;
  const std::string file = folder.file("b.json");
  const auto add_some = [&] {
    Bookmarks some(file, {"mine.obj"}, {});
    for (int i = 0; i < 50; ++i) some.add({{1, 0, 0}, 0, 0});
  };
  std::thread other(add_some);
  add_some();
  other.join();
  EXPECT_EQ(Bookmarks(file, {"mine.obj"}, {}).all().size(), 100U);
}

TEST(Bookmarks, OfSeveralEntriesAreKept) {
  const TestFolder folder;
  const std::string entry = R"({"scene": ["/mine.obj"], "bookmarks": [{"name": "NAME", "position": [1, 2, 3]}]})";
  const auto named = [&](const char* name) { return std::string(entry).replace(entry.find("NAME"), 4, name); };
  const std::string file = folder.write("b.json", "[" + named("door") + ", " + named("shaft") + "]");
  Bookmarks mine(file, {"/mine.obj"}, {});
  EXPECT_EQ(mine.names(), "door, shaft");
  mine.add({{4, 5, 6}, 0, 0});
  EXPECT_EQ(mine.names(), "door, shaft, 1");
  mine.remove("shaft");
  EXPECT_EQ(Bookmarks(file, {"/mine.obj"}, {}).names(), "door, 1");
}

TEST(Bookmarks, NeverWriteOverAFileThatTheyDoNotUnderstand) {
  const TestFolder folder;
  const std::string file = folder.write("b.json", "{\"mine\": 1}");
  const std::string what = error_of([&] { Bookmarks(file, {"mine.obj"}, {}); });
  EXPECT_TRUE(contains(what, file) && contains(what, "list of scenes")) << what;
  EXPECT_EQ(folder.read("b.json"), "{\"mine\": 1}");
}

}  // namespace
