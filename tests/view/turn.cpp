// The key that turns the scene: the session ends for another one, and the profile keeps the frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "collada_made.h"
#include "gltf_made.h"
#include "roam/profile.h"
#include "scenes/frame.h"
#include "view_driven.h"

namespace {

using namespace roam;
using namespace roam::app;

TEST(NextFrame, IsTheLikelyOneOrAQuarterTurnOn) {
  SceneFrame frame{UpAxis::z, LengthUnit::cm};
  EXPECT_EQ(next_frame(frame, UpAxis::minus_y), (SceneFrame{UpAxis::minus_y, LengthUnit::cm}));
  std::vector<UpAxis> seen;
  for (int i = 0; i < 6; ++i) {
    const UpAxis before = frame.up;
    frame = next_frame(frame, std::nullopt);
    EXPECT_NE(static_cast<int>(frame.up) % 3, static_cast<int>(before) % 3) << "a quarter turn";
    EXPECT_EQ(std::count(seen.begin(), seen.end(), frame.up), 0);
    seen.push_back(frame.up);
  }
  EXPECT_EQ(frame, (SceneFrame{UpAxis::z, LengthUnit::cm}));
}

TEST(NextUnit, IsTheStatedOneOrTheNext) {
  SceneFrame frame{UpAxis::y, LengthUnit::m};
  EXPECT_EQ(next_unit(frame, LengthUnit::in), (SceneFrame{UpAxis::y, LengthUnit::in}));
  for (const LengthUnit unit : {LengthUnit::cm, LengthUnit::mm, LengthUnit::ft, LengthUnit::in, LengthUnit::m}) {
    frame = next_unit(frame, std::nullopt);
    EXPECT_EQ(frame, (SceneFrame{UpAxis::y, unit}));
  }
}

TEST(Unit, IsAppliedByAKeyAndKept) {
  DrivenSession d;
  const std::string scene = d.folder.write("scene.dae", test::collada("Z_UP", "0.0254"));
  d.options.scene.scenes = {scene};
  d.begin();
  EXPECT_TRUE(contains(d.hud(), "(--unit in). Ctrl+U applies it.")) << d.hud();
  d.press(osgGA::GUIEventAdapter::KEY_Control_L);
  d.press('u');
  EXPECT_FALSE(d.session->frame());
  ASSERT_TRUE(d.session->next());
  EXPECT_EQ(d.session->next()->frame, (SceneFrame{UpAxis::z, LengthUnit::in}));
  EXPECT_EQ(find_frame(d.options.scene.scenes), d.session->next()->frame);
  d.session.reset();
  d.options.scene.unit = "in";
  d.begin();
  EXPECT_FALSE(contains(d.hud(), "Ctrl+U")) << d.hud();
}

TEST(Unit, IsNotedOnce) {
  DrivenSession d;
  d.options.scene.scenes = {d.folder.write("scene.dae", test::collada("Z_UP", "0.0254"))};
  d.begin();
  d.run(0.5);
  const std::vector<std::string> notes = d.finish().notes;
  EXPECT_EQ(std::count_if(notes.begin(), notes.end(), [](const std::string& note) { return contains(note, " unit "); }),
            1);
}

/// An OBJ with other coordinates.
std::string scaled(const std::string& obj, double by) {
  std::string text;
  std::istringstream lines(obj);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string kind;
    double x = 0.0, y = 0.0, z = 0.0;
    if (fields >> kind && kind == "v" && fields >> x >> y >> z) {
      line = "v " + std::to_string(by * x) + ' ' + std::to_string(by * y) + ' ' + std::to_string(by * z);
    }
    text += line + '\n';
  }
  return text;
}

TEST(Unit, IsDoubtedWhereCeilingsAreHigh) {
  for (const double by : {1.0, 39.37}) {
    DrivenSession d;
    d.write_scene(scaled(room_obj(), by));
    d.begin();
    const char* const doubt =
        "its ceilings are 118 m high: if it is too large, add --unit=cm, mm, ft or in; Ctrl+U applies";
    EXPECT_EQ(contains(d.hud(), doubt), by > 1.0) << d.hud();
    d.session.reset();
    d.options.scene.unit = "m";
    d.begin();
    EXPECT_FALSE(contains(d.hud(), "ceilings")) << "it is stated: " << d.hud();
  }
}

