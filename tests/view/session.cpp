// A session of roam view that nobody sits at: driven frame by frame, without a screen.
#include <gtest/gtest.h>

#include <fstream>
#include <glm/geometric.hpp>
#include <thread>

#include "roam/error.h"
#include "view_driven.h"

namespace {

using namespace roam;
using namespace roam::app;

/// In a scene of a few triangles.
class Driven : public DrivenSession {
 public:
  Driven() = default;
  explicit Driven(const std::string& text, const std::vector<double>& at = {}, const ViewSettings& settings = {}) {
    write_scene(text);
    options.verify = true;
    options.at = at;
    begin(settings);
  }

  /// Where the window's middle is (0, 0), from -1 to 1.
  void double_click(float x, float y) {
    osgGA::EventQueue& queue = events();
    const osgGA::GUIEventAdapter& now = *queue.getCurrentEventState();
    const float across = 0.5f * (1 + x) * (now.getXmax() - now.getXmin()) + now.getXmin();
    const float up = 0.5f * (1 + y) * (now.getYmax() - now.getYmin()) + now.getYmin();
    queue.mouseButtonPress(across, up, 1);
    queue.mouseButtonRelease(across, up, 1);
    queue.mouseDoubleButtonPress(across, up, 1);
    queue.mouseButtonRelease(across, up, 1);
    run(1.0 / 60.0);
  }
  [[nodiscard]] verification::Verification verified() {
    const ViewReport report = finish();
    return verify(report.meshes, report.pieces);
  }
};

TEST(Session, WalksWhileAKeyIsDownAndStopsAtTheWall) {
  Driven d(room_obj(), {10, 0, 0.95, 0});
  d.press('w');
  d.run(2.0);
  EXPECT_NEAR(d.place().x, 12.8, 0.2);  // 1.4 m/s
  d.run(8.0);
  EXPECT_NEAR(d.place().x, 19.7, 0.01);
  EXPECT_TRUE(contains(d.hud(), "blocked by front")) << d.hud();
  d.release('w');
  d.run(1.0);
  EXPECT_FALSE(contains(d.hud(), "blocked")) << d.hud();
  const verification::Verification proof = d.verified();
  EXPECT_GT(proof.pieces, 300u);
  EXPECT_EQ(proof.violations, 0u);
}

TEST(Session, GoesToWhatIsDoubleClicked) {
  Driven d(room_obj(), {10, 0, 0.95, 0});
  d.session->stage().draw();  // one clicks on what one sees
  d.double_click(0, 0);
  d.run(5.0);
  EXPECT_GT(d.place().x, 15.0);
  EXPECT_EQ(d.verified().violations, 0u);
}

TEST(Session, ComesBackToWhereItCrouched) {
  // Under a table.
  Driven d(
      "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3 4\n"
      "v -1 -1 1.3\nv 1 -1 1.3\nv 1 1 1.3\nv -1 1 1.3\nf 5 6 7 8\n",
      {-0.9, 0, 0.95, 0});
  ASSERT_TRUE(d.session->roamer().walker()->crouched());
  d.run(0.5);
  const Vec3 kept = d.place();
  d.tap('b');
  d.press('w');
  d.run(3.0);
  d.release('w');
  ASSERT_FALSE(d.session->roamer().walker()->crouched());
  d.tap(osgGA::GUIEventAdapter::KEY_Tab);
  EXPECT_LT(glm::distance(d.place(), kept), 0.05) << d.place().x << " " << d.place().z;
}

TEST(Session, TellsWhenItBeginsElsewhere) {
  // In the wall at the front, and where there is room.
  Driven inside(room_obj(), {20, 0, 0.95, 0});
  EXPECT_TRUE(contains(inside.hud(), "The body does not fit at 20.00, 0.00, 0.95: it begins ")) << inside.hud();
  Driven free(room_obj(), {10, 0, 0.95, 0});
  EXPECT_FALSE(contains(free.hud(), "does not fit")) << free.hud();
}

TEST(Session, FliesWhereThereIsNothingToStandOn) {
  // Beside the house: at the start, and by the key.
  Driven d(room_obj(), {40, 0, 0.95, 0});
  EXPECT_EQ(d.session->roamer().mode(), Mode::fly);
  EXPECT_TRUE(contains(d.hud(), "There is nothing below to stand on: flying. G walks again.")) << d.hud();
  EXPECT_NEAR(d.place().z, 0.95, 0.1);
  d.tap('g');
  d.run(3.0);
  EXPECT_EQ(d.session->roamer().mode(), Mode::fly);
  EXPECT_NEAR(d.place().z, 0.95, 0.2);
  EXPECT_FALSE(contains(d.hud(), "fit")) << d.hud();
}

TEST(Session, FliesWhenItIsPutBackToWhereItNeverStood) {
  // Above the floor's edge, gliding off it while it falls.
  Driven d("v 0 -2 0\nv 5 -2 0\nv 5 2 0\nv 0 2 0\nf 1 2 3 4\n", {4.5, 0, 6, 0});
  EXPECT_EQ(d.session->roamer().mode(), Mode::walk);
  d.press('w');
  d.run(6.0);
  EXPECT_EQ(d.session->roamer().mode(), Mode::fly);
}

TEST(Session, EscapeClosesTheHelpFirst) {
  Driven d(room_obj(), {10, 0, 0.95, 0});
  d.tap('h');
  d.tap(osgGA::GUIEventAdapter::KEY_Escape);
  EXPECT_FALSE(d.session->stage().hud().help_shown());
  d.tap(osgGA::GUIEventAdapter::KEY_Escape);
  EXPECT_TRUE(contains(d.hud(), "Escape again ends")) << d.hud();
  d.press(osgGA::GUIEventAdapter::KEY_Escape);
  d.run(1.0 / 60.0);
  d.release(osgGA::GUIEventAdapter::KEY_Escape);
  EXPECT_FALSE(d.session->frame());
}

TEST(Session, ForgetsAnEscapeThatNoOtherFollows) {
  Driven d(room_obj(), {10, 0, 0.95, 0});
  d.tap(osgGA::GUIEventAdapter::KEY_Escape);
  d.run(4.0);
  EXPECT_FALSE(contains(d.hud(), "Escape")) << d.hud();
  d.tap(osgGA::GUIEventAdapter::KEY_Escape);
  EXPECT_TRUE(contains(d.hud(), "Escape again ends"));
}

TEST(Session, EndsAtOnceByF10AndByNoKeysThatMove) {
  Driven d(room_obj(), {10, 0, 0.95, 0});
  d.press(osgGA::GUIEventAdapter::KEY_Control_L);
  d.press('q');  // crouching and down
  d.release('q');
  d.release(osgGA::GUIEventAdapter::KEY_Control_L);
  EXPECT_TRUE(d.session->frame());
  d.press(osgGA::GUIEventAdapter::KEY_F10);
  d.release(osgGA::GUIEventAdapter::KEY_F10);
  EXPECT_FALSE(d.session->frame());
}

TEST(Session, ShowsNoSpeedOfABodyThatWasPutSomewhere) {
  Driven d(room_obj(), {10, 0, 0.95, 0});
  d.press('w');
  d.run(2.0);
  EXPECT_NEAR(d.session->status().speed, 1.4, 0.1);
  d.release('w');
  d.tap(osgGA::GUIEventAdapter::KEY_Home);
  d.run(0.2);
  EXPECT_LT(d.session->status().speed, 0.1);
}

TEST(Session, TakesTheKeysOfTheSettings) {
  ViewSettings settings;
  settings.keys = {{"forward", {"J"}}};
  Driven d(room_obj(), {10, 0, 0.95, 0}, settings);
  d.press('w');
  d.run(1.0);
  EXPECT_NEAR(d.place().x, 10.0, 1e-6);
  d.press('j');
  d.run(1.0);
  EXPECT_GT(d.place().x, 11.0);
}

TEST(Session, HomeReturnsToTheStart) {
  Driven d(room_obj(), {10, 1, 0.95, 0});
  d.run(0.5);
  const Vec3 start = d.place();
  d.press('s');
  d.run(2.0);
  d.release('s');
  EXPECT_GT(glm::distance(d.place(), start), 1.0);
  d.tap(osgGA::GUIEventAdapter::KEY_Home);
  d.run(0.2);
  EXPECT_LT(glm::distance(d.place(), start), 0.1);
}

TEST(Session, CyclesTheDisplayAndShowsTheHelp) {
  Driven d(room_obj(), {10, 0, 0.95, 0});
  EXPECT_TRUE(contains(d.hud(), "feet"));
  EXPECT_FALSE(contains(d.hud(), "memory"));
  d.session->stage().hint("walk this way");
  EXPECT_TRUE(contains(d.hud(), "walk this way"));
  d.tap('h');
  EXPECT_FALSE(contains(d.hud(), "walk this way")) << "it would lie over the help";
  EXPECT_TRUE(contains(d.hud(), "goes to the clicked place"));
  EXPECT_TRUE(contains(d.hud(), "keeps this place as a bookmark"));
  d.tap('h');
  EXPECT_FALSE(contains(d.hud(), "bookmark"));
  d.tap(osgGA::GUIEventAdapter::KEY_F1);
  EXPECT_TRUE(contains(d.hud(), "memory") && contains(d.hud(), "display: all figures")) << d.hud();
  d.tap(osgGA::GUIEventAdapter::KEY_F1);
  EXPECT_FALSE(contains(d.hud(), "feet"));
  EXPECT_TRUE(contains(d.hud(), "walk"));
  d.tap(osgGA::GUIEventAdapter::KEY_F1);
  EXPECT_EQ(d.hud(), "display: none\n");
  d.run(2.0);
  EXPECT_EQ(d.hud(), "");
  d.tap(osgGA::GUIEventAdapter::KEY_F1);
  EXPECT_TRUE(contains(d.hud(), "feet"));
}

TEST(Session, SaysWhereTheFeetAreAndWhatIsAhead) {
  Driven d(room_obj(), {10, 0, 2.4, -30});
  d.session->roamer().setMode(Mode::fly);
  std::string hud = d.hud();
  EXPECT_TRUE(contains(hud, "feet: 10.00, 0.00, 1.50\nheight: 1.50 m above the floor")) << hud;
  EXPECT_TRUE(contains(hud, "heading: 120\u00b0 SE, level")) << hud;
  EXPECT_TRUE(contains(hud, "ahead: right, 4.00 m")) << hud;
  d.session->roamer().setMode(Mode::walk);
  d.run(2.0);
  EXPECT_TRUE(contains(d.hud(), "height: on the floor")) << d.hud();
}

TEST(Session, SaysTheSpeedThatTheWheelSets) {
  Driven d(room_obj(), {10, 0, 0.95, 0});
  d.run(0.2);
  d.session->roamer().setSpeed(2.5);
  EXPECT_TRUE(contains(d.hud(), "speed 2.5 m/s")) << d.hud();
}

TEST(Session, KeepsBookmarksAndGoesThere) {
  Driven d(room_obj(), {10, 1, 0.95, 0});
  d.run(0.5);
  const Vec3 kept = d.place();
  d.tap('b');
  d.press('w');
  d.run(2.0);
  d.release('w');
  d.tap('b');
  d.session.reset();
  d.begin();
  d.tap(osgGA::GUIEventAdapter::KEY_Tab);
  EXPECT_LT(glm::distance(d.place(), kept), 0.1) << "the first";
  d.tap(osgGA::GUIEventAdapter::KEY_Tab);
  EXPECT_GT(glm::distance(d.place(), kept), 2.0);
  EXPECT_TRUE(std::filesystem::exists(d.folder.file("config/roam/bookmarks.json")));
}

TEST(Session, TakesEachPressOfAFrame) {
  Driven d(room_obj(), {10, 1, 0.95, 0});
  for (const bool down : {true, false, true, false}) down ? d.press('b') : d.release('b');
  d.press(osgGA::GUIEventAdapter::KEY_Control_L);
  d.press('b');
  const std::string hud = d.hud();
  EXPECT_TRUE(contains(hud, "bookmark 2") && contains(hud, "Name of the bookmark")) << hud;
}

TEST(Session, GoesToABookmarkInEveryCamera) {
  Driven d(room_obj(), {10, 1, 0.95, 0});
  std::vector<Vec3> kept;
  for (int i = 0; i < 3; ++i) {
    d.run(0.5);
    d.tap('b');
    kept.push_back(d.place());
    d.press('w');
    d.run(1.0);
    d.release('w');
  }
  constexpr int tab = osgGA::GUIEventAdapter::KEY_Tab, shift = osgGA::GUIEventAdapter::KEY_Shift_L;
  d.tap('2');
  d.tap(tab);
  EXPECT_TRUE(d.session->roamer_leads()) << "one sees the bookmark";
  EXPECT_LT(glm::distance(d.place(), kept[0]), 0.05);
  d.tap('2');
  d.tap(tab);
  ASSERT_LT(glm::distance(d.place(), kept[1]), 0.05);
  d.tap('2');
  d.events().keyPress(shift, shift);
  d.tap(tab);
  d.events().keyRelease(shift, shift);
  EXPECT_LT(glm::distance(d.place(), kept[0]), 0.05) << "backwards";
}

TEST(Session, ShowsNothingOfTheLoadingWithTheBody) {
  Driven d(room_obj(), {10, 1, 0.95, 0});
  EXPECT_FALSE(contains(d.session->stage().hud().text(), "oading")) << "it would be in a film";
}

TEST(Session, ReplacesABookmarkOfTheSameNameIfItIsSaidTwice) {
  Driven d(room_obj(), {10, 1, 0.95, 0});
  d.tap('b');
  d.tap('b');
  d.session->run("name_bookmark");
  d.tap('1');
  d.tap(osgGA::GUIEventAdapter::KEY_Return);
  EXPECT_TRUE(contains(d.hud(), "of this name. Name: 1_")) << d.hud();
  d.tap(osgGA::GUIEventAdapter::KEY_Escape);
  d.tap(osgGA::GUIEventAdapter::KEY_Tab);
  EXPECT_TRUE(contains(d.hud(), "of 2)")) << "nothing has changed: " << d.hud();
  d.tap(osgGA::GUIEventAdapter::KEY_Tab);
  ASSERT_TRUE(contains(d.hud(), "bookmark 2 (2 of 2)")) << d.hud();
  d.session->run("name_bookmark");
  d.tap('1');
  d.tap(osgGA::GUIEventAdapter::KEY_Return);
  d.tap(osgGA::GUIEventAdapter::KEY_Return);
  d.tap(osgGA::GUIEventAdapter::KEY_Tab);
  EXPECT_TRUE(contains(d.hud(), "bookmark 1 (1 of 1)")) << d.hud();
}

TEST(Session, NamesABookmarkByTyping) {
  Driven d(room_obj(), {10, 1, 0.95, 0});
  d.session->run("name_bookmark");
  EXPECT_TRUE(contains(d.hud(), "keep one first")) << d.hud();
  d.tap('b');
  const Vec3 before = d.place();
  d.session->run("name_bookmark");
  EXPECT_TRUE(contains(d.hud(), "Name of the bookmark: _")) << "no name is proposed: " << d.hud();
  d.tap(osgGA::GUIEventAdapter::KEY_BackSpace);
  for (const int key : {int{'w'}, int{'x'}, 0xfc, 0x01000416, int{' '}, int{'2'}}) d.tap(key);
  EXPECT_TRUE(contains(d.hud(), "Name of the bookmark: wx\u00fc\u0416 2_")) << d.hud();
  d.tap(osgGA::GUIEventAdapter::KEY_BackSpace);
  d.tap(osgGA::GUIEventAdapter::KEY_BackSpace);
  d.tap(osgGA::GUIEventAdapter::KEY_BackSpace);
  d.tap(osgGA::GUIEventAdapter::KEY_Return);
  EXPECT_TRUE(contains(d.hud(), "bookmark wx\u00fc")) << d.hud();
  EXPECT_LT(glm::distance(d.place(), before), 1e-6) << "the typed keys moved nobody";
  d.session->run("name_bookmark");
  EXPECT_TRUE(contains(d.hud(), "Name of the bookmark: wx\u00fc_")) << "a name of its own can be mended: " << d.hud();
  d.tap('z');
  d.tap(osgGA::GUIEventAdapter::KEY_Escape);
  EXPECT_FALSE(contains(d.hud(), "Name of the bookmark"))
      << "and Escape does not begin to end the session: " << d.hud();
  EXPECT_FALSE(contains(d.hud(), "again")) << d.hud();
  d.tap(osgGA::GUIEventAdapter::KEY_Tab);
  EXPECT_TRUE(contains(d.hud(), "bookmark wx\u00fc (1 of 1)")) << d.hud();
}

TEST(Session, ShowsItsQuestionUntilTheAnswer) {
  Driven d(room_obj(), {10, 1, 0.95, 0});
  d.tap('b');
  d.session->run("name_bookmark");
  d.session->roamer().setSpeed(2.5);
  d.run(0.2);
  EXPECT_TRUE(contains(d.hud(), "Name of the bookmark: _")) << d.hud();
  EXPECT_FALSE(contains(d.hud(), "speed 2.5 m/s")) << d.hud();
  d.tap(osgGA::GUIEventAdapter::KEY_Escape);
  EXPECT_FALSE(contains(d.hud(), "Name of the bookmark")) << d.hud();
}

TEST(Session, RecordsTheWayThatWasWalked) {
  Driven d(room_obj(), {10, 0, 0.95, 0});
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(d.folder.file(""));
  d.tap('r');
  d.press('w');
  d.run(2.0);
  d.release('w');
  EXPECT_TRUE(contains(d.hud(), "recording: 2.")) << d.hud();
  d.tap('r');
  EXPECT_TRUE(contains(d.hud(), "written: " + d.folder.file("roam-1.path"))) << d.hud();
  std::filesystem::current_path(before);
  const std::vector<Waypoint> path = load_path(d.folder.file("roam-1.path"));
  EXPECT_NEAR(path.front().position.x, 10.0, 0.1);
  EXPECT_LT(glm::distance(path.back().position, d.place()), 1e-6);
  ASSERT_TRUE(path.back().pose.has_value());
  EXPECT_GT(path.back().pose->time, 1.9);
  // Whoever goes it again is the same body, without being told.
  const Vec3 end = d.place();
  for (const char* verb : {"walk", "view"}) {
    std::vector<std::string> arguments{verb, d.folder.file("scene.obj"), "--json", "--path",
                                       d.folder.file("roam-1.path")};
    if (arguments[0] == "view") arguments.emplace_back("--headless");
    const ProgramResult again = run_program(ROAM_PROGRAM, arguments);
    ASSERT_EQ(again.status, 0) << verb << again.err << again.out;
    const nlohmann::json report = nlohmann::json::parse(again.out);
    EXPECT_EQ(report["height"], 1.8) << verb;
    EXPECT_NEAR(report["end"]["position"][0], end.x, 0.31) << verb;
    EXPECT_NEAR(report["end"]["position"][2], end.z, 0.01) << verb;
    EXPECT_FALSE(contains(again.err, "another body"));
  }
  const ProgramResult smaller = run_program(
      ROAM_PROGRAM, {"walk", d.folder.file("scene.obj"), "--path", d.folder.file("roam-1.path"), "--radius", "0.2"});
  EXPECT_TRUE(contains(smaller.err, "recorded by another body: radius 0.3 m, height 1.8 m")) << smaller.err;
}

TEST(Session, SwitchesToTheCamerasOfOsgviewerAndBack) {
  Driven d(room_obj(), {10, 0, 0.95, 0});
  d.tap('2');
  EXPECT_FALSE(d.session->roamer_leads());
  EXPECT_TRUE(contains(d.hud(), "trackball  (1: back to the body)")) << d.hud();
  // The viewer's own commands work all the same.
  d.tap('h');
  EXPECT_TRUE(contains(d.hud(), "looks around"));
  d.tap('h');
  d.tap('1');
  EXPECT_TRUE(d.session->roamer_leads());
  d.press('w');
  d.run(1.0);
  EXPECT_EQ(d.verified().violations, 0u);
}

TEST(Session, RunsACommandOncePerPressInEveryCamera) {
  Driven d(room_obj(), {10, 0, 0.95, 0});
  const auto size = [&] { return d.session->tools().plan().size(); };
  d.tap('2');
  for (int i = 0; i < 2; ++i) d.press('l');  // a held key repeats
  d.run(0.1);
  EXPECT_EQ(size(), graphics::PlanSize::small);
  d.release('l');
  d.press('l');
  d.run(0.1);
  EXPECT_EQ(size(), graphics::PlanSize::large);
  d.events().keyPress('l', d.events().getTime() + 1.5);  // the release before was lost
  d.run(0.1);
  EXPECT_EQ(size(), graphics::PlanSize::none);
}

TEST(Session, ShowsTheBodyAndWhatIsNear) {
  Driven d(room_obj(), {19, 0, 0.95, 0});
  d.press('w');
  d.run(1.0);
  d.tap('v');
  const std::string shot = d.folder.file("marks.png");
  d.session->stage().draw_picture(shot);
  const Shot marked(shot);
  d.tap('v');
  d.session->stage().draw_picture(shot);
  const Shot plain(shot);
  int different = 0;
  for (int y = 0; y < plain.height(); ++y) {
    for (int x = 0; x < plain.width(); ++x) different += (plain.at(x, y) - marked.at(x, y)).length() > 0.1f;
  }
  EXPECT_GT(different, 50);
}

TEST(Session, IsAGhostAndComesBackToASafePlace) {
  Driven d(room_obj(), {19, 0, 0.95, 0});
  d.run(0.3);
  d.tap('n');
  d.press('w');
  d.run(0.7);
  EXPECT_GT(d.place().x, 19.71);
  d.release('w');
  d.tap('n');
  d.run(0.3);
  EXPECT_EQ(d.session->roamer().mode(), Mode::walk);
  EXPECT_EQ(d.verified().violations, 0u);
}

TEST(Session, FallsNowhereForGood) {
  // A floor that ends: whoever walks over its edge, where nothing is below, is put back.
  Driven d("v 0 -2 0\nv 5 -2 0\nv 5 2 0\nv 0 2 0\nf 1 2 3 4\n", {3, 0, 0.95, 0});
  d.press('w');
  d.run(10.0);
  d.release('w');
  d.run(1.0);
  EXPECT_GT(d.place().z, 0.0);
  EXPECT_LT(d.place().x, 5.6);
}

TEST(Session, SaysAtItsEndThatAPictureCouldNotBeDrawn) {
  for (const double scale : {1.0, 2.0}) {
    ViewSettings settings;
    settings.picture_scale = scale;
    Driven d(room_obj(), {10, 0, 0.95, 0}, settings);
    d.tap('p');
    d.session->stage().viewer().setDone(true);  // as when the window is closed
    Unwritten unwritten;
    static_cast<void>(d.session->finish(unwritten));
    EXPECT_TRUE(unwritten.any()) << scale;
    try {
      unwritten.raise();
    } catch (const Error& error) {
      EXPECT_TRUE(contains(error.what(), scale > 1.0 ? "cannot be drawn" : "no picture was drawn")) << error.what();
    }
  }
}

TEST(Session, DrawsItsPictureThoughItEndsInTheSameFrame) {
  Driven d(room_obj(), {10, 0, 0.95, 0});
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(d.folder.file(""));
  d.press('p');
  d.session->run("quit");
  EXPECT_FALSE(d.session->frame());
  EXPECT_NO_THROW(static_cast<void>(d.finish()));
  std::filesystem::current_path(before);
  EXPECT_TRUE(std::filesystem::exists(d.folder.file("roam-1.png")));
}

TEST(Session, KeepsNoMoreThanSomePicturesInMemory) {
  Driven d;
  d.options.size = "8000x4000";  // 92 MiB each
  d.write_scene();
  d.begin();
  const auto is_refused = [&] { return contains(d.hud(), "Earlier pictures are still being written"); };
  for (int i = 0; i < 6; ++i) {
    EXPECT_FALSE(is_refused()) << i;
    d.tap('p');
  }
  d.tap('p');
  EXPECT_TRUE(is_refused()) << d.hud();
}

TEST(Session, TakesNoMoreMemoryTheLongerItIs) {
  Driven d(room_obj(), {10, 0, 0.95, 30});
  d.session->stage().set_hud(HudMode::off);
  std::uint64_t before = 0;
  unsigned state = 7;
  for (int i = 0; i < 36000; ++i) {  // ten minutes
    if (i == 6000) before = resident_bytes();
    state = state * 1664525u + 1013904223u;
    const int key = "wasdqe gnc"[(state >> 16) % 10];
    (state >> 28) % 2 ? d.press(key) : d.release(key);
    ASSERT_TRUE(d.session->frame());
  }
  // --verify keeps what it will check: about 200 bytes a step. The address sanitizer also keeps what is freed.
#ifdef __SANITIZE_ADDRESS__
  before += 300'000'000;
#endif
  EXPECT_LT(static_cast<double>(resident_bytes()) - static_cast<double>(before), 40e6);
  EXPECT_EQ(d.verified().violations, 0u);
}

}  // namespace
