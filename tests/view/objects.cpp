// The objects that a session of roam view joins, each by itself, without a window.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <thread>

#include "roam/error.h"
#include "view/arrival.h"
#include "view/body.h"
#include "view/commands.h"
#include "view/learning.h"
#include "view/news.h"
#include "view/records.h"
#include "view/store_building.h"
#include "view_scenes.h"

namespace {

using namespace roam;
using namespace roam::app;

/// A body in a room, with whatever object a test takes.
class ViewObjects : public testing::Test {
 protected:
  ViewObjects() {
    use_no_settings(folder_);
    setenv("ROAM_READER", ROAM_READER_PROGRAM, 1);
    options_.scene.scenes = {folder_.write("scene.obj", room_obj())};
    options_.at = {8, 0, 0.95, 90};
  }
  ~ViewObjects() override { unsetenv("ROAM_READER"); }

  /// Calls `look` until it is true.
  template <class Look>
  static void wait_until(const Look& look) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!look() && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_TRUE(look());
  }
  [[nodiscard]] SceneAndStore what() const { return scene_and_store(options_.scene, options_.store); }
  [[nodiscard]] ViewPlan plan() const { return make_plan(options_, {}); }
  /// Until the body may enter.
  void receive(Arrival& arrival, const Arrival::Seen& seen) {
    wait_until([&] { return is_over(arrival.loader().state()); });
    ASSERT_TRUE(arrival.receive(seen));
  }

  TestFolder folder_;
  ViewOptions options_;
  osg::ref_ptr<osgRoam::Manipulator> roamer_ = make_roamer({}, {});
  News news_{std::vector<std::filesystem::path>{}};
};

LoadState over(LoadState::Phase phase) {
  LoadState state;
  state.phase = phase;
  return state;
}

TEST(ViewNews, AreShownUntilTheyAreReadAndKeptOnce) {
  News news({"/scenes/mine.obj"});
  news.tell("'/scenes/mine.obj' has no floor");
  news.set_time(1.0);
  news.note("careful");
  news.note("careful");
  ASSERT_EQ(news.shown().size(), 3u);
  EXPECT_EQ(news.shown()[0].text, "'mine.obj' has no floor");
  EXPECT_FALSE(news.shown()[0].warning);
  EXPECT_TRUE(news.shown()[1].warning);
  EXPECT_EQ(news.notes(), std::vector<std::string>{"careful"});
  news.set_time(6.5);
  EXPECT_EQ(news.shown().size(), 2u);
  for (int i = 0; i < 9; ++i) news.tell("more");
  EXPECT_EQ(news.shown().size(), 4u) << "no more lines than fit";
}

TEST(ViewNews, TellTheTerminalEachNoteAtOnceAndOnce) {
  testing::internal::CaptureStderr();
  News news({}, {"said before"});
  news.note("careful");
  news.note("careful");
  news.note_first("careful", "U turns it");
  news.note("said before");
  news.note("7 files: a, b, c", "7 files");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "roam: note: careful\nroam: note: 7 files: a, b, c\n");
  EXPECT_EQ(news.notes().size(), 3u);
  ASSERT_EQ(news.shown().size(), 2u) << "what an earlier session said is not shown again";
  EXPECT_EQ(news.shown()[0].text, "careful; U turns it");
  EXPECT_EQ(news.shown()[1].text, "7 files");
  news.set_time(10.0);
  ASSERT_EQ(news.shown().size(), 1u) << "a remedy stays longer";
}

