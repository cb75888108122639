// A store from a stranger: links, pipes and folders in it lead nowhere, and nothing outside of it is changed.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <set>

#include "store/folder.h"
#include "store_builds.h"

namespace {

using namespace store_builds;
using roam::Vec3;

/// A store, the same for all tests, and beside it a folder of somebody's, which must stay as it is.
class StoreLinks : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    made_ = new TestFolder;
    write_ply(made_->file("a.ply"), field(60, 1.0, Vec3(0.0)));
    roam::build_store(options({made_->file("a.ply")}, made_->file("s")));
  }
  static void TearDownTestSuite() { delete made_; }

  void SetUp() override {
    fs::copy(made_->file("s"), store(), fs::copy_options::recursive);
    fs::copy(made_->file("a.ply"), scene());
    folder_.write("s/sources.json", "{}");
    fs::create_directories(folder_.file("home/inner"));
    folder_.write("home/letter.txt", "dear");
    // Of the very shape of what a store holds: only where they are says that they are not its own.
    for (const char* extension : {".pack", ".part", ".json"}) {
      folder_.write("home/" + std::string(64, 'e') + extension, "precious");
    }
    folder_.write("home/new.pack.1.0.unfinished", "precious");
    before_ = home();
  }
  void TearDown() override { EXPECT_TRUE(home() == before_) << "what lies outside of the store was changed"; }

  [[nodiscard]] std::string store() const { return folder_.file("s"); }
  [[nodiscard]] std::string scene() const { return folder_.file("a.ply"); }
  /// Something of the folder that is not the store's.
  [[nodiscard]] std::string outside(const std::string& name) const { return folder_.file("home/" + name); }
  [[nodiscard]] std::map<std::string, std::string> home() const { return content(folder_.file("home")); }
  [[nodiscard]] std::string only_file(const std::string& folder) const {
    return fs::directory_iterator(store() + "/" + folder)->path();
  }

  void build() const { roam::build_store(options({scene()}, store())); }
  /// Opens the store and reads all that is in it.
  void read() const {
    const auto opened = roam::Store::open(store());
    std::uint64_t count = 0;
    roam::TriangleId some = 0;
    opened->for_each_triangle(opened->info().bounds, [&](auto triangles, auto ids) {
      count += triangles.size();
      some = ids[0];
    });
    EXPECT_EQ(count, opened->info().triangles);
    EXPECT_EQ(opened->source(some).part, "a.ply");
  }
  /// What a verification finds, or says where it cannot be done.
  [[nodiscard]] std::string verified() const {
    try {
      std::string text;
      for (const auto& damage : roam::verify_store(store()).damage) text += damage.what + ": " + damage.why + "\n";
      return text;
    } catch (const roam::Error& error) {
      return error.what();
    }
  }

  static inline TestFolder* made_ = nullptr;
  const TestFolder folder_;
  std::map<std::string, std::string> before_;
};

TEST_F(StoreLinks, AFolderThatIsALinkIsRefusedByNameAndItsTargetLeftAlone) {
  for (const std::string folder : {"packs", "parts", "manifests", "spare", "scratch"}) {
    fs::remove_all(store());
    fs::copy(made_->file("s"), store(), fs::copy_options::recursive);
    const fs::path link = fs::path(store()) / folder;
    // All that the store needs is there; so nothing but the link is wrong.
    if (fs::exists(link)) {
      for (const auto& entry : fs::directory_iterator(link)) {
        fs::copy_file(entry.path(), outside(entry.path().filename()), fs::copy_options::overwrite_existing);
      }
    }
    before_ = home();
    fs::remove_all(link);
    fs::create_directory_symlink(folder_.file("home"), link);
    EXPECT_NE(refusal([&] { build(); }).find(link.string() + " is a symbolic link"), std::string::npos) << folder;
    if (folder != "spare" && folder != "scratch") {
      EXPECT_NE(refusal([&] { read(); }), "") << folder;
      EXPECT_NE(verified().find("symbolic link"), std::string::npos) << folder << ": " << verified();
    }
    EXPECT_TRUE(home() == before_) << folder;
  }
}

