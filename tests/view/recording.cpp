// What roam view records: the way, and the body that went it.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <functional>

#include "messages.h"
#include "program.h"
#include "roam/error.h"
#include "roam/path_file.h"
#include "scenes/recorded_body.h"
#include "view/options.h"
#include "view/path_recorder.h"
#include "view/walk_log.h"

namespace {

using namespace roam;
using namespace roam::app;

TEST(PathRecorder, WritesAPathThatCanBeWalked) {
  const TestFolder folder;
  PathRecorder recorder(folder.file("way.path"), {}, Mode::walk);
  const std::array<double, 4> ahead{0.5, 0.5, -0.5, -0.5};
  for (int i = 0; i <= 60; ++i) recorder.add(5.0 + i / 60.0, {i / 60.0, 2.0, 3.0}, ahead, Mode::walk);
  for (int i = 0; i < 120; ++i) recorder.add(6.0 + i / 60.0, {1.0, 2.0, 3.0}, ahead, Mode::walk);
  recorder.add(8.5, {1.0, 4.0, 3.0}, ahead, Mode::walk);
  recorder.close();
  const std::vector<Waypoint> path = load_path(folder.file("way.path"));
  // Ten a second while it moves; of the rest its begin and its end.
  ASSERT_GE(path.size(), 10u);
  EXPECT_LE(path.size(), 16u);
  EXPECT_EQ(path.front().position, Vec3(0, 2, 3));
  EXPECT_EQ(path.front().pose->time, 0.0);
  EXPECT_EQ(path.front().pose->rotation, (std::array<double, 4>{0.5, 0.5, -0.5, -0.5}));
  EXPECT_EQ(path.back().position, Vec3(1, 4, 3));
  EXPECT_NEAR(path.back().pose->time, 3.5, 1e-3);
  EXPECT_EQ(path[path.size() - 2].position, Vec3(1, 2, 3));
  EXPECT_NEAR(path[path.size() - 2].pose->time, 3.0, 0.05);
}

/// Records a way of some kB to way.path. What went wrong; empty: nothing.
std::string recorded(const TestFolder& folder, const std::function<void()>& meanwhile) {
  return error_of([&] {
    PathRecorder recorder(folder.file("way.path"), {}, Mode::walk);
    for (int i = 0; i < 200; ++i) recorder.add(0.1 * i, {0.1 * i, 2.0, 3.0}, {}, Mode::walk);
    meanwhile();
    recorder.close();
  });
}

TEST(PathRecorder, LeavesWhatWasThereUntilItCloses) {
  const TestFolder folder;
  folder.write("way.path", "# roam: of before");
  EXPECT_EQ(recorded(folder, [&] { EXPECT_TRUE(folder.read("way.path") == "# roam: of before"); }), "");
  EXPECT_GT(load_path(folder.file("way.path")).size(), 100U);
}

TEST(PathRecorder, LeavesWhatWasThereWhenTheDiskIsFull) {
  const TestFolder folder;
  folder.write("way.path", "# roam: of before");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit small{1024, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string said = recorded(folder, [] {});
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  EXPECT_TRUE(contains(said, "way.path: File too large")) << said;
  EXPECT_TRUE(folder.read("way.path") == "# roam: of before");
}

TEST(PathRecorder, WritesWhereALinkLeads) {
  const TestFolder folder;
  folder.write("real.path", "1 2 3\n4 5 6\n");
  std::filesystem::create_symlink("real.path", folder.file("way.path"));
  EXPECT_EQ(recorded(folder, [] {}), "");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("way.path")));
  EXPECT_GT(load_path(folder.file("real.path")).size(), 100U);
}

TEST(PathRecorder, KeepsAWayThatAnErrorCutShort) {
  const TestFolder folder;
  EXPECT_EQ(recorded(folder, [] { throw Error("the graphics driver has gone"); }), "the graphics driver has gone");
  EXPECT_GT(load_path(folder.file("way.path")).size(), 100U);
}

TEST(PathRecorder, SaysWhereItCannotWrite) {
  EXPECT_TRUE(contains(error_of([] { PathRecorder("/nowhere/way.path", {}, Mode::walk); }), "/nowhere/way.path"));
}

