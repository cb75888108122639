// roam view without a screen, as a shell sees it; and what it says where something is missing.
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <thread>

#include "view_program.h"

namespace {

// ------------------------------------------------------------------------------------------------------- pictures

TEST(ViewPicture, ShowsTheDisplayIfAskedFor) {
  // The upper left corner: the panel is dark, the ceiling is light.
  const auto corner = [](const View& view) { return view.picture().at(12, 180).length(); };
  View clean, full;
  clean.shot({});
  full.shot({"--hud", "full"});
  EXPECT_LT(corner(full) + 0.2f, corner(clean));
}

TEST(ViewPicture, ShowsASceneHigherThanAMotion) {
  View view(
      "o floor\nv -20 -20 0\nv 20 -20 0\nv 20 20 0\nv -20 20 0\nf 1 2 3 4\n"
      "o pad\nv -1 -1 2e6\nv 1 -1 2e6\nv 1 1 2e6\nv -1 1 2e6\nf 5 6 7 8\n");
  for (const std::vector<std::string>& start : {std::vector<std::string>{}, {"--at", "5,5,1.9e6"}}) {
    view.shot(start);
    EXPECT_EQ(view.result.status, 0) << view.result.err;
  }
}

TEST(ViewPicture, ShowsASceneOfMillimetres) {
  std::string cube = "o cube\n";
  for (int i = 0; i < 8; ++i) {
    cube += std::string("v ") + ((i & 1) != 0 ? "0.008 " : "0 ") + ((i & 2) != 0 ? "0.008 " : "0 ") +
            ((i & 4) != 0 ? "0.008\n" : "0\n");
  }
  cube += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  View tiny(cube);
  tiny.shot({});
  ASSERT_EQ(tiny.result.status, 0) << tiny.result.err;
  const Shot seen = tiny.picture();
  // Top and sides differ in light, and from what is around them.
  const osg::Vec4 top = seen.at(160, 130), side = seen.at(140, 85), around = seen.at(40, 100);
  EXPECT_GT((top - side).length(), 0.05f);
  EXPECT_GT((side - around).length(), 0.1f);
  EXPECT_GT((top - around).length(), 0.1f);
}

TEST(ViewPicture, IsAsLargeAsAskedFor) {
  View view;
  view.run({"--headless", "--size", "5000x2000", "--json", "--at", "2,0,0.95,0", "--screenshot",
            view.folder.file("large.png")});
  ASSERT_EQ(view.result.status, 0) << view.result.err;
  const Shot large(view.folder.file("large.png"));
  EXPECT_EQ(large.width(), 5000);
  EXPECT_EQ(large.height(), 2000);
  view.run({"--headless", "--size", "500x200", "--at", "2,0,0.95,0", "--screenshot", view.folder.file("small.png")});
  const Shot small(view.folder.file("small.png"));
  for (const int x : {50, 250, 450}) {
    for (const int y : {20, 100, 180}) EXPECT_LT((large.at(10 * x, 10 * y) - small.at(x, y)).length(), 0.1f) << x << y;
  }
}

TEST(ViewPicture, ShowsTheSceneAndTheDisplay) {
  View view;
  view.shot({"--hud", "full"});
  ASSERT_EQ(view.result.status, 0) << view.result.err;
  EXPECT_EQ(view.picture().width(), 320);
  EXPECT_EQ(view.picture().height(), 200);
  EXPECT_GT(view.picture().colours(), 8u);
  const nlohmann::json report = view.json();
  for (const char* key :
       {"scene",        "triangles",        "mode",     "radius",   "height",     "outcome",          "steps",
        "collision_ns", "collision_own_ns", "frames",   "frame_ms", "draw_calls", "violations",       "start",
        "end",          "memory",           "renderer", "hud",      "notes",      "missing_textures", "written"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
  EXPECT_EQ(report["triangles"], 12);
  // Sky, room, passes, at most four shadow maps, and the display.
  EXPECT_GE(report["draw_calls"]["max"], 6);
  EXPECT_LE(report["draw_calls"]["max"], 40);
  EXPECT_EQ(report["mode"], "walk");
  EXPECT_EQ(report["height"], 1.8);
  for (const char* part : {"walk", "radius 0.30 m", "feet", "memory", "collision"}) {
    EXPECT_TRUE(contains(all(report["hud"]), part)) << part;
  }
  // In a closed room there is no sky, and nothing but sky above its roof.
  EXPECT_GT(View(room_obj()).shot({"--hud", "off", "--mode", "fly", "--at", "5,0,9,0,80"}).picture().sky(), 0.9);
  EXPECT_LT(View(room_obj()).shot({"--hud", "off"}).picture().sky(), 0.001);
}

TEST(ViewPicture, OfAWallAtTheNoseIsNotCut) {
  for (const char* place : {"0.3005,0,0.9,180", "2,1.6995,0.9,90", "2,0,0.9,0,-90", "19.6995,1.6995,0.9,45"}) {
    View view;
    view.shot({"--hud", "off", "--at", place});
    ASSERT_EQ(view.result.status, 0) << view.result.err;
    EXPECT_LT(view.picture().sky(), 0.001) << place;
  }
}

TEST(ViewPicture, IsTakenWhereOneAskedFor) {
  View view;
  view.shot({"--at", "15,1,0.95,180,-10", "--mode", "fly"});
  const nlohmann::json report = view.json();
  EXPECT_NEAR(report["end"]["position"][0], 15.0, 1e-6);
  EXPECT_NEAR(report["end"]["position"][1], 1.0, 1e-6);
  EXPECT_NEAR(report["end"]["position"][2], 0.95, 1e-6);
  EXPECT_NEAR(std::abs(report["end"]["yaw"].get<double>()), 180.0, 1e-6);
  EXPECT_NEAR(report["end"]["pitch"], -10.0, 1e-6);
}

TEST(ViewPicture, FarFromTheOriginIsTheSame) {
  View near;
  near.shot({"--hud", "off", "--at", "5,0,0.95,0", "--mode", "fly"});
  std::string far_room;
  for (const char* line :
       {"v 4000000 4999998 0", "v 4000020 4999998 0", "v 4000020 5000002 0", "v 4000000 5000002 0",
        "v 4000000 4999998 3", "v 4000020 4999998 3", "v 4000020 5000002 3", "v 4000000 5000002 3"}) {
    far_room += std::string(line) + "\n";
  }
  View far(far_room + room_obj().substr(room_obj().find("o floor")));
  far.shot({"--hud", "off", "--at", "4000005,5000000,0.95,0", "--mode", "fly"});
  ASSERT_EQ(far.result.status, 0) << far.result.err;
  double worst = 0.0;
  const Shot a = near.picture(), b = far.picture();
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 320; ++x) worst = std::max<double>(worst, std::abs(a.at(x, y).g() - b.at(x, y).g()));
  }
  EXPECT_LT(worst, 0.25);  // an edge may fall into the next pixel's sample
  EXPECT_GT(far.json()["start"]["position"][0], 4e6);
}

// --------------------------------------------------------------------------------------------------------- paths

TEST(ViewPath, IsGoneExactlyAsRoamWalkGoesIt) {
  View view;
  const std::string path = view.folder.write("p.path", "2 0 0.3\n10 1 0.3\n18 -1 0.3\n");
  view.shot({"--path", path, "--trace", view.folder.file("view.csv"), "--verify"});
  ASSERT_EQ(view.result.status, 0) << view.result.err;
  const ProgramResult walk = run_program(
      ROAM_PROGRAM, {"walk", view.scene, "--path", path, "--trace", view.folder.file("walk.csv"), "--json"});
  const nlohmann::json expected = nlohmann::json::parse(walk.out), report = view.json();
  EXPECT_EQ(report["outcome"], "reached");
  for (const char* key : {"steps", "length_m", "least_clearance_m", "radius", "height", "mode"}) {
    EXPECT_EQ(report[key], expected[key]) << key;
  }
  EXPECT_EQ(report["end"]["position"], expected["end"]["position"]);
  EXPECT_EQ(report["violations"], 0);
  EXPECT_EQ(view.folder.read("view.csv"), view.folder.read("walk.csv"));
  EXPECT_GT(view.picture().colours(), 8u);
}

TEST(ViewPath, AndTraceMayBeStandardStreams) {
  View view;
  view.run({"--headless", "--path", "-", "--trace", "-"}, {.input = "2 0 0.3\n10 1 0.3\n"});
  EXPECT_EQ(view.result.status, 0) << view.result.err;
  EXPECT_TRUE(contains(view.result.out, "step,t,x,y,z,")) << view.result.out;
  EXPECT_TRUE(contains(view.result.err, "reached")) << view.result.err;
  EXPECT_FALSE(contains(view.result.err, "written")) << view.result.err;
}

TEST(ViewPath, ThatIsBlockedAnswersNoAndSaysByWhat) {
  View view;
  const std::string path = view.folder.write("p.path", "2 0 0.3\n25 0 0.3\n");
  view.run({"--headless", "--path", path, "--json"});
  EXPECT_EQ(view.result.status, 3) << view.result.err;
  EXPECT_EQ(view.json()["outcome"], "blocked");
  EXPECT_EQ(view.json()["blocked_at"]["object"], "front");
  EXPECT_TRUE(contains(all(view.json()["hud"]), "blocked by front")) << view.json()["hud"];
  view.run({"--headless", "--path", path});
  EXPECT_TRUE(contains(view.result.out, "blocked: at (19.")) << view.result.out;
  EXPECT_TRUE(contains(view.result.out, "by \"front\" (triangle ")) << view.result.out;
}

TEST(ViewPath, WithoutGroundEndsAsItDoesForWalk) {
  View view;
  const std::string path = view.folder.write("p.path", "40 0 0.3\n45 0 0.3\n");
  const ProgramResult walk = run_program(ROAM_PROGRAM, {"walk", view.scene, "--path", path, "--json"});
  view.run({"--headless", "--path", path, "--json"});
  EXPECT_EQ(view.result.status, 3) << view.result.err;
  EXPECT_EQ(view.json()["outcome"], nlohmann::json::parse(walk.out)["outcome"]);
  EXPECT_EQ(view.json()["mode"], "walk");
}

TEST(ViewPath, ThatEndsOnARampThatIsTooSteepSaysSo) {
  View view(
      "v -4 -4 0\nv 0 -4 0\nv 0 4 0\nv -4 4 0\nv 6 -4 -6.213\nv 6 4 -6.213\nf 1 2 3 4\nf 2 5 6 3\n");  // 46 degrees
  view.run({"--headless", "--path", view.folder.write("p.path", "-2 0 0.9\n5 0 -4.3\n")});
  EXPECT_EQ(view.result.status, 3) << view.result.err;
  EXPECT_TRUE(contains(view.result.out, "too steep to stand on: 46 degrees")) << view.result.out;
}

TEST(ViewPath, IsRecordedAndCanBeGoneAgain) {
  View view;
  const std::string path = view.folder.write("p.path", "2 0 0.3\n18 1 0.3\n");
  view.run({"--headless", "--path", path, "--json", "--record-path", view.folder.file("again.path")});
  ASSERT_EQ(view.result.status, 0) << view.result.err;
  const nlohmann::json first = view.json();
  view.run({"--headless", "--path", view.folder.file("again.path"), "--json"});
  EXPECT_EQ(view.result.status, 0) << view.result.err;
  EXPECT_NEAR(view.json()["length_m"], first["length_m"], 0.1);
}

// -------------------------------------------------------------------------------------- usage, settings, bookmarks

TEST(ViewUsage, PrintsTheTableOfKeysAsTheSettingsHaveIt) {
  const TestFolder folder;
  use_no_settings(folder);
  ProgramResult plain = run_program(ROAM_PROGRAM, {"view", "--keys"});
  EXPECT_EQ(plain.status, 0);
  for (const char* part : {"forward", "W, Up", "bookmark", "Escape", "2 to 8"}) EXPECT_TRUE(contains(plain.out, part));
  const std::string settings = folder.write("s.json", R"({"keys": {"forward": ["Z", "Up"]}})");
  EXPECT_TRUE(contains(run_program(ROAM_PROGRAM, {"view", "--keys", "--settings", settings}).out, "Z, Up"));
}

TEST(ViewUsage, SaysWhatIsWrong) {
  View view;
  EXPECT_EQ(run_program(ROAM_PROGRAM, {"view"}).status, 2);
  EXPECT_EQ(view.run({"--headless"}).result.status, 2);
  EXPECT_EQ(view.run({"--at", "1,2"}).result.status, 2);
  EXPECT_TRUE(contains(view.result.err, "X,Y,Z[,YAW[,PITCH]]")) << view.result.err;
  EXPECT_EQ(view.run({"--time", "0"}).result.status, 2);
  EXPECT_EQ(view.run({"--headless", "--time", "1", "--path", "way.path"}).result.status, 2);
  EXPECT_TRUE(contains(view.result.err, "--path and --time exclude each other")) << view.result.err;
  EXPECT_EQ(run_program(ROAM_PROGRAM, {"view", ""}).status, 2);
  EXPECT_EQ(view.run({"--trace", view.scene + ".new", "--record-path", view.scene + ".new"}).result.status, 2);
  EXPECT_FALSE(std::filesystem::exists(view.scene + ".new"));
  EXPECT_EQ(view.shot({"--bookmark", "shaft"}).result.status, 2);
  EXPECT_TRUE(contains(view.result.err, "no bookmarks")) << view.result.err;
  const std::string settings = view.folder.write("s.json", R"({"keys": {"forward": ["NoSuchKey"]}})");
  EXPECT_EQ(view.shot({"--settings", settings}).result.status, 2);
  EXPECT_TRUE(contains(view.result.err, "s.json") && contains(view.result.err, "NoSuchKey")) << view.result.err;
}

TEST(ViewUsage, StartsAtABookmark) {
  View view;
  std::filesystem::create_directories(view.folder.file("config/roam"));
  const nlohmann::json scene = {{"scene", {std::filesystem::canonical(view.scene).string()}},
                                {"bookmarks", {{{"name", "door"}, {"position", {7, 1, 0.95}}, {"yaw", 90}}}}};
  view.folder.write("config/roam/bookmarks.json", nlohmann::json::array({scene}).dump());
  view.shot({"--bookmark", "door"});
  ASSERT_EQ(view.result.status, 0) << view.result.err;
  EXPECT_NEAR(view.json()["end"]["position"][0], 7.0, 1e-6);
  EXPECT_NEAR(view.json()["end"]["yaw"], 90.0, 1e-6);
}

// ------------------------------------------------------------------------------------------------ what is missing

TEST(ViewMissing, DisplaySaysHeadless) {
  View view;
  const char* display = std::getenv("DISPLAY");
  const std::string before = display == nullptr ? "" : display;
  unsetenv("DISPLAY");
  EXPECT_EQ(view.run({}).result.status, 1);
  EXPECT_TRUE(contains(view.result.err, "--headless")) << view.result.err;
  setenv("DISPLAY", ":4711", 1);
  EXPECT_EQ(view.run({}).result.status, 1);
  EXPECT_TRUE(contains(view.result.err, "--headless")) << view.result.err;
  before.empty() ? unsetenv("DISPLAY") : setenv("DISPLAY", before.c_str(), 1);
}

TEST(ViewMissing, OpenGlSaysWhatToInstall) {
  View view;
  setenv("ROAM_HEADLESS", "xvfb", 1);
  const std::string path = std::getenv("PATH");
  setenv("PATH", view.folder.file("").c_str(), 1);
  view.shot({});
  setenv("PATH", path.c_str(), 1);
  unsetenv("ROAM_HEADLESS");
  EXPECT_EQ(view.result.status, 1);
  EXPECT_TRUE(contains(view.result.err, "xvfb")) << view.result.err;
}

TEST(ViewSite, FollowsTheFrameInWhichTilesAreRead) {
  View view;
  std::filesystem::create_directories(view.folder.file("site/Data/Tile_1"));
  view.folder.write("site/metadata.xml",
                    "<ModelMetadata><SRS>EPSG:32632</SRS><SRSOrigin>512000,5403000,400</SRSOrigin></ModelMetadata>\n");
  view.folder.write("site/Data/Tile_1/Tile_1.osgb",
                    "#Ascii Scene\n#Version 161\n#Generator OpenSceneGraph 3.6.5\n\nosg::Geode {\n UniqueID 1\n "
                    "Drawables 1 {\n  osg::Geometry {\n   UniqueID 2\n   PrimitiveSetList 1 {\n    osg::DrawArrays {\n"
                    "     UniqueID 3\n     Mode TRIANGLES\n     Count 3\n    }\n   }\n   VertexArray TRUE {\n    "
                    "osg::Vec3Array {\n     UniqueID 4\n     Binding BIND_PER_VERTEX\n     vector 3 {\n      90 0 0\n"
                    "      0 90 0\n      0 0 90\n     }\n    }\n   }\n  }\n }\n}\n");
  view.scene = view.folder.file("site");
  const std::string place = "20,-40,60";  // of the centre, 0.5 m above the lowest point
  view.shot({"--hud", "plain", "--mode", "fly", "--sphere", "--radius", "0.5", "--at", place});
  ASSERT_EQ(view.result.status, 0) << view.result.err;
  EXPECT_TRUE(contains(all(view.json()["hud"]), "512020.00, 5402960.00, 459.50 EPSG:32632")) << view.json()["hud"];
  view.shot({"--hud", "plain", "--mode", "fly", "--sphere", "--radius", "0.5", "--at", place, "--up=y"});
  ASSERT_EQ(view.result.status, 0) << view.result.err;
  EXPECT_TRUE(contains(all(view.json()["hud"]), "512020.00, 5403059.50, 440.00 EPSG:32632")) << view.json()["hud"];
}

TEST(ViewMissing, TextureIsNotedAndTheRestShown) {
  View view("mtllib scene.mtl\nusemtl wall\n" + room_obj());
  view.folder.write("scene.mtl", "newmtl wall\nKd 1 1 1\nmap_Kd gone.png\n");
  view.shot({});
  ASSERT_EQ(view.result.status, 0) << view.result.err;
  EXPECT_EQ(view.json()["missing_textures"], 1);
  EXPECT_TRUE(contains(all(view.json()["notes"]), "gone.png")) << view.json()["notes"];
  EXPECT_TRUE(contains(view.result.err, "gone.png"));
  EXPECT_TRUE(contains(all(view.shot({"--hud", "full"}).json()["hud"]), "1 image is missing; the terminal names them"))
      << "in one line";
  EXPECT_GT(view.picture().colours(), 8u);
}

TEST(ViewMissing, PagesOfTilesAreNoted) {
  ROAM_NEEDS_TEST_DATA();
  View view;
  view.scene = roam::test::test_data() / "contextcapture_tiles/Tile_+010_+005_L22_000020t4.osgb";
  view.shot({});
  ASSERT_EQ(view.result.status, 0) << view.result.err;
  EXPECT_GT(view.json()["missing_pages"], 0);
  EXPECT_TRUE(contains(all(view.json()["notes"]), "coarser")) << view.json()["notes"];
  EXPECT_GT(view.picture().colours(), 20u);
}

TEST(ViewMissing, TrianglesAreAnError) {
  const TestFolder folder;
  use_no_settings(folder);
  const std::string scene =
      folder.write("point.ply",
                   "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
                   "end_header\n1 2 3\n");
  const ProgramResult result =
      run_program(ROAM_PROGRAM, {"view", scene, "--headless", "--screenshot", folder.file("shot.png")});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, "point.ply")) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder.file("shot.png")));
}

