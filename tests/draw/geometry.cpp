// What a picture of a walk is made of: cuts, levels, lines, the survey of the way.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "draw/cut.h"
#include "draw/frames.h"
#include "draw/levels.h"
#include "draw/lines.h"
#include "draw/page.h"
#include "draw/stations.h"
#include "draw/way.h"
#include "math/round_length.h"
#include "walker_scenes.h"

namespace {

using namespace roam::draw;
using roam::Mesh;
using roam::round_length;
using roam::Vec3;
using scenes::Random;

double length(const Segment& s) { return glm::distance(s.a, s.b); }

double total_length(const std::vector<Segment>& segments) {
  double sum = 0.0;
  for (const Segment& s : segments) sum += length(s);
  return sum;
}

Mesh thicket(std::uint64_t seed, int triangles) {
  Random random(seed);
  Mesh mesh;
  const auto place = [&] { return Vec3(random.between(-9, 9), random.between(-9, 9), random.between(-3, 3)); };
  for (int i = 0; i < triangles; ++i) {
    const Vec3 a = place(), d = 0.3 * place(), e = 0.3 * place();
    scenes::add_triangle(mesh, a, a + d, a + e);
  }
  return mesh;
}

Station station(const Vec3& centre, double along, bool jump = false) {
  Station s;
  s.centre = centre;
  s.height = 1.8;
  s.along = along;
  s.jump = jump;
  return s;
}

/// Where a triangle is at the given height, by the lines between its corners sorted by height.
std::optional<Segment> sliced(roam::Triangle t, long double height) {
  std::sort(t.begin(), t.end(), [](const Vec3& a, const Vec3& b) { return a.z < b.z; });
  if (t[0].z >= height || t[2].z <= height) return std::nullopt;
  const auto between = [&](const Vec3& a, const Vec3& b) {
    const long double f = (height - a.z) / (static_cast<long double>(b.z) - a.z);
    return Point(static_cast<double>(a.x + f * (b.x - a.x)), static_cast<double>(a.y + f * (b.y - a.y)));
  };
  return Segment{between(t[0], t[2]), t[1].z > height ? between(t[0], t[1]) : between(t[1], t[2])};
}

const auto nobody = [](std::uint64_t) {};

TEST(PictureCut, IsWhatEachTriangleAloneGives) {
  const Mesh mesh = thicket(1, 3000);
  const Rect area{{-5, -4}, {6, 3}};
  const PlanView view{LevelMap(area, 0), {0.25}, {}, 1.0};
  const Cuts cuts = cut({&mesh, 1}, Turn{}, {&view, 1}, {}, nobody);
  std::vector<Segment> expected;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    auto s = sliced(mesh.triangle(i), 0.25L);
    if (s && clip(*s, area)) expected.push_back(*s);
  }
  ASSERT_EQ(cuts.plans[0].walls.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Segment &s = cuts.plans[0].walls[i], &e = expected[i];
    const double same = glm::distance(s.a, e.a) + glm::distance(s.b, e.b);
    const double swapped = glm::distance(s.a, e.b) + glm::distance(s.b, e.a);
    EXPECT_LT(std::min(same, swapped), 1e-9);
  }
  EXPECT_TRUE(cuts.plans[0].below.empty());
}

TEST(PictureCut, TurnsTheSceneWithThePlan) {
  const Mesh mesh = thicket(2, 500);
  const Turn turn{{1, 2, 0}, std::cos(0.7), std::sin(0.7)};
  const PlanView view{LevelMap(Rect{{-99, -99}, {99, 99}}, 0), {0.5}, {}, 1.0};
  const Cuts cuts = cut({&mesh, 1}, turn, {&view, 1}, {}, nobody);
  double expected = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto s = sliced(mesh.triangle(i), 0.5L);
    if (!s) continue;
    expected += length(*s);
    const Point a = turn.plan({s->a, 0.5}), b = turn.plan({s->b, 0.5});
    const Segment& got = cuts.plans[0].walls[count++];
    EXPECT_LT(std::min(glm::distance(got.a, a), glm::distance(got.a, b)), 1e-9);
  }
  EXPECT_EQ(cuts.plans[0].walls.size(), count);
  EXPECT_NEAR(total_length(cuts.plans[0].walls), expected, 1e-9 * expected);
}

