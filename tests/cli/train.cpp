// roam train as a shell sees it.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "messages.h"
#include "program.h"
#include "train_scenes.h"

namespace {

std::string obj(const roam::Mesh& mesh) {
  std::ostringstream out;
  out.precision(17);
  for (const roam::Vec3& v : mesh.vertices) out << "v " << v.x << ' ' << v.y << ' ' << v.z << '\n';
  for (const auto& t : mesh.triangles) out << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  return out.str();
}

/// One training in a folder of its own.
struct Train {
  TestFolder folder;
  ProgramResult result;

  explicit Train(const CorridorOptions& scene, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"train", folder.write("scene.obj", obj(corridor_mesh(scene)))};
    for (const std::string& argument : more)
      arguments.push_back(argument.starts_with("@") ? folder.file(argument.substr(1)) : argument);
    result = run_program(ROAM_PROGRAM, arguments);
  }
  [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(result.out, nullptr, false); }
  [[nodiscard]] bool wrote(const std::string& name) const { return std::filesystem::exists(folder.file(name)); }
};

TEST(TrainVerb, ReportsTheIntervalAndWritesTheProfileBesideTheScene) {
  const Train train({.door = 1.0, .split = 0.4}, {"--height", "1.8", "--json"});
  EXPECT_EQ(train.result.status, 0) << train.result.err;
  const nlohmann::json report = train.json();
  for (const char* key : {"radius", "interval", "feasible", "paths", "decisive", "regions", "seconds", "support_radius",
                          "trapped_radius", "answer", "complete", "cracks", "contradictions"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_NEAR(report["interval"]["min"], 0.2, 1e-3);
  EXPECT_NEAR(report["interval"]["max"], 0.5, 1e-3);
  EXPECT_EQ(report["feasible"], true);
  EXPECT_EQ(report["decisive"][0]["kind"], "opening");
  EXPECT_EQ(report["decisive"][1]["kind"], "split");
  ASSERT_FALSE(report["paths"].empty());
  EXPECT_TRUE(report["paths"][0]["trials"][0].contains("outcome"));
  EXPECT_TRUE(train.wrote("scene.obj.roam.json"));
}

TEST(TrainVerb, EndsWithThreeWhereNoOneBodyServesAndSaysWhatToUse) {
  const Train train({.door = 0.8, .split = 1.25}, {"--height", "1.8", "-o", "@p.json"});
  EXPECT_EQ(train.result.status, 3) << train.result.err;
  EXPECT_TRUE(train.result.out.starts_with("PASSES WITH A SUPPORT DISC")) << train.result.out;
  EXPECT_TRUE(train.wrote("p.json"));
  EXPECT_FALSE(train.wrote("scene.obj.roam.json"));
  EXPECT_TRUE(contains(train.result.out, "walk and view do not read it")) << train.result.out;
  const Train beside({}, {"-o", "@./scene.obj.roam.json"});
  EXPECT_TRUE(contains(beside.result.out, "walk and view use this body")) << beside.result.out;
}

TEST(TrainVerb, SaysNullForAnEndThatNothingLimits) {
  const Train train({}, {"--json", "--no-profile"});
  EXPECT_EQ(train.result.status, 0) << train.result.err;
  EXPECT_TRUE(train.json()["interval"]["max"].is_null());
  EXPECT_EQ(train.json()["interval"]["min"], 0.0);
  EXPECT_FALSE(train.wrote("scene.obj.roam.json"));
}

TEST(TrainVerb, FollowsThePaperWhenAskedTo) {
  const Train train({.door = 0.8, .split = 1.25}, {"--method", "paper", "--json", "--no-profile"});
  EXPECT_EQ(train.result.status, 3) << train.result.err;
  EXPECT_TRUE(contains(train.json()["answer"], "contradiction")) << train.result.out;
}

TEST(TrainVerb, DrawsWhatDecides) {
  const Train train({.door = 0.8, .split = 0.5}, {"--no-profile", "--picture", "@d.svg"});
  EXPECT_EQ(train.result.status, 0) << train.result.err;
  const Train open({}, {"--no-profile", "--picture", "@d.svg"});  // nothing decides: what was found, in words
  const std::string words = open.folder.read("d.svg");
  std::size_t letters = 0;
  for (std::size_t i = 0; (i = words.find("xlink:href", i)) != std::string::npos; ++i) ++letters;
  EXPECT_GT(letters, 60u);
  EXPECT_TRUE(contains(train.folder.read("d.svg"), "<svg"));
  EXPECT_GT(train.folder.read("d.svg").size(), words.size());
}

TEST(TrainVerb, RefusesWhatCannotBeMeant) {
  EXPECT_EQ(Train({}, {"--mode", "ghost"}).result.status, 2);
  EXPECT_EQ(Train({}, {"--mode", "fly", "--height", "1.8"}).result.status, 2);
  EXPECT_EQ(Train({}, {"-o", "@p.json", "--no-profile"}).result.status, 2);
  EXPECT_EQ(Train({}, {"--picture", "@scene.obj"}).result.status, 2);
  EXPECT_EQ(Train({}, {"--paths", "0"}).result.status, 2);
  EXPECT_EQ(Train({}, {"--height", "0.05"}).result.status, 2);
  EXPECT_EQ(Train({}, {"--radius-min", "0.001"}).result.status, 2);
  for (const char* option : {"--radius-max", "--height"}) {
    const Train narrow({}, {"--radius-min", "0.5", option, option == std::string("--height") ? "0.9" : "0.4"});
    EXPECT_EQ(narrow.result.status, 2) << option;
    EXPECT_TRUE(contains(narrow.result.err, "--radius-min 0.5: the largest radius is 0.4")) << narrow.result.err;
  }
  EXPECT_EQ(Train({}, {"--height", "500"}).result.status, 2);
  EXPECT_EQ(Train({}, {"--seed", "-1"}).result.status, 2);
  const Train step({}, {"--height", "1.8", "--step", "1.75"});
  EXPECT_EQ(step.result.status, 2);
  EXPECT_TRUE(contains(step.result.err, "--step 1.75: a body 1.8 m high steps up at most 0.9 m")) << step.result.err;
  const Train low({}, {"--height", "0.15", "--radius-min", "0.05"});
  EXPECT_EQ(low.result.status, 2);
  EXPECT_TRUE(contains(low.result.err, "above the knee")) << low.result.err;
  const Train paths({}, {"--paths", "x"});
  EXPECT_EQ(paths.result.status, 2);
  EXPECT_TRUE(contains(paths.result.err, "'x' is not a whole number from 1 to 10000")) << paths.result.err;
}

TEST(TrainVerb, RefusesAFileThatCannotBeWrittenBeforeAnyWork) {
  for (const char* option : {"-o", "--picture"}) {
    const Train none({}, {option, "@none/p.svg"});
    EXPECT_EQ(none.result.status, 2) << option;
    EXPECT_TRUE(contains(none.result.err, "there is no folder")) << none.result.err;
    EXPECT_TRUE(none.result.out.empty()) << none.result.out;
    EXPECT_EQ(Train({}, {option, ""}).result.status, 2) << option;
    EXPECT_TRUE(contains(Train({}, {option, "@."}).result.err, "that is a folder")) << option;
  }
  EXPECT_TRUE(contains(Train({}, {"-o", "@scene.obj"}).result.err, "would overwrite the scene"));
  EXPECT_TRUE(contains(Train({}, {"--picture", "@scene.obj.roam.json"}).result.err, "would overwrite the profile"));
  const Train both({}, {"-o", "@p.svg", "--picture", "@p.svg"});
  EXPECT_EQ(both.result.status, 2);
  EXPECT_TRUE(contains(both.result.err, "would overwrite the file of -o")) << both.result.err;
}

TEST(TrainVerb, TellsItsAnswerThoughTheProfileCannotBeWritten) {
  const TestFolder folder;
  const std::string scene = folder.write("scene.obj", obj(corridor_mesh({})));
  const ProgramResult train = run_without_files(ROAM_PROGRAM, {"train", scene, "--json", "-o", folder.file("p.json")});
  EXPECT_EQ(train.status, 1);
  EXPECT_TRUE(contains(train.err, "cannot write")) << train.err;
  const nlohmann::json report = nlohmann::json::parse(train.out, nullptr, false);
  ASSERT_TRUE(report.contains("answer")) << train.out;
  EXPECT_TRUE(report["profile"].is_null());
}

TEST(TrainVerb, NamesEachFileThatCannotBeWritten) {
  const TestFolder folder;
  const std::string scene = folder.write("scene.obj", obj(corridor_mesh({})));
  const ProgramResult train =
      run_without_files(ROAM_PROGRAM, {"train", scene, "-o", folder.file("p.json"), "--picture", folder.file("d.svg")});
  EXPECT_EQ(train.status, 1);
  for (const char* name : {"p.json", "d.svg"}) EXPECT_TRUE(contains(train.err, name)) << train.err;
}

TEST(TrainVerb, WritesNoProfileWhereItHasLearnedNothing) {
  // Read in no time, and 9 million places to look at.
  roam::Mesh hall;
  scenes::add_floor(hall, 0, 0, 60, 60, 0);
  const TestFolder folder;
  const std::string scene = folder.write("hall.obj", obj(hall));
  // How long reading takes depends on the machine.
  ProgramResult result;
  const auto is_early = [&] { return contains(result.err, "before it had learned anything"); };
  for (double seconds = 0.3; !is_early() && seconds < 10.0; seconds *= 1.15) {
    std::filesystem::remove(scene + ".roam.json");
    result = run_program(ROAM_PROGRAM, {"train", scene, "--spacing", "0.02"}, {.interrupt_after = seconds});
  }
  EXPECT_TRUE(is_early()) << result.err;
  EXPECT_FALSE(std::filesystem::exists(scene + ".roam.json")) << result.err;
  EXPECT_EQ(result.status, 130);
  EXPECT_TRUE(result.out.starts_with("INTERRUPTED")) << result.out;
}

TEST(TrainVerb, SaysWhatToDoWhereNoProfileCanLieBesideTheScene) {
  const TestFolder folder;
  const std::string scene = folder.write("scene.obj", obj(corridor_mesh({})));
  std::filesystem::create_directory(scene + ".roam.json");
  const ProgramResult result = run_program(ROAM_PROGRAM, {"train", scene});
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(contains(result.err, "that is a folder; name a file elsewhere by -o, or say --no-profile")) << result.err;
}

TEST(TrainVerb, RefusesASpacingThatTheSceneIsTooSmallFor) {
  const Train train({}, {"--spacing", "20"});
  EXPECT_EQ(train.result.status, 2);
  EXPECT_TRUE(contains(train.result.err, "hardly a place would be looked at")) << train.result.err;
  const Train wide({}, {"--spacing", "1", "--no-profile"});
  EXPECT_TRUE(contains(wide.result.err, "say --spacing 0.85 or less")) << wide.result.err;
}

TEST(TrainVerb, EndsWithThreeForABodyThatStandsNowhereInside) {
  const Train train({}, {"--height", "3.5", "--json", "--no-profile"});
  EXPECT_EQ(train.result.status, 3) << train.result.err;
  EXPECT_TRUE(contains(train.json()["answer"], "stands nowhere inside")) << train.result.out;
}

TEST(TrainVerb, NamesTheParts) {
  const Train train({}, {"--height", "1.8", "--json", "--no-profile"});
  const nlohmann::json parts = train.json()["parts"];
  ASSERT_FALSE(parts.empty());
  EXPECT_EQ(parts[0]["trained"], true);
  EXPECT_EQ(parts[0]["whole"], true);
  EXPECT_EQ(parts[0]["why"], "");
  EXPECT_NEAR(parts[0]["area_m2"], 40.0, 4.0);
  EXPECT_EQ(parts[0]["place"].size(), 3u);
}

}  // namespace