TEST(Turn, EndsTheSessionAndIsKept) {
  DrivenSession d;
  d.write_scene();
  d.begin();
  EXPECT_FALSE(d.session->next());
  d.session->run("turn");
  EXPECT_FALSE(d.session->frame());
  ASSERT_TRUE(d.session->next());
  EXPECT_STREQ(to_string(d.session->next()->frame->up), "y");
  EXPECT_EQ(find_frame(d.options.scene.scenes), d.session->next()->frame);
  EXPECT_FALSE(find_profile(d.options.scene.scenes));
}

TEST(Turn, IsToldWhenTheSceneIsOpenedAgain) {
  DrivenSession d;
  d.write_scene();
  d.begin();
  EXPECT_FALSE(contains(d.hud(), "as you chose")) << d.hud();
  d.session->run("turn");
  d.session.reset();
  take_kept_frame(d.options.scene);
  d.begin();
  EXPECT_TRUE(contains(d.hud(), "y is up, as you chose; U turns")) << d.hud();
}

TEST(Turn, DoesNotTakeABodyFromTheProfile) {
  DrivenSession d;
  d.write_scene();
  d.begin();
  d.folder.write("scene.obj.roam.json",
                 R"({"roam_profile": 1, "scene": {"hash": null, "geometry_hash": "0123456789abcdef", "triangles": 2,
                 "bounds": {"min": [0, 0, 0], "max": [1, 1, 1]}}, "mode": "walk", "radius": 0.3, "height": 1.8,
                 "support_radius": 0, "step": 0.3, "slope": 45, "interval": {"min": 0, "max": null}, "regions": [],
                 "method": "interval", "complete": true})");
  const std::string before = d.folder.read("scene.obj.roam.json");
  d.session->run("turn");
  EXPECT_FALSE(d.session->next());
  EXPECT_TRUE(contains(d.hud(), "has a body for the scene as it is")) << d.hud();
  EXPECT_EQ(d.folder.read("scene.obj.roam.json"), before);
}

TEST(Turn, SaysThatSeveralScenesDiffer) {
  DrivenSession d;
  d.write_scene();
  d.options.scene.scenes.emplace_back(d.folder.write("other.glb", test::MadeGrid(2).gltf().glb()));
  d.begin();
  d.session->run("turn");
  EXPECT_FALSE(d.session->next());
  EXPECT_TRUE(contains(d.hud(), "so no key changes them")) << d.hud();
}

TEST(Turn, SaysWhyItIsNotKept) {
  DrivenSession d;
  const std::string scene = d.write_scene();
  std::filesystem::create_directory(scene + ".roam.json");  // where the profile would be
  d.begin();
  d.session->run("turn");
  ASSERT_TRUE(d.session->next());
  EXPECT_NE(d.session->next()->note.find("the frame is not kept: "), std::string::npos) << d.session->next()->note;
  EXPECT_NE(d.session->next()->note.find(scene), std::string::npos);
}

TEST(Turn, IsNotKeptWithoutAProfile) {
  DrivenSession d;
  const std::string scene = d.write_scene();
  d.options.scene.no_profile = true;
  d.begin();
  d.session->run("turn");
  EXPECT_TRUE(d.session->next());
  EXPECT_FALSE(std::filesystem::exists(scene + ".roam.json"));
}

TEST(Turn, IsRefusedWhileSomethingIsWritten) {
  DrivenSession d;
  d.write_scene();
  d.options.trace = d.folder.file("t.csv");
  d.begin();
  d.session->run("turn");
  EXPECT_FALSE(d.session->next());
  EXPECT_TRUE(contains(d.hud(), "is not read anew")) << d.hud();
}