TEST(ViewMissing, AllButOnePointIsShown) {
  View view("v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n");
  view.shot({});
  ASSERT_EQ(view.result.status, 0) << view.result.err;
  EXPECT_EQ(view.json()["triangles"], 1);
}

TEST(ViewMissing, FloorMakesTheBodyFly) {
  View view("v 0 0 0\nv 10 0 0\nv 10 1 9\nv 0 1 9\nf 1 2 3 4\n");
  view.shot({});
  ASSERT_EQ(view.result.status, 0) << view.result.err;
  EXPECT_EQ(view.json()["mode"], "fly");
  EXPECT_FALSE(view.json()["notes"].empty());
}

TEST(ViewMissing, SceneIsAnError) {
  View view;
  view.scene = view.folder.file("gone.obj");
  EXPECT_EQ(view.shot({}).result.status, 1);
  EXPECT_TRUE(contains(view.result.err, "gone.obj")) << view.result.err;
  view.scene = view.folder.write("broken.obj", "v 0 0 0\nf 1 2 99\nv nonsense\n");
  EXPECT_EQ(view.shot({}).result.status, 1);
  EXPECT_TRUE(contains(view.result.err, "broken.obj")) << view.result.err;
}

TEST(ViewMissing, CollisionLeavesAGhost) {
  View view;
  view.set_reader("case \"$*\" in *--display*) exec \"$real\" \"$@\";; esac\nexit 1\n");
  view.shot({});
  ASSERT_EQ(view.result.status, 0) << view.result.err;
  EXPECT_EQ(view.json()["mode"], "ghost");
  EXPECT_TRUE(contains(all(view.json()["notes"]), "collision")) << view.json()["notes"];
  EXPECT_TRUE(contains(all(view.json()["hud"]), "passes through walls")) << view.json()["hud"];
  // What needs walls is refused.
  const std::string path = view.folder.write("p.path", "2 0 0.9\n4 0 0.9\n");
  EXPECT_EQ(view.run({"--headless", "--path", path}).result.status, 1);
}