TEST(PathRecorder, SaysTheBodyAndItsModes) {
  const TestFolder folder;
  const std::string file = folder.file("way.path");
  const auto record = [&](const std::vector<Mode>& modes) {
    PathRecorder recorder(file, {.radius = 0.25, .height = 1.7, .eye = 1.4, .step = 0.2, .slope_degrees = 40},
                          modes[0]);
    for (std::size_t i = 0; i < modes.size(); ++i) recorder.add(static_cast<double>(i), {1.0 * i, 0, 0}, {}, modes[i]);
    recorder.close();
    EXPECT_EQ(load_path(file).size(), modes.size());
    return load_recorded_path(file).body.value();
  };
  const RecordedBody walked = record({Mode::walk, Mode::walk});
  EXPECT_EQ(walked.mode, Mode::walk);
  EXPECT_EQ(walked.settings.radius, 0.25);
  EXPECT_EQ(walked.settings.height, 1.7);
  EXPECT_EQ(walked.settings.eye, 1.4);
  EXPECT_EQ(walked.settings.step, 0.2);
  EXPECT_EQ(walked.settings.slope_degrees, 40.0);
  EXPECT_FALSE(walked.ghost);
  const RecordedBody mixed = record({Mode::walk, Mode::ghost, Mode::walk});
  EXPECT_EQ(mixed.mode, Mode::fly);
  EXPECT_EQ(mixed.settings.radius, 0.25);
  EXPECT_TRUE(mixed.ghost);
}

TEST(PathRecorder, SaysTheFrame) {
  const TestFolder folder;
  const std::string file = folder.file("way.path");
  const SceneFrame turned{UpAxis::minus_y, LengthUnit::in};
  {
    PathRecorder recorder(file, {}, Mode::walk, turned);
    for (const double t : {0.0, 1.0}) recorder.add(t, {t, 0, 0}, {}, Mode::walk);
    recorder.close();
  }
  EXPECT_EQ(load_recorded_path(file).frame, turned);
  EXPECT_TRUE(load_recorded_path(file).body);
}

TEST(RecordedPath, OfAnotherFrameIsRefusedWithTheOptionsThatOpenIt) {
  const TestFolder folder;
  const RecordedPath path = load_recorded_path(folder.write("p.path", "# roam: frame up -y unit cm\n1 2 3\n4 5 6\n"));
  const auto error = [&](const std::optional<SceneFrame>& frame) {
    return error_of([&] { demand_frame(path, frame, {}); });
  };
  EXPECT_TRUE(contains(error(SceneFrame{}), "--up=-y --unit=cm, which is read with --up=z here: use --up=-y --unit=cm"))
      << error(SceneFrame{});
  EXPECT_EQ(error(SceneFrame{UpAxis::minus_y, LengthUnit::cm}), "");
  EXPECT_EQ(error(std::nullopt), "");
  EXPECT_EQ(error_of([&] {
              demand_frame(load_recorded_path(folder.write("q.path", "1 2 3\n4 5 6\n")), SceneFrame{UpAxis::x}, {});
            }),
            "");
}

TEST(RecordedPath, NamesTheLineOfAFrameThatIsNone) {
  const TestFolder folder;
  for (const char* frame :
       {"up w unit m", "up y unit parsec", "up y", "y m", "up y unit m m", "up z unit m\n# roam: frame up y unit m"}) {
    const std::string bad = folder.write("bad.path", "# roam: frame " + std::string(frame) + "\n1 2 3\n4 5 6\n");
    EXPECT_TRUE(contains(error_of([&] { static_cast<void>(load_recorded_path(bad).waypoints()); }), "bad.path:"))
        << frame;
  }
}

TEST(RecordedBody, IsSaidByNoOtherComment) {
  const TestFolder folder;
  EXPECT_FALSE(load_recorded_path(folder.write("p.path", "# roam: a fine tour\n1 2 3\n4 5 6\n")).body);
  const std::string bad = folder.write("bad.path", "1 2 3\n# roam: mode walk radius wide\n4 5 6\n");
  EXPECT_TRUE(contains(error_of([&] { static_cast<void>(load_recorded_path(bad).waypoints()); }), "bad.path:2"));
}

