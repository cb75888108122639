// The sheet of an opening: that its measures are true, the body is where it stands, and its texts can be read.
#include "draw/opening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sheet_items.h"
#include "walker_scenes.h"

namespace {

using namespace roam::draw;
using roam::Mesh;
using roam::Vec3;
using sheets::all;
using sheets::box;

/// A wall along `across` through `at` with a door of `width` in it, on a floor.
std::vector<Mesh> door(const Vec3& at, const Vec3& across, double width) {
  Mesh mesh;
  scenes::add_floor(mesh, at.x - 20.0, at.y - 20.0, at.x + 20.0, at.y + 20.0, at.z);
  for (const double side : {-1.0, 1.0}) {
    const Vec3 jamb = at + 0.5 * width * side * across, far = at + 10.0 * side * across;
    scenes::add_wall(mesh, jamb.x, jamb.y, far.x, far.y, at.z, at.z + 3.0);
  }
  return {mesh};
}

OpeningView view_of_door(const Vec3& at, const Vec3& across, double width) {
  OpeningView view;
  view.heading = "Door";
  view.text = "A body of radius 0.3 m and height 1.9 m passes.";
  view.point = at + Vec3(0.0, 0.0, 1.0);
  view.direction = across;
  view.width = width;
  view.floor = at.z;
  view.radius = 0.3;
  view.height = 1.9;
  view.fits = true;
  return view;
}

/// From the bar and what stands over it.
double pixels_per_metre(const Sheet& sheet) {
  const auto bars = all<Lines>(sheet, "scale bar");
  const auto texts = all<Text>(sheet, "scale length");
  if (bars.empty() || texts.empty()) return 0.0;
  const Polyline& bar = bars[0].lines[0];
  const double unit = texts[0].text.find("mm") != std::string::npos ? 1e-3 : 1.0;
  return glm::distance(bar[1], bar[2]) / (std::stod(texts[0].text) * unit);
}

/// Lines of one label touch.
void expect_readable(const Sheet& sheet) { sheets::expect_readable(sheet, 2.0); }

TEST(OpeningPicture, MeasuresTheDoorToScaleInPlanAndSection) {
  const Vec3 at(-13739.0, 253.0, 181.0), across = glm::normalize(Vec3(0.6, 0.8, 0.0));
  const Sheet sheet = opening_sheet("scene.obj", std::vector{view_of_door(at, across, 0.84)}, door(at, across, 0.84));
  const double scale = pixels_per_metre(sheet);
  ASSERT_GT(scale, 0.0);
  const auto measures = all<Lines>(sheet, "measure");
  ASSERT_EQ(measures.size(), 2u);
  for (const Lines& measure : measures) {
    EXPECT_NEAR(glm::distance(measure.lines[0][0], measure.lines[0][1]), 0.84 * scale, 0.5);
  }
  // The jambs are where the measure ends.
  const auto walls = all<Lines>(sheet, "plan walls");
  ASSERT_EQ(walls.size(), 1u);
  for (const Point& end : measures[0].lines[0]) {
    double nearest = 1e9;
    for (const Polyline& line : walls[0].lines) {
      for (const Point& p : line) nearest = std::min(nearest, glm::distance(p, end));
    }
    EXPECT_LT(nearest, 1.0);
  }
  const auto bodies = all<Disc>(sheet, "plan body");
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_NEAR(bodies[0].radius, 0.3 * scale, 0.5);
  const auto widths = all<Text>(sheet, "width");
  ASSERT_EQ(widths.size(), 2u);
  EXPECT_EQ(widths[0].text, "0.840 m");
  expect_readable(sheet);
}

TEST(OpeningPicture, StandsTheBodyOnTheFloorOfTheSection) {
  const Vec3 at(5.0, -2.0, 30.0), across(0.0, 1.0, 0.0);
  const Sheet sheet = opening_sheet("scene.obj", std::vector{view_of_door(at, across, 0.7)}, door(at, across, 0.7));
  const double scale = pixels_per_metre(sheet);
  const auto bodies = all<Lines>(sheet, "section body");
  const auto walls = all<Lines>(sheet, "section walls");
  ASSERT_EQ(bodies.size(), 1u);
  ASSERT_EQ(walls.size(), 1u);
  const Rect body = box(bodies[0]), scene = box(walls[0]);
  EXPECT_NEAR(body.height(), 1.9 * scale, 1.0);
  EXPECT_NEAR(body.width(), 0.6 * scale, 1.0);
  EXPECT_NEAR(body.upper.y, scene.upper.y, 1.0);  // the sheet's y points down: the feet are on the floor
}

TEST(OpeningPicture, ShowsFallingAndTheSupportDiscOverACrack) {
  Mesh mesh;
  scenes::add_floor(mesh, -10.0, -2.0, -0.4, 2.0, 0.0);
  scenes::add_floor(mesh, 0.4, -2.0, 10.0, 2.0, 0.0);
  const std::vector<Mesh> meshes{mesh};
  OpeningView view = view_of_door({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.8);
  view.kind = OpeningView::Kind::crack;
  view.point = {0.0, 0.0, 0.0};
  view.fits = false;
  const Sheet falls = opening_sheet("scene.obj", std::vector{view}, meshes);
  EXPECT_EQ(all<Lines>(falls, "fall").size(), 1u);
  EXPECT_TRUE(all<Disc>(falls, "plan disc").empty());
  expect_readable(falls);
  view.fits = true;
  view.support_radius = 0.45;
  const Sheet carried = opening_sheet("scene.obj", std::vector{view}, meshes);
  EXPECT_TRUE(all<Lines>(carried, "fall").empty());
  ASSERT_EQ(all<Disc>(carried, "plan disc").size(), 1u);
  EXPECT_NEAR(all<Disc>(carried, "plan disc")[0].radius, 0.45 * pixels_per_metre(carried), 0.5);
  expect_readable(carried);
}

TEST(OpeningPicture, ShowsFloorsWhoseFacesAreThereTwice) {
  const Vec3 at(0.0, 0.0, 0.0), across(0.0, 1.0, 0.0);
  std::vector<Mesh> meshes = door(at, across, 0.7);
  const std::size_t count = meshes[0].triangles.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto [a, b, c] = meshes[0].triangles[i];
    meshes[0].triangles.push_back({a, c, b});
  }
  const Sheet sheet = opening_sheet("scene.obj", std::vector{view_of_door(at, across, 0.7)}, meshes);
  const auto floors = all<Lines>(sheet, "floor");
  ASSERT_EQ(floors.size(), 1u);
  ASSERT_EQ(floors[0].lines.size(), 4u);
  // Areas that turn one way and the other would cancel each other.
  for (const Polyline& area : floors[0].lines) {
    const Point d = area[1] - area[0], e = area[2] - area[0];
    EXPECT_LT(d.x * e.y - d.y * e.x, 0.0);  // the sheet's y points down
  }
}

TEST(OpeningPicture, PutsSeveralOneBelowTheOther) {
  const Vec3 at(0.0, 0.0, 0.0), across(0.0, 1.0, 0.0);
  OpeningView tight = view_of_door(at, across, 0.5), high = view_of_door(at, across, 0.5);
  tight.fits = false;
  high.direction = {0.0, 0.0, 1.0};
  high.heading_to = {1.0, 0.0, 0.0};
  const Sheet sheet = opening_sheet("scene.obj", std::vector{tight, high}, door(at, across, 0.5));
  EXPECT_EQ(all<Disc>(sheet, "plan body").size(), 2u);
  EXPECT_EQ(all<Lines>(sheet, "measure").size(), 3u);  // an upright width shows in no plan
  expect_readable(sheet);
  const Sheet one = opening_sheet("scene.obj", std::vector{tight}, door(at, across, 0.5));
  EXPECT_GT(sheet.height, 1.7 * one.height);
}

/// Whether some area of the sheet covers a place.
bool covered(const std::vector<Lines>& all, const Point& p) {
  for (const Lines& areas : all) {
    for (const Polyline& area : areas.lines) {
      bool inside = false;
      for (std::size_t i = 0, k = area.size() - 1; i < area.size(); k = i++) {
        const Point a = area[i], b = area[k];
        if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
      }
      if (inside) return true;
    }
  }
  return false;
}

TEST(OpeningPicture, ShowsTheFaceOfAWallWithoutAnyThicknessBesideItsDoor) {
  const Vec3 at(5.0, -2.0, 30.0), across(0.0, 1.0, 0.0);
  OpeningView view = view_of_door(at, across, 0.84);
  view.depth = 0.005;
  const Sheet sheet = opening_sheet("scene.obj", std::vector{view}, door(at, across, 0.84));
  const auto faces = all<Lines>(sheet, "faces");
  ASSERT_EQ(faces.size(), 1u);
  const Lines measure = all<Lines>(sheet, "measure")[1];
  const Point from = measure.lines[0][0], to = measure.lines[0][1];
  EXPECT_FALSE(covered(faces, 0.5 * (from + to)));
  EXPECT_TRUE(covered(faces, from - 0.1 * (to - from)));
  EXPECT_TRUE(covered(faces, to + 0.1 * (to - from)));
  expect_readable(sheet);
}

TEST(OpeningPicture, DrawsTheBodyOfAnEndBesideItsWall) {
  Mesh mesh;
  scenes::add_floor(mesh, -5.0, -5.0, 5.0, 0.25, 0.0);
  scenes::add_wall(mesh, -5.0, 0.25, 5.0, 0.25, 0.0, 3.0);
  OpeningView view = view_of_door({0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 0.25);
  view.kind = OpeningView::Kind::beside;
  view.point = {0.0, 0.125, 1.0};
  view.body = Vec3(0.0);
  view.support_radius = 0.2;
  view.fits = false;
  const Sheet sheet = opening_sheet("scene.obj", std::vector{view}, std::vector{mesh});
  const double scale = pixels_per_metre(sheet);
  const auto measures = all<Lines>(sheet, "measure");
  ASSERT_EQ(measures.size(), 2u);
  const auto bodies = all<Disc>(sheet, "plan body");
  ASSERT_EQ(bodies.size(), 1u);
  EXPECT_LT(glm::distance(measures[0].lines[0][0], bodies[0].centre), 1.0);  // from the axis
  EXPECT_NEAR(glm::distance(measures[0].lines[0][1], bodies[0].centre), 0.25 * scale, 0.5);
  const auto disc = all<Lines>(sheet, "section disc"), body = all<Lines>(sheet, "section body");
  ASSERT_EQ(disc.size(), 1u);
  ASSERT_EQ(body.size(), 1u);
  EXPECT_NEAR(box(disc[0]).center().x, box(body[0]).center().x, 0.5);
  expect_readable(sheet);
}

TEST(OpeningPicture, MeasuresAHeightBesideTheBodyAndDashesWhatHangsThere) {
  const Vec3 at(0.0, 0.0, 0.0), across(0.0, 1.0, 0.0);
  std::vector<Mesh> meshes = door(at, across, 0.9);
  for (const double x : {-0.1, 0.1}) scenes::add_wall(meshes[0], x, -0.45, x, 0.45, 1.75, 3.0);
  OpeningView view = view_of_door(at, across, 1.75);
  view.point = {0.0, 0.0, 0.875};
  view.direction = {0.0, 0.0, 1.0};
  view.heading_to = {1.0, 0.0, 0.0};
  view.fits = false;
  const Sheet sheet = opening_sheet("scene.obj", std::vector{view}, meshes);
  const double scale = pixels_per_metre(sheet);
  const auto measures = all<Lines>(sheet, "measure");
  ASSERT_EQ(measures.size(), 1u);
  const Point low = measures[0].lines[0][0], high = measures[0].lines[0][1];
  EXPECT_NEAR(low.y - high.y, 1.75 * scale, 0.5);
  const auto bodies = all<Lines>(sheet, "section body");
  ASSERT_EQ(bodies.size(), 1u);
  const Rect body = box(bodies[0]);
  EXPECT_GT(low.x, body.upper.x);
  ASSERT_EQ(all<Lines>(sheet, "plan above").size(), 1u);
  EXPECT_GT(all<Lines>(sheet, "plan above")[0].style.dash[0], 0.0);
  expect_readable(sheet);
}

TEST(OpeningPicture, DrawsSlopesAsWallsInFlight) {
  Mesh ramp;
  scenes::add_quad(ramp, {-9, -1, 0.7}, {9, -1, 0.7}, {9, 3, 1.9}, {-9, 3, 1.9});
  OpeningView view = view_of_door({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.8);
  Overview overview;
  overview.mode = view.mode = roam::Mode::fly;
  overview.radius = view.radius;
  overview.height = view.height = 2.0 * view.radius;
  overview.start = {-5.0, 0.0, 1.0};
  overview.target = {5.0, 0.0, 1.0};
  for (const roam::Mode mode : {roam::Mode::fly, roam::Mode::walk}) {
    overview.mode = view.mode = mode;
    const Sheet sheet = opening_sheet("ramp.obj", std::vector{view}, std::vector{ramp}, {}, overview);
    for (const char* panel : {"overview", "plan"}) {
      const std::string seen = mode == roam::Mode::fly ? "walls" : "below";  // on foot it is ground to walk on
      EXPECT_EQ(all<Lines>(sheet, std::string(panel) + " " + seen).size(), 1u) << panel;
    }
  }
}

TEST(OpeningPicture, ShowsBothEndsAndWhatIsReachedFromThem) {
  const Vec3 at(-13739.0, 253.0, 181.0), across(0.0, 1.0, 0.0);
  Overview overview;
  overview.radius = 0.3;
  overview.height = 1.9;
  overview.start = at - Vec3(4.0, 0.0, 0.0);
  overview.target = at + Vec3(4.0, 0.5, 0.0);
  for (double x = -5.0; x < -0.5; x += 0.2) overview.from_start.push_back(at + Vec3(x, 0.0, 0.0));
  for (double x = 0.6; x < 5.0; x += 0.2) overview.from_target.push_back(at + Vec3(x, 0.2, 0.0));
  overview.marks.push_back({at, "nearest approach", false});
  const Sheet sheet = opening_sheet("scene.obj", {}, door(at, across, 0.001), "No: there is no way.", overview);
  const auto start = all<Disc>(sheet, "start"), target = all<Disc>(sheet, "target");
  const auto mark = all<Disc>(sheet, "overview mark");
  ASSERT_EQ(start.size(), 1u);
  ASSERT_EQ(target.size(), 1u);
  ASSERT_EQ(mark.size(), 1u);
  const double scale = start[0].radius / 0.3;
  EXPECT_NEAR(target[0].centre.x - start[0].centre.x, 8.0 * scale, 1.0);
  EXPECT_NEAR(start[0].centre.y - target[0].centre.y, 0.5 * scale, 1.0);  // the sheet's y points down
  EXPECT_TRUE(covered(all<Lines>(sheet, "reached from the start"), start[0].centre));
  EXPECT_FALSE(covered(all<Lines>(sheet, "reached from the start"), mark[0].centre));
  EXPECT_FALSE(covered(all<Lines>(sheet, "reached from the target"), mark[0].centre));
  EXPECT_EQ(all<Lines>(sheet, "overview walls").size(), 1u);
  expect_readable(sheet);
  // With a way there is nothing to be told of what is reached.
  overview.way = {overview.start, overview.target};
  overview.from_start.clear();
  overview.from_target.clear();
  const Sheet yes = opening_sheet("scene.obj", {}, door(at, across, 0.9), "Yes.", overview);
  EXPECT_EQ(all<Lines>(yes, "way").size(), 1u);
  EXPECT_TRUE(all<Lines>(yes, "reached from the start").empty());
}

TEST(OpeningPicture, HasATitleWhereNothingDecides) {
  const Sheet sheet = opening_sheet("scene.obj: nothing is as narrow", {}, {});
  EXPECT_GT(sheet.height, 50.0);
  EXPECT_EQ(all<Text>(sheet, "title").size(), 1u);
}

}  // namespace