TEST(Turn, IsRefusedWhileAWayIsRecordedOrAStoreIsBuilt) {
  DrivenSession d;
  d.write_scene();
  d.options.program = d.folder.write("roam", "#!/bin/sh\nexec sleep 100\n");
  std::filesystem::permissions(d.options.program, std::filesystem::perms::owner_all);
  d.begin();
  const auto is_refused = [&](const char* why) {
    for (const char* command : {"turn", "show_all"}) {
      d.session->run(command);
      EXPECT_FALSE(d.session->next()) << command;
      EXPECT_TRUE(contains(d.hud(), why)) << d.hud();
    }
  };
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(d.folder.file(""));
  d.session->run("record");
  is_refused("a way is written");
  d.session->run("record");
  std::filesystem::current_path(before);
  d.session->run("store");
  d.session->run("store");
  is_refused("while its store is built");
}

TEST(Turn, KeepsTheModeOfTheCommandLine) {
  ViewOptions given, options;
  NextSession next;
  next.mode = Mode::fly;
  static_cast<void>(go_on(options, next, given));
  EXPECT_EQ(options.mode, Mode::fly) << "nothing has moved";
  next.frame = SceneFrame{.up = UpAxis::y};
  static_cast<void>(go_on(options, next, given));
  EXPECT_FALSE(options.mode);
}

/// The report of a session that measured a point at `x` and wrote a file.
ViewReport report_of(const SceneFrame& frame, double x, const std::string& file) {
  ViewReport report;
  report.frame = frame;
  report.measurements = {{{Vec3(x, 0.0, 0.0), Vec3(0.0, 0.0, 1.0), {}}, {}}};
  report.probes.resize(1);
  report.written = {file};
  report.notes = {"of both", file + " is good"};
  report.learned = 1;
  report.untold = written_line(file);
  return report;
}

TEST(ViewReport, HasTheResultsOfTheSessionsBefore) {
  ViewReport report = report_of({}, 2.0, "2.png");
  add_earlier(report, report_of({}, 1.0, "1.png"));
  ASSERT_EQ(report.measurements.size(), 2u);
  EXPECT_EQ(report.measurements[0].a.point.x, 1.0);
  EXPECT_EQ(report.probes.size(), 2u);
  EXPECT_EQ(report.written, (std::vector<std::string>{"1.png", "2.png"}));
  EXPECT_EQ(report.notes, (std::vector<std::string>{"of both", "1.png is good", "2.png is good"}));
  EXPECT_EQ(report.learned, 2);
  EXPECT_EQ(text_report(report), "written: 1.png\nwritten: 2.png\n");
  add_earlier(report, report_of({.up = UpAxis::y}, 0.0, "0.png"));
  EXPECT_EQ(report.measurements.size(), 2u) << "its places mean nothing here";
  EXPECT_EQ(report.written.size(), 3u);
}

TEST(LeaveOut, EndsTheSessionWithThePatternOfTheObjectAhead) {
  DrivenSession d;
  d.write_scene();
  d.options.at = {10, 0, 0.95, 0};
  d.begin();
  d.run(0.2);
  d.session->run("leave_out");
  EXPECT_FALSE(d.session->frame());
  ASSERT_TRUE(d.session->next());
  EXPECT_FALSE(d.session->next()->frame);
  EXPECT_EQ(d.session->next()->leave_out, "front");
  EXPECT_NEAR(d.session->next()->at.position.x, 10.0, 1e-6);
  // The next session has neither its picture nor its wall.
  d.session.reset();
  d.options.scene.ignore = {"front"};
  d.begin();
  d.run(0.2);
  EXPECT_NE(d.session->status().around.ahead, "front");
  d.press('w');
  d.run(12.0);
  EXPECT_GT(d.place().x, 20.0) << "nothing stops the body there";
}

TEST(LeaveOut, TakesTheObjectInTheMiddleOfThePictureOfEveryCamera) {
  DrivenSession d;
  d.write_scene();
  d.options.at = {10, 0, 0.95, 0};
  d.begin();
  d.tap('2');
  const Vec3 origin = d.session->scene().origin();
  const osg::Vec3d eye = osg::Vec3d(10.0, 0.0, 1.5) - osg::Vec3d(origin.x, origin.y, origin.z);
  osg::Matrixd view;
  view.makeLookAt(eye, eye + osg::Vec3d(0.0, 1.0, 0.0), osg::Vec3d(0.0, 0.0, 1.0));
  d.session->stage().viewer().getCameraManipulator()->setByInverseMatrix(view);
  d.run(0.2);
  d.session->run("leave_out");
  ASSERT_TRUE(d.session->next());
  EXPECT_EQ(d.session->next()->leave_out, "left") << "the body's eye looks at another wall";
}

