// The options of roam view, and the settings that fill them in.
#include "view/options.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "cli/exit_status.h"
#include "messages.h"
#include "program.h"
#include "view/path_recorder.h"
#include "view/settings.h"

namespace {

using namespace roam;
using namespace roam::app;

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

}  // namespace
