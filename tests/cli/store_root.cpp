// A store whose CURRENT or manifest is gone or damaged: what roam build, verify and info make of it.
#include <nlohmann/json.hpp>

#include "store_builds.h"
#include "store_verbs.h"

namespace {

using namespace store_verbs;
using nlohmann::json;

class StoreRoot : public StoreVerbs {
 protected:
  static fs::path only_file(const std::string& folder) { return fs::directory_iterator(folder)->path(); }
  static fs::path manifest_of(const std::string& store) { return only_file(store + "/manifests"); }
  static void empty(const fs::path& file) { fs::resize_file(file, 0); }

  struct Loss {
    const char* what;
    void (*happens)(const std::string& store);
  };
  /// Each leaves a whole copy of the manifest.
  static constexpr Loss losses[] = {
      {"no CURRENT", [](const std::string& s) { fs::remove(s + "/CURRENT"); }},
      {"an empty CURRENT", [](const std::string& s) { empty(s + "/CURRENT"); }},
      {"another CURRENT", [](const std::string& s) { std::ofstream(s + "/CURRENT") << "MANIFEST-000042\n"; }},
      {"a CURRENT that leads nowhere",
       [](const std::string& s) {
         fs::remove(s + "/CURRENT");
         fs::create_symlink("nothing", s + "/CURRENT");
       }},
      {"no manifest", [](const std::string& s) { fs::remove(manifest_of(s)); }},
      {"an empty manifest", [](const std::string& s) { empty(manifest_of(s)); }},
      {"a damaged manifest", [](const std::string& s) { flip(manifest_of(s), 100); }},
      {"no manifests", [](const std::string& s) { fs::remove_all(s + "/manifests"); }},
      {"neither CURRENT nor manifests",
       [](const std::string& s) {
         fs::remove(s + "/CURRENT");
         fs::remove_all(s + "/manifests");
       }},
      {"a damaged spare", [](const std::string& s) { flip(only_file(s + "/spare"), 100); }},
  };
};

TEST_F(StoreRoot, IsFoundDamagedWithTheAnswerNo) {
  for (const Loss& loss : losses) {
    const TestFolder folder;
    const std::string bad = copy(folder);
    loss.happens(bad);
    const ProgramResult verified = run({"verify", bad, "--json"});
    EXPECT_EQ(verified.status, 3) << loss.what << verified.err;
    const json found = json::parse(verified.out);
    EXPECT_FALSE(found["whole"]) << loss.what;
    EXPECT_EQ(found["damage"].size(), 1U) << loss.what << verified.out;
    EXPECT_TRUE(contains(run({"verify", bad}).out, "--repair")) << loss.what;
  }
}

TEST_F(StoreRoot, IsMendedByABuildWhichSaysSoAndReadsNothingAgain) {
  for (const Loss& loss : losses) {
    const TestFolder folder;
    const std::string bad = copy(folder);
    loss.happens(bad);
    const ProgramResult built = run({"build", scene(), "-o", bad, "--json"});
    ASSERT_EQ(built.status, 0) << loss.what << built.err;
    const json report = json::parse(built.out);
    EXPECT_EQ(report["parts_read"], 0) << loss.what;
    EXPECT_EQ(report["shards_built"], 0) << loss.what;
    EXPECT_EQ(contains(built.err, "was damaged: "), loss.what != std::string("a damaged spare")) << built.err;
    store_builds::expect_same(bad, store());
    EXPECT_EQ(run({"verify", bad}).status, 0) << loss.what;
  }
}

TEST_F(StoreRoot, IsRepairedAsItWasBuilt) {
  const TestFolder folder;
  const std::string whole = folder.file("whole.roam");
  ASSERT_EQ(run({"build", scene(), "-o", whole, "--unit", "ft", "--lossless"}).status, 0);
  for (const Loss& loss : losses) {
    const std::string bad = folder.file("bad.roam");
    fs::remove_all(bad);
    fs::copy(whole, bad, fs::copy_options::recursive);
    loss.happens(bad);
    const ProgramResult repaired = run({"verify", bad, "--repair", scene()});
    ASSERT_EQ(repaired.status, 0) << loss.what << repaired.err << repaired.out;
    store_builds::expect_same(bad, whole);
  }
}

TEST_F(StoreRoot, WithoutAnyCopyIsBuiltAgainButNotRepaired) {
  const TestFolder folder;
  const std::string bad = copy(folder);
  for (const char* name : {"CURRENT", "manifests", "spare"}) fs::remove_all(bad + "/" + name);
  EXPECT_EQ(run({"verify", bad}).status, 3);
  const ProgramResult repaired = run({"verify", bad, "--repair", scene()});
  EXPECT_EQ(repaired.status, 1) << repaired.out;
  EXPECT_TRUE(contains(repaired.err, "roam build") && contains(repaired.err, "--lossless")) << repaired.err;
  // Nothing is left to show whose it was.
  const ProgramResult refused = run({"build", scene(), "-o", bad});
  EXPECT_EQ(refused.status, 1) << refused.out;
  EXPECT_TRUE(contains(refused.err, "--adopt")) << refused.err;
  const ProgramResult built = run({"build", scene(), "-o", bad, "--adopt"});
  EXPECT_EQ(built.status, 0) << built.err;
  EXPECT_TRUE(contains(built.err, "built again")) << built.err;
  store_builds::expect_same(bad, store());
}

TEST_F(StoreRoot, IsNamedByWhoeverOpensTheStore) {
  for (const Loss& loss : losses) {
    if (loss.what == std::string("a damaged spare")) continue;  // nobody needs it
    const TestFolder folder;
    const std::string bad = copy(folder);
    loss.happens(bad);
    for (const std::vector<std::string>& verb : {std::vector<std::string>{"info", bad},
                                                 {"sweep", bad},
                                                 {"walk", bad, "--path", path()},
                                                 {"view", bad, "--headless", "--time", "1"}}) {
      const ProgramResult told = run(verb);
      EXPECT_EQ(told.status, 1) << verb[0] << loss.what;
      EXPECT_TRUE(contains(told.err, "is damaged") && contains(told.err, "roam build")) << verb[0] << told.err;
    }
  }
}

TEST_F(StoreRoot, OfAnotherProgramIsLeftAlone) {
  const TestFolder folder;
  const std::string database = folder.file("database");
  fs::create_directory(database);
  folder.write("database/CURRENT", "MANIFEST-000042\n");
  for (const bool more : {true, false}) {
    if (more) folder.write("database/000042.log", "");
    if (!more) fs::remove(database + "/000042.log");
    EXPECT_EQ(run({"build", scene(), "-o", database}).status, 1);
    EXPECT_EQ(run({"verify", database}).status, 1);
    EXPECT_EQ(run({"verify", database, "--repair", scene()}).status, 1);
    EXPECT_EQ(folder.read("database/CURRENT"), "MANIFEST-000042\n");
  }
}

TEST_F(StoreRoot, OfANewerFormatIsNotMended) {
  const TestFolder folder;
  const std::string newer = copy(folder);
  std::string current = folder.read("copy.roam/CURRENT");
  current.replace(current.find(" 1\n"), 3, " 9\n");
  folder.write("copy.roam/CURRENT", current);
  for (const auto& verb :
       {std::vector<std::string>{"build", scene(), "-o", newer}, {"verify", newer, "--repair", scene()}}) {
    const ProgramResult told = run(verb);
    EXPECT_EQ(told.status, 1) << verb[0];
    EXPECT_TRUE(contains(told.err, "newer roam")) << told.err;
  }
  EXPECT_EQ(folder.read("copy.roam/CURRENT"), current);
}

}  // namespace
