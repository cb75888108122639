// The frame of a scene, in reports, stores, paths and profiles.
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>

#include "door_rooms.h"
#include "messages.h"
#include "program.h"

namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

/// The room of door_obj as a file whose -y is up: (x, y, z) is written as (x, -z, y).
std::string turned_room() {
  std::istringstream in(door_obj(0.9));
  std::string text;
  for (std::string line; std::getline(in, line);) {
    double x = 0.0, y = 0.0, z = 0.0;
    if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3) {
      line = "v " + std::to_string(x) + " " + std::to_string(-z) + " " + std::to_string(y);
    }
    text += line + "\n";
  }
  return text;
}

class Frame : public testing::Test {
 protected:
  TestFolder folder;
  std::string scene = folder.write("room.obj", turned_room());
  std::string path = folder.write("p.path", "2 0 1\n6 0 1\n");

  void SetUp() override { setenv("XDG_CONFIG_HOME", folder.file("none").c_str(), 1); }

  [[nodiscard]] ProgramResult run(Words words, const Words& more = {}) const {
    words.insert(words.end(), more.begin(), more.end());
    return run_program(ROAM_PROGRAM, words);
  }
  [[nodiscard]] Json report(const Words& words, const Words& more = {}) const {
    const ProgramResult result = run(words, more);
    EXPECT_TRUE(result.status == 0 || result.status == 3) << result.err;
    return Json::parse(result.out, nullptr, false);
  }
};

TEST_F(Frame, IsInTheReportOfEveryVerb) {
  const std::string store = folder.file("room.roam");
  const Json frame = report({"info", scene, "--up=-y", "--unit", "cm", "--json"})["frame"];
  EXPECT_EQ(frame["up"], "-y");
  EXPECT_EQ(frame["unit"], "cm");
  EXPECT_EQ(frame["matrix"], Json::parse("[[100, 0, 0, 0], [0, 0, -100, 0], [0, 100, 0, 0], [0, 0, 0, 1]]"));
  const Words upright{"--up=-y", "--json"};
  const Json expected = report({"info", scene}, upright)["frame"];
  EXPECT_EQ(expected["up"], "-y");
  const std::string certificate = folder.file("certificate");
  EXPECT_EQ(report({"walk", scene, "--path", path, "--certify", certificate}, upright)["frame"], expected);
  EXPECT_EQ(report({"check", certificate, scene}, upright)["frame"], expected);
  EXPECT_EQ(report({"probe", scene, "--from", "2,0,1", "--to", "8,0,1"}, upright)["frame"], expected);
  EXPECT_EQ(report({"train", scene, "--no-profile", "--spacing", "0.4"}, upright)["frame"], expected);
  EXPECT_EQ(report({"view", scene, "--headless", "--size", "160x120", "--time", "0.1"}, upright)["frame"], expected);
  EXPECT_EQ(report({"build", scene, "-o", store}, upright)["frame"], expected);
  EXPECT_EQ(report({"walk", store, "--path", path, "--json"})["frame"], expected) << "as it was built";
  EXPECT_EQ(report({"info", store, "--json"})["frame"], expected);
  EXPECT_EQ(report({"info", scene, "--json"})["frame"]["up"], "z");
}

TEST_F(Frame, OfAPathIsKeptAndDemanded) {
  const std::string way = folder.file("way.path"), store = folder.file("room.roam");
  ASSERT_EQ(run({"probe", scene, "--up=-y", "--from", "2,0,1", "--to", "18,0,1", "--path", way}).status, 0);
  EXPECT_TRUE(contains(folder.read("way.path"), "# roam: frame up -y unit m\n")) << folder.read("way.path");
  EXPECT_EQ(report({"walk", scene, "--up=-y", "--path", way, "--json"})["outcome"], "reached");
  for (const char* verb : {"walk", "view"}) {
    const ProgramResult other = run({verb, scene, "--path", way});
    EXPECT_EQ(other.status, 1) << verb;
    EXPECT_TRUE(contains(other.err, way + ": its places are of the scene with --up=-y, which is read with --up=z here: "
                                          "use --up=-y, or record the path again"))
        << other.err;
  }
  const ProgramResult unit = run({"walk", scene, "--up=-y", "--unit=ft", "--path", way});
  EXPECT_TRUE(contains(unit.err, "use --up=-y --unit=m, or record the path again")) << unit.err;
  ASSERT_EQ(run({"build", scene, "-o", store}).status, 0);
  const ProgramResult stored = run({"walk", store, "--path", way});
  EXPECT_EQ(stored.status, 1);
  EXPECT_TRUE(contains(stored.err, "this store was built with --up=z")) << stored.err;
}