TEST(ViewMissing, PictureLeavesTheWalls) {
  View view;
  view.set_reader("case \"$*\" in *--display*) exit 1;; esac\nexec \"$real\" \"$@\"\n");
  const std::string path = view.folder.write("p.path", "2 0 0.3\n25 0 0.3\n");
  view.run({"--headless", "--path", path, "--json"});
  EXPECT_EQ(view.result.status, 3) << view.result.err;
  EXPECT_EQ(view.json()["outcome"], "blocked");
  EXPECT_TRUE(contains(all(view.json()["notes"]), "can be seen")) << view.json()["notes"];
}

TEST(ViewReport, IsPrintedThoughAnErrorEndsTheSession) {
  View view;
  const std::string folder = view.folder.file("out");
  std::filesystem::create_directory(folder);
  view.set_reader("rmdir '" + folder + "' 2> /dev/null\nexec \"$real\" \"$@\"\n");
  view.run({"--headless", "--time", "1", "--json", "--trace", view.folder.file("t.csv"), "--record-path",
            folder + "/way.path"});
  EXPECT_EQ(view.result.status, 1);
  EXPECT_TRUE(contains(view.result.err, folder + "/way.path")) << view.result.err;
  ASSERT_TRUE(view.json().is_object()) << view.result.out;
  EXPECT_EQ(view.json()["roamed"], true);
  EXPECT_EQ(view.json()["written"], nlohmann::json({view.folder.file("t.csv")})) << view.result.out;
}

