// Bookmarks, and their file.
#include "view/bookmarks.h"

#include <gtest/gtest.h>

#include <thread>

#include "messages.h"
#include "program.h"

namespace {

using namespace roam;
using namespace roam::app;

TEST(Bookmarks, AreKeptForTheirSceneAlone) {
  const TestFolder folder;
  const std::filesystem::path file = folder.file("config/roam/bookmarks.json");
  Bookmarks mine(file, {"mine.obj"}, {});
  EXPECT_EQ(mine.add({{1, 2, 3}, 90, -5}).name, "1");
  EXPECT_EQ(mine.add({{4, 5, 6}, 0, 0}).name, "2");
  EXPECT_TRUE(Bookmarks(file, {"yours.obj"}, {}).all().empty());
  EXPECT_TRUE(Bookmarks(file, {"mine.obj"}, {.up = UpAxis::y}).all().empty());
  Bookmarks again(file, {std::filesystem::absolute("mine.obj")}, {});
  ASSERT_EQ(again.all().size(), 2u);
  EXPECT_EQ(again.find("1")->pose.position, Vec3(1, 2, 3));
  EXPECT_EQ(again.find("1")->pose.yaw, 90.0);
  EXPECT_EQ(again.find("1")->pose.pitch, -5.0);
  EXPECT_FALSE(again.find("3"));
  // Nothing is left beside the file.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(file.parent_path()), {}), 1);
}

TEST(Bookmarks, AreKeptForASceneWhoseNameIsNoUtf8) {
  const TestFolder folder;
  const std::filesystem::path file = folder.file("b.json");
  Bookmarks mine(file, {"caf\xe9.obj"}, {});
  EXPECT_EQ(mine.add({{1, 2, 3}, 90, -5}).name, "1");
  EXPECT_EQ(mine.add({{4, 5, 6}, 0, 0}).name, "2");
  EXPECT_EQ(Bookmarks(file, {"caf\xe9.obj"}, {}).all().size(), 2u);
  EXPECT_TRUE(Bookmarks(file, {"caf\xe8.obj"}, {}).all().empty());
}

TEST(Bookmarks, AreGivenNames) {
  const TestFolder folder;
  const std::filesystem::path file = folder.file("b.json");
  Bookmarks mine(file, {"mine.obj"}, {});
  EXPECT_TRUE(contains(error_of([&] { mine.rename("shaft"); }), "keep one first"));
  mine.add({{1, 2, 3}, 90, -5});
  mine.rename("shaft");
  EXPECT_EQ(mine.present()->name, "shaft");
  EXPECT_EQ(mine.add({{4, 5, 6}, 0, 0}).name, "1");
  EXPECT_TRUE(contains(error_of([&] { mine.rename("shaft"); }), "another bookmark has the name shaft"));
  mine.rename("1");
  Bookmarks other(file, {"mine.obj"}, {});
  EXPECT_EQ(other.names(), "shaft, 1");
  EXPECT_EQ(other.find("shaft")->pose.position, Vec3(1, 2, 3));
  // Another session has renamed it meanwhile.
  other.rename("door");
  EXPECT_TRUE(mine.find("shaft"));
  EXPECT_TRUE(contains(error_of([&] { mine.rename("hall"); }), "no longer there"));
  EXPECT_EQ(Bookmarks(file, {"mine.obj"}, {}).names(), "door, 1");
}

TEST(Bookmarks, AreReplacedInOneChange) {
  const TestFolder folder;
  const std::string file = folder.file("b.json");
  Bookmarks mine(file, {"mine.obj"}, {});
  for (const double x : {1.0, 2.0, 3.0}) mine.add({{x, 0, 0}, 0, 0});
  Bookmarks(file, {"mine.obj"}, {}).remove("3");
  EXPECT_TRUE(contains(error_of([&] { mine.rename("1", true); }), "no longer there"));
  EXPECT_EQ(Bookmarks(file, {"mine.obj"}, {}).names(), "1, 2") << "the other one stays";
  mine.find("2");
  mine.rename("1", true);
  EXPECT_EQ(mine.names(), "1");
  EXPECT_EQ(mine.present()->pose.position.x, 2.0);
  EXPECT_EQ(Bookmarks(file, {"mine.obj"}, {}).find("1")->pose.position.x, 2.0);
}

TEST(Bookmarks, OfAnotherFrameAreNotTakenButKnown) {
  const TestFolder folder;
  const std::filesystem::path file = folder.file("b.json");
  const SceneFrame turned{UpAxis::minus_y, LengthUnit::cm};
  Bookmarks(file, {"mine.obj"}, turned).add({{1, 2, 3}, 90, -5});
  Bookmarks plain(file, {"mine.obj"}, {});
  EXPECT_FALSE(plain.find("1"));
  EXPECT_EQ(plain.frame_elsewhere("1"), turned);
  EXPECT_FALSE(plain.frame_elsewhere("2"));
  EXPECT_TRUE(Bookmarks(file, {"mine.obj"}, turned).find("1"));
}

TEST(Bookmarks, OfAnOldFileAreOfTheFrameWithoutOptions) {
  const TestFolder folder;
  const std::string file =
      folder.write("b.json",
                   "[{\"scene\": [\"/house.glb\"], \"up\": \"\", \"unit\": \"m\", \"bookmarks\": [{\"name\": "
                   "\"1\", \"position\": [1, 2, 3]}]}]");
  const SceneFrame gltf{.up = UpAxis::y};
  EXPECT_TRUE(Bookmarks(file, {"/house.glb"}, gltf, gltf).find("1"));
  EXPECT_EQ(Bookmarks(file, {"/house.glb"}, {}, gltf).frame_elsewhere("1"), gltf);
}

TEST(Bookmarks, KeepWhatAnotherSessionHasWrittenMeanwhile) {
  const TestFolder folder;
  Bookmarks one(folder.file("b.json"), {"mine.obj"}, {});
  Bookmarks two(folder.file("b.json"), {"mine.obj"}, {});
  one.add({{1, 0, 0}, 0, 0});
  EXPECT_EQ(two.add({{2, 0, 0}, 0, 0}).name, "2");
  EXPECT_EQ(two.all().size(), 2u);
}

TEST(Bookmarks, KeepWhatAnotherSessionWritesAtTheSameTime) {
  const TestFolder folder;
  const std::string file = folder.file("b.json");
  const auto add_some = [&] {
    Bookmarks some(file, {"mine.obj"}, {});
    for (int i = 0; i < 50; ++i) some.add({{1, 0, 0}, 0, 0});
  };
  std::thread other(add_some);
  add_some();
  other.join();
  EXPECT_EQ(Bookmarks(file, {"mine.obj"}, {}).all().size(), 100U);
}

TEST(Bookmarks, OfSeveralEntriesAreKept) {
  const TestFolder folder;
  const std::string entry = R"({"scene": ["/mine.obj"], "bookmarks": [{"name": "NAME", "position": [1, 2, 3]}]})";
  const auto named = [&](const char* name) { return std::string(entry).replace(entry.find("NAME"), 4, name); };
  const std::string file = folder.write("b.json", "[" + named("door") + ", " + named("shaft") + "]");
  Bookmarks mine(file, {"/mine.obj"}, {});
  EXPECT_EQ(mine.names(), "door, shaft");
  mine.add({{4, 5, 6}, 0, 0});
  EXPECT_EQ(mine.names(), "door, shaft, 1");
  mine.remove("shaft");
  EXPECT_EQ(Bookmarks(file, {"/mine.obj"}, {}).names(), "door, 1");
}

TEST(Bookmarks, NeverWriteOverAFileThatTheyDoNotUnderstand) {
  const TestFolder folder;
  const std::string file = folder.write("b.json", "{\"mine\": 1}");
  const std::string what = error_of([&] { Bookmarks(file, {"mine.obj"}, {}); });
  EXPECT_TRUE(contains(what, file) && contains(what, "list of scenes")) << what;
  EXPECT_EQ(folder.read("b.json"), "{\"mine\": 1}");
}

}  // namespace
