// What roam probe promises of its report, its table and its exit statuses.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "door_rooms.h"
#include "messages.h"
#include "program.h"
#include "roam/profile.h"

namespace {

using Json = nlohmann::json;

std::vector<std::string> question(const std::string& scene, const std::string& from,
                                  const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"probe", scene, "--from", from, "--to", "18,-0.4,1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}
ProgramResult ask(const std::string& scene, const std::string& from, const std::vector<std::string>& more) {
  return run_program(ROAM_PROGRAM, question(scene, from, more));
}
const std::vector<std::string> of_a_size{
    "scene",  "triangles",      "mode",     "from",        "to",          "step",     "slope",  "spacing",
    "radius", "height",         "passable", "wide_enough", "clearance_m", "limited",  "start",  "target",
    "way",    "length_m",       "opening",  "proven",      "bound_m",     "complete", "places", "walked",
    "answer", "support_radius", "steepest", "narrower",    "text",        "frame",    "drops",  "passing_m",
    "marks",  "other"};

TEST(ProbeReport, HasEveryMemberWhateverTheAnswer) {
  const TestFolder folder;
  const std::string open = folder.write("open.obj", door_obj(0.84)), closed = folder.write("closed.obj", door_obj(0.0));
  for (const std::string& scene : {open, closed}) {
    for (const char* mode : {"walk", "fly"}) {
      const ProgramResult result = ask(scene, "2,0.3,1", {"--radius", "0.3", "--sphere", "--mode", mode, "--json"});
      EXPECT_EQ(result.status, scene == open ? 0 : 3) << result.err;
      const Json report = Json::parse(result.out, nullptr, false);
      for (const std::string& member : of_a_size) EXPECT_TRUE(report.contains(member)) << member;
      for (const char* member : {"roam", "schema"}) EXPECT_TRUE(report.contains(member)) << member;
      EXPECT_EQ(report.size(), of_a_size.size() + 2) << "a member that is not documented";
      EXPECT_EQ(report["walked"].is_null(), scene == closed);
      EXPECT_EQ(report["complete"], true);
    }
  }
  const Json sizes = Json::parse(ask(open, "2,0.3,1", {"--matrix", "0.3,0.5", "--json"}).out, nullptr, false)["sizes"];
  ASSERT_EQ(sizes.size(), 2u);
  EXPECT_FALSE(sizes[0].contains("way") || sizes[0].contains("length_m"));
}

TEST(ProbeReport, NamesAStepDownThatLeadsOneWay) {
  const TestFolder folder;
  // A platform 0.45 m high from x = 0 to 10, and the floor beyond.
  const std::string scene =
      folder.write("platform.obj",
                   "v 0 -2 0.45\nv 10 -2 0.45\nv 10 2 0.45\nv 0 2 0.45\nv 10 -2 0\nv 20 -2 0\nv 20 2 0\nv 10 2 0\n"
                   "f 1 2 3 4\nf 5 6 7 8\nf 2 5 8 3\n");
  const std::string drawing = folder.file("drop.svg"), path = folder.file("drop.path");
  const ProgramResult down = ask(scene, "2,0,1", {"--step", "0.35", "--json", "--picture", drawing, "--path", path});
  EXPECT_EQ(down.status, 0) << down.err;
  const Json report = Json::parse(down.out, nullptr, false);
  ASSERT_EQ(report["drops"].size(), 1U) << report["answer"];
  EXPECT_NEAR(report["drops"][0]["down_m"].get<double>(), 0.45, 1e-3);
  EXPECT_NEAR(report["drops"][0]["point"][0].get<double>(), 10.0, 0.02);
  EXPECT_FALSE(folder.read("drop.svg").empty());
  EXPECT_TRUE(contains(report["marks"].dump(), "one way: down 0.450 m")) << report["marks"];
  const ProgramResult walk = run_program(ROAM_PROGRAM, {"walk", scene, "--path", path, "--verify"});
  EXPECT_EQ(walk.status, 0) << walk.out << walk.err;
  const ProgramResult up =
      run_program(ROAM_PROGRAM, {"probe", scene, "--from", "18,0,1", "--to", "2,0,1", "--step", "0.35", "--json"});
  EXPECT_EQ(up.status, 3) << up.err;
  const Json back = Json::parse(up.out, nullptr, false);
  EXPECT_EQ(back["drops"], Json::array());
  EXPECT_EQ(back["opening"]["kind"], "step");
}

TEST(ProbeReport, BoundsAndProvesWhatFlies) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", door_obj(0.5));
  const ProgramResult result = ask(scene, "2,0.3,1", {"--sphere", "--mode", "fly", "--json"});
  EXPECT_EQ(result.status, 3) << result.err;
  const Json report = Json::parse(result.out, nullptr, false);
  EXPECT_EQ(report["opening"]["kind"], "gap");
  EXPECT_NEAR(report["opening"]["missing_m"].get<double>(), 0.1, 1e-3);
  EXPECT_EQ(report["proven"], true);
  EXPECT_GE(report["bound_m"].get<double>(), report["clearance_m"].get<double>());
  EXPECT_LE(report["bound_m"].get<double>(), report["clearance_m"].get<double>() + 5e-3);
  EXPECT_TRUE(contains(report["answer"], "it is proven that nothing wider than 0.5")) << report["answer"];
}

TEST(ProbeReport, ListsSizesInTheirOrder) {
  const TestFolder folder;
  const ProgramResult result = ask(folder.write("room.obj", door_obj(0.7)), "2,0.3,1", {"--matrix", "0.4x1.8,0.3x1.8"});
  EXPECT_EQ(result.status, 3) << result.err;
  const std::size_t first = result.out.find("0.400 m"), second = result.out.find("0.300 m");
  ASSERT_TRUE(first != std::string::npos && second != std::string::npos) << result.out;
  EXPECT_LT(first, second);
  EXPECT_TRUE(contains(result.out.substr(first, second - first), " no ")) << result.out;
  EXPECT_TRUE(contains(result.out.substr(second), " yes ")) << result.out;
}

TEST(ProbeReport, SaysWhereAnEndWasMovedTo) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", door_obj(0.84));
  // On the outer wall, where nobody has room.
  const ProgramResult result = ask(scene, "2,1.99,1", {"--radius", "0.2", "--height", "1.8", "--json"});
  const Json report = Json::parse(result.out, nullptr, false);
  EXPECT_TRUE(contains(report["answer"], "m: there is no room at (2.00, 1.99, ")) << report["answer"];
  EXPECT_LT(report["start"][1].get<double>(), 1.99);
  EXPECT_GE(report["start"][1].get<double>(), -0.01);
}

