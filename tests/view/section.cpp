// Sections of roam view: planes and a box that hide, and a body that may pass.
#include "view/section.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>

#include "cli/exit_status.h"
#include "view/section_grips.h"
#include "view_tooled.h"

namespace {

using namespace roam;
using namespace roam::app;
using view_stores::Tooled;

TEST(Section, HidesAClickedSurfaceAndWhatIsBeforeIt) {
  Tooled d;
  d.tap('x');
  EXPECT_TRUE(contains(d.hud(), "Section: click what is to be hidden, turn the wheel to cut deeper; X ends"))
      << d.hud();
  d.click(0, 0);
  d.tap('t');
  d.click(0.2, 0);  // at the same place it would be a double click
  EXPECT_TRUE(contains(d.hud(), "There is no surface here")) << "the wall is hidden: " << d.hud();
  d.click(0, -0.9);
  EXPECT_TRUE(contains(d.hud(), "There is no surface here")) << "so is all that is before it: " << d.hud();
  const Vec3 before = d.place();
  d.run(1.0);
  EXPECT_LT(glm::distance(d.place(), before), 1e-3) << "the body still stands on the floor";
  d.tap('x');
  d.tap('x');
  EXPECT_TRUE(contains(d.hud(), "All is shown again")) << d.hud();
  d.tap('t');
  d.click(0.3, -0.9);
  ASSERT_TRUE(d.until([&] { return contains(d.hud(), ", floor, slope 0"); })) << d.hud();
  EXPECT_TRUE(json_report(d.finish())["section"].empty());
}

TEST(Section, IsMovedByTheWheel) {
  Tooled d;
  d.tap('x');
  d.click(0, -0.9);
  EXPECT_TRUE(contains(d.hud(), "Cut below the eye, at z = 1.")) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "section: a plane at z = 1.")) << d.hud();
  d.events().mouseScroll(osgGA::GUIEventAdapter::SCROLL_UP);
  d.events().mouseScroll(osgGA::GUIEventAdapter::SCROLL_UP);
  d.run(0.1);
  const Json json = json_report(d.finish());
  ASSERT_EQ(json["section"].size(), 1u);
  EXPECT_NEAR(json["section"][0]["normal"][2], 1.0, 1e-6);
  const double eye = json["end"]["eye"][2];
  EXPECT_LT(json["section"][0]["distance_m"], eye - 0.1) << "a clicked floor is cut at the height of the eye";
  EXPECT_GT(json["section"][0]["distance_m"], eye - 0.5);
}

ViewOptions with_section(const std::vector<std::string>& section, bool pass_hidden) {
  ViewOptions options;
  options.section = section;
  options.pass_hidden = pass_hidden;
  return options;
}

SectionShape section_of(const std::vector<std::string>& options) {
  SectionShape shape;
  for (const std::string& text : options) add_section(text, shape);
  return shape;
}

TEST(Section, IsGivenByOptions) {
  const SectionShape shape = section_of({"z<2.5", "x>-10", "box 10 0,3 0 -5 0"});
  ASSERT_EQ(shape.planes.size(), 2u);
  EXPECT_EQ(shape.planes[0], (HalfSpace{{0, 0, 1}, 2.5}));
  EXPECT_EQ(shape.planes[1], (HalfSpace{{-1, 0, 0}, 10}));
  ASSERT_TRUE(shape.box);
  EXPECT_EQ(shape.box->lower, Vec3(0, -5, 0));
  EXPECT_EQ(shape.box->upper, Vec3(10, 0, 3));
  const std::vector<HalfSpace> hidden = shape.hidden();
  ASSERT_EQ(hidden.size(), 8u);
  const auto is_hidden = [&](const Vec3& p) {
    return std::any_of(hidden.begin(), hidden.end(), [&](const HalfSpace& half) { return half.holds(p); });
  };
  EXPECT_FALSE(is_hidden({5, -1, 2}));
  for (const Vec3& p : {Vec3(5, -1, 2.7), Vec3(-1, -1, 2), Vec3(5, -6, 2), Vec3(5, 1, 2)}) EXPECT_TRUE(is_hidden(p));
  for (const char* text : {"", "z", "z<", "w<1", "z=1", "z<a", "z<nan", "z<1e300", "z<1 ", "box", "box 1 2 3",
                           "box 0 0 0, 1 1 1 1", "box 0 0 0, 1 1 x", "box 0 0 0, 5 5 0", "box 0 0 0, 5 5 1e300"}) {
    EXPECT_THROW((void)section_of({text}), UsageError) << text;
  }
  EXPECT_THROW((void)section_of({"box 0 0 0, 1 1 1", "box 0 0 0, 1 1 1"}), UsageError);
  EXPECT_THROW((void)section_of(std::vector<std::string>(7, "z<2")), UsageError);
}

