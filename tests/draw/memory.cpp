// Pictures of ways and scenes of any size, drawn in little memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "draw/cut.h"
#include "draw/lines.h"
#include "draw/way.h"

namespace {

using namespace roam::draw;
using roam::Mesh;

void unheard(std::uint64_t) {}

TEST(PictureMemory, HoldsFewPlacesOfAWayOfAnyLength) {
  // Round and round, a little lower each time, and once near to something.
  Record record;
  roam::StepReport report;
  report.height = 1.8;
  const auto place = [](int i) {
    const double angle = 1e-3 * i;
    return roam::Vec3(10.0 * std::cos(angle), 10.0 * std::sin(angle), 100.0 - 1e-5 * i);
  };
  const int steps = 300'000, nearest = 123'456;
  for (int i = 0; i <= steps; ++i) {
    report.from = place(std::max(i - 1, 0));
    report.to = place(i);
    report.axis_clearance = i == nearest ? 0.31 : 0.5;
    report.segments.clear();
    roam::Segment corner;
    corner.position = report.to;
    corner.height = 1.8;
    corner.axis_clearance = report.axis_clearance;
    if (i > 0) report.segments.push(corner);
    append(record, report, i == 0);
    ASSERT_LE(record.places.size(), Record::most);
  }
  const Way way = simplified(record, 0.001);
  EXPECT_NEAR(way.length, 10.0 * 1e-3 * steps, 1.0);
  ASSERT_LT(way.nearest, record.places.size());
  EXPECT_EQ(record.places[way.nearest].clearance, 0.31);
  EXPECT_NEAR(glm::distance(record.places[way.nearest].position, place(nearest)), 0.0, 1e-12);
  EXPECT_LE(way.tolerance, 1.0);
  EXPECT_GT(way.tolerance, 0.001);
}

TEST(PictureMemory, HoldsFewPlacesOfAWayThatIsAllJumps) {
  // A jump and a stroll in each step, touching something.
  Record record;
  roam::StepReport report;
  report.height = 1.8;
  const auto place = [](int i) { return roam::Vec3(3.0 * i, 0.0, 1.0); };
  const int steps = 20'000, nearest = 12'345;
  for (int i = 0; i <= steps; ++i) {
    report.from = report.to;
    report.to = place(i) + roam::Vec3(i > 0 ? 1.0 : 0.0, 0.0, 0.0);
    report.axis_clearance = 0.5;
    report.segments.clear();
    report.contacts.clear();
    if (i > 0) {
      roam::Segment jump, stroll;
      jump.position = place(i);
      jump.teleport = true;
      stroll.position = report.to;
      stroll.axis_clearance = i == nearest ? 0.31 : 0.5;
      jump.height = stroll.height = 1.8;
      report.segments.push(jump);
      report.segments.push(stroll);
      roam::Contact contact;
      contact.point = report.to;
      report.contacts.push(contact);
    }
    append(record, report, i == 0);
    ASSERT_LE(record.places.size(), Record::most);
  }
  for (const Touch& touch : record.touches) {
    ASSERT_LT(touch.place, record.places.size());
    EXPECT_EQ(touch.point, record.places[touch.place].position);
  }
  const auto runs =
      std::count_if(record.places.begin(), record.places.end(), [](const Place& p) { return p.teleport; });
  EXPECT_EQ(static_cast<std::size_t>(runs) + record.runs_left_out, steps + 1U);
  const Way way = simplified(record, 0.001);
  EXPECT_GT(way.points.size(), Record::most / 8);
  EXPECT_EQ(way.points.front().position, place(0));
  EXPECT_EQ(way.points.back().position, report.to);
  for (std::size_t i = 1; i < way.points.size(); ++i) {
    const double step = glm::distance(way.points[i - 1].position, way.points[i].position);
    EXPECT_TRUE(way.points[i].jump || step <= 1.0) << i;
  }
  ASSERT_LT(way.nearest, record.places.size());
  EXPECT_EQ(record.places[way.nearest].clearance, 0.31);
  EXPECT_EQ(record.places[way.nearest].position, place(nearest) + roam::Vec3(1.0, 0.0, 0.0));
}

TEST(PictureMemory, HoldsOnlyAsManySegmentsAsItMay) {
  // A wavy field, cut in its middle: the same lines, held in little.
  const std::uint32_t n = 300;
  Mesh mesh;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x)
      mesh.vertices.emplace_back(x, y, 10.0 * std::sin(0.1 * x) * std::sin(0.1 * y));
  }
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      const std::uint32_t a = y * (n + 1) + x;
      mesh.triangles.push_back({a, a + 1, a + n + 1});
      mesh.triangles.push_back({a + 1, a + n + 2, a + n + 1});
    }
  }
  const PlanView view{LevelMap({{0, 0}, {n, n}}, 0), {0.5}, {}, 1.0};
  const Cuts all = cut({&mesh, 1}, Turn{}, {&view, 1}, {}, unheard);
  const std::size_t most = 4000;
  ASSERT_GT(all.plans[0].walls.size(), 2 * most);
  Cutter cutter(Turn{}, {&view, 1}, {}, {}, most);
  for (std::size_t first = 0; first < mesh.triangles.size(); first += 5000) {
    Mesh some{"", mesh.vertices, {}};
    for (std::size_t t = first; t < std::min(first + 5000, mesh.triangles.size()); ++t) {
      some.triangles.push_back(mesh.triangles[t]);
    }
    cutter.add({&some, 1}, unheard);
  }
  const Cuts few = cutter.take();
  EXPECT_LE(few.plans[0].walls.size(), most);
  EXPECT_GT(few.plans[0].walls.size(), most / 8);
  EXPECT_EQ(all.plans[0].grid, 0.0);
  EXPECT_GT(few.plans[0].grid, 0.0);
  // Every line that was cut is still drawn where it was.
  for (const Segment& s : all.plans[0].walls) {
    double nearest = 1e9;
    for (const Segment& held : few.plans[0].walls) nearest = std::min(nearest, glm::distance(held.a, s.a));
    EXPECT_LT(nearest, 10.0);
  }
}

