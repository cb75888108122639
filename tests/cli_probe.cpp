// roam probe as a shell sees it.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "door_rooms.h"
#include "program.h"

namespace {

using Json = nlohmann::json;

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

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
  EXPECT_TRUE(contains(report["answer"], "Yes: a body of radius 0.3 m and height 1.8 m gets from")) << report["answer"];
  EXPECT_TRUE(contains(report["answer"], "0.840 m wide (door)")) << report["answer"];
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
  EXPECT_TRUE(contains(probe.result.out, "No: ") && contains(probe.result.out, "is 0.520 m wide; 0.080 m are missing"))
      << probe.result.out;
}

TEST(ProbeVerb, SaysNoWhereThereIsNoWay) {
  Probe probe(0.0);
  probe.ask({"--radius", "0.2", "--height", "1.8"});
  EXPECT_EQ(probe.result.status, 3) << probe.result.err;
  EXPECT_TRUE(contains(probe.result.out, "There is no way at all")) << probe.result.out;
  EXPECT_EQ(probe.ask({"--radius", "0.2", "--json"}).json()["passable"], false);
}

TEST(ProbeVerb, WritesAPathThatIsWalkedWithoutAViolation) {
  Probe probe(0.7);
  const std::string path = probe.folder.file("way.path");
  for (const char* body : {"", "--height=1.7", "--mode=fly"}) {
    std::vector<std::string> options{"--radius", "0.31", "--path", path};
    if (*body != '\0') options.emplace_back(body);
    ASSERT_EQ(probe.ask(options).result.status, 0) << probe.result.err << probe.result.out;
    const ProgramResult walked = run_program(ROAM_PROGRAM, {"walk", probe.scene, "--path", path, "--verify", "--json"});
    EXPECT_EQ(walked.status, 0) << walked.err << walked.out;
    const Json report = Json::parse(walked.out, nullptr, false);
    EXPECT_EQ(report["outcome"], "reached") << body;
    EXPECT_EQ(report["violations"], 0) << body;
    EXPECT_EQ(report["radius"], 0.31);  // the path says its body
    EXPECT_EQ(report["mode"], contains(body, "fly") ? "fly" : "walk");
    EXPECT_EQ(report["height"], contains(body, "1.7") ? 1.7 : 0.62);
  }
}

TEST(ProbeVerb, TellsOfAGapInTheFloorOfAWayThatIsWideEnough) {
  const TestFolder folder;
  const std::string scene = folder.write("gap.obj", gap_obj("5.9"));
  const ProgramResult result = run_program(
      ROAM_PROGRAM, {"probe", scene, "--from", "2,0,1", "--to", "12,0,1", "--radius", "0.3", "--height", "1.8"});
  EXPECT_EQ(result.status, 0) << result.err << result.out;
  EXPECT_TRUE(contains(result.out, "Yes: ") && contains(result.out, "the floor has a gap")) << result.out;
  const ProgramResult carried =
      run_program(ROAM_PROGRAM, {"probe", scene, "--from", "2,0,1", "--to", "12,0,1", "--radius", "0.3", "--height",
                                 "1.8", "--support-radius", "0.47"});
  EXPECT_FALSE(contains(carried.out, "gap")) << carried.out;
}

TEST(ProbeVerb, FliesWhereAsked) {
  Probe probe(0.9);
  EXPECT_EQ(probe.ask({"--radius", "0.4", "--mode", "fly", "--json"}).result.status, 0) << probe.result.err;
  EXPECT_EQ(probe.json()["mode"], "fly");
  EXPECT_NEAR(probe.json()["clearance_m"].get<double>(), 0.45, 5e-3);
  EXPECT_EQ(probe.ask({"--radius", "0.5", "--mode", "fly"}).result.status, 3) << probe.result.err;
}

TEST(ProbeVerb, AnswersForManySizesInOneRun) {
  Probe probe(0.7);
  probe.ask({"--matrix", "0.3,0.3x1.8,0.4x1.8 0.34x2.05", "--json"});
  EXPECT_EQ(probe.result.status, 3) << probe.result.err;
  const Json sizes = probe.json()["sizes"];
  ASSERT_EQ(sizes.size(), 4u);
  const std::vector<bool> expected{true, true, false, true};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(sizes[i]["passable"], expected[i]) << i;
    EXPECT_NEAR(sizes[i]["clearance_m"].get<double>(), 0.35, 5e-4) << i;
  }
  EXPECT_EQ(sizes[0]["height"], 0.6);
  EXPECT_EQ(sizes[1]["height"], 1.8);
  EXPECT_NEAR(sizes[2]["opening"]["missing_m"].get<double>(), 0.1, 1e-3);
  const std::string file = probe.folder.write("sizes", "# a child\n0.2x1.2\n\n0.3, 0.33x1.9  # grown\n");
  probe.ask({"--matrix", file});
  EXPECT_EQ(probe.result.status, 0) << probe.result.err;
  EXPECT_EQ(std::count(probe.result.out.begin(), probe.result.out.end(), '\n'), 4);  // a head and three sizes
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
  refused({}, "--radius");
  refused({"--radius", "0"}, "greater than 0");
  refused({"--radius", "0.3", "--height", "0.5"}, "height");
  refused({"--radius", "0.3", "--matrix", "0.3"}, "--matrix");
  refused({"--matrix", "0.3xx2"}, "'0.3xx2' is no size");
  refused({"--matrix", "0.3", "--path", "p.path"}, "--path");
  refused({"--radius", "0.3", "--height", "1.8", "--mode", "fly"}, "sphere");
  refused({"--radius", "0.3", "--picture", "door.txt"}, ".svg or a .png");
  refused({"--radius", "0.3", "--path", probe.scene}, "would overwrite");
  EXPECT_EQ(probe.ask({"--radius", "0.3", "--from", "2,0"}).result.status, 2);
  EXPECT_EQ(probe.folder.read("room.obj"), door_obj(0.7));
}

TEST(ProbeVerb, NamesAPlaceWhereNobodyFits) {
  Probe probe(0.7);
  const ProgramResult result =
      run_program(ROAM_PROGRAM, {"probe", probe.scene, "--from", "2,0,1", "--to", "500,0,1", "--radius", "0.3"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, "(500, 0, 1)")) << result.err;
}

}  // namespace