TEST_F(StoreLinks, AFileThatIsALinkIsRefusedByNameAndItsTargetLeftAlone) {
  for (const std::string folder : {"packs", "parts", "manifests"}) {
    fs::remove_all(store());
    fs::copy(made_->file("s"), store(), fs::copy_options::recursive);
    const std::string file = only_file(folder);
    // It leads to what should be there.
    const std::string target = outside("target");
    fs::copy_file(file, target, fs::copy_options::overwrite_existing);
    before_ = home();
    fs::remove(file);
    fs::create_symlink(target, file);
    EXPECT_NE(refusal([&] { read(); }).find("symbolic link"), std::string::npos) << refusal([&] { read(); });
    EXPECT_NE(verified().find("symbolic link"), std::string::npos) << verified();
    // The manifest is mended from its spare; nobody can build what lies elsewhere.
    const std::string refused = refusal([&] { build(); });
    EXPECT_EQ(refused.find(file + " is a symbolic link") == std::string::npos, folder == "manifests") << refused;
    EXPECT_TRUE(home() == before_) << folder;
  }
}

TEST_F(StoreLinks, CurrentThatIsALinkIsRefusedAndReplaced) {
  fs::rename(store() + "/CURRENT", outside("CURRENT"));
  before_ = home();
  fs::create_symlink(outside("CURRENT"), store() + "/CURRENT");
  const std::string refused = refusal([&] { read(); });
  EXPECT_NE(refused.find("CURRENT"), std::string::npos) << refused;
  EXPECT_NE(refused.find("symbolic link"), std::string::npos) << refused;
  EXPECT_NE(verified().find("symbolic link"), std::string::npos) << verified();
  build();
  EXPECT_FALSE(fs::is_symlink(store() + "/CURRENT"));
  read();
}

TEST_F(StoreLinks, ALockThatLeadsElsewhereIsNotWrittenTo) {
  const std::string lock = store() + "/LOCK", letter = outside("letter.txt");
  fs::remove(lock);
  fs::create_symlink(letter, lock);
  EXPECT_NE(refusal([&] { build(); }).find(lock + " is a symbolic link"), std::string::npos)
      << refusal([&] { build(); });
  fs::remove(lock);
  fs::create_symlink(outside("not there"), lock);
  EXPECT_NE(refusal([&] { build(); }), "");
  fs::remove(lock);
  fs::create_hard_link(letter, lock);
  EXPECT_NE(refusal([&] { build(); }).find("LOCK"), std::string::npos);
  // A number of a process, by chance: it must not be overwritten either.
  const std::string number = folder_.write("home/number", "12\n");
  before_ = home();
  fs::remove(lock);
  fs::create_hard_link(number, lock);
  EXPECT_NE(refusal([&] { build(); }).find("other names"), std::string::npos) << refusal([&] { build(); });
  fs::remove(lock);
  build();
}

TEST_F(StoreLinks, SourcesThatAreALinkAreRefused) {
  fs::remove(store() + "/sources.json");
  fs::create_symlink(outside("letter.txt"), store() + "/sources.json");
  EXPECT_NE(refusal([&] { build(); }).find("sources.json is a symbolic link"), std::string::npos);
}

TEST_F(StoreLinks, PipesAndFoldersInThePlaceOfFilesAreRefusedAndNotWaitedFor) {
  for (const std::string& name : {only_file("packs"), only_file("parts"), only_file("manifests"), store() + "/CURRENT",
                                  store() + "/LOCK", store() + "/sources.json"}) {
    for (const bool pipe : {true, false}) {
      const std::string aside = folder_.file("aside");
      fs::rename(name, aside);
      if (pipe) {
        ASSERT_EQ(::mkfifo(name.c_str(), 0600), 0);
      } else {
        fs::create_directory(name);
      }
      const bool of_builder = name.ends_with("LOCK") || name.ends_with("sources.json");
      if (!of_builder) {
        EXPECT_NE(refusal([&] { read(); }), "") << name;
        EXPECT_NE(verified(), "") << name;
      }
      // CURRENT and the manifest it may mend.
      if (of_builder || name.find("pa") != std::string::npos) {
        EXPECT_NE(refusal([&] { build(); }), "") << name;
      }
      fs::remove(name);
      fs::rename(aside, name);
    }
  }
  build();
  read();
}

