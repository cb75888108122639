// roam probe as a shell sees it.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "door_rooms.h"
#include "messages.h"
#include "program.h"

namespace {

using Json = nlohmann::json;

/// A room with a door, and what is asked of it: from one end to the other.
struct Probe {
  TestFolder folder;
  std::string scene;
  ProgramResult result;

  explicit Probe(double width) : scene(folder.write("room.obj", door_obj(width))) {}
  Probe& ask(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"probe", scene, "--from", "2,0.3,1", "--to", "18,-0.4,1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    result = run_program(ROAM_PROGRAM, arguments);
    return *this;
  }
  [[nodiscard]] Json json() const { return Json::parse(result.out, nullptr, false); }
};

TEST(ProbeVerb, SaysYesWithTheWayAndItsNarrowestPlace) {
  Probe probe(0.84);
  probe.ask({"--radius", "0.3", "--height", "1.8", "--json"});
  EXPECT_EQ(probe.result.status, 0) << probe.result.err;
  const Json report = probe.json();
  for (const char* key : {"scene", "triangles", "mode", "radius", "height", "passable", "clearance_m", "way",
                          "length_m", "opening", "proven", "answer"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report["passable"], true);
  EXPECT_EQ(report["triangles"], 18);
  EXPECT_EQ(report["mode"], "walk");
  EXPECT_EQ(report["height"], 1.8);
  EXPECT_NEAR(report["clearance_m"].get<double>(), 0.42, 5e-4);
  const Json& opening = report["opening"];
  EXPECT_NEAR(opening["width_m"].get<double>(), 0.84, 1e-3);
  EXPECT_EQ(opening["missing_m"], 0.0);
  EXPECT_EQ(opening["kind"], "door");
  EXPECT_NEAR(opening["point"][0].get<double>(), 10.0, 0.02);
  EXPECT_NEAR(opening["point"][1].get<double>(), 0.0, 0.02);
  EXPECT_NEAR(std::abs(opening["direction"][1].get<double>()), 1.0, 1e-3);
  const Json& way = report["way"];
  ASSERT_GE(way.size(), 2u);
  EXPECT_NEAR(way.front()[0].get<double>(), 2.0, 1e-6);
  EXPECT_NEAR(way.front()[2].get<double>(), 0.0, 1e-3);  // of the feet
  EXPECT_NEAR(way.back()[1].get<double>(), -0.4, 1e-6);
  EXPECT_NEAR(report["length_m"].get<double>(), 16.0, 1.5);
  EXPECT_EQ(report["walked"]["outcome"], "reached");
  EXPECT_TRUE(contains(report["answer"], "YES: a body 0.60 m wide and 1.80 m high gets from A to B."))
      << report["answer"];
  EXPECT_TRUE(contains(report["answer"], "Narrowest: door 0.840 m wide")) << report["answer"];
}

TEST(ProbeVerb, SaysNoAndWhatIsMissing) {
  Probe probe(0.52);
  probe.ask({"--radius", "0.3", "--height", "1.8", "--json"});
  EXPECT_EQ(probe.result.status, 3) << probe.result.err;
  const Json report = probe.json();
  EXPECT_EQ(report["passable"], false);
  EXPECT_NEAR(report["clearance_m"].get<double>(), 0.26, 5e-4);
  EXPECT_NEAR(report["opening"]["width_m"].get<double>(), 0.52, 1e-3);
  EXPECT_NEAR(report["opening"]["missing_m"].get<double>(), 0.08, 1e-3);
  EXPECT_TRUE(report["walked"].is_null());
  probe.ask({"--radius", "0.3", "--height", "1.8"});
  EXPECT_TRUE(probe.result.out.starts_with("NO: ")) << probe.result.out;
}

TEST(ProbeVerb, NamesTheObjectsBesideTheDoorAndListsNarrowPlaces) {
  Probe probe(0.84);
  const Json report = probe.ask({"--radius", "0.3", "--height", "1.8", "--narrower", "1", "--json"}).json();
  EXPECT_EQ(report["opening"]["objects"], (std::vector<std::string>{"wall", "wall"}));
  ASSERT_EQ(report["narrower"].size(), 1u) << report["narrower"];
  const Json& door = report["narrower"][0];
  EXPECT_NEAR(door["width_m"].get<double>(), 0.84, 0.002);
  EXPECT_NEAR(door["point"][0].get<double>(), 10.0, 0.3);
  EXPECT_EQ(door["objects"], (std::vector<std::string>{"wall", "wall"}));
  EXPECT_NEAR(report["steepest"]["degrees"].get<double>(), 0.0, 0.2);
  EXPECT_TRUE(probe.ask({"--radius", "0.3", "--narrower", "0.8", "--json"}).json()["narrower"].empty());
  EXPECT_TRUE(probe.ask({"--radius", "0.3", "--json"}).json()["narrower"].is_null());  // not asked for
  EXPECT_EQ(probe.ask({"--matrix", "0.3", "--narrower", "1"}).result.status, 2);
}

TEST(ProbeVerb, SaysNoWhereThereIsNoWay) {
  Probe probe(0.0);
  probe.ask({"--radius", "0.2", "--height", "1.8"});
  EXPECT_EQ(probe.result.status, 3) << probe.result.err;
  EXPECT_TRUE(probe.result.out.starts_with("NO: ")) << probe.result.out;
  EXPECT_EQ(probe.ask({"--radius", "0.2", "--json"}).json()["passable"], false);
}

TEST(ProbeVerb, WritesAPathThatIsWalkedWithoutAViolation) {
  Probe probe(0.7);
  const std::string path = probe.folder.file("way.path");
  for (const char* body : {"", "--height=1.7", "--mode=fly"}) {
    std::vector<std::string> options{"--radius", "0.31", "--path", path};
    if (*body != '\0') options.emplace_back(body);
    if (contains(body, "fly")) options.emplace_back("--sphere");
    ASSERT_EQ(probe.ask(options).result.status, 0) << probe.result.err << probe.result.out;
    const ProgramResult walked = run_program(ROAM_PROGRAM, {"walk", probe.scene, "--path", path, "--verify", "--json"});
    EXPECT_EQ(walked.status, 0) << walked.err << walked.out;
    const Json report = Json::parse(walked.out, nullptr, false);
    EXPECT_EQ(report["outcome"], "reached") << body;
    EXPECT_EQ(report["violations"], 0) << body;
    EXPECT_EQ(report["radius"], 0.31);  // the path says its body
    EXPECT_EQ(report["mode"], contains(body, "fly") ? "fly" : "walk");
    EXPECT_EQ(report["height"], contains(body, "1.7") ? 1.7 : contains(body, "fly") ? 0.62 : 1.8);
  }
}

TEST(ProbeVerb, SaysNoWhereTheBodyFallsIntoAGapOfAWayThatIsWideEnough) {
  const TestFolder folder;
  const std::string scene = folder.write("gap.obj", gap_obj("5.9"));
  const auto ask = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"probe",  scene,      "--from", "2,0,1",    "--to",
                                       "12,0,1", "--radius", "0.3",    "--height", "1.8"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(ROAM_PROGRAM, arguments);
  };
  const ProgramResult falls = ask({});
  EXPECT_EQ(falls.status, 3) << falls.err;
  EXPECT_TRUE(falls.out.starts_with("NO: ")) << falls.out;
  const Json report = Json::parse(ask({"--json"}).out, nullptr, false);
  EXPECT_EQ(report["passable"], false);
  EXPECT_EQ(report["wide_enough"], true);
  EXPECT_EQ(report["walked"]["outcome"], "fell");
  const ProgramResult table =
      run_program(ROAM_PROGRAM, {"probe", scene, "--from", "2,0,1", "--to", "12,0,1", "--matrix", "0.3x1.8,0.7x1.8"});
  EXPECT_EQ(table.status, 3);
  EXPECT_TRUE(contains(table.out, "walker fell at")) << table.out;
  const ProgramResult carried = ask({"--support-radius", "0.47"});
  EXPECT_EQ(carried.status, 0) << carried.out;
  EXPECT_TRUE(carried.out.starts_with("YES: ")) << carried.out;
}

TEST(ProbeVerb, FliesWhereAsked) {
  Probe probe(0.9);
  EXPECT_EQ(probe.ask({"--radius", "0.4", "--sphere", "--mode", "fly", "--json"}).result.status, 0) << probe.result.err;
  EXPECT_EQ(probe.json()["mode"], "fly");
  EXPECT_NEAR(probe.json()["clearance_m"].get<double>(), 0.45, 5e-3);
  EXPECT_EQ(probe.ask({"--radius", "0.5", "--sphere", "--mode", "fly"}).result.status, 3) << probe.result.err;
}

TEST(ProbeVerb, ListsNarrowPlacesForTheSphereThatPassesWhereALargerOneDoesNot) {
  const TestFolder folder;
  const std::string duct = folder.write("duct.obj",
                                        "v 0 -0.375 0\nv 10 -0.375 0\nv 10 0.375 0\nv 0 0.375 0\n"
                                        "v 0 -0.375 0.75\nv 10 -0.375 0.75\nv 10 0.375 0.75\nv 0 0.375 0.75\n"
                                        "f 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 4 3 7 8\nf 1 4 8 5\nf 2 6 7 3\n");
  const ProgramResult result =
      run_program(ROAM_PROGRAM, {"probe", duct, "--from", "1,0,0.375", "--to", "9,0,0.375", "--mode", "fly", "--sphere",
                                 "--radius", "0.5", "--narrower", "0.9", "--json"});
  EXPECT_EQ(result.status, 3) << result.err;
  const Json narrower = Json::parse(result.out, nullptr, false)["narrower"];
  ASSERT_EQ(narrower.size(), 1u) << result.out;
  EXPECT_NEAR(narrower[0]["width_m"].get<double>(), 0.75, 2e-3);
}

TEST(ProbeVerb, AnswersForManySizesInOneRun) {
  Probe probe(0.7);
  probe.ask({"--matrix", "0.3,0.3x1.7,\t0.4x1.8 0.34x2.05", "--json"});
  EXPECT_EQ(probe.result.status, 3) << probe.result.err;
  const Json sizes = probe.json()["sizes"];
  ASSERT_EQ(sizes.size(), 4u);
  const std::vector<bool> expected{true, true, false, true};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(sizes[i]["passable"], expected[i]) << i;
    EXPECT_NEAR(sizes[i]["clearance_m"].get<double>(), 0.35, 5e-4) << i;
  }
  EXPECT_EQ(sizes[0]["height"], 1.8);
  EXPECT_EQ(sizes[1]["height"], 1.7);
  EXPECT_NEAR(sizes[2]["opening"]["missing_m"].get<double>(), 0.1, 1e-3);
  const std::string file = probe.folder.write("sizes", "# a child\n0.2x1.2\n\n0.3, 0.33x1.9  # grown\n");
  probe.ask({"--matrix", file});
  EXPECT_EQ(probe.result.status, 0) << probe.result.err;
  EXPECT_EQ(std::count(probe.result.out.begin(), probe.result.out.end(), '\n'), 4);  // a head and three sizes
}