/// The box of the report.
std::optional<Box> box_of(Tooled& d) { return d.session->tools().section().box; }

/// Where a grip of the box is in the picture.
std::array<double, 2> grip_place(Tooled& d, Grip grip) {
  d.session->stage().draw();
  return *seen_at(d.session->tools().camera(), place_of(grip, *box_of(d)));
}

void tap_box(Tooled& d) {
  d.session->stage().draw();
  d.press(osgGA::GUIEventAdapter::KEY_Control_L);
  d.tap('x');
  d.release(osgGA::GUIEventAdapter::KEY_Control_L);
  d.run(0.1);
}

TEST(SectionBox, BeginsAroundTheRoomAndEndsWithItsKey) {
  Tooled d;
  tap_box(d);
  EXPECT_TRUE(contains(d.hud(), "Box: drag its points")) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "section: a box of 16.20 x 4.20 x 3.20 m; the body meets")) << d.hud();
  ASSERT_TRUE(box_of(d));
  EXPECT_NEAR(box_of(d)->center().x, 10.0, 0.01) << "8 m to either side";
  EXPECT_NEAR(box_of(d)->lower.z, -0.1, 0.01) << "the floor is in it";
  const Json during = json_report(d.finish());
  EXPECT_NEAR(during["section_box"]["upper"][0], 18.1, 0.1);
  tap_box(d);
  EXPECT_FALSE(box_of(d));
  EXPECT_TRUE(contains(d.hud(), "All is shown again")) << d.hud();
  EXPECT_TRUE(json_report(d.finish())["section_box"].is_null());
}

/// A box about the wall ahead.
ViewOptions with_box_ahead() { return with_section({"box 16.5 -3.5 -2, 23.5 3.5 5"}, false); }

TEST(SectionBox, IsResizedAndMovedByItsGrips) {
  Tooled d(with_box_ahead());
  tap_box(d);
  const Box first = *box_of(d);
  const double yaw = d.session->roamer().yaw();
  constexpr Grip top = 5;
  const auto from = grip_place(d, top);
  d.drag(from, {from[0], from[1] - 0.2});
  const Box lower = *box_of(d);
  EXPECT_LT(lower.upper.z, first.upper.z - 0.5) << "the top follows the mouse";
  EXPECT_NEAR(grip_place(d, top)[1], from[1] - 0.2, 0.01);
  EXPECT_EQ(lower.lower, first.lower);
  EXPECT_EQ(lower.upper.x, first.upper.x);
  const auto middle = grip_place(d, middle_grip);
  d.drag(middle, {middle[0] + 0.1, middle[1]});
  const Box moved = *box_of(d);
  EXPECT_LT(glm::distance(moved.size(), lower.size()), 1e-9);
  EXPECT_LT(moved.center().y, lower.center().y - 0.3) << "to the right, which is -y";
  EXPECT_NEAR(moved.center().z, lower.center().z, 1e-6);
  EXPECT_EQ(d.session->roamer().yaw(), yaw) << "the gaze stays";
  d.drag({0.9, 0.9}, {0.5, 0.9});
  EXPECT_NE(d.session->roamer().yaw(), yaw) << "beside the grips one looks around";
}

TEST(SectionBox, LetsAGripGoUnderTheHelp) {
  Tooled d(with_box_ahead());
  tap_box(d);
  const Box before = *box_of(d);
  graphics::Hud& hud = d.session->stage().hud();
  d.hold_at(grip_place(d, 5));
  d.run(0.1);
  hud.show_help(true);
  d.let_go();
  d.run(0.1);
  hud.show_help(false);
  const osgGA::GUIEventAdapter& now = *d.events().getCurrentEventState();
  d.events().mouseButtonPress(now.getX(), now.getY(), 3);
  d.drag_to({0.0, -0.5});
  EXPECT_EQ(box_of(d)->upper, before.upper) << "another button drags no side";
}

