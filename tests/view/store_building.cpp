// roam view builds the store of a scene while one roams in it, and changes to it.
#include <chrono>
#include <future>
#include <glm/geometric.hpp>
#include <memory>
#include <thread>

#include "view/freeing.h"
#include "view_stores.h"

namespace {

using namespace roam;
using namespace roam::app;
using namespace view_stores;

TEST(ViewStoreBuilding, BuildsAStoreMeanwhileAndChangesToIt) {
  Driven d;
  d.write_scene();
  d.options.verify = true;
  d.begin();
  d.run(0.5);
  EXPECT_FALSE(d.on_store());
  EXPECT_FALSE(contains(d.hud(), "builds it")) << "a scene as small as that needs none";
  d.press('w');
  d.run(1.0);
  d.release('w');
  d.run(0.5);
  const Vec3 before = d.place();
  d.tap('o');
  EXPECT_TRUE(
      contains(d.hud(), "O again builds the collision store " + d.folder.file("scene.obj.roam") + " (less than 1 MB)"))
      << d.hud();
  d.run(5.0);
  d.tap('o');
  EXPECT_FALSE(d.session->status().building) << "too late for a second order";
  d.tap('o');
  ASSERT_TRUE(d.until([&] { return d.on_store(); }));
  EXPECT_LT(glm::distance(d.place(), before), 0.005);
  EXPECT_TRUE(contains(d.hud(), "the walls come from ")) << d.hud();
  d.press('w');
  d.run(12.0);
  EXPECT_NEAR(d.place().x, 19.7, 0.02);
  EXPECT_TRUE(Store::is_store(d.folder.file("scene.obj.roam")));
  const ViewReport report = d.finish();
  EXPECT_TRUE(report.notes.empty()) << report.notes.front();
  const verification::Verification proof = verify(report.meshes, report.pieces);
  EXPECT_GT(proof.pieces, 300u);
  EXPECT_EQ(proof.violations, 0u);
}

TEST(Freeing, MakesNobodyWaitForWhatIsDropped) {
  struct Slow {
    std::shared_future<void> goes_on;
    std::thread::id& freed_by;
    ~Slow() {
      goes_on.wait_for(std::chrono::seconds(20));
      freed_by = std::this_thread::get_id();
    }
  };
  std::promise<void> promise;
  const std::shared_future<void> goes_on = promise.get_future().share();
  std::thread::id freed_by[2];
  auto freeing = std::make_shared<Freeing>();
  for (std::thread::id& by : freed_by) {
    std::shared_ptr<Slow> slow(new Slow{goes_on, by});
    slow = Freeing::later(freeing, std::move(slow));
    const std::shared_ptr<Slow> another_owner = slow;
  }
  EXPECT_EQ(freed_by[0], std::thread::id()) << "it waits elsewhere";
  promise.set_value();
  freeing.reset();
  for (const std::thread::id by : freed_by) {
    EXPECT_NE(by, std::thread::id()) << "all is freed at the end";
    EXPECT_NE(by, std::this_thread::get_id());
  }
}

TEST(ViewStoreBuilding, BringsAStaleStoreUpToDate) {
  Driven d;
  d.write_scene(short_room_obj());
  d.build();
  const std::string scene = d.write_scene(room_obj());
  d.begin();
  d.tap('o');
  d.tap('o');
  ASSERT_TRUE(d.until([&] { return d.on_store(); }));
  EXPECT_TRUE(build_store(build_of(scene, scene + ".roam")).unchanged);
}

TEST(ViewStoreBuilding, KeepsWhatIsBuiltWhenItIsClosed) {
  Driven d;
  const std::string scene =
      store_builds::write_ply(d.folder.file("field.ply"), store_builds::field(500, 0.1, Vec3(0.0)));
  d.options.scene.scenes = {scene};
  d.options.at = {20, 20, 2, 0};
  d.begin();
  d.tap('o');
  d.tap('o');
  const std::string store = scene + ".roam";
  ASSERT_TRUE(d.until([&] { return fs::is_directory(store); }));
  EXPECT_TRUE(contains(d.notes(), "is not finished; what is done is kept"));
  d.session.reset();
  EXPECT_FALSE(Store::is_store(store));
  const StoreBuildReport rest = build_store(build_of(scene, store));
  EXPECT_EQ(rest.triangles, 500'000u);
  // Byte for byte what nobody has disturbed.
  build_store(build_of(scene, d.folder.file("undisturbed.roam")));
  EXPECT_EQ(Store::open(store)->info().hash, Store::open(d.folder.file("undisturbed.roam"))->info().hash);
}

TEST(ViewStoreBuilding, FollowsNoLinkBesideTheScene) {
  for (const bool is_whole : {false, true}) {
    Driven d;
    const std::string scene = d.write_scene(), mine = d.folder.file("mine.roam");
    if (is_whole) build_store(build_of(scene, mine));
    fs::create_directories(mine);
    fs::create_symlink(mine, scene + ".roam");
    d.begin();
    d.run(0.5);
    EXPECT_FALSE(d.on_store());
    d.tap('o');
    d.tap('o');
    d.run(2.0);
    EXPECT_FALSE(d.on_store());
    EXPECT_EQ(Store::is_store(mine), is_whole);
    EXPECT_TRUE(contains(d.notes(), ".roam is a link"));
  }
}

TEST(ViewStoreBuilding, TheKeyStopsABuild) {
  Driven d;
  const std::string scene =
      store_builds::write_ply(d.folder.file("field.ply"), store_builds::field(500, 0.1, Vec3(0.0)));
  d.options.scene.scenes = {scene};
  d.options.at = {20, 20, 2, 0};
  d.begin();
  d.tap('o');
  d.tap('o');
  ASSERT_TRUE(d.until([&] { return d.session->status().building.has_value(); }));
  d.run(0.02);
  d.press('o');
  ASSERT_TRUE(d.until([&] { return !d.session->status().building.has_value(); }));
  EXPECT_FALSE(d.on_store());
  EXPECT_TRUE(contains(d.hud(), "stopped; what was done is kept")) << d.hud();
  EXPECT_FALSE(Store::is_store(scene + ".roam"));
}

}  // namespace
