// roam view on collision stores: found, named, stale, damaged, built meanwhile.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <glm/geometric.hpp>
#include <thread>

#include "exit_status.h"
#include "roam/error.h"
#include "roam/store_build.h"
#include "store/tile_reader.h"
#include "store_builds.h"
#include "view/session.h"
#include "view_scenes.h"

namespace {

using namespace roam;
using namespace roam::app;

namespace fs = std::filesystem;

/// Half as long as room_obj().
std::string short_room_obj() {
  std::string text = room_obj();
  for (std::size_t at = text.find("v 20 "); at != std::string::npos; at = text.find("v 20 ")) {
    text.replace(at, 5, "v 10 ");
  }
  return text;
}

StoreBuildOptions build_of(const std::string& scene, const std::string& store) {
  StoreBuildOptions build;
  build.scene = {scene};
  build.output = store;
  build.memory = StoreBuildOptions::least_memory;
  build.threads = 1;
  return build;
}

/// Changes a byte of the tile around (x, y) in a store of one page.
void damage_tile_at(const std::string& folder, double x, double y) {
  const auto opened = Store::open(folder);
  store::TileReader reader(opened->state());
  const store::LoadedPage page = reader.page(0);
  const auto tile = std::find_if(page.view.tiles.begin(), page.view.tiles.end(), [&](const store::TileEntry& entry) {
    return entry.lower[0] <= x && x <= entry.upper[0] && entry.lower[1] <= y && y <= entry.upper[1];
  });
  ASSERT_NE(tile, page.view.tiles.end());
  ASSERT_GT(page.view.tiles.size(), 3u);
  std::fstream file(folder + "/" + opened->state().packs.front(), std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(static_cast<std::streamoff>(tile->offset));
  const int byte = file.get();
  file.seekp(static_cast<std::streamoff>(tile->offset));
  file.put(static_cast<char>(byte ^ 1));
}

/// A session without a screen, with the options that a test sets before begin().
class Driven {
 public:
  Driven() {
    use_no_settings(folder);
    setenv("ROAM_READER", ROAM_READER_PROGRAM, 1);
    options.headless = true;
    options.size = "160x100";
    options.time_limit = 1e6;
    options.at = {8, 0, 0.95, 0};
  }
  ~Driven() {
    session.reset();
    unsetenv("ROAM_READER");
  }

  std::string write_scene(const std::string& text = room_obj()) {
    const std::string file = folder.write("scene.obj", text);
    options.scene.scenes = {file};
    return file;
  }
  /// Beside the scene, where it is looked for.
  std::string build() {
    const std::string scene = options.scene.scenes.front().string();
    build_store(build_of(scene, scene + ".roam"));
    return scene + ".roam";
  }
  void begin() {
    session.emplace(options, make_plan(options, {}), ViewSettings{});
    ASSERT_TRUE(until([this] { return session->roaming(); })) << "nothing was loaded";
  }
  /// Frames until something is so; false when it is not within a minute.
  template <class Done>
  bool until(const Done& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!done() && std::chrono::steady_clock::now() < end) {
      if (!session->frame()) return false;
    }
    return done();
  }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 60.0 + 0.5); ++i) ASSERT_TRUE(session->frame());
  }
  void press(int key) { session->stage().viewer().getEventQueue()->keyPress(key); }
  void release(int key) { session->stage().viewer().getEventQueue()->keyRelease(key); }
  [[nodiscard]] bool on_store() { return session->status().paging.has_value(); }
  [[nodiscard]] const Vec3& place() { return session->roamer().walker()->position(); }
  [[nodiscard]] std::string hud() {
    run(0.2);
    return session->stage().hud().text();
  }
  [[nodiscard]] std::string notes() {
    const ViewReport report = session->finish();
    std::string text;
    for (const std::string& note : report.notes) text += note + "\n";
    return text;
  }

  TestFolder folder;
  ViewOptions options;
  std::optional<Session> session;
};

