// roam walk as a shell sees it.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "cli_scenes.h"
#include "interrupted_walk.h"
#include "messages.h"
#include "program.h"

namespace {

/// One walk in a folder of its own.
struct Walk {
  TestFolder folder;
  ProgramResult result;

  Walk(const std::string& scene, const std::string& path, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"walk", folder.write("scene.obj", scene), "--path",
                                       folder.write("p.path", path)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    result = run_program(ROAM_PROGRAM, arguments);
  }
  [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(result.out, nullptr, false); }
};

/// Two floors 0.5 m apart that end nowhere near, the upper one at z = 0.5.
std::string slot_obj() {
  return "v -90 -90 0\nv 90 -90 0\nv 90 90 0\nv -90 90 0\nv -90 -90 0.5\nv 90 -90 0.5\nv 90 90 0.5\nv -90 90 0.5\n"
         "o lower\nf 1 2 3 4\no upper\nf 5 6 7 8\n";
}

/// Two floors 4 m wide at z = 0, 10 m apart: from x = 0 to 2 and from 12 to 14.
std::string ledge_obj() {
  return "v 0 -2 0\nv 2 -2 0\nv 2 2 0\nv 0 2 0\nv 12 -2 0\nv 14 -2 0\nv 14 2 0\nv 12 2 0\n"
         "o near\nf 1 2 3 4\no far\nf 5 6 7 8\n";
}

TEST(WalkVerb, ReportsAPathThatWasWalkedToItsEnd) {
  const Walk walk(room_obj(), "2 0 0.9\n18 0 0.9\n", {"--height", "1.8", "--json", "--verify"});
  EXPECT_EQ(walk.result.status, 0) << walk.result.err;
  const nlohmann::json report = walk.json();
  for (const char* key :
       {"scene", "triangles", "mode", "radius", "height", "outcome", "length_m", "steps", "simulated_s", "step_ns",
        "least_clearance_m", "violations", "throttled", "blocked_at", "events"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report["triangles"], 12);
  EXPECT_EQ(report["mode"], "walk");
  EXPECT_EQ(report["radius"], 0.3);
  EXPECT_EQ(report["height"], 1.8);
  EXPECT_EQ(report["outcome"], "reached");
  EXPECT_NEAR(report["length_m"].get<double>(), 16.0, 0.1);
  EXPECT_NEAR(report["simulated_s"].get<double>(), 16.0 / 1.4, 0.1);
  EXPECT_GE(report["least_clearance_m"].get<double>(), 0.3 - 1e-6);
  EXPECT_EQ(report["violations"], 0);
  EXPECT_EQ(report["verified"]["overstated_clearances"], 0);
  EXPECT_TRUE(report["blocked_at"].is_null());
  EXPECT_GT(report["step_ns"]["median"].get<double>(), 0.0);
  EXPECT_GE(report["step_ns"]["max"], report["step_ns"]["p99"]);
}

TEST(WalkVerb, RefusesWhatWouldNeverEnd) {
  const Walk far(room_obj(), "2 0 1\n1e300 0 1\n", {"--mode", "fly"});
  EXPECT_EQ(far.result.status, 1);
  EXPECT_TRUE(contains(far.result.err, ":2: '1e300' is beyond 1e9")) << far.result.err;
  const std::string body = "# roam: mode walk radius 1e-09 height 2e-09 eye 0 step 0 slope 45\n";
  const Walk recorded(room_obj(), body + "2 0 1\n3 0 1\n");
  EXPECT_EQ(recorded.result.status, 1);
  EXPECT_TRUE(contains(recorded.result.err, ":1: the walker's radius is 1e-09 m; it must be at least 0.001"))
      << recorded.result.err;
  const Walk tiny(room_obj(), "2 0 1\n3 0 1\n", {"--radius", "5e-324"});
  EXPECT_EQ(tiny.result.status, 2);
  EXPECT_TRUE(contains(tiny.result.err, "it must be at least 0.001")) << tiny.result.err;
  for (const char* dt : {"1e-300", "nan", "0", "-1", "inf"}) {
    const Walk walk(room_obj(), "2 0 1\n3 0 1\n", {std::string("--dt=") + dt});
    EXPECT_EQ(walk.result.status, 2) << dt;
    EXPECT_TRUE(contains(walk.result.err, "--dt")) << walk.result.err;
  }
}

TEST(WalkVerb, VerifiesOnDemand) {
  const Walk walk(room_obj(), "2 0 0.4\n4 0 0.4\n", {"--json"});
  EXPECT_TRUE(walk.json()["violations"].is_null());  // not asked to --verify
}

TEST(WalkVerb, NamesTheWallThatBlocks) {
  const Walk walk(room_obj(), "2 0 1.5\n25 0 1.5\n", {"--mode", "fly", "--json", "--verify"});
  EXPECT_EQ(walk.result.status, 3) << walk.result.err;
  const nlohmann::json report = walk.json();
  EXPECT_EQ(report["outcome"], "blocked");
  EXPECT_EQ(report["blocked_at"]["object"], "front");
  EXPECT_NEAR(report["blocked_at"]["point"][0].get<double>(), 20.0, 1e-2);
  EXPECT_NEAR(report["blocked_at"]["normal"][0].get<double>(), -1.0, 1e-6);
  EXPECT_TRUE(report["blocked_at"].contains("triangle"));
  EXPECT_TRUE(report["blocked_at"]["opening_m"].is_null());
  EXPECT_EQ(report["violations"], 0);
}

// The first word is the answer; programmers' figures come with --stats.
TEST(WalkVerb, AnswersFirstAndKeepsFiguresForStats) {
  const Walk stopped(room_obj(), "2 0 1.5\n25 0 1.5\n", {"--mode", "fly", "--verify"});
  EXPECT_EQ(stopped.result.status, 3);
  EXPECT_TRUE(stopped.result.out.starts_with("NOT REACHED: blocked by \"front\"")) << stopped.result.out;
  EXPECT_TRUE(contains(stopped.result.out, "  checked ")) << stopped.result.out;
  const Walk reached(room_obj(), "2 0 1.5\n5 0 1.5\n");
  EXPECT_TRUE(reached.result.out.starts_with("REACHED: 2 of 2 waypoints")) << reached.result.out;
  EXPECT_FALSE(contains(reached.result.out, "time of a step")) << reached.result.out;
  const Walk stats(room_obj(), "2 0 1.5\n5 0 1.5\n", {"--stats"});
  EXPECT_TRUE(stats.result.out.starts_with(reached.result.out)) << stats.result.out;
  EXPECT_TRUE(contains(stats.result.out, "time of a step")) << stats.result.out;
}

TEST(WalkVerb, GivesTheTightestPlaceAndTheHeadroom) {
  const Walk walk(room_obj(), "2 0 0.3\n10 0 0.3\n", {"--json", "--radius", "0.4"});
  const nlohmann::json report = walk.json();
  EXPECT_NEAR(report["narrowest"]["width_m"].get<double>(), 4.0, 0.01);
  EXPECT_NEAR(report["narrowest"]["spare_m"].get<double>(), 1.6, 0.01);
  EXPECT_NEAR(report["headroom"]["height_m"].get<double>(), 3.0, 0.01);
  EXPECT_EQ(report["ducked"], 0);
  EXPECT_EQ(report["measured_beside_m"], 12 * 0.4);
  for (const char* side : {"left", "right"}) {
    EXPECT_NEAR(std::abs(report["narrowest"][side]["point"][1].get<double>()), 2.0, 0.01);
    EXPECT_NE(report["narrowest"][side]["object"], "");
  }
  const Walk slim(room_obj(), "2 0 0.2\n10 0 0.2\n", {"--json", "--radius", "0.1"});
  EXPECT_TRUE(slim.json()["narrowest"].is_null());  // no wall within 1.2 m
}

TEST(WalkVerb, CrossesAGapThatTheRadiusBridgesAndFallsIntoAWiderOne) {
  const std::string path = "2 0 0.5\n12 0 0.5\n";
  const Walk bridged(gap_obj("5.5"), path, {"--radius", "0.5", "--json", "--verify"});
  EXPECT_EQ(bridged.json()["outcome"], "reached") << bridged.result.out;
  EXPECT_EQ(bridged.json()["violations"], 0);
  const Walk fell(gap_obj("6.5"), path, {"--radius", "0.5", "--json", "--verify"});
  EXPECT_EQ(fell.result.status, 3);
  EXPECT_EQ(fell.json()["outcome"], "fell") << fell.result.out;
  EXPECT_EQ(fell.json()["violations"], 0);
}

TEST(WalkVerb, SaysThatARampIsTooSteepAndAdvisesNoLargerRadius) {
  const auto why = [](double degrees) {
    const double foot = -6.0 * std::tan(degrees * std::numbers::pi / 180.0);
    std::ostringstream scene, path;
    scene << "v -4 -4 0\nv 0 -4 0\nv 0 4 0\nv -4 4 0\nv 6 -4 " << foot << "\nv 6 4 " << foot << "\nv 16 -4 " << foot
          << "\nv 16 4 " << foot << "\nf 1 2 3 4\nf 2 5 6 3\nf 5 7 8 6\n";
    path << "-2 0 0.9\n12 0 " << foot + 0.9 << '\n';
    const nlohmann::json report = Walk(scene.str(), path.str(), {"--json"}).json();
    return report["outcome"].get<std::string>() + ": " + report.value("why", "");
  };
  EXPECT_TRUE(contains(why(46.0), "fell: at (")) << why(46.0);
  EXPECT_TRUE(contains(why(46.0), "too steep to stand on: 46 degrees, more than 45; ")) << why(46.0);
  EXPECT_FALSE(contains(why(46.0), "a larger one may")) << why(46.0);
  EXPECT_TRUE(contains(why(44.0), "reached")) << why(44.0);
  // Where the ground ends, the advice is as before.
  EXPECT_TRUE(contains(why(89.0), "the ground ends, or has a crack")) << why(89.0);
}

TEST(WalkVerb, SaysThatAPathLeadsOutOfTheScene) {
  const Walk walk("v 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 3\n", "1 1 1\n1 1 -9\n", {"--mode", "fly", "--json"});
  EXPECT_EQ(walk.result.status, 3);
  EXPECT_EQ(walk.json()["outcome"], "blocked");
  const Walk out("v 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 3\n", "1 1 1\n1 1 2\n", {"--wander", "1", "--json"});
  EXPECT_EQ(out.result.status, 2);  // a path or no path, not both
}

TEST(WalkVerb, SaysWhatToDoAboutAStartInsideAWall) {
  const Walk walk(slot_obj(), "0 0 0.25\n5 0 0.25\n", {"--radius", "0.3", "--json"});
  EXPECT_EQ(walk.result.status, 3) << walk.result.out;
  const nlohmann::json report = walk.json();
  EXPECT_EQ(report["outcome"], "held");
  EXPECT_TRUE(contains(report["why"], "move the first waypoint")) << report["why"];
}

TEST(WalkVerb, TellsOfAStartFromWhichTheBodyWasFreed) {
  const Walk walk(room_obj(), "2 -1.8 0.3\n6 0 0.3\n", {"--json"});
  EXPECT_EQ(walk.result.status, 0) << walk.result.out;
  const nlohmann::json report = walk.json();
  bool freed = false;
  for (const auto& event : report["events"]) freed = freed || event["kind"] == "freed";
  EXPECT_TRUE(freed) << walk.result.out;
}

TEST(WalkVerb, PassesThroughWallsOnlyAsAGhost) {
  const Walk walk(room_obj(), "2 0 1.5\n25 0 1.5\n", {"--mode", "ghost", "--speed", "3", "--json"});
  EXPECT_EQ(walk.result.status, 0) << walk.result.err;
  EXPECT_EQ(walk.json()["outcome"], "reached");
  EXPECT_NEAR(walk.json()["length_m"].get<double>(), 23.0, 1e-9);
  EXPECT_NEAR(walk.json()["simulated_s"].get<double>(), 23.0 / 3.0, 1e-9);
}

TEST(WalkVerb, WandersWhereThereIsNoPath) {
  const TestFolder folder;
  const std::vector<std::string> arguments{
      "walk", folder.write("room.obj", room_obj()), "--wander", "30", "--height", "1.8", "--verify", "--json"};
  const ProgramResult result = run_program(ROAM_PROGRAM, arguments);
  EXPECT_EQ(result.status, 0) << result.err << result.out;
  const auto report = nlohmann::json::parse(result.out, nullptr, false);
  EXPECT_EQ(report["outcome"], "reached");
  EXPECT_EQ(report["violations"], 0);
  EXPECT_GT(report["length_m"].get<double>(), 15.0);  // of 42 m when it never turned
  EXPECT_NEAR(report["simulated_s"].get<double>(), 30.0, 0.02);
  // Inside, not on the roof.
  EXPECT_LT(report["end"]["position"][2].get<double>(), 3.0);
  EXPECT_GT(report["end"]["eye"][2].get<double>(), 1.5);
}

TEST(WalkVerb, WandersFromWhereItIsTold) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", room_obj());
  const ProgramResult result = run_program(
      ROAM_PROGRAM, {"walk", scene, "--wander", "1", "--from", "3,1,0.5", "--json", "--trace", folder.file("t.csv")});
  EXPECT_EQ(result.status, 0) << result.err;
  double x = 0, y = 0;
  const std::string trace = folder.read("t.csv");
  ASSERT_EQ(std::sscanf(trace.substr(trace.find('\n') + 1).c_str(), "0,0,%lf,%lf", &x, &y), 2) << trace;
  EXPECT_EQ(x, 3.0);
  EXPECT_EQ(y, 1.0);
  EXPECT_EQ(run_program(ROAM_PROGRAM, {"walk", scene, "--path", "p.path", "--from", "3,1,0.5"}).status, 2);
}

TEST(WalkVerb, WritesAllThatItHasWhenItIsInterrupted) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", room_obj());
  const std::string trace = folder.file("t.csv"), picture = folder.file("way.svg");
  const ProgramResult result = interrupted_walk(
      ROAM_PROGRAM, {"walk", scene, "--wander", "1e9", "--trace", trace, "--picture", picture, "--json"});
  EXPECT_EQ(result.status, 130) << result.err;
  const auto report = nlohmann::json::parse(result.out, nullptr, false);
  ASSERT_TRUE(report.is_object()) << result.out << result.err;
  EXPECT_EQ(report["interrupted"], true);
  EXPECT_EQ(report["outcome"], "interrupted");
  EXPECT_GT(report["length_m"], 0.0);
  EXPECT_LE(report["length_m"].get<double>(), 1.4 * report["simulated_s"].get<double>() + 0.1);
  // The last row is that of the last step.
  const std::string rows = folder.read("t.csv");
  const std::string last = rows.substr(rows.rfind('\n', rows.size() - 2) + 1);
  EXPECT_EQ(std::stoll(last), report["steps"]) << last;
  EXPECT_TRUE(folder.read("way.svg").ends_with("</svg>\n")) << result.err;

