// roam view on collision stores: found, named, stale, damaged.
#include <thread>

#include "cli/exit_status.h"
#include "import/display.h"
#include "import/page_reader.h"
#include "roam/error.h"
#include "scenes/beside_scene.h"
#include "scenes/frame.h"
#include "store/opened.h"
#include "view/store_triangles.h"
#include "view_stores.h"

namespace {

using namespace roam;
using namespace roam::app;
using namespace view_stores;

TEST(ViewStore, FindsTheStoreBesideTheScene) {
  Driven d;
  d.write_scene();
  const std::string store = d.build();
  d.options.hud = "full";
  d.begin();
  d.run(0.2);
  ASSERT_TRUE(d.on_store());
  EXPECT_TRUE(contains(d.hud(), "64 MiB, 2 tiles, all ready")) << d.hud();
  d.press('w');
  d.run(12.0);
  EXPECT_NEAR(d.place().x, 19.7, 0.02);
  // The name is read by another thread, and comes with a later frame.
  EXPECT_TRUE(d.until([&] { return contains(d.hud(), "blocked by front"); })) << d.hud();
  const ViewReport report = d.finish();
  EXPECT_EQ(report.store, store);
  EXPECT_EQ(report.triangles, 12u);
  ASSERT_TRUE(report.paging.has_value());
  EXPECT_LE(report.paging->memory, 64u << 20);
  EXPECT_GT(report.paging->memory, 60u << 20);
  EXPECT_TRUE(report.notes.empty()) << report.notes.front();
}

TEST(ViewStore, LiesBesideAFolderHoweverThatIsNamed) {
  const TestFolder folder;
  fs::create_directories(folder.file("Data/sub"));
  const fs::path before = fs::current_path();
  fs::current_path(folder.file("Data"));
  const fs::path beside = fs::current_path().parent_path() / "Data.roam";
  for (const char* name : {".", "./", "sub/..", "../Data", "sub/../../Data/"})
    EXPECT_EQ(store_beside(name), beside) << name;
  EXPECT_EQ(store_beside("sub"), "sub.roam");
  EXPECT_EQ(store_beside("./sub/"), "sub.roam");
  EXPECT_EQ(store_beside("sub/mine.dae"), fs::current_path() / "sub/mine.dae.roam");
  EXPECT_EQ(store_beside("sub/../../Data/mine.dae"), "mine.dae.roam");
  fs::current_path("sub");
  EXPECT_EQ(store_beside(".."), beside);
  fs::current_path(before);
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
  EXPECT_TRUE(contains(notes, "scene.obj.roam is not used: scene.obj, or a file that it refers to, has changed since"))
      << notes;
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
  d.options.scene.memory = 16u << 20;
  d.options.hud = "full";
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
  EXPECT_TRUE(contains(d.notes(), "is not of what is seen: scene.obj, or a file that it refers to, has changed since"));
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
  const ViewReport report = d.finish();
  EXPECT_EQ(report.scene, scene);
  EXPECT_TRUE(report.notes.empty()) << report.notes.front();
}

TEST(ViewStore, IsOpenedByTheFileInItThatDesktopsKnow) {
  Driven d;
  d.write_scene();
  const std::string store = d.build();
  const ProgramResult shown =
      run_program(ROAM_PROGRAM, {"view", store + "/CURRENT", "--headless", "--json", "--at", "8,0,0.95,0", "--radius",
                                 "0.3", "--size", "64x64", "--screenshot", d.folder.file("shot.png")});
  EXPECT_EQ(shown.status, 0) << shown.err;
  EXPECT_EQ(nlohmann::json::parse(shown.out)["store"], store) << shown.out;
}

TEST(ViewStore, FollowsNoLinkBesideTheStore) {
  Driven d;
  const std::string scene = d.write_scene(), store = d.build();
  fs::create_directory(d.folder.file("vault"));
  const std::string elsewhere = d.folder.write("vault/confidential.obj", "v hush 3 4\n");
  for (const std::string& target : {elsewhere, d.folder.file("vault"), d.folder.file("nowhere")}) {
    fs::remove(scene);
    fs::create_symlink(target, scene);
    const ProgramResult shown =
        run_program(ROAM_PROGRAM, {"view", store, "--headless", "--json", "--at", "8,0,0.95,0", "--radius", "0.3",
                                   "--mode", "fly", "--size", "64x64", "--screenshot", d.folder.file("shot.png")});
    EXPECT_EQ(shown.status, 0) << shown.err;
    for (const char* word : {"hush", "confidential", "nowhere", "vault"}) {
      EXPECT_FALSE(contains(shown.out + shown.err, word)) << word << " in " << shown.out << shown.err;
    }
    EXPECT_TRUE(contains(shown.err, "is a link")) << shown.err;
    EXPECT_TRUE(contains(shown.err, "roam view " + scene + " --store " + store)) << shown.err;
    EXPECT_TRUE(contains(nlohmann::json::parse(shown.out)["notes"].dump(), "is a link")) << shown.out;
  }
}

/// Puts a link where the file was.
void become_link(const std::string& file, const std::string& target) {
  fs::rename(file, target);
  fs::create_symlink(target, file);
}

TEST(ViewStore, FollowsNoLinkThatTakesThePlaceOfTheSceneLater) {
  Driven d;
  const std::string scene = d.write_scene();
  SceneOptions named;
  named.scenes = {d.build()};
  const SceneAndStore what = scene_and_store(named, {});
  ASSERT_EQ(what.scene.scenes, std::vector<fs::path>{scene});
  ASSERT_TRUE(choose_store(what, [] { return true; }).note.empty());
  fs::create_directory(d.folder.file("home"));
  become_link(scene, d.folder.file("home/scene.obj"));
  const StoreChoice choice = choose_store(what, [] { return true; });
  EXPECT_TRUE(choice.stale);
  EXPECT_TRUE(contains(choice.note, "is a link")) << choice.note;
  const auto fails = [](const auto& work) {
    try {
      work();
    } catch (const Error& error) {
      return contains(error.what(), "is a link");
    }
    return false;
  };
  const ImportOptions reading = what.scene.import_options();
  EXPECT_TRUE(fails([&] { static_cast<void>(import_scene(what.scene.scenes, reading)); }));
  EXPECT_TRUE(
      fails([&] { static_cast<void>(read_display(what.scene.scenes, reading, [](DisplayPart&&) { return true; })); }));
  EXPECT_TRUE(fails([&] { static_cast<void>(PageReader(what.scene.scenes, reading).read(0, Vec3(0.0), "page")); }));
  fs::create_directory_symlink(named.scenes.front(), d.folder.file("link.roam"));
  EXPECT_TRUE(fails([&] { static_cast<void>(open_store_beside(d.folder.file("link.roam"))); }));
  std::vector<std::string> build{"build", "--output=" + d.folder.file("again.roam")};
  for (const std::string& word : what.scene.arguments()) build.push_back(word);
  const ProgramResult built = run_program(ROAM_PROGRAM, build);
  EXPECT_EQ(built.status, 1) << built.err;
  EXPECT_TRUE(contains(built.err, "is a link")) << built.err;
  // A user who names the link means what it leads to.
  EXPECT_EQ(run_program(ROAM_PROGRAM, {"info", scene}).status, 0);
}

TEST(ViewStore, ReadsTheSceneOfAStoreAsTheStoreWas) {
  Driven d;
  const std::string scene = d.write_scene();
  StoreBuildOptions build = build_of(scene, scene + ".roam");
  build.import.up = UpAxis::y;
  build.import.unit = LengthUnit::in;
  build.import.ignore = {"nothing of this name", "front"};
  (void)build_store(build);
  SceneOptions store;
  store.scenes = {scene + ".roam"};
  const SceneAndStore what = scene_and_store(store, {});
  EXPECT_EQ(what.scene.scenes, std::vector<fs::path>{scene});
  EXPECT_EQ(what.scene.up, "y");
  EXPECT_EQ(what.scene.unit, "in");
  EXPECT_EQ(what.scene.ignore, build.import.ignore);
  const StoreChoice choice = choose_store(what, [] { return true; });
  EXPECT_TRUE(choice.store);
  EXPECT_FALSE(choice.stale) << choice.note;
}

TEST(ViewStore, OpensAsLargeAManifestAsMemorySays) {
  Driven d;
  const std::string scene = d.write_scene(), place = d.folder.file("s");
  (void)build_store(build_of(scene, place));
  {
    // Short notes take over 256 MiB in the end, and little as text.
    std::string text = store::to_text(Store::open(place)->state().manifest), notes = "\"notes\": [\"\"";
    for (int i = 0; i < 4'000'000; ++i) notes += ",\"\"";
    text.replace(text.find("\"notes\": ["), 10, notes);
    store::publish(fs::path(place), text, store::format_version);
  }
  SceneOptions named;
  named.scenes = {place};
  for (const std::string& in : {std::string(), place}) {
    SceneOptions shown = named;
    if (!in.empty()) shown.scenes = {scene};
    const auto open = [&] { return choose_store(scene_and_store(shown, in), [] { return true; }).store; };
    EXPECT_THROW(static_cast<void>(open()), Error);
    shown.memory = std::uint64_t{1} << 30;
    EXPECT_TRUE(open());
  }
  EXPECT_FALSE(frame_of(named));
  named.memory = std::uint64_t{1} << 30;
  EXPECT_TRUE(frame_of(named));
  const SceneAndStore what = scene_and_store(named, {});
  ASSERT_TRUE(what.store_only);
  EXPECT_TRUE(frame_of(what.scene));
}

TEST(ViewStore, TakesNoFolderAboveForTheSceneOfAStore) {
  Driven d;
  const std::string scene = d.write_scene();
  fs::create_directories(d.folder.file("downloads/evil"));
  for (const char* name : {"downloads/evil/...roam", "downloads/evil/..roam"}) {
    (void)build_store(build_of(scene, d.folder.file(name)));
    SceneOptions store;
    store.scenes = {d.folder.file(name)};
    EXPECT_TRUE(scene_and_store(store, {}).store_only) << name;
  }
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
  d.session->stage().draw_picture(shot);
  const Shot picture(shot);
  EXPECT_GT(picture.colours(), 3u);
  EXPECT_LT(picture.sky(), 0.01);  // one is in a room
  EXPECT_TRUE(contains(d.notes(), "is not known: what is seen is what is collided with"));
}

TEST(ViewStore, ShowsTheRestOfAStoreThatIsDamaged) {
  Driven d;
  const std::string scene =
      store_builds::write_ply(d.folder.file("field.ply"), store_builds::field(200, 0.25, Vec3(0.0)));
  d.options.scene.scenes = {scene};
  const std::string store = d.build();
  damage_tile_at(store, 37.0, 37.0);
  const auto shown = Store::open(store);
  std::uint64_t triangles = 0;
  const DisplayReport report = show_store(
      *shown, Vec3(8.0, 8.0, 2.0), [&](DisplayNode&&, std::uint64_t more) { triangles += more; }, [] { return true; });
  EXPECT_EQ(report.triangles, triangles);
  EXPECT_LT(triangles, 80'000u);
  EXPECT_GT(triangles, 60'000u);
  ASSERT_EQ(report.notes.size(), 2u);
  EXPECT_TRUE(contains(report.notes[1], "not all of it is shown: ") && contains(report.notes[1], "tile "))
      << report.notes[1];
  fs::remove(scene);
  d.options.scene.scenes = {store};
  d.options.at.clear();
  d.begin();
  EXPECT_TRUE(d.on_store() || d.until([&] { return d.on_store(); })) << "a start is found beside it";
  const auto is_told = [&] { return contains(d.notes(), "not all of it is shown"); };
  EXPECT_TRUE(is_told() || d.until(is_told));
}

TEST(ViewStore, HoldsWhereATileIsDamagedAndNamesIt) {
  Driven d;
  const std::string scene =
      store_builds::write_ply(d.folder.file("field.ply"), store_builds::field(200, 0.25, Vec3(0.0)));
  d.options.scene.scenes = {scene};
  const std::string store = d.build();
  damage_tile_at(store, 37.0, 37.0);
  d.options.mode = Mode::fly;
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