TEST(SectionBox, IsShrunkByTheWheelAndMovedByAClick) {
  Tooled d(with_box_ahead());
  tap_box(d);
  const Box first = *box_of(d);
  d.point_at(0.9, 0.9);
  d.events().mouseScroll(osgGA::GUIEventAdapter::SCROLL_UP);
  d.run(0.1);
  const Box smaller = *box_of(d);
  EXPECT_LT(smaller.size().x, first.size().x - 0.1);
  EXPECT_LT(glm::distance(smaller.center(), first.center()), 1e-9);
  const auto top = grip_place(d, 5);
  d.point_at(top[0], top[1]);
  d.events().mouseScroll(osgGA::GUIEventAdapter::SCROLL_UP);
  d.run(0.1);
  EXPECT_LT(box_of(d)->upper.z, smaller.upper.z - 0.1) << "over a grip its side alone";
  EXPECT_EQ(box_of(d)->lower, smaller.lower);
  const Vec3 size = box_of(d)->size();
  d.click(0.0, -0.3);
  EXPECT_LT(glm::distance(box_of(d)->size(), size), 1e-9);
  EXPECT_GT(glm::distance(box_of(d)->center(), smaller.center()), 0.5);
}

TEST(SectionBox, LeavesThePlanes) {
  Tooled d(with_section({"z<2.9"}, false));
  tap_box(d);
  tap_box(d);
  EXPECT_TRUE(contains(d.hud(), "The rest of the section stays")) << d.hud();
  EXPECT_EQ(d.session->tools().section().planes.size(), 1u);
}

TEST(SectionBox, KeepsItsLeastSide) {
  const Box box{{0, 0, 0}, {1, 2, 3}};
  const Box least = grown_at(middle_grip, box, -9.0, 0.5);
  EXPECT_LT(glm::distance(least.size(), Vec3(0.5)), 1e-9);
  EXPECT_LT(glm::distance(least.center(), box.center()), 1e-9);
  const Box side = grown_at(0, box, -9.0, 0.5);
  EXPECT_EQ(side.upper, box.upper);
  EXPECT_NEAR(side.lower.x, 0.5, 1e-9);
}

// ------------------------------------------------------------------------------------------------ open for the body

/// Where the body gets to, flying along +x for 9 s.
double flies_to(Tooled& d) {
  d.session->roamer().setMode(Mode::fly);
  d.press('w');
  d.run(9.0);
  d.release('w');
  d.run(0.5);
  return d.place().x;
}

TEST(OpenSection, LetsTheBodyThroughWhatIsHiddenWhole) {
  Tooled shut(with_section({"x<15"}, false)), open(with_section({"x<15"}, true));
  EXPECT_TRUE(contains(shut.hud(), "section: a plane at x = 15.00 m; the body meets what is hidden")) << shut.hud();
  EXPECT_TRUE(contains(open.hud(), "section: a plane at x = 15.00 m; the body passes")) << open.hud();
  EXPECT_NEAR(flies_to(shut), 19.7, 0.02) << "the wall at 20 m";
  EXPECT_GT(flies_to(open), 20.3);
  const ViewReport report = open.finish();
  EXPECT_EQ(std::count(report.notes.begin(), report.notes.end(), "The body passes through what is hidden."), 1)
      << "it is said on the console";
  EXPECT_EQ(json_report(report)["section_passed"], true);
  EXPECT_EQ(json_report(shut.finish())["section_passed"], false);
}

TEST(OpenSection, LeavesWhatIsSeenInPartSolid) {
  Tooled d(with_section({"z<1.5", "box -1 -3 -1, 25 3 5"}, true));
  EXPECT_TRUE(contains(d.hud(), "section: a box of 26.00 x 6.00 x 6.00 m and a plane at z = 1.50 m; the")) << d.hud();
  EXPECT_NEAR(flies_to(d), 19.7, 0.02) << "half of the wall is seen";
  // The ceiling is hidden whole.
  d.session->roamer().setPose({10, 0, 1.5}, 0.0, 0.0);
  d.press('e');
  d.run(4.0);
  EXPECT_GT(d.place().z, 3.5);
}

