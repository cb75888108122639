// The profile beside a scene: written whole, read strictly, and only for the scene that it was trained on.
#include "roam/profile.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "messages.h"
#include "profile_made.h"
#include "program.h"
#include "roam/store.h"

namespace {

using Json = nlohmann::ordered_json;
using made::complaint;
using made::full_profile;
using made::scene;

void expect_same(const roam::Profile& a, const roam::Profile& b) {
  EXPECT_EQ(a.scene.hash, b.scene.hash);
  EXPECT_EQ(a.scene.geometry_hash, b.scene.geometry_hash);
  EXPECT_EQ(a.scene.triangles, b.scene.triangles);
  EXPECT_EQ(a.scene.bounds.lower, b.scene.bounds.lower);
  EXPECT_EQ(a.scene.bounds.upper, b.scene.bounds.upper);
  EXPECT_EQ(a.mode, b.mode);
  EXPECT_EQ(a.radius, b.radius);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.support_radius, b.support_radius);
  EXPECT_EQ(a.step, b.step);
  EXPECT_EQ(a.slope_degrees, b.slope_degrees);
  EXPECT_EQ(a.largest, b.largest);
  EXPECT_EQ(a.smallest, b.smallest);
  EXPECT_EQ(a.method, b.method);
  EXPECT_EQ(a.complete, b.complete);
  ASSERT_EQ(a.regions.size(), b.regions.size());
  for (std::size_t i = 0; i < a.regions.size(); ++i) {
    EXPECT_EQ(a.regions[i].bounds.lower, b.regions[i].bounds.lower);
    EXPECT_EQ(a.regions[i].bounds.upper, b.regions[i].bounds.upper);
    EXPECT_EQ(a.regions[i].radius, b.regions[i].radius);
    EXPECT_EQ(a.regions[i].support_radius, b.regions[i].support_radius);
    EXPECT_EQ(a.regions[i].why, b.regions[i].why);
  }
}

std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().filename());
  return names;
}

TEST(Profile, IsReadAsItWasWrittenToTheLastBit) {
  const TestFolder folder;
  const std::string file = folder.file("dam.ply.roam.json");
  roam::Profile profile = full_profile();
  roam::save_profile(profile, file);
  expect_same(roam::load_profile(file), profile);
  profile.largest.reset();
  profile.mode = roam::Mode::fly;
  profile.regions.clear();
  profile.scene.hash.clear();
  profile.scene.geometry_hash = "0123456789abcdef";
  roam::save_profile(profile, file);
  expect_same(roam::load_profile(file), profile);
  EXPECT_EQ(files_in(std::filesystem::path(file).parent_path()).size(), 1u);
  EXPECT_TRUE(folder.read("dam.ply.roam.json").starts_with(roam::profile_start));
}

TEST(Profile, HasTheMembersThatAreDocumented) {
  const TestFolder folder;
  roam::save_profile(full_profile(), folder.file("p.json"));
  const Json json = Json::parse(folder.read("p.json"));
  std::vector<std::string> names;
  for (const auto& [name, value] : json.items()) names.push_back(name);
  EXPECT_EQ(names, (std::vector<std::string>{"roam_profile", "scene", "mode", "radius", "height", "support_radius",
                                             "step", "slope", "interval", "regions", "method", "complete"}));
  EXPECT_EQ(json["roam_profile"], 1);
  EXPECT_EQ(json["scene"]["triangles"], 2);
  EXPECT_EQ(json["scene"]["hash"].get<std::string>().size(), 32u);
  EXPECT_TRUE(json["scene"]["geometry_hash"].is_null());
  EXPECT_EQ(json["interval"]["min"], 0.125);
  EXPECT_EQ(json["regions"][0]["why"], "door 0.41 m wide");
}

TEST(Profile, LiesBesideItsSceneAndItsStore) {
  const auto path = [](const char* scene) { return roam::profile_path(std::filesystem::path(scene)).string(); };
  EXPECT_EQ(path("dam.ply"), "dam.ply.roam.json");
  EXPECT_EQ(path("dam.ply.roam"), "dam.ply.roam.json");
  EXPECT_EQ(path("dam.ply.roam/"), "dam.ply.roam.json");
  EXPECT_EQ(path("stores/dam.roam"), "stores/dam.roam.json");
  EXPECT_EQ(path("/data/Data/"), "/data/Data.roam.json");
  EXPECT_EQ(path("./Data"), "Data.roam.json");
  EXPECT_EQ(path("."), std::filesystem::current_path().string() + ".roam.json");
  const std::vector<std::filesystem::path> two{"x/a.ply", "./x/b.ply"};
  EXPECT_EQ(roam::profile_path(two).string(), "x/a.ply+b.ply.roam.json");
}

