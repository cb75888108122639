// What all JSON of the program has in common: version and schema, and an object for a command that failed.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli_scenes.h"
#include "messages.h"
#include "program.h"

namespace {

using nlohmann::json;
using Arguments = std::vector<std::string>;

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
  const std::string store = folder.file("room.roam"), certificate = folder.file("certificate");
  for (const Arguments& arguments :
       std::vector<Arguments>{{"info", scene},
                              {"walk", scene, "--path", path, "--height", "1.8", "--certify", certificate},
                              {"check", certificate, scene},
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
    const json report = object_of(run_roam(all));
    EXPECT_GT(report.size(), 3u);
    EXPECT_FALSE(report.contains("error"));
  }
}

TEST(Json, HasTheLinesOfTheReportForPeople) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", room_obj());
  const std::string path = folder.write("way.path", "2 0 0.9\n18 0 0.9\n");
  for (const Arguments& arguments :
       std::vector<Arguments>{{"info", scene},
                              {"walk", scene, "--path", path, "--height", "1.8"},
                              {"probe", scene, "--from", "2,0,1", "--to", "8,0,1", "--radius", "0.3"},
                              {"probe", scene, "--from", "2,0,1", "--to", "8,0,1", "--matrix", "0.3,0.4x1.8"},
                              {"train", scene, "--height", "1.8", "--no-profile"}}) {
    SCOPED_TRACE(arguments.front());
    Arguments all = arguments;
    all.push_back("--json");
    std::string text;
    const json report = object_of(run_roam(all));
    for (const json& line : report["text"]) text += line.get<std::string>() + "\n";
    EXPECT_EQ(text, run_roam(arguments).out);
    EXPECT_NE(text, "");
  }
}

TEST(Json, ACommandThatFailsHasAnObjectToo) {
  const ProgramResult missing = run_roam({"info", "no/such/scene.obj", "--json"});
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
                          {{"build", "a.obj", "--memory", "1M", "--json"}, "--memory 1 MiB", nullptr},
                          {{"walk", "a.obj", "--json"}, "walk", nullptr}}) {
    const ProgramResult result = run_roam(wrong.arguments);
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
      run_without_files(ROAM_PROGRAM, {"train", scene, "--height", "1.8", "--json", "-o", folder.file("p.json")});
  EXPECT_EQ(result.status, 1) << result.err;
  EXPECT_FALSE(object_of(result).contains("error"));
}

TEST(Json, WithoutItAFailureLeavesStandardOutputEmpty) { EXPECT_EQ(run_roam({"info", "no/such/scene.obj"}).out, ""); }

/// The error of a command that fails with this status, with all that holds of every error.
json error_of(const Arguments& arguments, int status) {
  Arguments all = arguments;
  all.emplace_back("--json");
  const ProgramResult result = run_roam(all);
  EXPECT_EQ(result.status, status) << result.err;
  const json error = object_of(result)["error"];
  EXPECT_TRUE(contains(result.err, error["message"])) << result.err;
  const std::string message = error["message"], what = error["what"];
  EXPECT_TRUE(message.ends_with(what)) << error;
  if (what != message) {
    EXPECT_EQ(message, error["where"].get<std::string>() + ": " + what);
  }
  return error;
}

TEST(Json, AFailureNamesTheFileOrTheLineInIt) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", room_obj());
  const std::string path = folder.write("way.path", "2 0 0.9\n18 0 0.9\n");
  const std::string mesh = folder.write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 oops\nf 1 2 3\n");
  const std::string way = folder.write("broken.path", "2 0 0.9\n18 zero 0.9\n");
  const std::string settings = folder.write("settings.json", R"({"body": {"radius": "wide"}})");
  const std::string sizes = folder.write("sizes.txt", "0.3x1.8\n0.4x\n");
  const std::string absent = folder.file("absent.path");
  struct Failure {
    Arguments arguments;
    int status;
    std::string where;
  };
  for (const Failure& failure :
       std::vector<Failure>{{{"walk", scene, "--path", absent}, 1, absent},
                            {{"walk", mesh, "--path", path}, 1, mesh + ":3"},
                            {{"info", mesh}, 1, mesh + ":3"},
                            {{"walk", scene, "--path", way}, 1, way + ":2"},
                            {{"view", scene, "--headless", "--settings", settings, "--time", "1"}, 2, settings},
                            {{"probe", scene, "--from", "2,0,1", "--to", "8,0,1", "--matrix", sizes}, 2, sizes + ":2"},
                            {{"build", mesh, "-o", folder.file("broken.roam")}, 1, mesh + ":3"},
                            {{"verify", folder.file("absent.roam")}, 1, folder.file("absent.roam")},
                            {{"walk", scene, "--path", path, "--picture", scene}, 2, "--picture " + scene}}) {
    SCOPED_TRACE(failure.arguments.front() + " " + failure.where);
    EXPECT_EQ(error_of(failure.arguments, failure.status)["where"], failure.where);
  }
}

TEST(Json, AFailureNamesTheOption) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", room_obj());
  struct Wrong {
    Arguments arguments;
    const char* where;
  };
  for (const Wrong& wrong :
       std::vector<Wrong>{{{"walk", scene, "--path", "p", "--speed", "fast"}, "--speed"},
                          {{"walk", scene, "--path", "p", "--mode", "swim"}, "--mode"},
                          {{"walk", scene, "--path", "p", "--wander", "3"}, "--path"},
                          {{"walk", scene, "--patch", "p"}, "--patch"},
                          {{"walk", scene, "--path", "p", "--mode", "ghost", "--verify"}, "--verify with --mode ghost"},
                          {{"probe", scene, "--from", "2,0,1", "--radius", "0.3"}, "--to"},
                          {{"probe", scene, "--from", "2,0", "--to", "8,0,1", "--radius", "0.3"}, "--from"},
                          {{"view", scene, "--headless"}, "--headless"}}) {
    SCOPED_TRACE(wrong.where);
    EXPECT_EQ(error_of(wrong.arguments, 2)["where"], wrong.where);
  }
}

TEST(Json, AFailureNamesTheDamagedFileOfAStore) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", room_obj()), store = folder.file("room.roam");
  ASSERT_EQ(run_roam({"build", scene, "-o", store}).status, 0);
  const Arguments probe{"probe", store, "--from", "2,0,1", "--to", "8,0,1", "--radius", "0.3"};
  const auto only_file = [&](const char* kind) {
    return std::filesystem::directory_iterator(store + "/" + kind)->path().string();
  };
  const std::string pack = only_file("packs");
  std::filesystem::resize_file(pack, 10);
  EXPECT_EQ(error_of(probe, 1)["where"], store);
  std::filesystem::resize_file(only_file("manifests"), 10);
  EXPECT_EQ(error_of(probe, 1)["where"], store);
}

TEST(Json, LinesEndWithTheErrorOfABuildThatFails) {
  const TestFolder folder;
  const std::string mesh = folder.write("broken.obj", "v 0 0 0\nf 1 2 oops\n");
  const ProgramResult result = run_roam({"build", mesh, "-o", folder.file("broken.roam"), "--json-lines"});
  EXPECT_EQ(result.status, 1);
  const std::size_t line = result.out.rfind('\n', result.out.size() - 2) + 1;  // npos + 1 is 0
  const json last = json::parse(result.out.substr(line), nullptr, false);
  ASSERT_TRUE(last.is_object()) << result.out << result.err;
  EXPECT_EQ(last["error"]["where"], mesh + ":2");
}

}  // namespace