TEST(ProbeVerb, TakesANumberAsASizeThoughAFileHasItsName) {
  Probe probe(0.7);
  probe.folder.write("0.3", "no size\n");
  const ProgramResult result =
      run_program("/bin/sh", {"-c", "cd '" + probe.folder.file("") + "' && exec '" ROAM_PROGRAM "' probe '" +
                                        probe.scene + "' --from 2,0,1 --to 18,0,1 --matrix 0.3 --json"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(Json::parse(result.out, nullptr, false)["sizes"][0]["radius"], 0.3) << result.out;
}

TEST(ProbeVerb, DrawsTheOpening) {
  Probe probe(0.7);
  const std::string svg = probe.folder.file("door.svg"), png = probe.folder.file("door.png");
  EXPECT_EQ(probe.ask({"--radius", "0.3", "--height", "1.8", "--picture", svg}).result.status, 0) << probe.result.err;
  EXPECT_TRUE(contains(probe.folder.read("door.svg"), "<svg"));
  EXPECT_EQ(probe.ask({"--radius", "0.5", "--height", "1.8", "--picture", png}).result.status, 3) << probe.result.err;
  EXPECT_TRUE(probe.folder.read("door.png").starts_with("\x89PNG"));
}

TEST(ProbeVerb, AnswersAlikeForTheStoreOfTheScene) {
  Probe probe(0.7);
  const std::string store = probe.folder.file("room.roam");
  ASSERT_EQ(run_program(ROAM_PROGRAM, {"build", probe.scene, "-o", store}).status, 0);
  const ProgramResult result = run_program(ROAM_PROGRAM, {"probe", store, "--from", "2,0,1", "--to", "18,0,1",
                                                          "--radius", "0.3", "--height", "1.8", "--json"});
  EXPECT_EQ(result.status, 0) << result.err;
  const Json report = Json::parse(result.out, nullptr, false);
  EXPECT_EQ(report["triangles"], 18);
  EXPECT_NEAR(report["clearance_m"].get<double>(), 0.35, 2e-3);  // as stored
}

TEST(ProbeVerb, RefusesWhatCannotBeMeant) {
  Probe probe(0.7);
  const auto refused = [&](const std::vector<std::string>& options, const std::string& why) {
    EXPECT_EQ(probe.ask(options).result.status, 2) << why;
    EXPECT_TRUE(contains(probe.result.err, why)) << probe.result.err;
  };
  refused({"--radius", "0"}, "greater than 0");
  refused({"--radius", "0.3", "--height", "0.5"}, "height");
  refused({"--radius", "0.3", "--matrix", "0.3"}, "--matrix");
  refused({"--matrix", "0.3xx2"}, "'0.3xx2' is no size");
  refused({"--matrix", "sizes.txt"}, "there is no file \"sizes.txt\"");
  refused({"--matrix", probe.folder.file(".")}, "folder");
  refused({"--matrix", ""}, "--matrix \"\": there are no sizes in it");
  for (const char* sizes : {",", "0.3,", ",0.3", "0.3,,0.4"}) refused({"--matrix", sizes}, "a comma has no size");
  refused({"--matrix", "0.3,0.4x1.9,0.3x1.8"}, "it has the size 0.3x1.8 twice");
  refused({"--matrix", "nan"}, "radius");
  refused({"--matrix", "1e-300x1.8"}, "at least 0.001");
  refused({"--matrix", "0.3x0.1"}, "--matrix, size 0.3x0.1");
  refused({"--matrix", "0.3\t1.9"}, "a tab separates two numbers");
  refused({"--matrix", probe.folder.write("t.csv", "0.3\t1.9\n")}, "t.csv:1: a tab separates two numbers");
  refused({"--matrix", "0.3", "--picture", "p.svg"}, "--picture");
  refused({"--radius", "nan"}, "--radius");
  refused({"--radius", "-1"}, "--radius");
  refused({"--radius", "2000"}, "radius");
  refused({"--radius", "0.3", "--height", "inf"}, "--height");
  refused({"--radius", "0.3", "--step", "nan"}, "--step");
  refused({"--radius", "0.3", "--step", "-1"}, "--step");
  refused({"--radius", "0.3", "--step", "0.91"}, "--step 0.91: a body 1.8 m high steps up at most 0.9 m");
  refused({"--radius", "0.3", "--slope", "nan"}, "--slope");
  refused({"--radius", "0.3", "--slope", "90"}, "--slope");
  refused({"--radius", "0.3", "--spacing", "1e-9"}, "--spacing");
  refused({"--radius", "0.3", "--spacing", "5000"}, "--spacing");
  refused({"--radius", "0.3", "--support-radius", "-1"}, "--support-radius");
  refused({"--radius", "0.3", "--threads", "0"}, "--threads");
  refused({"--radius", "0.3", "--mode", "ghost"}, "--mode");
  refused({"--sphere", "--mode", "fly", "--step", "0.2"}, "--step, --slope and");
  refused({"--radius", "0.3", "--picture", ""}, "--picture");
  refused({"--radius", "0.3", "--path", ""}, "--path");
  refused({"--radius", "0.3", "--seed", "-1"}, "--seed");
  refused({"--matrix", "0.3", "--path", "p.path"}, "--path");
  refused({"--radius", "0.3", "--height", "1.8", "--mode", "fly"}, "sphere");
  refused({"--radius", "0.3", "--picture", "door.txt"}, "an .svg, a .png or a .dxf");
  refused({"--radius", "0.3", "--path", probe.scene}, "would overwrite");
  EXPECT_EQ(probe.ask({"--radius", "0.3", "--from", "2,0"}).result.status, 2);
  for (const char* place : {"nan,0,1", "inf,0,1", "1e300,0,1", "a,0,1", "1,2"}) {
    const ProgramResult result =
        run_program(ROAM_PROGRAM, {"probe", probe.scene, "--from", place, "--to", "18,0,1", "--radius", "0.3"});
    EXPECT_EQ(result.status, 2) << place;
    EXPECT_TRUE(contains(result.err, "--from")) << result.err;
  }
  EXPECT_EQ(probe.folder.read("room.obj"), door_obj(0.7));
}

TEST(ProbeVerb, TellsAnEndBesideAWallFromADoor) {
  Probe probe(0.84);
  // A wall 0.5 m from the one at y = 2, from x = 1 to 3.
  probe.folder.write("room.obj", door_obj(0.84) + "v 1 1.5 0\nv 3 1.5 0\nv 3 1.5 2\nv 1 1.5 2\nf -4 -3 -2 -1\n");
  const auto ask = [&](const char* from, const char* radius) {
    probe.result = run_program(ROAM_PROGRAM, {"probe", probe.scene, "--from", from, "--to", "18,0,1", "--radius",
                                              radius, "--height", "1.8", "--json"});
    return probe.json();
  };
  const Json no = ask("2,1.85,1", "0.3");
  EXPECT_EQ(probe.result.status, 3) << probe.result.err;
  const Json& end = no["opening"];
  EXPECT_EQ(end["kind"], "end");
  EXPECT_EQ(end["end"], "start");
  EXPECT_NEAR(end["distance_m"].get<double>(), 0.15, 1e-3);
  EXPECT_NEAR(end["missing_m"].get<double>(), 0.15, 1e-3);
  EXPECT_FALSE(end.contains("width_m"));
  EXPECT_NEAR(end["direction"][1].get<double>(), 1.0, 1e-6);
  EXPECT_TRUE(contains(no["answer"], "Why: no room at A: the body at (2.00, 1.85, 0.00) is 0.150 m from "))
      << no["answer"];
  EXPECT_TRUE(contains(no["answer"], ", 0.150 m too near; the nearest place with room is ")) << no["answer"];
  EXPECT_FALSE(contains(no["answer"], "door")) << no["answer"];
  const Json yes = ask("5,1.75,1", "0.2");
  EXPECT_EQ(probe.result.status, 0) << probe.result.err;
  EXPECT_EQ(yes["opening"]["kind"], "end");
  EXPECT_TRUE(contains(yes["answer"], "Narrowest: at A: the body at (5.00, 1.75, 0.00) is 0.250 m from "))
      << yes["answer"];
  // In the doorway, half way through: the door decides, not the end.
  const Json door = ask("10,0,1", "0.5");
  EXPECT_EQ(door["opening"]["kind"], "door") << door["answer"];
  EXPECT_NEAR(door["opening"]["width_m"].get<double>(), 0.84, 1e-3);
  // Beside one wall it is only moved.
  const Json moved = ask("5,1.93,1", "0.3");
  EXPECT_EQ(moved["passable"], true) << moved["answer"];
  EXPECT_TRUE(contains(moved["answer"], ", moved by 0.25 m: there is no room at (5.00, 1.93, 1.00)"))
      << moved["answer"];
}

TEST(ProbeVerb, TellsAWallBesideTheEndOfTheFloorFromADoor) {
  const TestFolder folder;
  // A wall along the floor from x = 8 to 12, 0.25 m from where it ends.
  const std::string scene =
      folder.write("edge.obj",
                   "v 0 -2 0\nv 20 -2 0\nv 20 2 0\nv 0 2 0\nv 8 1.75 0\nv 12 1.75 0\nv 12 1.75 3\n"
                   "v 8 1.75 3\nv 8 -2 0\nv 8 -2 3\no edge\nf 1 2 3 4\nf 5 6 7 8\nf 9 5 8 10\n");
  const ProgramResult result = run_program(ROAM_PROGRAM, {"probe", scene, "--from", "2,0,1", "--to", "18,0,1",
                                                          "--radius", "0.3", "--height", "1.8", "--json"});
  EXPECT_EQ(result.status, 3) << result.err;
  const Json report = Json::parse(result.out, nullptr, false);
  EXPECT_EQ(report["opening"]["kind"], "edge") << report["answer"];
  EXPECT_FALSE(report["opening"].contains("width_m"));
  EXPECT_GE(report["opening"]["distance_m"].get<double>(), 0.25 - 1e-3);  // where the walker may stand, or farther out
  EXPECT_TRUE(contains(report["answer"], "floor only 0.")) << report["answer"];
  EXPECT_TRUE(contains(report["answer"], "NO: ")) << report["answer"];
}

TEST(ProbeVerb, MeasuresTheHeightOfALintelThatStopsTheBody) {
  Probe probe(0.9);  // 2.1 m high
  probe.ask({"--radius", "0.3", "--height", "2.2", "--json"});
  EXPECT_EQ(probe.result.status, 3) << probe.result.err;
  const Json low = probe.json();
  EXPECT_EQ(low["opening"]["kind"], "height") << low["answer"];
  EXPECT_NEAR(low["opening"]["height_m"].get<double>(), 2.1, 1e-3);
  ASSERT_TRUE(low["opening"].contains("width_m")) << low["opening"];
  EXPECT_NEAR(low["opening"]["width_m"].get<double>(), 0.9, 1e-3);
  EXPECT_NEAR(low["opening"]["missing_m"].get<double>(), 0.1, 1e-3);
  EXPECT_NEAR(low["opening"]["point"][0].get<double>(), 10.0, 0.31);  // below the lintel, by the body's radius
  EXPECT_TRUE(contains(low["answer"], "Stopped by: headroom 2.100 m ")) << low["answer"];
  // A lower body that is as wide does not pass either.
  probe.ask({"--radius", "0.5", "--height", "2.2", "--json"});
  EXPECT_EQ(probe.json()["other"]["kind"], "door") << probe.result.out;
  probe.ask({"--radius", "0.5", "--height", "2.0", "--json"});
  EXPECT_EQ(probe.json()["opening"]["kind"], "door") << probe.result.out;
}

/// A floor with a ledge across it at x = 10, as high as said, under no ceiling.
std::string ledge_obj(const std::string& height) {
  return "v 0 -2 0\nv 10 -2 0\nv 10 2 0\nv 0 2 0\nv 10 -2 " + height + "\nv 20 -2 " + height + "\nv 20 2 " + height +
         "\nv 10 2 " + height + "\no ledge\nf 1 2 3 4\nf 5 6 7 8\nf 2 3 8 5\n";
}

TEST(ProbeVerb, MeasuresTheStepThatIsTooHigh) {
  const TestFolder folder;
  const std::string scene = folder.write("ledge.obj", ledge_obj("0.5"));
  const auto ask = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"probe",    scene, "--from",   "2,0,1", "--to",  "18,0,1.5",
                                       "--radius", "0.3", "--height", "1.8",   "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run_program(ROAM_PROGRAM, arguments);
    Json report = Json::parse(result.out, nullptr, false);
    report["status"] = result.status;
    return report;
  };
  const Json stopped = ask({});
  EXPECT_EQ(stopped["status"], 3);
  EXPECT_EQ(stopped["opening"]["kind"], "step") << stopped["answer"];
  EXPECT_NEAR(stopped["opening"]["step_m"].get<double>(), 0.5, 1e-3);
  EXPECT_NEAR(stopped["opening"]["missing_m"].get<double>(), 0.2, 1e-3);
  EXPECT_NEAR(stopped["opening"]["point"][0].get<double>(), 10.0, 0.02);
  EXPECT_EQ(ask({"--step", "0.55"})["opening"]["kind"].is_null(), true);
}

TEST(ProbeVerb, EndsClearlyWhereTheTargetIsOnAnotherFloor) {
  const TestFolder folder;
  std::string text = room_obj();
  text += "v 0 -2 3.3\nv 20 -2 3.3\nv 20 2 3.3\nv 0 2 3.3\no upper\nf 9 10 11 12\n";
  const std::string scene = folder.write("storeys.obj", text);
  const ProgramResult result = run_program(ROAM_PROGRAM, {"probe", scene, "--from", "2,0,1", "--to", "18,0,4",
                                                          "--radius", "0.3", "--height", "1.8", "--json"});
  EXPECT_EQ(result.status, 3) << result.err;
  const Json report = Json::parse(result.out, nullptr, false);
  EXPECT_TRUE(report["opening"].is_null());
  EXPECT_NEAR(report["target"][2].get<double>() - report["start"][2].get<double>(), 3.3, 0.01);
}

TEST(ProbeVerb, SaysWhyNobodyCanBeAtAnEndAndWhereOneCould) {
  Probe probe(0.7);
  const auto refused = [&](const std::string& from, const std::string& why) {
    const ProgramResult result = run_program(
        ROAM_PROGRAM, {"probe", probe.scene, "--from", from, "--to", "18,0,1", "--radius", "0.3", "--height", "1.8"});
    EXPECT_EQ(result.status, 1) << from;
    EXPECT_TRUE(contains(result.err, "--from (") && contains(result.err, why)) << result.err;
    EXPECT_TRUE(contains(result.err, "The nearest place found for a radius of 0.3 m is (")) << result.err;
  };
  refused("500,0,1", "off the scene, which spans (0.00, -2.00, 0.00) to (20.00, 2.00, 3.00)");
  refused("2,0,-4", "off the scene");
  // Over a hole.
  const std::string gap = probe.folder.write("gap.obj",
                                             "v 0 -2 0\nv 8 -2 0\nv 8 2 0\nv 0 2 0\nv 12 -2 0\nv 20 -2 0\n"
                                             "v 20 2 0\nv 12 2 0\no floors\nf 1 2 3 4\nf 5 6 7 8\n");
  const ProgramResult hole = run_program(
      ROAM_PROGRAM, {"probe", gap, "--from", "10,0,1", "--to", "18,0,1", "--radius", "0.3", "--height", "1.8"});
  EXPECT_EQ(hole.status, 1);
  EXPECT_TRUE(contains(hole.err, "off the scene") || contains(hole.err, "there is no floor below it")) << hole.err;
  EXPECT_TRUE(contains(hole.err, "The nearest place")) << hole.err;
  // High up it is taken down.
  const ProgramResult high = run_program(
      ROAM_PROGRAM, {"probe", gap, "--from", "2,0,9", "--to", "6,0,1", "--radius", "0.3", "--height", "1.8", "--json"});
  EXPECT_EQ(high.status, 0) << high.err;
  EXPECT_NEAR(Json::parse(high.out, nullptr, false)["start"][2].get<double>(), 0.0, 1e-3);
}

TEST(ProbeVerb, SaysThatAnEndIsTooLow) {
  Probe probe(0.7);
  const ProgramResult result = run_program(ROAM_PROGRAM, {"probe", probe.scene, "--from", "2,0,1", "--to", "18,0,1",
                                                          "--radius", "0.3", "--height", "3.2", "--json"});
  EXPECT_EQ(result.status, 3) << result.err;
  const Json report = Json::parse(result.out, nullptr, false);
  EXPECT_EQ(report["opening"]["kind"], "end");
  EXPECT_NEAR(report["opening"]["height_m"].get<double>(), 3.0, 1e-3);
  EXPECT_TRUE(contains(report["answer"], "Why: no room at A: the floor at (2.00, 0.00, 0.00) is 3.000 m below "))
      << report["answer"];
}

TEST(ProbeVerb, NamesAPlaceWhereNobodyFits) {
  Probe probe(0.7);
  const ProgramResult result =
      run_program(ROAM_PROGRAM, {"probe", probe.scene, "--from", "2,0,1", "--to", "500,0,1", "--radius", "0.3"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, "(500.00, 0.00, 1.00)")) << result.err;
}

}  // namespace