TEST(Profile, OfFilesThatLieElsewhereIsAnotherFile) {
  const auto path = [](const std::vector<std::filesystem::path>& scenes) {
    return roam::profile_path(scenes).string();
  };
  const std::string apart = path({"x/a.ply", "y/b.ply"});
  EXPECT_TRUE(apart.starts_with("x/a.ply+b.ply-") && apart.ends_with(".roam.json")) << apart;
  EXPECT_NE(apart, path({"x/a.ply", "z/b.ply"}));
  const std::filesystem::path here = std::filesystem::current_path();
  EXPECT_EQ((here / apart).string(), path({here / "x/a.ply", "y/../y/b.ply"})) << "from wherever it is named";
  std::vector<std::filesystem::path> many(100, "x/part.ply");
  const std::string cut = path(many);
  EXPECT_TRUE(cut.starts_with("x/part.ply+99-") && cut.size() < 50) << cut;
  many.back() = "x/other.ply";
  EXPECT_NE(cut, path(many));
}

TEST(Profile, OfAnEmptyPathIsRefusedByTheOneTypeOfError) {
  const std::vector<std::filesystem::path> scenes{"a.ply", ""}, none;
  const std::filesystem::path empty;
  for (const std::function<void()>& ask : std::vector<std::function<void()>>{
           [&] { (void)roam::profile_path(empty); }, [&] { (void)roam::find_profile(empty); },
           [&] { (void)roam::profile_path(scenes); }, [&] { (void)roam::find_profile(scenes); }}) {
    EXPECT_TRUE(contains(complaint(ask), "empty; name its file or folder")) << complaint(ask);
  }
  EXPECT_THROW((void)roam::profile_path(none), roam::Error);
}

TEST(Profile, IsFoundBesideTheSceneOrNotAtAll) {
  const TestFolder folder;
  const std::filesystem::path dam = folder.file("dam.ply");
  EXPECT_FALSE(roam::find_profile(dam).has_value());
  roam::save_profile(full_profile(), folder.file("dam.ply.roam.json"));
  ASSERT_TRUE(roam::find_profile(dam).has_value());
  EXPECT_TRUE(roam::find_profile(folder.file("dam.ply.roam")).has_value());
  EXPECT_FALSE(roam::find_profile(folder.file("other.ply")).has_value());
  folder.write("dam.ply.roam.json", "");
  EXPECT_THROW((void)roam::find_profile(dam), roam::Error);
}

TEST(Profile, OfAnotherSceneIsNotFoundInSilence) {
  const TestFolder folder;
  const std::filesystem::path dam = folder.file("dam.ply");
  EXPECT_FALSE(roam::find_profile(dam, roam::identity_of(scene())));
  roam::save_profile(full_profile(), folder.file("dam.ply.roam.json"));
  EXPECT_TRUE(roam::find_profile(dam, roam::identity_of(scene())));
  const std::string said =
      complaint([&] { (void)roam::find_profile(dam, roam::identity_of(std::vector<roam::Mesh>{})); });
  EXPECT_TRUE(contains(said, "dam.ply.roam.json is of another scene")) << said;
  EXPECT_TRUE(contains(said, "train again")) << said;
}

TEST(Profile, ThatIsNotThereOrNotGoodSaysWhatToDo) {
  const TestFolder folder;
  const std::string missing = complaint([&] { (void)roam::load_profile(folder.file("nope.json")); });
  EXPECT_TRUE(contains(missing, "nope.json: No such file or directory; check its name")) << missing;
  EXPECT_TRUE(contains(complaint([] { (void)roam::load_profile(""); }), "name the file"));
  EXPECT_TRUE(contains(complaint([] { roam::save_profile(full_profile(), ""); }), "name the file"));
  roam::Profile profile = full_profile();
  profile.scene = {};
  const std::string nameless = complaint([&] { roam::save_profile(profile, folder.file("p.json")); });
  EXPECT_TRUE(contains(nameless, "p.json") && contains(nameless, "set Profile::scene to identity_of")) << nameless;
  profile = full_profile();
  profile.method = "guessed";
  const std::string method = complaint([&] { roam::save_profile(profile, folder.file("p.json")); });
  EXPECT_TRUE(contains(method, "p.json") && contains(method, "\"guessed\"")) << method;
  profile = full_profile();
  profile.mode = roam::Mode::ghost;
  EXPECT_TRUE(contains(complaint([&] { roam::check(profile); }), "not \"ghost\""));
}