TEST(RecordedBody, ThatCannotBeIsNamedWithItsLine) {
  const TestFolder folder;
  const std::string bad = folder.write("bad.path", "1 2 3\n# roam: mode walk radius -1\n4 5 6\n");
  const std::string what = error_of([&] { static_cast<void>(load_recorded_path(bad).waypoints()); });
  EXPECT_TRUE(contains(what, "bad.path:2: the walker's radius is -1 m")) << what;
}

TEST(RecordedBody, ThatClimbsOtherwiseIsAnotherOnFoot) {
  RecordedBody body;
  WalkerSettings settings;
  EXPECT_EQ(compare(body, settings, Mode::walk), "");
  settings.step = 0.1;
  EXPECT_TRUE(contains(compare(body, settings, Mode::walk), "steps 0.3 m and climbs 45 degrees; this one 0.1 m"));
  settings.step = body.settings.step;
  settings.slope_degrees = 10.0;
  EXPECT_TRUE(contains(compare(body, settings, Mode::walk), "0.3 m and 10 degrees"));
  body.mode = Mode::fly;
  EXPECT_EQ(compare(body, settings, Mode::fly), "");
}

TEST(RecordedBody, IsTheBodyOfThePlanUnlessOptionsSayOtherwise) {
  RecordedBody body;
  body.mode = Mode::fly;
  body.settings.radius = 0.25;
  body.settings.height = 1.7;
  body.settings.slope_degrees = 30.0;
  ViewOptions options;
  options.scene.scenes = {"hall.obj"};
  options.path = "tour.path";
  ViewSettings settings;
  settings.radius = 0.2;
  const ViewPlan same = make_plan(options, settings, body);
  EXPECT_EQ(same.walker.radius, 0.25);
  EXPECT_EQ(same.walker.height, 1.7);
  EXPECT_EQ(same.walker.slope_degrees, 30.0);
  EXPECT_EQ(same.mode, Mode::fly);
  EXPECT_EQ(same.note, "");
  options.body.radius = 0.4;
  options.mode = Mode::walk;
  const ViewPlan other = make_plan(options, settings, body);
  EXPECT_EQ(other.walker.height, 1.8);
  EXPECT_EQ(other.walker.slope_degrees, 45.0);
  EXPECT_EQ(other.mode, Mode::walk);
  EXPECT_EQ(other.note,
            "the path was recorded by another body: radius 0.25 m, height 1.7 m; this is radius 0.4 m, height 1.8 m");
  options.body.radius.reset();
  options.body.height = 1.0;
  EXPECT_EQ(make_plan(options, settings, body).walker.eye, 1.0);
}

TEST(WalkLog, KeepsForVerifyingWhatABodyDidBeforeItWasHeld) {
  const auto step = [](double x, double clearance) {
    StepReport report;
    report.segments.push({Vec3(x, 0.0, 0.0), 1.8, 0.3, 0.01, clearance, false});
    report.from = {x - 1.0, 0.0, 0.0};
    report.to = {x, 0.0, 0.0};
    report.height = 1.8;
    report.radius = 0.3;
    report.elapsed = 0.01;
    report.axis_clearance = report.least_axis_clearance = clearance;
    return report;
  };
  WalkLog log({}, true);
  log.take(step(0.0, 0.9), Mode::walk, 0.0);
  StepReport held = step(1.0, 0.4);
  held.held = true;
  log.take(held, Mode::walk, 0.01);
  log.take(step(2.0, 0.0), Mode::ghost, 0.01);
  ViewReport report;
  log.fill(report);
  EXPECT_EQ(report.steps, 2u);
  EXPECT_EQ(report.length, 2.0);
  EXPECT_EQ(report.least_axis_clearance, 0.4);
  int of_the_step = 0;
  report.pieces.each(100, [&](std::span<const verification::Piece> pieces) {
    for (const verification::Piece& piece : pieces) {
      EXPECT_NE(piece.step, 2u) << "nothing is promised of a ghost";
      of_the_step += piece.step == 1 ? 1 : 0;
    }
  });
  EXPECT_EQ(of_the_step, 2) << "the way, and the place at its end";
}

}  // namespace
