// roam make as a shell sees it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "program.h"

namespace {

nlohmann::json json_of(const ProgramResult& result) { return nlohmann::json::parse(result.out, nullptr, false); }

TEST(MakeVerb, MakesAGalleryWithItsPathsAndABodyFliesTheFirst) {
  const TestFolder folder;
  const std::string scene = folder.file("dam.ply");
  const ProgramResult made = run_roam({"make", "gallery", "-o", scene, "--triangles", "20k", "--json"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NEAR(json_of(made)["triangles"].get<double>(), 20'000, 600);
  EXPECT_EQ(json_of(made)["paths"].size(), 3u);
  EXPECT_EQ(json_of(run_roam({"info", scene, "--json"}))["triangles"], json_of(made)["triangles"]);
  for (const char* path : {"dam-straight.path", "dam-corner.path"}) {
    const ProgramResult walked =
        run_roam({"walk", scene, "--path", folder.file(path), "--mode", "fly", "--speed", "50", "--verify", "--json"});
    EXPECT_EQ(walked.status, 0) << walked.err << walked.out;
    EXPECT_EQ(json_of(walked)["violations"], 0);
  }
}

TEST(MakeVerb, CrossesTheSplitWithARadiusThatBridgesIt) {
  const TestFolder folder;
  const std::string scene = folder.file("dam.ply");
  ASSERT_EQ(run_roam({"make", "gallery", "-o", scene, "--triangles", "50k"}).status, 0);
  const std::vector<std::string> walk{"walk",     scene,    "--path",  folder.file("dam-split.path"), "--speed", "1.5",
                                      "--verify", "--json", "--radius"};
  auto with = [&](const char* radius) {
    std::vector<std::string> arguments = walk;
    arguments.emplace_back(radius);
    return json_of(run_roam(arguments));
  };
  const nlohmann::json crossed = with("0.7");
  EXPECT_EQ(crossed["outcome"], "reached") << crossed;
  EXPECT_EQ(crossed["violations"], 0);
  const nlohmann::json fell = with("0.5");
  EXPECT_EQ(fell["outcome"], "fell") << fell;
  EXPECT_EQ(fell["violations"], 0);
}

TEST(MakeVerb, GivesTheSameBitsForTheSameSeed) {
  const TestFolder folder;
  const auto make = [&](const std::string& file, const std::string& seed) {
    EXPECT_EQ(run_roam({"make", "terrain", "-o", folder.file(file), "--triangles", "10k", "--seed", seed}).status, 0);
    return folder.read(file);
  };
  const std::string first = make("a.ply", "5");
  EXPECT_FALSE(first.empty());
  EXPECT_EQ(first, make("b.ply", "5"));
  EXPECT_NE(first, make("c.ply", "6"));
}

TEST(MakeVerb, TakesNumbersOfThousandsWithDecimals) {
  const TestFolder folder;
  const auto make = [&](const char* triangles) {
    return run_roam({"make", "terrain", "-o", folder.file("t.ply"), "--triangles", triangles, "--json"});
  };
  for (const char* triangles : {"16.1k", "32.3k"}) {
    EXPECT_EQ(make(triangles).status, 0) << triangles << make(triangles).err;
  }
  EXPECT_EQ(make("16.1005k").status, 2);
}

TEST(MakeVerb, CountsOneObjectAsOne) {
  const TestFolder folder;
  const std::string told = run_roam({"make", "terrain", "-o", folder.file("t.ply"), "--triangles", "10k"}).out;
  EXPECT_NE(told.find(" triangles in 1 object, "), std::string::npos) << told;
}

TEST(MakeVerb, ShiftsTheGalleryAndItsPathsTogether) {
  const TestFolder folder;
  const ProgramResult made = run_roam(
      {"make", "gallery", "-o", folder.file("far.obj"), "--triangles", "10k", "--origin", "4000000,500000,-100"});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(folder.read("far-straight.path").find("\n3986261 500253 82\n"), std::string::npos)
      << folder.read("far-straight.path");
}

TEST(MakeVerb, SaysWhatIsWrongWithTheOutput) {
  for (const auto& [file, status] : {std::pair{"/no/such/folder/city.ply", 1}, {"city.xyz", 2}, {"city", 2}}) {
    const ProgramResult result = run_roam({"make", "city", "-o", file, "--triangles", "10k"});
    EXPECT_EQ(result.status, status) << file;
    EXPECT_NE(result.err.find(file), std::string::npos) << result.err;
  }
}

TEST(MakeVerb, IsCancelledInGoodOrder) {
  const TestFolder folder;
  const ProgramResult result = run_program(
      ROAM_PROGRAM, {"make", "terrain", "-o", folder.file("huge.ply"), "--triangles", "100M"}, {.interrupt_after = 1});
  EXPECT_EQ(result.status, 130);
  EXPECT_EQ(result.err, "roam: cancelled\n");
  EXPECT_TRUE(std::filesystem::is_empty(std::filesystem::path(folder.file("huge.ply")).parent_path()));
}

}  // namespace
