// Which files a scene may be read from, and how the walls keep to it.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "import/parts.h"
#include "import/processor_budget.h"
#include "import/scene_scope.h"
#include "import_files.h"

namespace roam::test {
namespace {

namespace fs = std::filesystem;

const std::string one = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const std::string two = one + "f 3 2 1\n";

TEST(ImportScope, FollowsALinkBeforeTheDotsBehindIt) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "a");
  fs::create_directories(folder.path() / "b/inner");
  fs::create_directory_symlink(folder.path() / "b/inner", folder.path() / "a/link");
  folder.write("a/x.obj", two);
  folder.write("b/x.obj", one);
  const fs::path named = folder.path() / "a/link/../x.obj";
  EXPECT_EQ(import_scene(named).report.triangles, 1u);
  const std::vector<fs::path> paths{named};
  EXPECT_EQ(scene_parts(paths).at(0).files.at(0), fs::canonical(folder.path() / "b/x.obj"));
}

TEST(ImportScope, HoldsNoPathThatTheSystemCannotOpen) {
  const TemporaryFolder folder;
  folder.write("x.obj", one);
  reader::SceneScope scope;
  scope.folders.push_back(fs::canonical(folder.path()));
  std::string path = scope.folders[0].string();
  EXPECT_TRUE(scope.resolve(path + "/x.obj"));
  while (path.size() <= 4096) path += "/a";
  EXPECT_FALSE(scope.resolve(path));
  // A link to such a path, which the system itself never follows.
  const std::string target = std::string(4000, 'b');
  ASSERT_EQ(symlink(target.c_str(), (folder.path() / "link").c_str()), 0);
  EXPECT_FALSE(scope.resolve(scope.folders[0] / "link" / std::string(200, 'c')));
}

TEST(ImportScope, SaysWhatLeadsOutWhereNothingIsLeft) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "disk/Tile_0");
  folder.write("disk/Tile_0/Tile_0.osgb", "x");
  fs::create_directories(folder.path() / "city/Data");
  fs::create_directory_symlink(folder.path() / "disk/Tile_0", folder.path() / "city/Data/Tile_0");
  const std::string error = import_error(folder.path() / "city");
  EXPECT_TRUE(contains(error, "city/Data/Tile_0, which lies outside")) << error;
  EXPECT_TRUE(contains(error, "--allow")) << error;
}

TEST(ImportScope, ListsNoFolderForEachLinkToIt) {
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "city/Data/Tile_0");
  folder.write("city/Data/Tile_0/Tile_0.osgb", "x");
  folder.write("city/Data/Tile_0/Tile_1.osgb", "x");
  const std::vector<fs::path> city{folder.path() / "city"};
  EXPECT_EQ(scene_parts(city).size(), 1u);
  fs::create_directory_symlink("Tile_0", folder.path() / "city/Data/Tile_1");
  try {
    static_cast<void>(scene_parts(city));
    FAIL() << "expected an error";
  } catch (const Error& error) {
    EXPECT_TRUE(std::string(error.where()).ends_with("city/Data/Tile_1")) << error.what();
    EXPECT_TRUE(contains(error.what(), "same folder as Tile_0")) << error.what();
  }
}

TEST(ImportScope, RefusesALinkInThePlaceOfASceneThatNobodyNamed) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("vault/secret.obj", one), link = folder.path() / "scene.obj";
  fs::create_symlink(file, link);
  fs::create_directories(folder.path() / "vault/Data/Tile_0");
  fs::create_directory_symlink(folder.path() / "vault", folder.path() / "city");
  ImportOptions options;
  EXPECT_EQ(import_error(link, options), "") << "a user may name it";
  options.through_link = false;
  EXPECT_EQ(import_error(file, options), "");
  EXPECT_EQ(import_error(folder.path() / "city/secret.obj", options), "") << "the folders above may be links";
  for (const fs::path& path : {link, folder.path() / "city", folder.path() / "city/", folder.path() / "city/."}) {
    const std::string error = import_error(path, options);
    EXPECT_TRUE(contains(error, "this is a link")) << path << ": " << error;
    EXPECT_FALSE(contains(error, "secret") || contains(error, "vault")) << error;
    EXPECT_THROW(static_cast<void>(scene_parts(std::vector<fs::path>{path}, options)), Error);
  }
}

/// What a reader that was taken over says to a deed; `arguments` come before roam's own.
std::string deed_of(const TemporaryFolder& folder, const std::string& deed, const std::string& arguments) {
  ImportOptions options;
  options.reader = folder.write_script("reader.sh", "exec '" MISBEHAVING_READER "' " + arguments + " \"$@\"\n");
  return import_error(folder.write("scene.obj", deed), options);
}

TEST(ImportScope, LandlockLetsNoLinkIn) {
  if (reader_confinement().landlock == 0) GTEST_SKIP() << "this system has no Landlock";
  const TemporaryFolder folder;
  fs::create_symlink("/etc/passwd", folder.path() / "metadata.xml");
  fs::create_directory_symlink("/etc", folder.path() / "Data");
  EXPECT_EQ(deed_of(folder, "secret", "--file /etc/passwd"), "secret was done");
  EXPECT_TRUE(contains(deed_of(folder, "secret", "--file '" + (folder.path() / "metadata.xml").string() + "'"),
                       "secret was refused"));
  EXPECT_TRUE(contains(deed_of(folder, "secret", "--file '" + (folder.path() / "Data/passwd").string() + "'"),
                       "secret was refused"));
}

TEST(ImportScope, ReadsNoInventorFileWithoutLandlock) {
  const TemporaryFolder folder;
  const fs::path scene =
      folder.write("scene.iv", "#Inventor V2.1 ascii\nSeparator { File { name \"/etc/passwd\" } }\n");
  ImportOptions options;
  options.reader = folder.write_script("reader.sh", "exec '" ROAM_READER_PROGRAM "' --highest-landlock 0 \"$@\"\n");
  EXPECT_TRUE(contains(import_error(scene, options), "Inventor files are not read here"));
  EXPECT_FALSE(contains(import_error(scene), "Inventor files are not read here") && reader_confinement().landlock > 0);
}

TEST(ImportScope, ReportsNoLandlockWhereAThreadEscapesIt) {
  const TemporaryFolder folder;
  ImportOptions options;
  options.reader = folder.write_script("reader.sh", "exec '" MISBEHAVING_READER "' --thread before \"$@\"\n");
  EXPECT_EQ(import_error(folder.write("scene.obj", "landlock"), options), "landlock 0 was done");
}

TEST(ImportScope, ABudgetCountsNoMoreThanIsRead) {
  const TemporaryFolder folder;
  const fs::path file = folder.write("scene.obj", std::string(1u << 20, 'x'));
  auto budget = reader::ProcessorBudget::from_now_on(static_cast<int>(getpid()));
  fs::resize_file(file, std::uintmax_t{1} << 40);
  budget.add_file(file);
  std::ifstream bytes(file);
  std::string read(3u << 20, ' ');
  bytes.read(read.data(), static_cast<std::streamsize>(read.size()));
  EXPECT_LE(budget.bytes(), 4u << 20);
}

}  // namespace
}  // namespace roam::test