TEST(PictureCut, TellsWallsFromGroundAndFromWhatLiesBelow) {
  Mesh mesh;
  scenes::add_wall(mesh, 0, 1, 10, 1, 0, 3);                                 // a wall
  scenes::add_wall(mesh, 0, 2, 10, 2, 0, 0.6);                               // a bench
  scenes::add_wall(mesh, 0, 3, 10, 3, -2, 0);                                // the side of a ditch
  scenes::add_quad(mesh, {0, 4, 0}, {10, 4, 0}, {10, 9, 1.8}, {0, 9, 1.8});  // a ramp
  const PlanView view{LevelMap(Rect{{-1, -1}, {11, 11}}, 0), {0.9}, {0.5, 1.3}, 0.7};
  const Cuts cuts = cut({&mesh, 1}, Turn{}, {&view, 1}, {}, nobody);
  EXPECT_NEAR(total_length(cuts.plans[0].walls), 10.0, 1e-9);
  // The wall and the bench at 0.4 m, the ditch at -0.4 m, and the ramp where it rises to 0.9 m, there only.
  EXPECT_NEAR(total_length(cuts.plans[0].below), 40.0, 1e-9);
  for (const Segment& s : cuts.plans[0].walls) EXPECT_DOUBLE_EQ(s.a.y, 1.0);
}

TEST(PictureSection, UnrollsWhatStandsOverAndUnderTheWay) {
  const Mesh mesh = thicket(3, 3000);
  Way way;
  for (const Vec3& p : {Vec3(-7, -7, 0), Vec3(3, -5, 0), Vec3(6, 6, 0.5), Vec3(-2, 1, 0)}) {
    const double step =
        way.points.empty() ? 0.0 : std::hypot(p.x - way.points.back().position.x, p.y - way.points.back().position.y);
    way.length += step;
    way.points.push_back({p, 1.8, way.length, false});
  }
  const auto parts = stretches(way, Turn{}, 1.5, -2.0, 2.5);
  ASSERT_EQ(parts.size(), 5u);
  EXPECT_DOUBLE_EQ(parts.front().along, -1.5);
  EXPECT_NEAR(parts.back().along, way.length, 1e-12);
  const Cuts cuts = cut({&mesh, 1}, Turn{}, {}, parts, nobody);
  // Each stretch by hand: the triangle in the stretch's own frame, whose y is across, cut where y is 0.
  double expected = 0.0;
  for (const Stretch& s : parts) {
    const double l = glm::distance(s.from, s.to);
    const Point d = (s.to - s.from) / l;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      roam::Triangle t = mesh.triangle(i);
      for (Vec3& v : t) {
        const Point r = Point(v.x, v.y) - s.from;
        v = {d.x * r.x + d.y * r.y, v.z, d.x * r.y - d.y * r.x};
      }
      auto piece = sliced(t, 0.0L);
      if (piece && clip(*piece, Rect{{0, -2.0}, {l, 2.5}})) expected += length(*piece);
    }
  }
  EXPECT_GT(expected, 100.0);
  EXPECT_NEAR(total_length(cuts.sections[0]), expected, 1e-9 * expected);
  for (const Segment& s : cuts.sections[0]) {
    EXPECT_GE(std::min(s.a.x, s.b.x), -1.5 - 1e-9);
    EXPECT_LE(std::max(s.a.x, s.b.x), way.length + 1.5 + 1e-9);
    EXPECT_LE(std::max(s.a.y, s.b.y), 2.5 + 1e-9);
  }
}

