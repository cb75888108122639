// The body of every verb: a person, unless options, a path or a profile say otherwise.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "door_rooms.h"
#include "messages.h"
#include "program.h"

namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

/// Each verb that has a body, in a room with a door.
class BodyOfAVerb : public testing::Test {
 protected:
  TestFolder folder;
  std::string scene = folder.write("room.obj", door_obj(0.9));
  std::string path = folder.write("p.path", "2 0 1\n6 0 1\n");

  void SetUp() override { setenv("XDG_CONFIG_HOME", folder.file("none").c_str(), 1); }

  [[nodiscard]] ProgramResult run(Words words, const Words& more = {}) const {
    words.insert(words.begin() + 1, scene);
    words.insert(words.end(), more.begin(), more.end());
    return run_program(ROAM_PROGRAM, words);
  }
  [[nodiscard]] Json report(const Words& words, Words more = {}) const {
    more.emplace_back("--json");
    const ProgramResult result = run(words, more);
    EXPECT_NE(result.status, 2) << result.err;
    return Json::parse(result.out, nullptr, false);
  }
  void expect_size(const Words& verb, const Words& more, double radius, double height) const {
    const Json json = report(verb, more);
    const std::string what = verb.front() + (more.empty() ? "" : " " + more.front());
    EXPECT_EQ(json["radius"], radius) << what;
    EXPECT_EQ(json["height"], height) << what;
  }

  const Words walk{"walk", "--path", path};
  const Words fly{"walk", "--path", path, "--mode", "fly"};
  const Words wander{"walk", "--wander", "0.1"};
  const Words probe{"probe", "--from", "2,0.3,1", "--to", "18,-0.4,1"};
  const Words view{"view", "--headless", "--size", "160x120", "--time", "0.1", "--at", "2,0,0.9"};
};

TEST_F(BodyOfAVerb, IsAPerson) {
  for (const Words& verb : {walk, fly, wander, probe, view}) expect_size(verb, {}, 0.3, 1.8);
  EXPECT_EQ(report({"train", "--no-profile", "--spacing", "0.4"})["height"], 1.8);
}

TEST_F(BodyOfAVerb, OfARadiusIsAPersonThatIsAtLeastAsHighAsWide) {
  for (const Words& verb : {walk, probe, view}) expect_size(verb, {"--radius", "0.25"}, 0.25, 1.8);
  expect_size(walk, {"--radius", "1.2"}, 1.2, 2.4);
}

TEST_F(BodyOfAVerb, IsASphereOnDemand) {
  for (const Words& verb : {walk, fly, probe, view}) {
    expect_size(verb, {"--sphere"}, 0.3, 0.6);
    const ProgramResult both = run(verb, {"--sphere", "--height", "1.8"});
    EXPECT_EQ(both.status, 2) << verb.front();
    EXPECT_TRUE(contains(both.err, "--height and --sphere exclude each other") ||
                contains(both.err, "--sphere and --height exclude each other"))
        << both.err;
  }
  expect_size(walk, {"--sphere", "--radius", "0.4"}, 0.4, 0.8);
}

TEST_F(BodyOfAVerb, OfEverySizeOfAMatrixIsThatOfARadius) {
  const Json people = report(probe, {"--matrix", "0.3,0.4x1.9"})["sizes"];
  EXPECT_EQ(people[0]["height"], 1.8);
  EXPECT_EQ(people[1]["height"], 1.9);
  EXPECT_EQ(report(probe, {"--matrix", "0.3,0.4", "--sphere"})["sizes"][1]["height"], 0.8);
  const ProgramResult both = run(probe, {"--matrix", "0.3,0.4x1.9", "--sphere"});
  EXPECT_EQ(both.status, 2);
  EXPECT_TRUE(contains(both.err, "'0.4x1.9' has a height, and --sphere excludes it")) << both.err;
}

TEST_F(BodyOfAVerb, ThatIsSearchedForInTheAirIsASphereThatIsAskedFor) {
  for (const Words& verb : {probe, Words{"train", "--no-profile"}}) {
    const ProgramResult person = run(verb, {"--mode", "fly"});
    EXPECT_EQ(person.status, 2) << verb.front();
    EXPECT_TRUE(contains(person.err, "ways through the air are found for spheres; add --sphere")) << person.err;
  }
  EXPECT_EQ(report(probe, {"--mode", "fly", "--sphere"})["height"], 0.6);
}

TEST_F(BodyOfAVerb, ThatIsTrainedIsAtMostAsWideAsHigh) {
  const ProgramResult wide = run({"train", "--no-profile"}, {"--radius-max", "0.95"});
  EXPECT_EQ(wide.status, 2);
  EXPECT_TRUE(contains(wide.err, "a body 1.8 m high has a radius of at most 0.9 m")) << wide.err;
  EXPECT_EQ(run({"train", "--no-profile", "--spacing", "0.4"}, {"--radius-max", "0.95", "--height", "1.9"}).status, 0);
  EXPECT_EQ(run({"train", "--no-profile", "--spacing", "0.4"}, {"--radius-max", "0.95", "--sphere"}).status, 0);
}

TEST_F(BodyOfAVerb, ThatWasTrainedIsThatOfTheWalkUnlessASphereIsAskedFor) {
  ASSERT_EQ(run({"train", "--spacing", "0.4", "--height", "1.7"}).status, 0);
  EXPECT_EQ(report(walk)["height"], 1.7);
  EXPECT_EQ(report(view)["height"], 1.7);
  const Json sphere = report(walk, {"--sphere"});
  EXPECT_EQ(sphere["height"], 0.6);
  EXPECT_TRUE(sphere["profile"].is_null());
}

}  // namespace