TEST(OpenSection, IsSwitchedByAKeyAndFollowsTheBox) {
  Tooled d(with_section({"box -1 -3 -1, 15 3 5"}, false));
  const std::shared_ptr<const Space> solid = d.session->roamer().space();
  const auto tap = [&] {
    d.press(osgGA::GUIEventAdapter::KEY_Control_L);
    d.tap('n');
    d.release(osgGA::GUIEventAdapter::KEY_Control_L);
    d.run(0.1);
  };
  tap();
  EXPECT_TRUE(contains(d.hud(), "the body passes through what is hidden whole")) << d.hud();
  const std::shared_ptr<const Space> open = d.session->roamer().space();
  EXPECT_NE(open, solid);
  const auto is_wall = [&](const Space& space) { return space.ray({18, 0, 1.5}, {5, 0, 0}).hit; };
  EXPECT_TRUE(is_wall(*solid));
  EXPECT_FALSE(is_wall(*open));
  tap_box(d);
  tap_box(d);  // which ends the box
  EXPECT_TRUE(is_wall(*d.session->roamer().space())) << "nothing is hidden any more";
  tap();
  EXPECT_EQ(d.session->roamer().space(), solid);
  EXPECT_TRUE(contains(d.hud(), "The body meets what is hidden")) << d.hud();
}

TEST(OpenSection, OfAStoreLetsTheBodyThroughToo) {
  Tooled d(with_section({"x<15", "z<1.5"}, true), true);
  EXPECT_TRUE(contains(d.hud(), "section: 2 planes, the last at z = 1.50 m; the body passes through what")) << d.hud();
  EXPECT_FALSE(contains(d.notes(), "With a store"));
  EXPECT_GT(flies_to(d), 20.3);
  // A part of the wall behind is still drawn.
  d.session->roamer().setPose({10, 0, 1.5}, std::numbers::pi, 0.0);
  EXPECT_NEAR(flies_to(d), 0.3, 0.02);
  d.session->hidden().pass_through(false);
  d.session->roamer().setPose({10, 0, 1.5}, 0.0, 0.0);
  EXPECT_NEAR(flies_to(d), 19.7, 0.02);
}

TEST(OpenSection, OfAStoreIsReportedApartFromItsObjects) {
  ViewOptions options = with_section({"x<15"}, true);
  options.hide = {"front"};
  const Json json = json_report(Tooled(options, true).finish());
  EXPECT_EQ(json["hidden"]["objects"], 1);
  EXPECT_EQ(json["hidden"]["passed"], false);
  EXPECT_EQ(json["section_passed"], true);
}

double pace(Tooled& d) { return glm::length(d.session->roamer().walker()->pace()); }