/// Of a scene without other objects, whose section may be open.
void expect_it_stays(const std::vector<std::string>& section) {
  DrivenSession d;
  d.options.section = section;
  d.options.pass_hidden = !section.empty();
  std::string scene;
  std::istringstream lines(room_obj());
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("o ") && !line.starts_with("g ")) scene += line + '\n';
  }
  d.write_scene(scene);
  d.options.at = {10, 0, 0.95, 0};
  d.begin();
  d.run(0.2);
  d.session->run("leave_out");
  EXPECT_FALSE(d.session->next());
  EXPECT_TRUE(contains(d.hud(), "only this object")) << d.hud();
}

TEST(LeaveOut, KeepsTheOnlyObject) {
  expect_it_stays({});
  expect_it_stays({"z<2.5"});
}

TEST(LeaveOut, LeavesTheViewAsItIs) {
  DrivenSession d;
  d.write_scene();
  d.options.at = {10, 0, 0.95, 0};
  d.begin();
  const ViewOptions given = d.options;
  for (const char* command : {"section_box", "pass_hidden", "hud", "edges"}) d.session->run(command);
  d.session->roamer().setSpeed(2.5);
  d.run(0.2);
  const std::optional<Box> box = d.session->tools().section().box;
  ASSERT_TRUE(box);
  d.session->run("show_all");
  NextSession next = d.session->next().value();
  next.hidden = {{{"left"}, true}};
  d.session.reset();
  static_cast<void>(go_on(d.options, next, given));
  ViewPlan plan = make_plan(d.options, {});
  keep_view(plan, next);
  d.session.emplace(d.options, plan, ViewSettings{});
  ASSERT_TRUE(d.until([&] { return d.session->roaming(); }));
  EXPECT_EQ(d.session->tools().section().box->lower, box->lower);
  EXPECT_EQ(d.session->tools().section().box->upper, box->upper);
  EXPECT_TRUE(d.session->hidden().passes());
  EXPECT_EQ(d.session->stage().hud_mode(), HudMode::full);
  EXPECT_FALSE(d.session->stage().edges());
  EXPECT_EQ(d.session->roamer().speed(), 2.5);
  EXPECT_TRUE(contains(d.hud(), "hidden: 1 of 6 objects")) << d.hud();
  next.frame = SceneFrame{.up = UpAxis::y};
  plan = make_plan(given, {});
  keep_view(plan, next);
  EXPECT_TRUE(plan.section.empty()) << "it means nothing in another frame";
  EXPECT_EQ(plan.walker.speed, 1.4);
  EXPECT_EQ(plan.hidden, next.hidden);
}

TEST(LeaveOut, ShowsAllAgain) {
  DrivenSession d;
  d.write_scene();
  d.options.scene.ignore = {"front"};
  d.options.at = {10, 0, 0.95, 0};
  d.begin();
  d.session->run("show_all");
  EXPECT_FALSE(d.session->frame());
  ASSERT_TRUE(d.session->next());
  EXPECT_EQ(d.session->next()->leave_out, "");
}

TEST(LeaveOut, TakesNamesAsTheyAre) {
  DrivenSession d;
  std::string scene = room_obj();
  for (std::size_t at = scene.find("front"); at != std::string::npos; at = scene.find("front", at + 1)) {
    scene.replace(at, 5, "fr*[t");
  }
  d.write_scene(scene);
  d.options.at = {10, 0, 0.95, 0};
  d.begin();
  d.run(0.2);
  d.session->run("leave_out");
  ASSERT_TRUE(d.session->next());
  EXPECT_EQ(d.session->next()->leave_out, "fr\\*\\[t");
}

}  // namespace