  const ProgramResult words = interrupted_walk(ROAM_PROGRAM, {"walk", scene, "--wander", "1e9"});
  EXPECT_EQ(words.status, 130);
  EXPECT_TRUE(words.out.starts_with("INTERRUPTED after ")) << words.out;
  EXPECT_FALSE(contains(words.out, "reached")) << words.out;
}

TEST(WalkVerb, IsNotMarkedAsInterruptedWhenItEndsByItself) {
  const Walk walk(room_obj(), "2 0 0.9\n18 0 0.9\n", {"--height", "1.8", "--json"});
  EXPECT_EQ(walk.json()["interrupted"], false);
}

TEST(WalkVerb, IsHeldWhereItsTimeEndsWhileItIsHeld) {
  // Between two floors: it falls out of the scene, and is put back over nothing.
  for (const char* seconds : {"2", "5"}) {
    const TestFolder folder;
    const ProgramResult result = run_program(ROAM_PROGRAM, {"walk", folder.write("ledge.obj", ledge_obj()), "--wander",
                                                            seconds, "--from", "7,0,1", "--json", "--verify"});
    EXPECT_EQ(result.status, 3) << result.out;
    const auto report = nlohmann::json::parse(result.out, nullptr, false);
    EXPECT_EQ(report["outcome"], "held") << seconds;
    EXPECT_TRUE(contains(report["why"], "no ground below to stand on; start elsewhere (--from)")) << report["why"];
    EXPECT_EQ(report["events"].back()["kind"], "held");
    // It fits where it is held, and was never near anything.
    EXPECT_GE(report["least_gap_m"].get<double>(), 0.75);
    EXPECT_EQ(report["violations"], 0);
    EXPECT_EQ(report["verified"]["overstated_clearances"], 0);
  }
}