// ----------------------------------------------------------------------------------------------------- interrupts

TEST(ViewInterrupt, WhileLoadingEndsAtOnceAndLeavesNoReader) {
  View view;
  const std::string pids = view.folder.file("pids");
  view.set_reader("echo $$ >> '" + pids + "'\nexec sleep 100\n");
  view.run({"--headless", "--screenshot", view.folder.file("shot.png")}, {.interrupt_after = 1.5});
  EXPECT_EQ(view.result.status, 130);
  EXPECT_TRUE(contains(view.result.err, "cancelled")) << view.result.err;
  EXPECT_LT(view.seconds, 1.5 + 1.5);
  std::ifstream in(pids);
  int count = 0;
  for (pid_t pid = 0; in >> pid; ++count) EXPECT_NE(::kill(pid, 0), 0) << "a reader still runs";
  EXPECT_EQ(count, 2);
}

/// A million moves are more than there is time to verify.
TEST(ViewInterrupt, WhileRoamingStillTellsAndVerifiesWhereThereIsTime) {
  View view;
  view.run({"--headless", "--time", "1e8", "--json", "--verify", "--at", "5,0,0.95,370"}, {.interrupt_after = 4.0});
  EXPECT_EQ(view.result.status, 130);
  EXPECT_TRUE(contains(view.result.err, "cancelled")) << view.result.err;
  const nlohmann::json report = view.json();
  ASSERT_TRUE(report.is_object()) << view.result.out;
  EXPECT_EQ(report["roamed"], true);
  const bool verified = report["violations"] == 0;
  EXPECT_NE(verified, contains(view.result.err, "were not all verified")) << report["violations"] << view.result.err;
  EXPECT_NEAR(report["start"]["yaw"], 10.0, 1e-9);
  EXPECT_NEAR(report["end"]["yaw"], 10.0, 1e-9);
}

}  // namespace
