// The ways that roam probe finds, as roam walk goes them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli_scenes.h"
#include "door_rooms.h"
#include "messages.h"
#include "program.h"

namespace {

using Json = nlohmann::json;

/// A floor under the sky, 20 m long in x and 4 m wide, with a wall across it at x = 10, 2 m high.
std::string yard_obj() {
  return "v 0 -2 0\nv 20 -2 0\nv 20 2 0\nv 0 2 0\nv 10 -2 0\nv 10 2 0\nv 10 2 2\nv 10 -2 2\n"
         "o floor\nf 1 2 3 4\no wall\nf 5 6 7 8\n";
}

TEST(ProbePath, FliesOverAWallUnderTheSkyAndIsFlownAgain) {
  const TestFolder folder;
  const std::string scene = folder.write("yard.obj", yard_obj()), path = folder.file("way.path");
  for (const char* radius : {"0.1", "0.3", "0.6"}) {
    const ProgramResult found =
        run_program(ROAM_PROGRAM, {"probe", scene, "--from", "8,0,1", "--to", "12,0,1", "--radius", radius, "--sphere",
                                   "--mode", "fly", "--path", path});
    EXPECT_EQ(found.status, 0) << found.out << found.err;
    EXPECT_TRUE(found.out.starts_with("YES: ")) << found.out;
    const ProgramResult flown = run_program(ROAM_PROGRAM, {"walk", scene, "--path", path, "--verify", "--json"});
    EXPECT_EQ(flown.status, 0) << flown.out << flown.err;
    const Json report = Json::parse(flown.out, nullptr, false);
    EXPECT_EQ(report["outcome"], "reached") << radius;
    EXPECT_EQ(report["violations"], 0) << radius;
  }
}

TEST(ProbePath, EndsAboveTheSceneWhereItIsAskedTo) {
  const TestFolder folder;
  const std::string scene = folder.write("yard.obj", yard_obj());
  const std::vector<std::string> question{"probe",    scene,      "--from", "8,0,1", "--to",
                                          "12,0,3.5", "--sphere", "--mode", "fly"};
  const auto ask = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = question;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(ROAM_PROGRAM, arguments);
  };
  const ProgramResult one = ask({"--radius", "0.3"});
  EXPECT_EQ(one.status, 0) << one.out << one.err;
  const ProgramResult many = ask({"--matrix", "0.2,0.3,0.6"});
  EXPECT_EQ(many.status, 0) << many.out << many.err;
}

TEST(ProbePath, FromAPlaceToItselfIsOneThatWalkTakes) {
  const TestFolder folder;
  const std::string scene = folder.write("yard.obj", yard_obj()), path = folder.file("way.path");
  const ProgramResult found = run_program(ROAM_PROGRAM, {"probe", scene, "--from", "8,0,1", "--to", "8,0,1", "--radius",
                                                         "0.3", "--height", "1.8", "--path", path});
  EXPECT_EQ(found.status, 0) << found.out << found.err;
  const ProgramResult walked = run_program(ROAM_PROGRAM, {"walk", scene, "--path", path, "--verify", "--json"});
  EXPECT_EQ(walked.status, 0) << walked.out << walked.err;
  EXPECT_EQ(Json::parse(walked.out, nullptr, false)["outcome"], "reached") << walked.out;
}

TEST(ProbePath, HasTheEyeOfTheBodyInTheWindow) {
  const TestFolder folder;
  const std::string scene = folder.write("yard.obj", yard_obj()), path = folder.file("way.path");
  for (const auto& [height, eye] : {std::pair("1.8", "eye 1.5 "), std::pair("2.5", "eye 1.6 ")}) {
    const ProgramResult found = run_program(
        ROAM_PROGRAM, {"probe", scene, "--from", "2,0,1", "--to", "8,0,1", "--height", height, "--path", path});
    EXPECT_EQ(found.status, 0) << found.out << found.err;
    EXPECT_TRUE(contains(folder.read("way.path"), eye)) << folder.read("way.path");
  }
}

TEST(ProbePath, SaysThatAPathWithoutAWayIsNotWritten) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", door_obj(0.5));
  const std::string path = folder.write("way.path", "# roam: mode walk another day\n1 0 1\n");
  const ProgramResult none = run_program(ROAM_PROGRAM, {"probe", scene, "--from", "2,0,1", "--to", "18,0,1", "--radius",
                                                        "0.3", "--height", "1.8", "--path", path});
  EXPECT_EQ(none.status, 3);
  EXPECT_TRUE(contains(none.err, "way.path") && contains(none.err, "was not written")) << none.err;
  EXPECT_EQ(folder.read("way.path"), "# roam: mode walk another day\n1 0 1\n");
}

TEST(ProbePath, ThatBreaksOffHasNoOpeningThatIsTooSmall) {
  const TestFolder folder;
  // Two floors, one 0.8 m above the end of the other: what is reached from both comes so near and does not meet.
  const std::string scene = folder.write("ledge.obj",
                                         "v 0 -2 0\nv 5 -2 0\nv 5 2 0\nv 0 2 0\n"
                                         "v 5 -2 0.8\nv 15 -2 0.8\nv 15 2 0.8\nv 5 2 0.8\n"
                                         "o near\nf 1 2 3 4\no far\nf 5 6 7 8\n");
  const ProgramResult none =
      run_program(ROAM_PROGRAM, {"probe", scene, "--from", "2,0,1", "--to", "12,0,1.8", "--sphere", "--json"});
  EXPECT_EQ(none.status, 3) << none.err;
  const Json opening = Json::parse(none.out, nullptr, false)["opening"];
  ASSERT_TRUE(opening.is_object()) << none.out;
  EXPECT_EQ(opening["kind"], "apart");
  EXPECT_TRUE(opening["missing_m"].is_null()) << opening;
}

}  // namespace