TEST(ProbeReport, GivesTheFloorUnderAnEndBesideTheTypedPosition) {
  const TestFolder folder;
  const ProgramResult result = ask(folder.write("room.obj", door_obj(0.84)), "2,0,1.5", {"--radius", "0.3", "--json"});
  const Json report = Json::parse(result.out, nullptr, false);
  EXPECT_EQ(report["from"], (std::vector<double>{2.0, 0.0, 1.5}));
  EXPECT_NEAR(report["start"][2].get<double>(), 0.0, 1e-3);
  EXPECT_NEAR(report["target"][2].get<double>(), 0.0, 1e-3);
}

TEST(ProbeReport, SaysAtOnceThatAnEndLiesFarOffTheScene) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", door_obj(0.84));
  const ProgramResult far = ask(scene, "11000,0,1", {"--sphere", "--mode", "fly"});
  EXPECT_EQ(far.status, 1);
  EXPECT_TRUE(contains(far.err, "10980 m outside the scene") && contains(far.err, "at most 100 m outside")) << far.err;
  EXPECT_EQ(ask(scene, "2,0,60", {"--sphere", "--mode", "fly"}).status, 3) << "the room is closed";
}

TEST(ProbeReport, RefusesASpacingThatTheSceneIsTooSmallFor) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", door_obj(0.84));
  const ProgramResult refused = ask(scene, "2,0,1", {"--radius", "0.3", "--spacing", "100"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(contains(refused.err, "--spacing 100: the scene is 20 m long")) << refused.err;
  const ProgramResult warned = ask(scene, "2,0,1", {"--radius", "0.3", "--spacing", "2"});
  EXPECT_TRUE(contains(warned.err, "say --spacing 0.85 or less")) << warned.err;
  EXPECT_TRUE(ask(scene, "2,0,1", {"--radius", "0.3", "--spacing", "0.8"}).err.empty());
}

TEST(ProbeReport, RefusesAFileThatCannotBeWrittenBeforeAnyWork) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", door_obj(0.84));
  for (const char* option : {"--path", "--picture"}) {
    const ProgramResult result = ask(scene, "2,0,1", {"--radius", "0.3", option, folder.file("none/door.svg")});
    EXPECT_EQ(result.status, 2) << option;
    EXPECT_TRUE(contains(result.err, "door.svg: there is no folder")) << result.err;
    EXPECT_TRUE(result.out.empty()) << result.out;
  }
  const ProgramResult kept = ask(scene, "2,0,1", {"--radius", "0.3", "--path", roam::profile_path(scene).string()});
  EXPECT_EQ(kept.status, 2);
  EXPECT_TRUE(contains(kept.err, "this would overwrite the profile")) << kept.err;
}

TEST(ProbeReport, FailsWithStatusOneWhereAFileCannotBeReadOrWrittenAndTellsTheAnswer) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", door_obj(0.84));
  EXPECT_EQ(ask(folder.file("none.obj"), "2,0,1", {"--radius", "0.3"}).status, 1);
  const std::string written = folder.file("way.path");
  const ProgramResult path =
      run_without_files(ROAM_PROGRAM, question(scene, "2,0,1", {"--radius", "0.3", "--path", written}));
  EXPECT_EQ(path.status, 1);
  EXPECT_TRUE(contains(path.err, "cannot write " + written)) << path.err;
  EXPECT_TRUE(contains(path.out, "YES: ")) << path.out;
}

}  // namespace