TEST_F(StoreLinks, OnlyWhatTheBuilderWroteIsTidied) {
  const std::string hash(64, 'a');
  const std::set<std::string> ours{"packs/" + hash + ".pack",
                                   "packs/new.pack.12.3.unfinished",
                                   "parts/" + hash + ".part",
                                   "spare/" + hash + ".json",
                                   "spare/" + hash + ".json.1.0.unfinished",
                                   "manifests/new.json.1.0.unfinished",
                                   "CURRENT.1.0.unfinished",
                                   "sources.json.7.1.unfinished",
                                   "scratch/plan.json",
                                   "scratch/plan.json.7.1.unfinished",
                                   "scratch/parts/" + hash.substr(0, 24) + ".json",
                                   "scratch/runs/" + hash.substr(0, 24) + ".0.run",
                                   "scratch/shards/" + hash + ".json"};
  const std::set<std::string> others{"packs/notes.txt",
                                     "packs/" + hash.substr(1) + ".pack",
                                     "packs/A" + hash.substr(1) + ".pack",
                                     "packs/" + hash + ".part",
                                     "parts/thesis.unfinished",
                                     "spare/x.json",
                                     "film.unfinished",
                                     "thesis.1.0.unfinished",
                                     "scratch/photo.jpg",
                                     "scratch/runs/a.run",
                                     "scratch/deep/letter",
                                     "manifests/readme.json"};
  for (const char* name : {"scratch/parts", "scratch/runs", "scratch/shards", "scratch/deep"}) {
    fs::create_directories(store() + "/" + name);
  }
  for (const auto* names : {&ours, &others}) {
    for (const std::string& name : *names) std::ofstream(store() + "/" + name) << "{}";
  }
  fs::create_symlink(outside("letter.txt"), store() + "/packs/" + std::string(64, 'b') + ".pack");
  const roam::StoreBuildReport report = roam::build_store(options({scene()}, store()));
  EXPECT_TRUE(report.unchanged);
  for (const std::string& name : ours) EXPECT_FALSE(fs::exists(store() + "/" + name)) << name;
  for (const std::string& name : others) EXPECT_TRUE(fs::exists(store() + "/" + name)) << name;
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_NE(report.notes[0].find("/s/scratch could not be removed"), std::string::npos) << report.notes[0];
}

TEST_F(StoreLinks, AFileOfAPlanLiesInTheStore) {
  const auto o = options({scene()}, folder_.file("new"));
  roam::StoreBuildReport report;
  ASSERT_EQ(roam::plan_store(o, report), 1U);
  const std::string plan = folder_.file("new/scratch/plan.json");
  std::ifstream in(plan);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  for (const std::string field : {"\"id\": \"", "\"file\": \""}) {
    std::string hostile = text;
    hostile.replace(text.find(field) + field.size(), 9, "../../../");
    std::ofstream(plan) << hostile;
    EXPECT_NE(refusal([&] { roam::build_task(o, 0, report); }).find("plan again"), std::string::npos) << field;
  }
}

TEST_F(StoreLinks, TheStoreItselfMayBeReachedByALink) {
  const std::string link = folder_.file("link");
  fs::create_directory_symlink(store(), link);
  EXPECT_TRUE(roam::Store::is_store(link));
  EXPECT_TRUE(roam::verify_store(link).whole());
  EXPECT_TRUE(roam::build_store(options({scene()}, link)).unchanged);
}

TEST(StoreFolder, RemovesNothingThatLiesDeeperThanAnythingOfAStore) {
  const TestFolder folder;
  const roam::store::Folder store(folder.file(""));
  std::string deep = "packs";
  for (int i = 0; i < 20; ++i) {
    make_folder_in(store, deep);
    folder.write(deep + "/file", "text");
    deep += "/a";
  }
  remove_all(store, "packs");
  for (const char* file : {"packs/file", "packs/a/file", "packs/a/a/file"}) EXPECT_FALSE(is_file(store, file)) << file;
  EXPECT_TRUE(is_file(store, "packs/a/a/a/file"));
  make_folder_in(store, "scratch/runs");
  folder.write("scratch/runs/a.run", "text");
  remove_all(store, "scratch");
  EXPECT_FALSE(fs::exists(folder.file("scratch")));
}

}  // namespace
