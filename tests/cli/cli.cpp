// The command line as a shell sees it: what every verb has in common, and info.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/progress.h"
#include "cli_scenes.h"
#include "messages.h"
#include "program.h"

namespace {

TEST(CommandLine, TellsItsVersion) {
  const ProgramResult result = run_roam({"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_TRUE(result.out.starts_with("roam " ROAM_PACKAGE_VERSION "\nscenes are read behind: ")) << result.out;
}

TEST(CommandLine, ExplainsEveryVerbWithExamples) {
  const std::vector<std::vector<std::string>> verbs = {
      {}, {"walk"}, {"sweep"}, {"info"}, {"make"}, {"make", "gallery"}, {"make", "terrain"}, {"make", "city"}};
  for (std::vector<std::string> verb : verbs) {
    verb.push_back("--help");
    const ProgramResult result = run_roam(verb);
    EXPECT_EQ(result.status, 0);
    EXPECT_TRUE(contains(result.out, "Examples:\n  ")) << result.out;
    EXPECT_EQ(result.err, "");
  }
}

TEST(CommandLine, SaysSoWhenWhatItExplainsCannotBeWritten) {
  for (const char* asked : {"--help", "walk --help", "--version"}) {
    const ProgramResult result =
        run_program("/bin/sh", {"-c", std::string("exec \"$0\" ") + asked + " > /dev/full", ROAM_PROGRAM});
    EXPECT_EQ(result.status, 1);
    EXPECT_TRUE(contains(result.err, "cannot write the result: No space left on device")) << result.err;
  }
}

TEST(CommandLine, FailsAndDoesNotCrashWhenNotEvenItsMessageCanBeWritten) {
  for (const char* asked : {"--version", "info nothing.ply"}) {
    const ProgramResult result =
        run_program("/bin/sh", {"-c", std::string("exec \"$0\" ") + asked + " > /dev/full 2>&1", ROAM_PROGRAM});
    EXPECT_EQ(result.status, 1) << asked;
  }
}

TEST(CommandLine, NamesTheUnknownOptionAndWhereToLook) {
  const ProgramResult result = run_roam({"walk", "scene.obj", "--path", "a.path", "--radis", "0.3"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(contains(result.err, "--radis")) << result.err;
  EXPECT_TRUE(contains(result.err, "`roam walk --help`")) << result.err;
}

TEST(CommandLine, RefusesWrongUsageWithStatusTwo) {
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {"fly"},
      {"walk"},
      {"walk", "scene.obj"},
      {"walk", "scene.obj", "--path"},
      {"walk", "scene.obj", "--path", "a", "--mode", "swim"},
      {"walk", "scene.obj", "--path", "a", "--radius", "wide"},
      {"walk", "scene.obj", "--path", "a", "--radius", "-1"},
      {"walk", "scene.obj", "--path", "a", "--radius", "nan"},
      {"walk", "scene.obj", "--path", "a", "--height", "0.5"},
      {"walk", "scene.obj", "--path", "a", "--speed", "0"},
      {"walk", "scene.obj", "--path", "a", "--mode", "ghost", "--verify"},
      {"info", "scene.obj", "--up", "w"},
      {"info", "scene.obj", "--unit", "mile"},
      {"info", "scene.obj", "--threads", "0"},
      {"make"},
      {"make", "castle", "-o", "castle.ply"},
      {"make", "gallery"},
      {"make", "gallery", "-o", "g.ply", "--triangles", "1"},
      {"make", "gallery", "-o", "g.ply", "--triangles", "-5"},
      {"make", "terrain", "-o", "t.ply", "--size", "1e9"},
  };
  for (const auto& arguments : wrong) {
    const ProgramResult result = run_roam(arguments);
    std::string line;
    for (const std::string& argument : arguments) line += argument + " ";
    EXPECT_EQ(result.status, 2) << line << "\n" << result.err;
    EXPECT_EQ(result.out, "") << line;
    EXPECT_FALSE(result.err.empty()) << line;
  }
}

TEST(CommandLine, NamesTheSceneThatIsNotThere) {
  const ProgramResult result = run_roam({"info", "no/such/scene.obj"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, "no/such/scene.obj")) << result.err;
}

TEST(CommandLine, RefusesASceneWithoutTriangles) {
  const TestFolder folder;
  const std::string scene = folder.write("empty.obj", "# nothing\nv 0 0 0\n");
  const ProgramResult result = run_roam({"info", scene});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, "empty.obj")) << result.err;
  EXPECT_TRUE(contains(result.err, "triangle")) << result.err;
}

TEST(Progress, WritesCountsAndTimesForPeople) {
  using roam::app::short_count;
  using roam::app::short_time;
  EXPECT_EQ(short_count(0), "0");
  EXPECT_EQ(short_count(999), "999");
  EXPECT_EQ(short_count(1000), "1.00 k");
  EXPECT_EQ(short_count(12345), "12.3 k");
  EXPECT_EQ(short_count(999'600), "1.00 M");
  EXPECT_EQ(short_count(123'456'789), "123 M");
  EXPECT_EQ(short_time(0.04), "0.0 s");
  EXPECT_EQ(short_time(9.94), "9.9 s");
  EXPECT_EQ(short_time(59.4), "59 s");
  EXPECT_EQ(short_time(59.6), "1 min 0 s");
  EXPECT_EQ(short_time(190), "3 min 10 s");
  EXPECT_EQ(short_time(7500), "2 h 5 min");
}

nlohmann::json info(const std::vector<std::string>& arguments) {
  std::vector<std::string> all{"info", "--json"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  const ProgramResult result = run_roam(all);
  EXPECT_EQ(result.status, 0) << result.err;
  return nlohmann::json::parse(result.out, nullptr, false);
}

TEST(Info, SaysWhatASceneHolds) {
  const TestFolder folder;
  const nlohmann::json report = info({folder.write("room.obj", room_obj())});
  EXPECT_EQ(report["triangles"], 12);
  EXPECT_EQ(report["objects"], 6);
  EXPECT_GE(report["tiles"], 1);
  EXPECT_GT(report["bytes"], 0);
  EXPECT_DOUBLE_EQ(report["bytes_per_triangle"], report["bytes"].get<double>() / 12);
  EXPECT_EQ(report["bounds"]["min"], (std::vector<double>{0, -2, 0}));
  EXPECT_EQ(report["bounds"]["max"], (std::vector<double>{20, 2, 3}));
  EXPECT_LE(report["largest_error_m"], 2e-3);
  EXPECT_EQ(report["hash"].get<std::string>().size(), 32u);
  EXPECT_EQ(report["import"]["files"], 1);
  EXPECT_EQ(report["import"]["bad_vertices"], 0);
}

TEST(Info, SaysFirstHowLargeItIsAndKeepsFiguresForStats) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", room_obj());
  const ProgramResult result = run_roam({"info", scene});
  EXPECT_EQ(result.status, 0) << result.err;
  const std::string first = result.out.substr(0, result.out.find("\n  from"));
  EXPECT_TRUE(contains(first, "20.00 x 4.00 x 3.00 m")) << result.out;
  const ProgramResult stats = run_roam({"info", scene, "--stats"});
  EXPECT_TRUE(stats.out.starts_with(result.out)) << stats.out;
  EXPECT_TRUE(contains(stats.out, "largest error")) << stats.out;
  EXPECT_FALSE(contains(result.out, "largest error")) << result.out;
}

TEST(Info, SaysWhetherTheSurfacesAreClosed) {
  const TestFolder folder;
  EXPECT_EQ(info({folder.write("room.obj", room_obj())})["edges"]["open"], 0);
  const nlohmann::json open = info({folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")})["edges"];
  EXPECT_EQ(open["open"], 3);
  EXPECT_EQ(open["all"], 3);
}

TEST(Info, AppliesUnitAndUpAxis) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", room_obj());
  const nlohmann::json report = info({scene, "--unit", "cm", "--up", "y"});
  // (x, y, z) becomes (x, -z, y).
  EXPECT_EQ(report["bounds"]["min"], (std::vector<double>{0, -0.03, -0.02}));
  EXPECT_EQ(report["bounds"]["max"], (std::vector<double>{0.2, 0, 0.02}));
}

TEST(Info, TurnsAnAxisThatPointsDown) {
  const TestFolder folder;
  const nlohmann::json report = info({folder.write("room.obj", room_obj()), "--up=-y"});
  // (x, y, z) becomes (x, z, -y).
  EXPECT_EQ(report["bounds"]["min"], (std::vector<double>{0, 0, -2}));
  EXPECT_EQ(report["bounds"]["max"], (std::vector<double>{20, 3, 2}));
}

TEST(Info, LeavesOutWhatIsIgnored) {
  const TestFolder folder;
  const std::string scene = folder.write("room.obj", room_obj());
  const nlohmann::json report = info({scene, "--ignore", "fr*", "--ignore", "ceiling"});
  EXPECT_EQ(report["triangles"], 8);
  EXPECT_EQ(report["import"]["ignored_triangles"], 4);
}

TEST(Info, HashesTrianglesNotFiles) {
  const TestFolder folder;
  const std::string named = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\no square\nf 1 2 3 4\n");
  const std::string twice = folder.write("b.obj", "v 9 9 9\nv 0 1 0\nv 1 1 0\nv 1 0 0\nv 0 0 0\nf 5 4 3\nf 5 3 2\n");
  const std::string other = folder.write("c.obj", "v 0 0 0\nv 1 0 0\nv 1 1 1e-9\nv 0 1 0\nf 1 2 3 4\n");
  EXPECT_EQ(info({named})["hash"], info({twice})["hash"]);
  EXPECT_NE(info({named})["hash"], info({other})["hash"]);
}

TEST(Info, LoadsSeveralScenesIntoOneWorld) {
  const TestFolder folder;
  const std::string a = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  const std::string b = folder.write("b.obj", "v 0 0 9\nv 1 0 9\nv 1 1 9\nf 1 2 3\n");
  const nlohmann::json report = info({a, b});
  EXPECT_EQ(report["triangles"], 2);
  EXPECT_EQ(report["bounds"]["max"], (std::vector<double>{1, 1, 9}));
}

TEST(Info, EndsQuietlyWhenNobodyReads) {
  const TestFolder folder;
  const ProgramResult result =
      run_program(ROAM_PROGRAM, {"info", folder.write("room.obj", room_obj())}, {.close_output = true});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err, "");
}

}  // namespace