TEST(PictureMemory, HoldsASectionAsItsFramesShowIt) {
  // The rough ceiling of a gallery of 1.8 km, its heights exaggerated 50 times, and a detail to scale.
  const std::uint32_t n = 20'000;
  const double length = 1800.0;
  Mesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i) {
    const double height = 184.54 + 0.01 * std::sin(1.7 * i);
    mesh.vertices.emplace_back(length * i / n, -1.0, height);
    mesh.vertices.emplace_back(length * i / n, 1.0, height);
    if (i == n) break;
    mesh.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
    mesh.triangles.push_back({2 * i + 1, 2 * i + 2, 2 * i + 3});
  }
  const Stretch stretch{{0.0, 0.1}, {length, 0.1}, 0.0, 180.0, 186.0};
  const std::array frames{Frame{{{0.0, 180.0}, {length, 186.0}}, 1.0, 50.0},
                          Frame{{{900.0, 183.0}, {906.0, 186.0}}, 80.0, 80.0}};
  const std::size_t most = 16'384;
  Cutter cutter(Turn{}, {}, {&stretch, 1}, frames, most);
  cutter.add({&mesh, 1}, unheard);
  const Cuts cuts = cutter.take();
  EXPECT_LE(cuts.sections[0].size(), most);
  EXPECT_GT(cuts.sections[0].size(), most / 8);
  for (std::size_t k = 0; k < frames.size(); ++k) {
    double worst = 0.0;  // pixels
    for (const Segment& s : cuts.sections[k]) {
      for (const Point& p : {s.a, s.b}) worst = std::max(worst, frames[k].scale_y * (std::abs(p.y - 184.54) - 0.01));
    }
    EXPECT_LT(worst, 1.0) << k;
  }
  EXPECT_GT(cuts.grids[0], 0.0);
  EXPECT_EQ(cuts.grids[1], 0.0);
  // The detail is whole, and of its frame alone.
  EXPECT_NEAR(static_cast<double>(cuts.sections[1].size()), 2.0 * n * 6.0 / length, 4.0);
}

TEST(PictureMemory, StraightensLinesBeforeItRoundsThem) {
  // A ceiling of many short pieces, with one step of a pixel: few pieces on the sheet, so nothing is rounded further.
  std::vector<Segment> ceiling;
  const auto at = [](int i) { return Point(0.25 * i, i < 2000 ? 10.125 : 11.125); };
  for (int i = 0; i < 4000; ++i) ceiling.push_back({at(i), at(i + 1)});
  Coarsened coarsened;
  const auto lines = joined(
      ceiling, [](const Point& p) { return p; }, 10, coarsened);
  EXPECT_EQ(coarsened.grid, 0.0);
  ASSERT_EQ(lines.size(), 1U);
  const Polyline expected{{0.0, 10.125}, {499.75, 10.125}, {500.0, 11.125}, {1000.0, 11.125}};
  EXPECT_TRUE(lines[0] == expected || lines[0] == Polyline(expected.rbegin(), expected.rend()));
}

TEST(PictureMemory, CutsNothingThatLiesElsewhere) {
  const PlanView view{LevelMap({{-1, -2}, {3, 4}}, 0), {5.0, 8.0}, {1.5}, 1.0};
  const Turn turn{{100, 200, 7}, 0.0, 1.0};  // a quarter
  const Cutter cutter(turn, {&view, 1}, {}, {});
  const roam::Box box = cutter.box();
  for (const auto& corner : {roam::Vec3(-1, -2, 3.5), roam::Vec3(3, 4, 8)}) {
    bool found = false;
    for (const double x : {box.lower.x, box.upper.x}) {
      for (const double y : {box.lower.y, box.upper.y}) {
        for (const double z : {box.lower.z, box.upper.z}) {
          found |= glm::distance(turn(roam::Vec3(x, y, z)), corner) < 1e-5;
        }
      }
    }
    EXPECT_TRUE(found);
  }
}

}  // namespace