TEST(OpenSection, KeepsTheBodysMotionWhileItsBoxIsDragged) {
  Tooled d(with_section({"box 12 -3 -1, 18 3 5"}, true));
  d.session->run("section_box");
  d.press('w');
  d.run(0.5);
  ASSERT_NEAR(pace(d), 1.4, 0.01);
  const auto middle = grip_place(d, middle_grip);
  d.hold_at(middle);
  for (int i = 0; i < 12; ++i) {
    const double x = d.place().x, y = box_of(d)->center().y;
    d.drag_to({middle[0] + 0.01 * (i + 1), middle[1]});
    EXPECT_NE(box_of(d)->center().y, y) << "the box moves in each frame";
    EXPECT_NEAR(pace(d), 1.4, 0.01);
    EXPECT_GT(d.place().x, x + 0.02);
  }
  d.let_go();
  d.release('w');
  d.run(0.5);
  // So does the way to a place that was clicked.
  d.session->roamer().goTo({18.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  d.run(0.1);
  d.drag(grip_place(d, middle_grip), {0.3, 0.1});
  EXPECT_TRUE(d.session->roamer().going());
  d.run(6.0);
  EXPECT_NEAR(d.place().x, 18.0, 0.05);
}

/// Shows all that the planes hide, while the body passes through it.
void show_all_again(Tooled& d) {
  d.tap('x');
  d.tap('x');
  ASSERT_TRUE(d.session->tools().section().empty());
}

TEST(OpenSection, StopsTheBodyAtAWallThatIsSeenAgain) {
  Tooled d(with_section({"x<15"}, true));
  d.session->roamer().setMode(Mode::fly);
  d.press('w');
  ASSERT_TRUE(d.until([&] { return d.place().x > 19.5; }));
  const double x = d.place().x;
  show_all_again(d);
  EXPECT_GT(d.place().x, x) << "the body keeps its motion until it is there";
  d.run(2.0);
  EXPECT_NEAR(d.place().x, 19.7, 0.02);
}

TEST(OpenSection, FreesTheBodyOfAWallThatIsSeenAgain) {
  Tooled d(with_section({"x<15"}, true));
  d.session->roamer().setMode(Mode::fly);
  d.press('w');
  ASSERT_TRUE(d.until([&] { return d.place().x > 19.8; }));
  d.release('w');
  show_all_again(d);
  d.run(0.5);
  const Walker& walker = *d.session->roamer().walker();
  EXPECT_FALSE(walker.held());
  EXPECT_NEAR(d.place().x, 19.7, 0.02) << "on the side of the wall where its centre was";
  EXPECT_TRUE(d.session->hidden().met().space->fits(walker.body(), walker.position()));
}

TEST(OpenSection, KeepsTheBodyBetweenTheFacesOfAThickWallUntilItIsOpenAgain) {
  const std::string wall =
      "v 12 -2 0\nv 12 2 0\nv 12 2 3\nv 12 -2 3\nv 16 -2 0\nv 16 2 0\nv 16 2 3\nv 16 -2 3\n"
      "o wall\nf 9 10 11 12\nf 16 15 14 13\n";
  Tooled d(with_section({"x<11"}, true), false, room_obj() + wall);
  d.session->roamer().setMode(Mode::fly);
  d.press('w');
  ASSERT_TRUE(d.until([&] { return d.place().x > 13.5; }));
  d.release('w');
  d.session->hidden().pass_through(false);
  EXPECT_NEAR(flies_to(d), 15.7, 0.02) << "no triangle cuts the body, so nothing frees it";
  EXPECT_FALSE(d.session->roamer().walker()->held());
  d.session->hidden().pass_through(true);
  EXPECT_GT(flies_to(d), 20.3);
}

/// A picture of the room from above; with a section, its roof is not shown.
Shot from_above(const std::vector<std::string>& section) {
  view_stores::Driven d;
  d.write_scene();
  d.options.at = {10, 0, 12, 0, -85};
  d.options.mode = Mode::ghost;
  d.options.size = "320x180";
  d.options.section = section;
  d.begin();
  d.run(0.2);
  const std::string shot = d.folder.file("above.png");
  d.session->stage().draw_picture(shot);
  return Shot(shot);
}

TEST(Section, LetsOneLookIntoARoomFromAbove) {
  const Shot closed = from_above({}), high = from_above({"z<10"}), open = from_above({"z<2.9"});
  int same = 0, other = 0;
  for (int y = 0; y < closed.height(); ++y) {
    for (int x = 0; x < closed.width(); ++x) {
      same += (closed.at(x, y) - high.at(x, y)).length() > 0.02;
      other += (closed.at(x, y) - open.at(x, y)).length() > 0.02;
    }
  }
  EXPECT_EQ(same, 0);
  EXPECT_GT(other, 1000);
}

TEST(SectionBox, HidesAllOutsideOfIt) {
  const Shot planes = from_above({"z<2.9", "x>5", "x<15"}), box = from_above({"box 5 -9 -9, 15 9 2.9"});
  const Shot all = from_above({"z<2.9"});
  int same = 0, other = 0;
  for (int y = 0; y < planes.height(); ++y) {
    for (int x = 0; x < planes.width(); ++x) {
      same += (planes.at(x, y) - box.at(x, y)).length() > 0.02;
      other += (all.at(x, y) - box.at(x, y)).length() > 0.02;
    }
  }
  EXPECT_EQ(same, 0);
  EXPECT_GT(other, 1000);
}

}  // namespace