TEST(ViewStore, FindsTheStoreBesideTheScene) {
  Driven d;
  d.write_scene();
  const std::string store = d.build();
  d.begin();
  d.run(0.2);
  ASSERT_TRUE(d.on_store());
  EXPECT_TRUE(contains(d.hud(), "64 MiB, 2 tiles, all ready")) << d.hud();
  d.press('w');
  d.run(12.0);
  EXPECT_NEAR(d.place().x, 19.7, 0.02);
  EXPECT_TRUE(contains(d.hud(), "blocked: wall, front")) << d.hud();
  const ViewReport report = d.session->finish();
  EXPECT_EQ(report.store, store);
  EXPECT_EQ(report.triangles, 12u);
  ASSERT_TRUE(report.paging.has_value());
  EXPECT_LE(report.paging->memory, 64u << 20);
  EXPECT_GT(report.paging->memory, 60u << 20);
  EXPECT_TRUE(report.notes.empty()) << report.notes.front();
}

TEST(ViewStore, FindsAStartInIt) {
  Driven d;
  d.options.at.clear();
  d.write_scene();
  d.build();
  d.begin();
  d.run(1.0);
  EXPECT_TRUE(d.on_store());
  EXPECT_EQ(d.session->roamer().mode(), Mode::walk);
  EXPECT_NEAR(d.place().z, 0.9, 0.1);
  EXPECT_LT(std::abs(d.place().y), 1.7);
  EXPECT_FALSE(d.session->roamer().held());
}

TEST(ViewStore, LeavesAStoreOfAnotherSceneAlone) {
  Driven d;
  d.write_scene(short_room_obj());
  d.build();
  d.write_scene(room_obj());
  d.begin();
  d.run(0.2);
  EXPECT_FALSE(d.on_store());
  EXPECT_TRUE(contains(d.hud(), "none; O builds it")) << d.hud();
  // The wall is where it is now.
  d.press('w');
  d.run(12.0);
  EXPECT_NEAR(d.place().x, 19.7, 0.02);
  const std::string notes = d.notes();
  EXPECT_TRUE(contains(notes, "scene.obj.roam is not used: scene.obj has changed since")) << notes;
  EXPECT_TRUE(contains(notes, "O or `roam build ")) << notes;
}

TEST(ViewStore, LeavesAStoreOfOtherOptionsAlone) {
  Driven d;
  d.write_scene();
  d.build();
  d.options.scene.unit = "cm";
  d.options.at.clear();
  d.begin();
  EXPECT_FALSE(d.on_store());
  EXPECT_TRUE(contains(d.notes(), "it was built with other options"));
}

TEST(ViewStore, TakesTheStoreThatIsNamed) {
  Driven d;
  const std::string scene = d.write_scene();
  d.options.store = d.folder.file("elsewhere.roam");
  build_store(build_of(scene, d.options.store));
  d.options.paging.memory = 16u << 20;
  d.begin();
  d.run(0.2);
  ASSERT_TRUE(d.on_store());
  EXPECT_TRUE(contains(d.hud(), "16 MiB, ")) << d.hud();
  EXPECT_EQ(d.notes(), "");
}

TEST(ViewStore, TakesAStoreThatIsNamedThoughItIsStale) {
  Driven d;
  d.write_scene(short_room_obj());
  d.options.store = d.build();
  d.write_scene(room_obj());
  d.begin();
  d.press('w');
  d.run(6.0);
  EXPECT_TRUE(d.on_store());
  EXPECT_NEAR(d.place().x, 9.7, 0.02);
  EXPECT_TRUE(contains(d.notes(), "is not of what is seen: scene.obj has changed since"));
}

TEST(ViewStore, RefusesAStoreThatIsNone) {
  Driven d;
  d.write_scene();
  d.options.store = d.folder.file("none.roam");
  EXPECT_THROW(d.begin(), UsageError);
}