/// Walls on the border of what is shown, but for rounding, in scenes that are turned by any angle.
TEST(PictureCut, ShowsWallsOnTheBorderOfItsView) {
  Random random(6);
  const Rect area{{-5, -4}, {6, 3}};
  for (int i = 0; i < 50; ++i) {
    const double angle = random.between(-3.0, 3.0);
    const Turn turn{{random.between(-9, 9), 2, 0}, std::cos(angle), std::sin(angle)};
    const auto place = [&](const Point& p) {
      return Point(turn.origin.x + turn.cosine * p.x - turn.sine * p.y,
                   turn.origin.y + turn.sine * p.x + turn.cosine * p.y);
    };
    const PlanView view{LevelMap(area, 0), {0.5}, {}, 1.0};
    const Polyline corners = area.outline();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Point from = corners[k], to = corners[(k + 1) % corners.size()], a = place(from), b = place(to);
      Mesh mesh;
      scenes::add_wall(mesh, a.x, a.y, b.x, b.y, 0, 1);
      EXPECT_NEAR(total_length(cut({&mesh, 1}, turn, {&view, 1}, {}, nobody).plans[0].walls), glm::distance(from, to),
                  1e-9);
    }
  }
}

TEST(PictureSection, ShowsWallsOnceWhereItBeginsEndsAndTurns) {
  Random random(7);
  for (int i = 0; i < 50; ++i) {
    const double angle = random.between(-3.0, 3.0), shift = random.between(-9.0, 9.0);
    Way way;
    Point at(shift, 2.0);
    for (int k = 0; k < 3; ++k) {
      way.points.push_back({{at.x, at.y, 0}, 1.8, way.length, false});
      const Point step(3.0 * std::cos(angle + k), 3.0 * std::sin(angle + k));
      if (k < 2) way.length += glm::length(step);
      at += step;
    }
    const auto parts = stretches(way, Turn{}, 1.5, -2.0, 2.5);
    const auto drawn = [&](const Point& middle, const Point& way_there) {
      const Point across = Point(-way_there.y, way_there.x) / glm::length(way_there);
      Mesh mesh;
      scenes::add_wall(mesh, middle.x - across.x, middle.y - across.y, middle.x + across.x, middle.y + across.y, 0, 1);
      Coarsened none;
      const auto lines = joined(
          cut({&mesh, 1}, Turn{}, {}, parts, nobody).sections[0], [](const Point& p) { return 100.0 * p; }, 1000, none);
      double sum = 0.0;
      for (const Polyline& line : lines) {
        for (std::size_t k = 1; k < line.size(); ++k) sum += glm::distance(line[k - 1], line[k]);
      }
      return sum;
    };
    for (const Stretch& s : parts) EXPECT_NEAR(drawn(s.from, s.to - s.from), 100.0, 0.2);
    EXPECT_NEAR(drawn(parts.back().to, parts.back().to - parts.back().from), 100.0, 0.2);
  }
}

TEST(PictureLevels, AreOneForAFlatWalkThatCrouches) {
  std::vector<Station> stations;
  for (int i = 0; i < 100; ++i) stations.push_back(station({i, 0, i > 40 && i < 50 ? 0.55 : 0.9}, i));
  const Levels levels = find_levels(stations, 1.8);
  ASSERT_EQ(levels.cuts.size(), 1u);
  EXPECT_DOUBLE_EQ(levels.cuts[0], 0.9);
}

TEST(PictureLevels, FollowARampWithinHalfABody) {
  std::vector<Station> stations;
  for (int i = 0; i <= 400; ++i) stations.push_back(station({0.1 * i, 0, 0.03 * i}, 0.1 * i));
  const Levels levels = find_levels(stations, 1.8);
  EXPECT_GE(levels.cuts.size(), 12.0 / 0.9 - 1);
  EXPECT_LE(levels.cuts.size(), 16u);
  for (std::size_t i = 0; i < stations.size(); ++i) {
    EXPECT_LE(std::abs(stations[i].centre.z - levels.cuts[levels.where[i]]), 0.9);
  }
  EXPECT_TRUE(std::is_sorted(levels.cuts.begin(), levels.cuts.end()));
}

TEST(PictureLevels, StayAboveAFall) {
  std::vector<Station> stations{station({0, 0, 1}, 0), station({5, 0, 1}, 5), station({5.2, 0, -9}, 5.2)};
  const Levels levels = find_levels(stations, 1.8);
  ASSERT_EQ(levels.cuts.size(), 1u);
  EXPECT_DOUBLE_EQ(levels.cuts[0], 1.0);
}

