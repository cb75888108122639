// What all JSON of the program has in common: version and schema, and an object for a command that failed.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/failure.h"
#include "cli_scenes.h"
#include "messages.h"
#include "program.h"

namespace {

using nlohmann::json;
using Arguments = std::vector<std::string>;

ProgramResult roam(const Arguments& arguments) { return run_program(ROAM_PROGRAM, arguments); }

/// The one JSON object on standard output.
json object_of(const ProgramResult& result) {
  json object = json::parse(result.out, nullptr, false);
  EXPECT_TRUE(object.is_object()) << result.out << result.err;
  if (!object.is_object()) return json::object();
  EXPECT_EQ(object["roam"], ROAM_PACKAGE_VERSION);
  EXPECT_EQ(object["schema"], 1);
  return object;
}

TEST(Json, EveryReportHasVersionAndSchema) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", room_obj());
  const std::string path = folder.write("way.path", "2 0 0.9\n18 0 0.9\n");
  const std::string store = folder.file("room.roam");
  for (const Arguments& arguments :
       std::vector<Arguments>{{"info", scene},
                              {"walk", scene, "--path", path, "--height", "1.8"},
                              {"probe", scene, "--from", "2,0,1", "--to", "8,0,1", "--radius", "0.3"},
                              {"train", scene, "--height", "1.8", "--no-profile"},
                              {"make", "city", "-o", folder.file("city.ply"), "--triangles", "10k"},
                              {"build", scene, "-o", store},
                              {"verify", store},
                              {"info", store},
                              {"view", scene, "--headless", "--size", "160x120", "--path", path}}) {
    SCOPED_TRACE(arguments.front());
    Arguments all = arguments;
    all.push_back("--json");
    const json report = object_of(roam(all));
    EXPECT_GT(report.size(), 3u);
    EXPECT_FALSE(report.contains("error"));
  }
}

TEST(Json, ACommandThatFailsHasAnObjectToo) {
  const ProgramResult missing = roam({"info", "no/such/scene.obj", "--json"});
  EXPECT_EQ(missing.status, 1);
  const json error = object_of(missing)["error"];
  EXPECT_EQ(error["where"], "no/such/scene.obj");
  EXPECT_EQ(error["what"], "there is no such file or folder. Check the spelling.");
  EXPECT_EQ(error["message"], "no/such/scene.obj: there is no such file or folder. Check the spelling.");
  EXPECT_EQ(missing.err, "roam: " + error["message"].get<std::string>() + "\n");
}

TEST(Json, SoDoesOneThatIsWrong) {
  struct Wrong {
    Arguments arguments;
    const char *where, *what;
  };
  for (const Wrong& wrong :
       std::vector<Wrong>{{{"walk", "a.obj", "--json", "--radius", "abc"}, "--radius", "'abc' is not a number"},
                          {{"walk", "a.obj", "--json", "--hieght=1"},
                           "--hieght",
                           "unknown option '--hieght'. Did you mean '--height'?"},
                          {{"wlak", "--json"}, nullptr, "there is no verb 'wlak'. Did you mean 'walk'?"},
                          {{"build", "a.obj", "--memory", "1M", "--json"}, "build", nullptr}}) {
    const ProgramResult result = roam(wrong.arguments);
    EXPECT_EQ(result.status, 2);
    const json error = object_of(result)["error"];
    EXPECT_EQ(error["where"], wrong.where == nullptr ? json() : json(wrong.where));
    if (wrong.what != nullptr) {
      EXPECT_EQ(error["what"], wrong.what);
    }
    EXPECT_TRUE(contains(result.err, error["message"])) << result.err;
  }
}

TEST(Json, AReportIsFollowedByNoSecondObject) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", room_obj());
  const ProgramResult result =
      roam({"train", scene, "--height", "1.8", "--json", "-o", folder.file(std::string(256, 'p'))});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_FALSE(object_of(result).contains("error"));
}

TEST(Json, WithoutItAFailureLeavesStandardOutputEmpty) { EXPECT_EQ(roam({"info", "no/such/scene.obj"}).out, ""); }

TEST(FailureReport, FindsThePlaceThatTheSentenceNames) {
  const auto where = [](const std::string& message, const Arguments& arguments) {
    return roam::app::failure_report(message, arguments)["error"]["where"];
  };
  const Arguments walk{"walk", "house.obj", "--trace=t.csv", "--speed", "1.4"};
  EXPECT_EQ(where("house.obj:3: no number", walk), "house.obj:3");
  EXPECT_EQ(where("house.obj.roam.json: is damaged", walk), "house.obj.roam.json");
  EXPECT_EQ(where("house.obj.roam.json is not of house.obj: train again", walk), "house.obj.roam.json");
  EXPECT_EQ(where("--trace t.csv: there is no folder", walk), "--trace t.csv");
  EXPECT_EQ(where("walk: where to?", walk), "walk");
  EXPECT_TRUE(where("walking needs ground: there is none", walk).is_null());
  EXPECT_EQ(where("cannot write t.csv: No space left on device", walk), "t.csv");
  EXPECT_TRUE(where("out of memory after 1.4 s of a walk", walk).is_null());
  EXPECT_TRUE(where("cancelled", walk).is_null());
}

}  // namespace