TEST(ViewStore, FindsTheSceneOfAStore) {
  Driven d;
  const std::string scene = d.write_scene();
  d.options.scene.scenes = {d.build() + "/"};
  d.begin();
  d.run(0.2);
  EXPECT_TRUE(d.on_store());
  const ViewReport report = d.session->finish();
  EXPECT_EQ(report.scene, scene);
  EXPECT_TRUE(report.notes.empty()) << report.notes.front();
}

TEST(ViewStore, ShowsTheTrianglesOfAStoreWhoseSceneIsGone) {
  Driven d;
  const std::string scene = d.write_scene();
  d.options.scene.scenes = {d.build()};
  fs::remove(scene);
  d.options.at = {2, 0, 0.95, 0, 0};
  d.begin();
  ASSERT_TRUE(d.on_store() || d.until([&] { return d.on_store(); }));
  const std::string shot = d.folder.file("shot.png");
  d.run(0.2);
  d.session->stage().draw_picture(shot, 0.0);
  const Shot picture(shot);
  EXPECT_GT(picture.colours(), 3u);
  EXPECT_LT(picture.sky(), 0.01);  // one is in a room
  EXPECT_TRUE(contains(d.notes(), "is not known: what is seen is what is collided with"));
}

TEST(ViewStore, HoldsWhereATileIsDamagedAndNamesIt) {
  Driven d;
  const std::string scene =
      store_builds::write_ply(d.folder.file("field.ply"), store_builds::field(200, 0.25, Vec3(0.0)));
  d.options.scene.scenes = {scene};
  const std::string store = d.build();
  damage_tile_at(store, 37.0, 37.0);
  d.options.mode = "fly";
  d.options.at = {37, 37, 3, 0};
  d.begin();
  d.press('q');
  d.run(4.0);
  EXPECT_GT(d.place().z, 0.9);  // not below the ground
  EXPECT_LT(d.place().z, 2.0);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));  // the reason is found out beside
  const std::string hud = d.hud();
  EXPECT_TRUE(contains(hud, "1 failed")) << hud;
  EXPECT_TRUE(contains(hud, "waiting: tile ") && contains(hud, " of page 0 ")) << hud;
  // The rest goes on.
  d.session->roamer().setFeet({8, 8, 2}, 0.0, 0.0);
  d.run(4.0);
  EXPECT_NEAR(d.place().z, 1.0, 0.3);
  EXPECT_FALSE(contains(d.hud(), "waiting")) << d.hud();
  const std::string notes = d.notes();
  EXPECT_TRUE(contains(notes, "cannot be used") && contains(notes, "it is solid")) << notes;
}

TEST(ViewStore, BuildsAStoreMeanwhileAndChangesToIt) {
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
  d.press('o');
  d.release('o');
  ASSERT_TRUE(d.until([&] { return d.on_store(); }));
  EXPECT_LT(glm::distance(d.place(), before), 0.005);
  EXPECT_TRUE(contains(d.hud(), "the walls come from ")) << d.hud();
  d.press('w');
  d.run(12.0);
  EXPECT_NEAR(d.place().x, 19.7, 0.02);
  EXPECT_TRUE(Store::is_store(d.folder.file("scene.obj.roam")));
  const ViewReport report = d.session->finish();
  EXPECT_TRUE(report.notes.empty()) << report.notes.front();
  const Verification proof = verify(report.meshes, report.pieces);
  EXPECT_GT(proof.pieces, 300u);
  EXPECT_EQ(proof.violations, 0u);
}

TEST(ViewStore, BringsAStaleStoreUpToDate) {
  Driven d;
  d.write_scene(short_room_obj());
  d.build();
  const std::string scene = d.write_scene(room_obj());
  d.begin();
  d.press('o');
  ASSERT_TRUE(d.until([&] { return d.on_store(); }));
  EXPECT_TRUE(build_store(build_of(scene, scene + ".roam")).unchanged);
}