TEST(PictureLevels, ShowTheNearestAndAStoreyBelow) {
  // East on the ground floor, then back right above, one storey up, and on to the west.
  std::vector<Station> stations;
  double along = 0.0;
  for (int i = 0; i <= 100; ++i) stations.push_back(station({0.2 * i, 0, 1}, along += 0.2));
  for (int i = 0; i <= 200; ++i) stations.push_back(station({20 - 0.2 * i, 0, 4}, along += 0.2, i == 0));
  const Levels levels = find_levels(stations, 1.8);
  ASSERT_EQ(levels.cuts, (std::vector{1.0, 4.0}));
  const LevelMap map(Rect{{-30, -10}, {30, 10}}, levels, stations, Turn{}, 2.0);
  EXPECT_EQ(map.at({10, 1}).upper, 1);  // both are here: the upper storey is shown, the lower one beneath
  EXPECT_EQ(map.at({10, 1}).lower, 0);
  EXPECT_EQ(map.at({-15, 1}).upper, 1);
  EXPECT_EQ(map.at({-15, 1}).lower, LevelMap::none);
}

TEST(PictureLevels, CutASegmentWhereTheLevelsMeet) {
  std::vector<Station> stations;
  for (int i = 0; i <= 40; ++i) stations.push_back(station({0.5 * i, 0, i <= 20 ? 1.0 : 3.0}, 0.5 * i));
  const Levels levels = find_levels(stations, 1.8);
  const LevelMap map(Rect{{0, -5}, {20, 5}}, levels, stations, Turn{}, 5.0);
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const auto place = [&] { return Point(random.between(-5, 25), random.between(-8, 8)); };
    const Segment whole{place(), i % 7 == 0 ? Point(random.between(-5, 25), 2.5) : place()};
    Segment seen = whole;
    const bool any = clip(seen, map.area());
    double sum = 0.0;
    map.pieces(whole, [&](const Segment& piece, const LevelMap::Cell& cell) {
      sum += length(piece);
      EXPECT_EQ(cell.upper, map.at(0.5 * (piece.a + piece.b)).upper);
    });
    EXPECT_NEAR(sum, any ? length(seen) : 0.0, 1e-9);
  }
}