TEST(ViewNews, ShowTheFrameBeforeWhatIsMissing) {
  News news({"/scenes/mine.dae"});
  news.note("/scenes/mine.dae states its unit.");
  for (int i = 0; i < 9; ++i) news.note("image " + std::to_string(i) + " is missing");
  news.note_first("/scenes/mine.dae states its unit.", "Ctrl+U applies it");
  news.note_first("floors face y", "U turns it");
  news.note("/scenes/mine.dae states its unit.");
  for (int i = 0; i < 9; ++i) news.tell("more");
  ASSERT_EQ(news.shown().size(), 4u);
  EXPECT_EQ(news.shown()[0].text, "mine.dae states its unit. Ctrl+U applies it.");
  EXPECT_EQ(news.shown()[1].text, "floors face y; U turns it");
  EXPECT_EQ(news.shown()[3].text, "more");
  ASSERT_EQ(news.notes().size(), 11u) << "each once";
  EXPECT_EQ(news.notes()[0], "/scenes/mine.dae states its unit.");
  EXPECT_EQ(news.notes()[1], "floors face y");
  EXPECT_EQ(news.notes()[2], "image 0 is missing");
}

TEST(ViewNews, ShowANewLineThoughAllOthersComeFirst) {
  News news({});
  for (int i = 0; i < 4; ++i) news.note_first("note " + std::to_string(i));
  news.written("/film.mp4");
  ASSERT_EQ(news.shown().size(), 4u);
  EXPECT_EQ(news.shown()[0].text, "note 1");
  EXPECT_EQ(news.shown()[3].text, "written: /film.mp4");
}

TEST_F(ViewObjects, ArrivalPutsTheBodyToItsPlace) {
  Arrival arrival(options_, plan(), what(), *roamer_, news_);
  wait_until([&] { return is_over(arrival.loader().state()); });
  EXPECT_FALSE(arrival.receive({})) << "nothing of the picture is there, so its origin is not known";
  receive(arrival, {.has_pieces = true});
  EXPECT_FALSE(arrival.is_placed());
  arrival.enter();
  EXPECT_TRUE(arrival.is_placed());
  EXPECT_NEAR(pose_of(*roamer_).position.x, 8.0, 0.01);
  EXPECT_NEAR(pose_of(*roamer_).yaw, 90.0, 1e-6);
  EXPECT_FALSE(arrival.is_ghost_only());
  Status status;
  arrival.fill(status);
  EXPECT_GT(status.triangles, 0u);
}

TEST_F(ViewObjects, ArrivalWithoutCollisionIsAGhostThatSeesAll) {
  options_.scene.scenes = {folder_.write("broken.obj", "f 1 2 3\n")};
  options_.at.clear();
  Arrival arrival(options_, plan(), what(), *roamer_, news_);
  receive(arrival, {over(LoadState::Phase::done), true, {}, {{1, 2, 3}, 30, 0}});
  arrival.enter();
  EXPECT_TRUE(arrival.is_ghost_only());
  EXPECT_EQ(arrival.identity(), nullptr);
  EXPECT_EQ(pose_of(*roamer_).position, Vec3(1, 2, 3));
  EXPECT_EQ(key_of(roamer_->controls(), "gravity"), "") << "there is nothing to stand on";
}

TEST_F(ViewObjects, ArrivalOfNothingIsAnError) {
  options_.scene.scenes = {folder_.write("broken.obj", "f 1 2 3\n")};
  Arrival arrival(options_, plan(), what(), *roamer_, news_);
  wait_until([&] { return is_over(arrival.loader().state()); });
  EXPECT_THROW(static_cast<void>(arrival.receive({over(LoadState::Phase::failed), false, {}, {}})), Error);
}

TEST_F(ViewObjects, StoreBuildingHandsOverThePager) {
  StoreBuilding building(what(), ROAM_PROGRAM, *roamer_, news_);
  building.toggle(nullptr, {8, 0, 1}, 12);
  EXPECT_TRUE(contains(news_.shown().back().text, "again builds the collision store"));
  building.toggle(nullptr, {8, 0, 1}, 12);
  Status status;
  building.fill(status);
  ASSERT_TRUE(status.building);
  std::shared_ptr<Pager> pager;
  wait_until([&] { return pager != nullptr || (pager = building.take()) != nullptr; });
  EXPECT_TRUE(std::filesystem::exists(folder_.file("scene.obj.roam")));
  building.toggle(pager.get(), {8, 0, 1}, 12);
  EXPECT_TRUE(contains(news_.shown().back().text, "there is nothing to build"));
}