TEST(Profile, BelongsToItsSceneAlone) {
  roam::Profile profile;
  profile.scene = roam::identity_of(scene());
  EXPECT_TRUE(profile.belongs_to(roam::identity_of(scene())));
  auto moved = scene();
  moved[0].vertices[2].x = std::nextafter(moved[0].vertices[2].x, 0.0);
  EXPECT_FALSE(profile.belongs_to(roam::identity_of(moved)));
  auto fewer = scene();
  fewer[0].triangles.pop_back();
  EXPECT_FALSE(profile.belongs_to(roam::identity_of(fewer)));
  auto zero = scene();
  zero[0].vertices[3].z = 0.0;  // as good as -0
  EXPECT_TRUE(profile.belongs_to(roam::identity_of(zero)));
}

TEST(Profile, OfASceneBelongsToTheStoreOfTheSameTriangles) {
  roam::Profile profile;
  profile.scene = roam::identity_of(scene());
  roam::StoreInfo store;
  store.geometry_hash = "0123456789abcdef";
  store.triangles = profile.scene.triangles;
  store.bounds = profile.scene.bounds;
  EXPECT_TRUE(profile.belongs_to(roam::identity_of(store)));
  roam::Profile of_store;
  of_store.scene = roam::identity_of(store);
  EXPECT_TRUE(of_store.belongs_to(roam::identity_of(scene())));
  EXPECT_TRUE(of_store.belongs_to(roam::identity_of(store)));
  roam::StoreInfo other = store;
  other.geometry_hash = "0123456789abcdee";
  EXPECT_FALSE(of_store.belongs_to(roam::identity_of(other)));
  other = store;
  other.triangles = 3;
  EXPECT_FALSE(profile.belongs_to(roam::identity_of(other)));
  other = store;
  other.bounds.upper.z += 1e-9;
  EXPECT_FALSE(profile.belongs_to(roam::identity_of(other)));
}

TEST(Profile, GivesAPersonTheBodyThatWasTrained) {
  const roam::Profile profile = full_profile();
  roam::WalkerSettings person;
  person.speed = 3.0;
  const roam::WalkerSettings body = roam::apply(profile, person);
  EXPECT_EQ(body.radius, profile.radius);
  EXPECT_EQ(body.height, 1.8);
  EXPECT_EQ(body.step, 0.25);
  EXPECT_EQ(body.slope_degrees, 50.0);
  EXPECT_EQ(body.support_radius, 0.45);
  EXPECT_EQ(body.eye, 1.6);
  EXPECT_EQ(body.speed, 3.0);
  roam::check(body);
  roam::Profile low = profile;
  low.height = 1.2;
  EXPECT_EQ(roam::apply(low, person).eye, 1.2);
  roam::Profile sphere = profile;
  sphere.height = 2.0 * sphere.radius;
  EXPECT_EQ(roam::apply(sphere, person).eye, roam::WalkerSettings::sphere(sphere.radius).eye);
}

TEST(Profile, PassesOverMembersThatItDoesNotKnow) {
  const TestFolder folder;
  const std::string file = folder.file("p.json");
  roam::save_profile(full_profile(), file);
  Json json = Json::parse(folder.read("p.json"));
  json["seed"] = 7;
  json["regions"][0]["colour"] = "red";
  folder.write("p.json", json.dump());
  expect_same(roam::load_profile(file), full_profile());
}

TEST(Profile, ReplacesOnlyAProfile) {
  const TestFolder folder;
  folder.write("room.ply", "ply\n");
  const std::string file = folder.file("room.ply"), link = folder.file("link.json");
  const std::string said = complaint([&] { roam::save_profile(full_profile(), file); });
  EXPECT_TRUE(contains(said, file) && contains(said, "no profile")) << said;
  EXPECT_EQ(folder.read("room.ply"), "ply\n");
  // As another program may write it.
  folder.write("dense.json", "\xef\xbb\xbf{\"roam_profile\":1}");
  roam::save_profile(full_profile(), folder.file("dense.json"));
  expect_same(roam::load_profile(folder.file("dense.json")), full_profile());
  std::filesystem::create_symlink(file, link);
  roam::save_profile(full_profile(), link);
  roam::save_profile(full_profile(), link);
  EXPECT_FALSE(std::filesystem::is_symlink(link));
  expect_same(roam::load_profile(link), full_profile());
  EXPECT_EQ(folder.read("room.ply"), "ply\n");
}