TEST(PictureLines, JoinLooseSegmentsIntoFew) {
  std::vector<Segment> circle;
  constexpr int parts = 5000;
  const auto at = [](int i) {
    const double angle = 2.0 * std::numbers::pi * i / parts;
    return Point(300 + 200 * std::cos(angle), 300 + 200 * std::sin(angle));
  };
  for (int i = 0; i < parts; ++i) circle.push_back({at(7 * i % parts), at((7 * i % parts + 1) % parts)});
  Coarsened none;
  const auto lines = joined(
      circle, [](const Point& p) { return p; }, 100'000, none);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].front(), lines[0].back());
  EXPECT_LT(lines[0].size(), 200u);
  for (const Point& p : lines[0]) EXPECT_NEAR(glm::distance(p, Point(300, 300)), 200.0, 0.1);
  double covered = 0.0;
  for (std::size_t i = 1; i < lines[0].size(); ++i) covered += glm::distance(lines[0][i - 1], lines[0][i]);
  EXPECT_NEAR(covered, 2.0 * std::numbers::pi * 200.0, 5.0);
}

/// Short segments that lie about in a square.
std::vector<Segment> dust_in(double side, int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Segment> dust;
  for (int i = 0; i < count; ++i) {
    const Point p(random.between(0, side), random.between(0, side));
    dust.push_back({p, p + Point(random.between(-3, 3), random.between(-3, 3))});
  }
  return dust;
}

TEST(PictureLines, StayFewHoweverManySegmentsThereAre) {
  const std::vector<Segment> dust = dust_in(500, 200'000, 9);
  std::size_t points = 0;
  Coarsened coarsened, none;
  for (const Polyline& line : joined(
           dust, [](const Point& p) { return p; }, 10'000, coarsened))
    points += line.size();
  EXPECT_LE(points, 20'000u);
  EXPECT_GT(points, 1'000u);
  EXPECT_EQ(coarsened.grid, 4.0);
  EXPECT_GT(coarsened.left_out, 1'000u);
  const std::vector<Segment> speck{{{1.01, 1.01}, {1.02, 1.03}}};
  EXPECT_TRUE(joined(
                  speck, [](const Point& p) { return p; }, 10, none)
                  .empty());
  EXPECT_EQ(none.grid, 0.0);
}

TEST(PictureLines, TellHowCoarseTheirNumberMadeThem) {
  const std::vector<Segment> dust = dust_in(50, 2'000, 10);
  const auto coarsest = [&](std::size_t most, double grid) {
    Page page;
    Panel panel = page.panel("plan", {{{0, 0}, {50, 50}}, 10.0, 10.0}, sheet_margin);
    panel.segments("walls", dust, wall_style, most, grid);
    panel.segments("below", dust, wall_style);
    return page.finish().coarsest;
  };
  for (const double unseen : {0.0, 0.03}) EXPECT_EQ(coarsest(usual_segments, unseen).pixels, 0.0) << unseen;
  EXPECT_DOUBLE_EQ(coarsest(usual_segments, 0.06).metres, 0.06);
  const CoarseLines few = coarsest(100, 0.06);
  EXPECT_EQ(few.what, "plan walls");
  EXPECT_EQ(few.pixels, 4.0);
  EXPECT_DOUBLE_EQ(few.metres, 0.4);
  EXPECT_GT(few.left_out, 0u);
}

TEST(PictureWay, KeepsItsCornersAndItsLength) {
  Record record;
  record.places.push_back({{0, 0, 1}, 1.8, 0.5, true});
  for (int i = 1; i <= 100; ++i) record.places.push_back({{0.1 * i, 0, 1}, 1.8, i == 70 ? 0.31 : 0.5, false});
  for (int i = 1; i <= 50; ++i) record.places.push_back({{10, 0.1 * i, 1}, 1.8, 0.5, false});
  record.places.push_back({{20, 5, 1}, 1.8, 0.0, true});
  record.places.push_back({{21, 5, 1}, 1.8, 0.5, false});
  const Way way = simplified(record, 0.001);
  ASSERT_EQ(way.points.size(), 5u);
  EXPECT_NEAR(way.length, 16.0, 1e-12);  // the jump counts for nothing
  EXPECT_TRUE(way.points[3].jump);
  EXPECT_EQ(way.nearest, 70u);
  EXPECT_NEAR(way.along[70], 7.0, 1e-9);
}

TEST(PictureSurvey, FindsFloorAndWalls) {
  Mesh mesh;
  scenes::add_floor(mesh, 0, 0, 20, 4, 0);
  scenes::add_wall(mesh, 0, 0, 20, 0, 0, 3);
  scenes::add_wall(mesh, 0, 4, 20, 4, 0, 3);
  const roam::World world = scenes::build(mesh);
  Way way;
  way.points = {{{2, 2.5, 0.902}, 1.8, 0, false}, {{18, 2.5, 0.902}, 1.8, 16, false}};
  way.length = 16;
  const roam::WalkerSettings settings;
  const RoomSurvey found = survey(world, way, settings, roam::Mode::walk);
  ASSERT_GT(found.stations.size(), 100u);
  for (const Station& s : found.stations) {
    EXPECT_NEAR(s.floor.value_or(9), 0.0, 0.002);
    EXPECT_NEAR(s.left, 1.2, 0.005);
    EXPECT_NEAR(s.right, 2.2, 0.005);
  }
  for (const Station& s : survey(world, way, settings, roam::Mode::ghost).stations) EXPECT_EQ(s.across, Vec3(0.0));
}

TEST(PictureFrames, HaveRoundLengths) {
  EXPECT_DOUBLE_EQ(round_length(1.0), 1.0);
  EXPECT_DOUBLE_EQ(round_length(1.99), 1.0);
  EXPECT_DOUBLE_EQ(round_length(37.0), 20.0);
  EXPECT_DOUBLE_EQ(round_length(99.0), 50.0);
  EXPECT_DOUBLE_EQ(round_length(0.051), 0.05);
  EXPECT_DOUBLE_EQ(round_length(1000.0), 1000.0);
}

}  // namespace