TEST(WalkVerb, KnowsNoClearanceOfABodyThatFitsNowhere) {
  const TestFolder folder;
  const std::vector<std::string> arguments{
      "walk", folder.write("slot.obj", slot_obj()), "--wander", "5", "--from", "0,0,0.25", "--radius", "0.3"};
  const ProgramResult told = run_program(ROAM_PROGRAM, arguments);
  EXPECT_EQ(told.status, 3) << told.out;
  EXPECT_FALSE(contains(told.out, "certified")) << told.out;
  std::vector<std::string> in_json = arguments;
  in_json.insert(in_json.end(), {"--json", "--verify"});
  const auto report = nlohmann::json::parse(run_program(ROAM_PROGRAM, in_json).out, nullptr, false);
  EXPECT_TRUE(report["least_clearance_m"].is_null());
  EXPECT_TRUE(report["least_gap_m"].is_null());
  EXPECT_EQ(report["violations"], 0);  // it has not moved
}

TEST(WalkVerb, CapsTheLeastClearanceAtTheReach) {
  const auto fly = [](const std::string& z) {
    return Walk(slot_obj(), "3 0 " + z + "\n6 0 " + z + "\n", {"--mode", "fly", "--json"}).json();
  };
  const nlohmann::json far = fly("3"), near = fly("1.3");  // half a metre above the upper floor
  EXPECT_EQ(far["clearance_reach_m"], 1.0);
  EXPECT_GE(far["least_gap_m"].get<double>(), 0.7);
  EXPECT_LE(far["least_gap_m"].get<double>(), 1.0);
  EXPECT_LT(near["least_gap_m"].get<double>(), 0.55);
}