TEST(Profile, ThatCannotBeWrittenLeavesWhatWasThere) {
  const TestFolder folder;
  const std::string file = folder.file("p.json");
  roam::save_profile(full_profile(), file);
  const std::string before = folder.read("p.json");
  roam::Profile longer = full_profile();
  for (int i = 0; i < 200; ++i) longer.regions.push_back(longer.regions[0]);
  // A disk that is full after 4 kB.
  rlimit old{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old), 0);
  rlimit small = old;
  small.rlim_cur = 4096;
  std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string said = complaint([&] { roam::save_profile(longer, file); });
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old), 0);
  EXPECT_TRUE(contains(said, "cannot write " + file)) << said;
  EXPECT_EQ(folder.read("p.json"), before);
  EXPECT_EQ(files_in(std::filesystem::path(file).parent_path()).size(), 1u);
  EXPECT_TRUE(contains(complaint([&] { roam::save_profile(longer, folder.file("no/p.json")); }), "cannot write"));
}

TEST(Profile, IsNeverWrittenWithWhatWouldNotBeRead) {
  const TestFolder folder;
  roam::Profile profile = full_profile();
  profile.radius = std::nan("");
  EXPECT_THROW(roam::save_profile(profile, folder.file("p.json")), roam::Error);
  profile = full_profile();
  profile.regions[0].bounds = {};
  EXPECT_THROW(roam::save_profile(profile, folder.file("p.json")), roam::Error);
  profile = full_profile();
  profile.scene = {};
  EXPECT_THROW(roam::save_profile(profile, folder.file("p.json")), roam::Error);
  EXPECT_FALSE(std::filesystem::exists(folder.file("p.json")));
}

TEST(Profile, HasTheRightsOfOtherFiles) {
  const TestFolder folder;
  const mode_t before = ::umask(022);
  roam::save_profile(full_profile(), folder.file("p.json"));
  ::umask(before);
  struct stat status {};
  ASSERT_EQ(::stat(folder.file("p.json").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0644u);
}

TEST(Profile, KeepsAFrameWithItsBody) {
  const TestFolder folder;
  const std::string scene = folder.file("mine.obj"), file = folder.file("mine.obj.roam.json");
  const std::vector<std::filesystem::path> scenes{scene};
  roam::Profile profile = full_profile();
  roam::save_profile(profile, file);
  EXPECT_FALSE(contains(folder.read("mine.obj.roam.json"), "frame"));
  EXPECT_EQ(roam::find_frame(scenes), std::nullopt);
  profile.frame = roam::SceneFrame{roam::UpAxis::minus_y, roam::LengthUnit::cm};
  roam::save_profile(profile, file);
  EXPECT_EQ(roam::find_frame(scenes), profile.frame);
  EXPECT_EQ(roam::find_profile(scene)->frame, profile.frame);
  EXPECT_TRUE(roam::save_frame(*profile.frame, file)) << "the body is of this frame";
  expect_same(roam::load_profile(file), profile);
}

TEST(Profile, MayHoldAFrameAlone) {
  const TestFolder folder;
  const std::string scene = folder.file("mine.obj"), file = folder.file("mine.obj.roam.json");
  const std::vector<std::filesystem::path> scenes{scene};
  const roam::SceneFrame turned{roam::UpAxis::y, roam::LengthUnit::in};
  EXPECT_EQ(roam::find_frame(scenes), std::nullopt) << "there is no file";
  EXPECT_TRUE(roam::save_frame(turned, file));
  EXPECT_TRUE(folder.read("mine.obj.roam.json").starts_with(roam::profile_start));
  EXPECT_EQ(roam::find_frame(scenes), turned);
  EXPECT_FALSE(roam::find_profile(scene));
  EXPECT_TRUE(contains(complaint([&] { (void)roam::load_profile(file); }), "it has a frame, but no body"));
}

TEST(Profile, KeepsABodyOfAnotherFrame) {
  const TestFolder folder;
  const std::string file = folder.file("mine.obj.roam.json");
  roam::save_profile(full_profile(), file);
  EXPECT_FALSE(roam::save_frame({.up = roam::UpAxis::y}, file));
  expect_same(roam::load_profile(file), full_profile());
}

}  // namespace