TEST(ViewStore, KeepsWhatIsBuiltWhenItIsClosed) {
  Driven d;
  const std::string scene =
      store_builds::write_ply(d.folder.file("field.ply"), store_builds::field(500, 0.1, Vec3(0.0)));
  d.options.scene.scenes = {scene};
  d.options.at = {20, 20, 2, 0};
  d.begin();
  d.press('o');
  ASSERT_TRUE(d.until([&] { return d.session->status().building.has_value(); }));
  EXPECT_TRUE(contains(d.notes(), "is not finished; what is done is kept"));
  d.session.reset();
  const std::string store = scene + ".roam";
  EXPECT_TRUE(fs::is_directory(store));
  EXPECT_FALSE(Store::is_store(store));
  const StoreBuildReport rest = build_store(build_of(scene, store));
  EXPECT_EQ(rest.triangles, 500'000u);
  // Byte for byte what nobody has disturbed.
  build_store(build_of(scene, d.folder.file("undisturbed.roam")));
  EXPECT_EQ(Store::open(store)->info().hash, Store::open(d.folder.file("undisturbed.roam"))->info().hash);
}

TEST(ViewStore, TheKeyStopsABuild) {
  Driven d;
  const std::string scene =
      store_builds::write_ply(d.folder.file("field.ply"), store_builds::field(500, 0.1, Vec3(0.0)));
  d.options.scene.scenes = {scene};
  d.options.at = {20, 20, 2, 0};
  d.begin();
  d.press('o');
  ASSERT_TRUE(d.until([&] { return d.session->status().building.has_value(); }));
  d.release('o');
  d.run(0.02);
  d.press('o');
  ASSERT_TRUE(d.until([&] { return !d.session->status().building.has_value(); }));
  EXPECT_FALSE(d.on_store());
  EXPECT_TRUE(contains(d.hud(), "stopped; what was done is kept")) << d.hud();
  EXPECT_FALSE(Store::is_store(scene + ".roam"));
}

TEST(ViewStore, WalksAPathVerifiedAndTellsTheCounters) {
  Driven d;
  d.write_scene();
  d.options.scene.scenes = {d.build()};
  const std::string path = d.folder.write("p.path", "2 0 0.95\n18 0 0.95\n18 1 0.95\n25 1 0.95\n");
  const ProgramResult result =
      run_program(ROAM_PROGRAM, {"view", d.options.scene.scenes.front().string(), "--headless", "--path", path,
                                 "--radius", "0.3", "--mode", "fly", "--verify", "--json", "--memory", "32M"});
  EXPECT_EQ(result.status, 3) << result.err;
  const nlohmann::json report = nlohmann::json::parse(result.out);
  EXPECT_EQ(report["violations"], 0);
  EXPECT_GT(report["verified"]["pieces"], 100);
  EXPECT_EQ(report["outcome"], "blocked");
  EXPECT_EQ(report["blocked_at"]["object"], "front");
  EXPECT_LT(report["blocked_at"]["triangle"], 12);
  EXPECT_EQ(report["paging"]["tiles"], 2);
  EXPECT_EQ(report["paging"]["failed"], 0);
  EXPECT_LE(report["paging"]["memory"], 32u << 20);
  EXPECT_TRUE(contains(report["store"].get<std::string>(), "scene.obj.roam"));
}

TEST(ViewStore, EndsComparingWhenItIsToldTo) {
  Driven d;
  d.write_scene();
  d.build();
  const std::string reader = d.folder.write("reader", "#!/bin/sh\nexec sleep 100\n");
  fs::permissions(reader, fs::perms::owner_all);
  setenv("ROAM_READER", reader.c_str(), 1);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THROW(static_cast<void>(choose_store({d.options.scene, {}, false}, [] { return false; })), Cancelled);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

}  // namespace