TEST(WalkVerb, SaysWhereTheSceneIsWhenItStartsOutside) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", room_obj());
  const ProgramResult result = run_program(ROAM_PROGRAM, {"walk", scene, "--wander", "3", "--from", "900,0,0"});
  EXPECT_EQ(result.status, 3);
  EXPECT_TRUE(result.out.starts_with("STOPPED: starts outside the scene")) << result.out;
}

TEST(WalkVerb, NotesThatTheBodyIsLargerThanTheScene) {
  const auto notes = [](const std::string& radius, const std::string& height) {
    return Walk(room_obj(), "2 0 50\n3 0 50\n", {"--mode", "fly", "--radius", radius, "--height", height}).result.err;
  };
  EXPECT_TRUE(contains(notes("10.1", "20.2"),
                       "roam: note: the body, 20.2 m across and 20.2 m high, is larger than the "
                       "scene, 20 x 4 x 3 m"))
      << notes("10.1", "20.2");
  EXPECT_TRUE(contains(notes("0.3", "20.1"), "larger than the scene"));
  EXPECT_EQ(notes("0.3", "19.9"), "");
}

TEST(WalkVerb, SaysWhenTheBodyFitsNowhere) {
  const TestFolder folder;
  const std::string scene = folder.write("spike.obj", "v 0 0 0\nv 0 1 9\nv 0 2 0\nf 1 2 3\n");
  const ProgramResult result = run_program(ROAM_PROGRAM, {"walk", scene, "--wander", "5"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, "--up")) << result.err;
}

