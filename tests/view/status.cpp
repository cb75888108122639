// The display's words, and the questions before it acts.
#include "view/status.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <thread>

#include "cli/histogram.h"
#include "messages.h"
#include "view/commands.h"
#include "view/loading.h"
#include "view/store_choice.h"
#include "view/thrift.h"
#include "view/twice.h"

namespace {

using namespace roam;
using namespace roam::app;

TEST(Histogram, TellsQuantilesToAPercent) {
  Histogram times;
  EXPECT_EQ(times.quantile(0.5), 0.0);
  for (int i = 1; i <= 10000; ++i) times.add(100.0 * i);
  EXPECT_NEAR(times.quantile(0.5), 5e5, 6e3);
  EXPECT_NEAR(times.quantile(0.99), 9.9e5, 1.2e4);
  EXPECT_EQ(times.largest(), 1e6);
}

TEST(Status, TellsHowLoadingGoesOn) {
  LoadState state;
  state.phase = LoadState::Phase::indexing;
  state.share = 0.6;
  state.triangles = 1'200'000;
  state.seconds_left = 8.0;
  EXPECT_EQ(load_text("collision", state), "collision 81 %: 1.20 M triangles, 8.0 s left");
  state.phase = LoadState::Phase::failed;
  state.error = Error("mine.dae", "is no Collada");
  EXPECT_EQ(load_text("collision", state), "collision failed: mine.dae: is no Collada");
  state.phase = LoadState::Phase::done;
  EXPECT_EQ(load_text("collision", state), "");
}

TEST(Loading, TellsATimeOnlyOfTheLastLongPhaseAndByItsOwnRate) {
  using Phase = LoadState::Phase;
  std::vector<double> left;
  {
    std::promise<Loading*> made;
    Loading loading([&] {
      Loading& self = *made.get_future().get();
      const auto tell = [&](Phase phase, double share) {
        self.tell(phase, share, 10);
        left.push_back(self.state().seconds_left);
      };
      const auto wait = [] { std::this_thread::sleep_for(std::chrono::milliseconds(1200)); };
      tell(Phase::reading, 0.1);
      wait();
      tell(Phase::reading, 0.9);   // indexing follows
      tell(Phase::indexing, 0.0);  // a plan
      tell(Phase::indexing, 0.5);  // what an earlier build has done
      wait();
      tell(Phase::indexing, 0.6);
      tell(Phase::indexing, 1.0);  // something else follows
    });
    made.set_value(&loading);
  }
  ASSERT_EQ(left.size(), 6u);
  for (const std::size_t i : {0, 1, 2, 3, 5}) EXPECT_LT(left[i], 0.0) << i;
  EXPECT_GT(left[4], 4.0) << "a tenth took 1.2 s, and four are left";
  EXPECT_LT(left[4], 20.0);
}

TEST(Status, HoldsTheBodyUntilThereIsSomethingToCollideWith) {
  Status status;
  EXPECT_TRUE(contains(status_message(status).text, "Loading the walls; then you can walk."));
  EXPECT_GE(load_share(status.display, status.collision), 0.0);
  status.collision.phase = LoadState::Phase::failed;
  EXPECT_TRUE(contains(status_message(status).text, "passes through walls"));
  status.display.phase = LoadState::Phase::done;
  EXPECT_LT(load_share(status.display, status.collision), 0.0);
}

TEST(Status, TellsNewsInFullBelowWhatHolds) {
  Status status;
  status.mode = Mode::walk;
  status.hold = {"blocked by a wall", false};
  status.news = {{"written: a.png", false}, {std::string(200, 'x'), true}};
  const Told message = status_message(status);
  EXPECT_EQ(message.text, "blocked by a wall\nwritten: a.png\n" + std::string(200, 'x'));
  EXPECT_TRUE(message.warning);
}

TEST(Status, GivesBearingsFromNorth) {
  EXPECT_EQ(heading_text(90.0, 0.2), "0\u00b0 N, level");
  EXPECT_EQ(heading_text(0.0, -0.2), "90\u00b0 E, level");
  EXPECT_EQ(heading_text(-122.0, -10.0), "212\u00b0 SW, 10\u00b0 down");
  EXPECT_EQ(heading_text(90.4, 90.0), "0\u00b0 N, 90\u00b0 up");
  EXPECT_EQ(heading_text(180.0, 0.0), "270\u00b0 W, level");
  EXPECT_EQ(heading_text(-180.0, 0.0), "270\u00b0 W, level");
  EXPECT_EQ(heading_text(112.6, 0.0), "337\u00b0 NW, level");
}

TEST(Status, SaysModeSpeedBodyAndPlace) {
  Status status;
  status.mode = Mode::walk;
  status.grounded = true;
  status.speed = 1.4;
  status.around.feet = {1.0, 2.0, 3.456};
  status.triangles = 1'970'000;
  std::string text;
  for (const StatusText& line : status_lines(status)) text += line.label + ": " + line.value + "\n";
  EXPECT_FALSE(contains(text, "ms")) << text;  // no frame yet
  for (const char* part : {"walk  1.4 m/s", "radius 0.30 m, height 1.80 m", "1.00, 2.00, 3.46", "1.97 M"}) {
    EXPECT_TRUE(contains(text, part)) << part << " in\n" << text;
  }
}

TEST(Status, SaysWhereTheFeetAreOnTheEarth) {
  Status status;
  status.mode = Mode::walk;
  status.around.feet = {1.0, 2.0, 3.456};
  status.georeference = Georeference{"EPSG:32632", {512'000.25, 5'403'000.0, 400.0}};
  const auto lines = status_lines(status);
  const auto site = std::find_if(lines.begin(), lines.end(), [](const StatusText& l) { return l.label == "site"; });
  ASSERT_NE(site, lines.end());
  EXPECT_EQ(site->value, "512001.25, 5403002.00, 403.46 EPSG:32632");
  // The reference is said of the file, in which other axes are up, or feet count.
  const auto there = [&](UpAxis up, LengthUnit unit) {
    status.georeferenced = {up, unit};
    return site_text(status, {0.3048, 0.6096, 0.9144});
  };
  EXPECT_EQ(there(UpAxis::z, LengthUnit::ft), "512001.25, 5403002.00, 403.00 EPSG:32632");
  EXPECT_EQ(there(UpAxis::y, LengthUnit::ft), "512001.25, 5403003.00, 398.00 EPSG:32632");
  EXPECT_EQ(there(UpAxis::x, LengthUnit::ft), "512003.25, 5403002.00, 399.00 EPSG:32632");
  status.georeferenced = {};
  // A definition of many lines is shown by its name alone.
  status.georeference->srs = "PROJCS[\"ETRS89 / UTM zone 32N\",\n  GEOGCS[\"ETRS89\",\n    DATUM[\"D\"]]]";
  EXPECT_EQ(status_lines(status)[2].value, "512001.25, 5403002.00, 403.46 ETRS89 / UTM zone 32N");
  // The option --origin names no reference system.
  status.georeference->srs.clear();
  EXPECT_TRUE(contains(status_lines(status)[2].value, "512001.25, 5403002.00, 403.46"));
  EXPECT_FALSE(status_lines(status)[2].value.ends_with(' '));
}

TEST(Status, LeavesFiguresForProgrammersToTheFullDisplay) {
  Status status;
  status.mode = Mode::walk;
  status.triangles = 12;
  status.frame_ms = 16.0;
  status.paging.emplace();
  std::string plain;
  for (const StatusText& line : status_lines(status)) plain += line.figures ? "" : line.label + "\n";
  for (const char* label : {"keys", "triangles", "memory", "collision", "frame"}) {
    EXPECT_FALSE(contains(plain, label)) << label;
  }
  status.paging->failed = 1;
  plain.clear();
  for (const StatusText& line : status_lines(status)) plain += line.figures ? "" : line.label + "\n";
  EXPECT_TRUE(contains(plain, "collision")) << "a warning";
}

TEST(Keys, BeginWithAHint) {
  osg::ref_ptr<osgRoam::Manipulator> roamer = new osgRoam::Manipulator;
  set_up(roamer->controls(), {});
  EXPECT_EQ(first_hint(roamer->controls()), "H: help     W A S D: walk     drag: look");
  roamer->controls().rebind("help =\nforward = Z\nleft = Q\ndown =\n");
  EXPECT_EQ(first_hint(roamer->controls()), "Z Q S D: walk     drag: look");
}

TEST(Twice, ConfirmsWithTheSecondOrderInTime) {
  Twice twice(3.0);
  EXPECT_FALSE(twice.confirms(10.0));
  EXPECT_TRUE(twice.confirms(12.9));
  EXPECT_FALSE(twice.confirms(13.0)) << "a new question";
  EXPECT_FALSE(twice.confirms(16.1)) << "too late";
  EXPECT_TRUE(twice.confirms(16.2));
}

TEST(Thrift, GivesTheMedianOfSlowFramesOnly) {
  Thrift thrift;
  const auto block = [&](double usual, double odd) {
    std::optional<double> last;
    for (std::size_t i = 0; i < Thrift::frames; ++i) {
      EXPECT_FALSE(last) << "not before the end of the block";
      const double ms = i % 4 == 0 ? odd : usual;
      last = thrift.take(ms, ms);
    }
    return last;
  };
  EXPECT_FALSE(block(16.0, 900.0)) << "stills and loading are slow";
  EXPECT_FALSE(block(85.0, 1.0)) << "once may be another program's";
  EXPECT_FALSE(block(16.0, 1.0));
  EXPECT_FALSE(block(85.0, 1.0)) << "not in a row";
  EXPECT_EQ(block(84.0, 1.0), 84.0);
  EXPECT_FALSE(block(85.0, 1.0)) << "of the next quality";
  EXPECT_EQ(block(83.0, 1.0), 83.0);
  EXPECT_FALSE(block(0.9 * Thrift::slowest, 2.0));
}

TEST(Thrift, CountsNoFrameThatWaitsForTheScreen) {
  Thrift thrift;
  const auto frames = [&](int blocks, double ms, double drawn_ms) {
    std::optional<double> found;
    for (std::size_t i = 0; i < blocks * Thrift::frames; ++i) {
      const auto now = thrift.take(ms, drawn_ms);
      if (now) found = now;
    }
    return found;
  };
  EXPECT_FALSE(frames(9, 1000.0, 12.0)) << "covered";
  EXPECT_FALSE(frames(9, 1000.0, 300.0)) << "and drawn at low power";
  EXPECT_TRUE(thrift.doubts());
  EXPECT_FALSE(frames(1, 16.0, 12.0));
  EXPECT_FALSE(thrift.doubts());
  EXPECT_EQ(frames(2, 100.0, 84.0), 84.0) << "slow indeed";
}

TEST(Stores, AreOfferedForLargeScenes) {
  EXPECT_FALSE(is_large(900'000'000, 10'000'000));
  EXPECT_TRUE(is_large(1'100'000'000, 0));
  EXPECT_TRUE(is_large(0, 21'000'000));
}

TEST(Status, SaysWhatIsToComeFromAServer) {
  EXPECT_EQ(coming_text(12, "a.org"), "12 tiles to come from a.org");
  EXPECT_EQ(coming_text(1, "a.org"), "1 tile to come from a.org");
  EXPECT_EQ(coming_text(0, "a.org"), "");
  EXPECT_EQ(coming_text(12, ""), "");
}

TEST(Status, SaysHowTheStoreIs) {
  Status status;
  status.mode = Mode::walk;
  status.paging.emplace();
  status.paging->memory = 64u << 20;
  status.paging->tiles = 512;
  status.paging->ready_radius = 35.2;
  status.paging->failed = 3;
  std::string text;
  for (const StatusText& line : status_lines(status)) text += line.label + ": " + line.value + "\n";
  EXPECT_TRUE(contains(text, "collision: 64 MiB, 512 tiles, ready 35 m, 3 failed\n")) << text;
  status.building.emplace();
  status.building->phase = LoadState::Phase::reading;
  status.building->share = 0.5;
  text.clear();
  for (const StatusText& line : status_lines(status)) text += line.value + "\n";
  EXPECT_TRUE(contains(text, "store 30 %")) << text;
}

}  // namespace