TEST_F(Frame, OfATrainedBodyHoldsForEveryVerb) {
  ASSERT_EQ(run({"train", scene, "--up=-y", "--spacing", "0.4"}).status, 0);
  const std::string file = scene + ".roam.json";
  EXPECT_EQ(Json::parse(folder.read("room.obj.roam.json"))["frame"]["up"], "-y");
  const ProgramResult walked = run({"walk", scene, "--path", path});
  EXPECT_EQ(walked.status, 0) << walked.err;
  EXPECT_TRUE(contains(walked.err, "note: " + scene + " is read with --up=-y, as " + file + " says")) << walked.err;
  EXPECT_TRUE(contains(walked.out, "  frame       --up=-y, from " + file)) << walked.out;
  const auto up = [&](const Words& words) { return report(words, {"--json"})["frame"]["up"]; };
  const std::string store = folder.file("room.roam");
  EXPECT_EQ(up({"walk", scene, "--path", path}), "-y");
  EXPECT_EQ(up({"view", scene, "--headless", "--size", "160x120", "--time", "0.1"}), "-y");
  EXPECT_EQ(up({"probe", scene, "--from", "2,0,1", "--to", "8,0,1"}), "-y");
  EXPECT_EQ(up({"train", scene, "--spacing", "0.4", "-o", folder.file("p.json")}), "-y");
  EXPECT_EQ(up({"info", scene}), "-y");
  EXPECT_EQ(up({"build", scene, "-o", store}), "-y");
  EXPECT_EQ(up({"info", store}), "-y");
  const ProgramResult swept = run_program(ROAM_PROGRAM, {"sweep", scene}, {.input = "5,0,1,0,0,-5,0.3\n"});
  EXPECT_TRUE(contains(swept.out, "\n1,")) << "the floor is below: " << swept.out;
  // Options say otherwise.
  EXPECT_EQ(up({"info", scene, "--no-profile"}), "z");
  EXPECT_EQ(up({"info", scene, "--up=y"}), "y");
  EXPECT_EQ(up({"info", scene, "--unit=cm"}), "z");
}

TEST_F(Frame, MayBeKeptWithoutABody) {
  (void)folder.write("room.obj.roam.json", R"({"roam_profile": 1, "frame": {"up": "-y", "unit": "m"}})");
  const Json walked = report({"walk", scene, "--path", path, "--json"});
  EXPECT_EQ(walked["frame"]["up"], "-y");
  EXPECT_EQ(walked["height"], 1.8);
  EXPECT_TRUE(walked["profile"].is_null());
  (void)folder.write("room.obj.roam.json", R"({"roam_profile": 1, "frame": {"up": "w", "unit": "m"}})");
  const ProgramResult wrong = run({"info", scene});
  EXPECT_EQ(wrong.status, 1);
  EXPECT_TRUE(contains(wrong.err, "\"frame.up\" 'w' is no axis") && contains(wrong.err, "--no-profile")) << wrong.err;
}

TEST_F(Frame, OfASceneIsThatOfTheSameSceneOfAgainst) {
  const Json walked = report({"walk", scene, "--path", path, "--up=-y", "--against", scene, "--json"});
  EXPECT_EQ(walked["frame"]["up"], "-y");
  EXPECT_EQ(walked["outcome"], "reached");
  EXPECT_EQ(walked["violations"], 0);
}

TEST_F(Frame, OfASceneOutOfReachIsNotWhatIsNamed) {
  const std::string name = folder.file(std::string(300, 'x'));
  const ProgramResult result = run({"info", name});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, name + ": cannot be looked at: File name too long")) << result.err;
}

}  // namespace