TEST(WalkVerb, NamesTheLineOfThePathThatCannotBeRead) {
  const Walk walk(room_obj(), "2 0 0.9\n# then\n18 zero 0.9\n");
  EXPECT_EQ(walk.result.status, 1);
  EXPECT_TRUE(contains(walk.result.err, "p.path:3: 'zero' is no number")) << walk.result.err;
}

/// A row of a trace: its fields as they stand.
std::vector<std::string> fields(const std::string& row) {
  std::vector<std::string> result;
  std::istringstream in(row);
  for (std::string field; std::getline(in, field, ',');) result.push_back(field);
  return result;
}

TEST(WalkVerb, TracesEveryStep) {
  TestFolder folder;
  const std::string scene = folder.write("scene.obj", room_obj());
  const std::string path = folder.write("p.path", "2 0 0.9\n6 1 0.9\n19 3 0.9\n");
  const ProgramResult result = run_program(
      ROAM_PROGRAM, {"walk", scene, "--path", path, "--height", "1.8", "--trace", folder.file("t.csv"), "--json"});
  const auto report = nlohmann::json::parse(result.out, nullptr, false);
  std::istringstream trace(folder.read("t.csv"));
  std::string row;
  ASSERT_TRUE(std::getline(trace, row));
  EXPECT_EQ(row, "step,t,x,y,z,radius,height,clearance,contacts,event,teleport");
  long long last_step = -1;
  double last_time = 0.0;
  double last_x = 2.0;
  bool slid = false;
  while (std::getline(trace, row)) {
    if (row.back() == ',') row += ' ';
    const auto f = fields(row);
    ASSERT_EQ(f.size(), 11u) << row;
    const long long step = std::stoll(f[0]);
    EXPECT_TRUE(step == last_step || step == last_step + 1) << row;
    const double t = std::stod(f[1]);
    EXPECT_GE(t, last_time) << row;
    const double x = std::stod(f[2]);
    if (f[10] == "0") {
      EXPECT_LE(std::abs(x - last_x), 1.4 / 60 + 1e-9) << row;
    }
    EXPECT_EQ(std::stod(f[5]), 0.3);
    EXPECT_EQ(std::stod(f[6]), 1.8);
    EXPECT_GE(std::stod(f[7]), 0.3 - 1e-6) << row;
    slid = slid || contains(f[9], "slid");
    last_step = step;
    last_time = t;
    last_x = x;
  }
  EXPECT_EQ(last_step, report["steps"].get<long long>());
  EXPECT_NEAR(last_time, report["simulated_s"].get<double>(), 1e-9);
  EXPECT_NEAR(last_x, report["end"]["position"][0].get<double>(), 0.0);
  EXPECT_TRUE(slid);  // along the left wall, where the last waypoint lies behind it
}

TEST(WalkVerb, SaysThatTheTraceCannotBeWritten) {
  const Walk walk(room_obj(), "2 0 0.9\n3 0 0.9\n", {"--trace", "/no/such/folder/t.csv"});
  EXPECT_EQ(walk.result.status, 2);
  EXPECT_TRUE(contains(walk.result.err, "/no/such/folder/t.csv")) << walk.result.err;
}

TEST(WalkVerb, GivesTheSameBitsEveryTime) {
  const auto trace = [](const std::string& threads) {
    const TestFolder folder;
    run_program(ROAM_PROGRAM, {"walk", folder.write("room.obj", room_obj()), "--wander", "10", "--threads", threads,
                               "--trace", folder.file("t.csv")});
    return folder.read("t.csv");
  };
  const std::string once = trace("1");
  EXPECT_GT(once.size(), 10'000u);
  EXPECT_EQ(once, trace("2"));
}

}  // namespace