TEST_F(ViewObjects, StoreBuildingSaysWhyItFailed) {
  const std::string failing = folder_.write(
      "roam", "#!/bin/sh\necho '{\"error\": {\"message\": \"the disk is full\", \"where\": null}}'\nexit 1\n");
  std::filesystem::permissions(failing, std::filesystem::perms::owner_all);
  for (const auto& [program, why] :
       {std::pair(failing, "the store could not be built: the disk is full"),
        std::pair(std::string("/bin/false"), "the store could not be built: `roam build` ended with status 1"),
        std::pair(folder_.file("absent"), "the store could not be built: cannot start ")}) {
    StoreBuilding building(what(), program, *roamer_, news_);
    building.toggle(nullptr, {8, 0, 1}, 12);
    building.toggle(nullptr, {8, 0, 1}, 12);
    const std::size_t before = news_.notes().size();
    wait_until([&] {
      building.follow({8, 0, 1});
      return news_.notes().size() > before;
    });
    EXPECT_TRUE(contains(news_.notes().back(), why)) << news_.notes().back();
    EXPECT_EQ(building.take(), nullptr);
  }
}

TEST_F(ViewObjects, StoreBuildingReadsTheSceneAsTheSessionDoes) {
  SceneOptions scene;
  scene.scenes = {"-a.obj", "b c.obj"};
  scene.up = "-y";
  scene.unit = "cm";
  scene.ignore = {"--x", "Door*"};
  scene.allow = {"-d"};
  scene.lossless = true;
  scene.threads = 3;
  scene.memory = 1 << 30;
  CLI::App program;
  SceneOptions read;
  read.add_to(*program.add_subcommand("verb"));
  std::vector<std::string> words = scene.arguments();
  words.insert(words.begin(), "verb");
  std::reverse(words.begin(), words.end());
  program.parse(words);
  EXPECT_EQ(read.arguments(), scene.arguments());
  EXPECT_EQ(read.scenes, scene.scenes);
  EXPECT_EQ(read.ignore, scene.ignore);
}

TEST_F(ViewObjects, RecordsKeepPlacesAndTheWay) {
  Records records(options_.scene, *roamer_, news_);
  roamer_->setSpace(std::make_shared<const World>());
  roamer_->setMode(Mode::ghost);
  for (const double x : {1.0, 2.0, 3.0}) {
    go_to(*roamer_, {{x, 0, 1}, 0, 0});
    records.add_bookmark();
  }
  const auto x_after = [&](bool backwards) {
    records.go_to_next_bookmark(backwards);
    return pose_of(*roamer_).position.x;
  };
  EXPECT_EQ(x_after(false), 1.0) << "in a circle, from the one that was just kept";
  EXPECT_EQ(x_after(true), 3.0);
  EXPECT_EQ(Records(options_.scene, *roamer_, news_).named("2").position.x, 2.0);
  records.record(folder_.file("way.path"));
  records.add_frame(0.0);
  records.finish();
  EXPECT_EQ(news_.files(), std::vector<std::string>{folder_.file("way.path")});
}

TEST_F(ViewObjects, LearningSavesForTheBodyThatRoams) {
  roamer_->setSpace(std::make_shared<const World>());
  Learning learning(options_, plan(), {}, *roamer_, news_);
  Commands commands(news_);
  learning.add_to(commands);
  EXPECT_TRUE(commands.run("adapt"));
  learning.update();
  EXPECT_EQ(learning.taken(), 0) << "nothing was offered";
  Status status;
  learning.fill(status);
  EXPECT_EQ(status.hold.text, "");
}

}  // namespace
