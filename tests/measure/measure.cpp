// Measurements along a way: the narrowest place and the least headroom, against scenes whose widths are known by
// construction; slopes, edges and named triangles, against all of them one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "measure/along.h"
#include "measure/edges.h"
#include "measure/slope.h"
#include "roam/route.h"
#include "roam/standing.h"
#include "seeded_gallery.h"
#include "walker_scenes.h"

namespace {

using roam::Body;
using roam::Mesh;
using roam::Mode;
using roam::Vec3;
using roam::World;
using roam::measure::Along;
using scenes::Random;

Along walked(const World& world, const roam::WalkerSettings& settings, const std::vector<Vec3>& path,
             Mode mode = Mode::walk) {
  roam::Walker walker(world, settings, mode, path[0]);
  roam::Route route(walker, path);
  Along along(world, settings, mode);
  along.put(walker.position());
  while (!route.done()) along.add(route.advance());
  EXPECT_EQ(route.result().outcome, roam::Outcome::reached);
  return along;
}

void add_corridor(Mesh& mesh) {
  scenes::add_floor(mesh, 0, 0, 20, 4, 0);
  scenes::add_wall(mesh, 0, 0, 20, 0, 0, 3);
  scenes::add_wall(mesh, 0, 4, 20, 4, 0, 3);
}

/// The door, 0.8 m wide, is in the middle.
World corridor_with_door() {
  Mesh mesh;
  add_corridor(mesh);
  scenes::add_box(mesh, {9, 0, 0}, {9.2, 1.6, 3});
  scenes::add_box(mesh, {9, 2.4, 0}, {9.2, 4, 3});
  return scenes::build(mesh);
}

TEST(MeasureAlong, FindsTheDoorAndItsWidth) {
  const World world = corridor_with_door();
  const Along along = walked(world, {}, {{2, 2, 0.902}, {18, 2, 0.902}});
  ASSERT_TRUE(along.narrowest());
  const auto& n = *along.narrowest();
  EXPECT_NEAR(n.width, 0.8, 0.003);
  EXPECT_NEAR(n.spare(), 0.1, 0.002);
  EXPECT_NEAR(n.centre.x, 9.1, 0.15);
  EXPECT_NEAR(n.along, n.centre.x - 2.0, 0.01);
  EXPECT_NEAR(n.left.y, 2.4, 0.005);
  EXPECT_NEAR(n.right.y, 1.6, 0.005);
  EXPECT_NE(n.left_triangle, n.right_triangle);
  EXPECT_FALSE(along.lowest());
}

TEST(MeasureAlong, FindsTheDoorInOneLongStep) {
  const World world = corridor_with_door();
  roam::Walker walker(world, roam::WalkerSettings::sphere(0.3), Mode::fly, {2.55, 2.0, 1.5});
  Along along(world, walker.settings(), Mode::fly);
  along.put(walker.position());
  along.add(walker.step({.velocity = {16.0, 0.0, 0.0}}, 1.0));
  ASSERT_TRUE(along.narrowest());
  EXPECT_NEAR(along.narrowest()->width, 0.8, 0.003);
}

// Door jambs at random angles and offsets: their least distance, edge to edge, is what the body has.
TEST(MeasureAlong, FindsTheLeastDistanceOfPostsOnEitherSide) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed);
    Mesh mesh;
    add_corridor(mesh);
    double least = 4.0;
    for (const double x : {6.0, 11.0, 16.0}) {
      const double middle = random.between(1.9, 2.1), gap = random.between(0.8, 1.6), shift = random.between(-0.3, 0.3);
      const double depth = random.between(0.05, 0.3);
      scenes::add_box(mesh, {x, 0, 0}, {x + depth, middle - 0.5 * gap, 3});
      scenes::add_box(mesh, {x + shift, middle + 0.5 * gap, 0}, {x + shift + depth, 4, 3});
      least = std::min(least, std::hypot(gap, std::max(0.0, std::abs(shift) - depth)));
    }
    const World world = scenes::build(mesh, true);
    roam::WalkerSettings settings;
    settings.radius = random.between(0.15, 0.35);
    const Along along = walked(world, settings, {{2, 2, 0.902}, {19, 2, 0.902}});
    ASSERT_TRUE(along.narrowest()) << seed;
    EXPECT_NEAR(along.narrowest()->width, least, 0.004) << seed;
  }
}

TEST(MeasureAlong, FindsTheNarrowestDoorOfSeededGalleries) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const seeded::Gallery gallery = seeded::gallery(seed);
    const World world = scenes::build(gallery.mesh, true);
    const Body body = Body::capsule(0.9 * gallery.upper(), 1.8);
    roam::WalkerSettings settings;
    settings.radius = body.radius;
    Along along(world, settings, Mode::walk);
    along.list_narrower(1.25);
    const auto centre = [](const Vec3& feet) { return feet + Vec3(0.0, 0.0, 0.902); };
    along.put(centre(gallery.from));
    std::size_t narrower = 0;
    for (const seeded::Door& door : gallery.doors) {
      const Vec3 through = 0.6 * Vec3(door.across.y, -door.across.x, 0.0);
      const Vec3 ahead = through.x > 0.0 ? through : -through;
      along.go(centre(door.point - ahead), body);
      along.go(centre(door.point + ahead), body);
      ++narrower;  // all are, see seeded_gallery.h
    }
    along.go(centre(gallery.to), body);
    along.finish();
    ASSERT_TRUE(along.narrowest()) << seed;
    EXPECT_NEAR(along.narrowest()->width, 2.0 * gallery.upper(), 0.004) << seed;
    ASSERT_EQ(along.narrow().size(), narrower) << seed;
    for (std::size_t i = 0; i < narrower; ++i) {
      const auto& place = along.narrow()[i];
      EXPECT_NEAR(place.width, gallery.doors[i].width, 0.004) << seed;
      EXPECT_LT(glm::distance(place.centre, centre(gallery.doors[i].point)), 0.5) << seed;
      EXPECT_LE(place.from, place.along + 0.1);
      EXPECT_GE(place.to, place.along - 0.1);
    }
  }
}

TEST(MeasureAlong, SeesNoWallInGroundThatIsWalkedOn) {
  Mesh mesh;  // a valley between slopes of 30 degrees
  scenes::add_floor(mesh, 0, -1, 20, 1, 0);
  scenes::add_quad(mesh, {0, 1, 0}, {20, 1, 0}, {20, 9, 4.6}, {0, 9, 4.6});
  scenes::add_quad(mesh, {0, -1, 0}, {20, -1, 0}, {20, -9, 4.6}, {0, -9, 4.6});
  const World world = scenes::build(mesh);
  const std::vector<Vec3> path{{2, 0, 0.902}, {18, 0, 0.902}};
  EXPECT_FALSE(walked(world, {}, path).narrowest());
  EXPECT_TRUE(walked(world, {}, path, Mode::fly).narrowest());
  Mesh rounded;  // 40 degrees, and 10 from a height of 0.35 m on
  scenes::add_floor(rounded, 0, -1, 20, 1, 0);
  for (const double y : {1.0, -1.0}) {
    scenes::add_quad(rounded, {0, y, 0}, {20, y, 0}, {20, 1.417 * y, 0.35}, {0, 1.417 * y, 0.35});
    scenes::add_quad(rounded, {0, 1.417 * y, 0.35}, {20, 1.417 * y, 0.35}, {20, 9 * y, 1.69}, {0, 9 * y, 1.69});
  }
  EXPECT_FALSE(walked(scenes::build(rounded), {}, path).narrowest());
  Mesh steep;  // as steep as the body walks at most
  scenes::add_floor(steep, 0, -1, 20, 1, 0);
  for (const double y : {1.0, -1.0}) scenes::add_quad(steep, {0, y, 0}, {20, y, 0}, {20, 9 * y, 8}, {0, 9 * y, 8});
  EXPECT_FALSE(walked(scenes::build(steep), {}, path).narrowest());
}

// The person steps 0.3 m high.
TEST(MeasureAlong, FindsTheWidthBetweenBenchesThatAreTooHighToStepOnto) {
  for (const double height : {0.35, 0.45, 0.59, 0.8}) {
    for (const bool with_ridges : {false, true}) {
      SCOPED_TRACE(testing::Message() << height << " m high" << (with_ridges ? ", behind ridges" : ""));
      Mesh mesh;
      add_corridor(mesh);
      scenes::add_box(mesh, {9, 0, 0}, {11, 1.65, height});
      scenes::add_box(mesh, {9, 2.35, 0}, {11, 4, height});
      if (with_ridges) {
        for (const double y : {1.9, 2.1}) scenes::add_wall(mesh, 8, y, 12, y, 0, 0.015);
      }
      const World world = scenes::build(mesh);
      Along along(world, {}, Mode::walk);
      along.put({2, 2, 0.902});
      along.go({18, 2, 0.902}, Body::capsule(0.3, 1.8));
      ASSERT_TRUE(along.narrowest());
      EXPECT_NEAR(along.narrowest()->width, 0.7, 0.004);
    }
  }
}

// The upper edges are 0.7 m apart.
TEST(MeasureAlong, FindsTheWidthBetweenBenchesWhoseFrontsLean) {
  Mesh mesh;
  add_corridor(mesh);
  for (const double side : {-1.0, 1.0}) {
    const auto corner = [&](double x, double beside, double z) { return Vec3(x, 2.0 + side * beside, z); };
    scenes::add_quad(mesh, corner(9, 0.288, 0), corner(11, 0.288, 0), corner(11, 0.35, 0.35), corner(9, 0.35, 0.35));
    scenes::add_quad(mesh, corner(9, 0.35, 0.35), corner(11, 0.35, 0.35), corner(11, 2, 0.35), corner(9, 2, 0.35));
  }
  const World world = scenes::build(mesh);
  const auto narrowest = walked(world, {}, {{2, 2, 0.902}, {18, 2, 0.902}}).narrowest();
  ASSERT_TRUE(narrowest);
  EXPECT_LT(narrowest->width, 0.704);
}

// The sphere is lifted as a whole, and cannot be lifted as high as it steps.
TEST(MeasureAlong, FindsTheDoorOfALowTunnel) {
  for (const Vec3& fall : {Vec3(0.0), Vec3(0.01, 0.0, 0.0), Vec3(0.0, 0.01, 0.0)}) {
    for (const bool lossless : {false, true}) {
      SCOPED_TRACE(testing::Message() << "falling by " << fall.x << ", " << fall.y << (lossless ? ", lossless" : ""));
      Mesh mesh;
      add_corridor(mesh);
      const auto ceiling = [&](double x, double y) {
        return Vec3(x, y, 0.8 - fall.x * (x - 9.1) - fall.y * (y - 2.0));
      };
      scenes::add_quad(mesh, ceiling(0, 0), ceiling(20, 0), ceiling(20, 4), ceiling(0, 4));
      scenes::add_box(mesh, {9, 0, 0}, {9.2, 1.65, 1});
      scenes::add_box(mesh, {9, 2.35, 0}, {9.2, 4, 1});
      const World world = scenes::build(mesh, lossless);
      const roam::WalkerSettings settings = roam::WalkerSettings::sphere(0.3);
      Along along(world, settings, Mode::walk);
      along.put({2, 2, 0.302});
      along.go({18, 2, 0.302}, Body{0.3, 0.0});
      ASSERT_TRUE(along.narrowest());
      EXPECT_NEAR(along.narrowest()->width, 0.7, 0.004);
      EXPECT_NEAR(along.narrowest()->centre.x, 9.1, 0.15);
    }
  }
}

TEST(MeasureAlong, FindsTheLowestBeamAndCountsHowOftenTheBodyDucked) {
  Mesh mesh;
  add_corridor(mesh);
  scenes::add_floor(mesh, 0, 0, 20, 4, 3);
  scenes::add_box(mesh, {5, 0, 1.5}, {5.2, 4, 1.8});
  scenes::add_box(mesh, {12, 0, 1.3}, {12.2, 4, 1.8});
  const World world = scenes::build(mesh);
  const Along along = walked(world, {}, {{2, 2, 0.902}, {18, 2, 0.902}});
  ASSERT_TRUE(along.lowest());
  EXPECT_NEAR(along.lowest()->height, 1.3, 0.01);
  EXPECT_NEAR(along.lowest()->centre.x, 12.1, 0.45);
  EXPECT_EQ(along.ducked(), 2u);
}

// Each triangle that is named is as near to its end of the measure as the nearest of all triangles, one by one.
TEST(MeasureRoom, NamesTheTrianglesAtBothEnds) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const seeded::Gallery gallery = seeded::gallery(seed);
    const World world = scenes::build(gallery.mesh, true);
    for (const seeded::Door& door : gallery.doors) {
      const Vec3 middle = door.point + Vec3(0.0, 0.0, 1.0);
      const auto ends = roam::measure::at_ends(world, middle, door.across, door.width);
      for (int i = 0; i < 2; ++i) {
        const Vec3 end = middle + (i == 0 ? -0.5 : 0.5) * door.width * door.across;
        ASSERT_NE(ends[i], roam::no_triangle) << seed;
        long double nearest = 9.0L;
        for (std::size_t t = 0; t < gallery.mesh.triangles.size(); ++t)
          nearest = std::min(nearest, oracle::distance(Body{0.0, 0.0}, end, gallery.mesh.triangle(t)));
        const long double named = oracle::distance(Body{0.0, 0.0}, end, gallery.mesh.triangle(ends[i]));
        EXPECT_NEAR(static_cast<double>(named), static_cast<double>(nearest), 2e-5) << seed;
      }
      EXPECT_EQ(roam::measure::at_ends(world, middle, Vec3(0.0, 0.0, 1.0), 0.1)[0], roam::no_triangle);
    }
  }
}

TEST(MeasureSlope, IsThatOfTheSteepestMetreOfAllStretches) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    std::vector<Vec3> way{{0, 0, 0}};
    double rise = 0.0, fall = 0.0, length = 0.0;
    for (int i = 0; i < 12; ++i) {
      const Vec3 part(random.between(0.0, 0.8), random.between(-0.5, 0.5), random.between(-0.3, 0.3));
      way.push_back(way.back() + part);
      length += std::hypot(part.x, part.y);
      (part.z > 0.0 ? rise : fall) += std::abs(part.z);
    }
    const auto height = [&](double at) {
      for (std::size_t i = 1;; ++i) {
        const Vec3 part = way[i] - way[i - 1];
        const double across = std::hypot(part.x, part.y);
        if (at <= across || i + 1 == way.size()) return way[i - 1].z + std::min(1.0, at / across) * part.z;
        at -= across;
      }
    };
    double steepest = 0.0;
    constexpr int samples = 4000;
    for (int k = 0; k <= samples; ++k) {
      const double begin = (length - 1.0) * k / samples;
      steepest = std::max(steepest, std::abs(height(begin + 1.0) - height(begin)));
    }
    const roam::measure::Slope found = roam::measure::steepest(way);
    EXPECT_NEAR(found.degrees, std::atan(steepest) * 180.0 / std::numbers::pi, 0.1) << seed;
    EXPECT_NEAR(found.rise, rise, 1e-12);
    EXPECT_NEAR(found.fall, fall, 1e-12);
  }
  EXPECT_EQ(roam::measure::steepest(std::vector<Vec3>{{1, 2, 3}}).degrees, 0.0);
  EXPECT_NEAR(roam::measure::steepest(std::vector<Vec3>{{0, 0, 0}, {0, 0, 3}}).degrees, 90.0, 1e-9);
}

TEST(MeasureSlope, OfAWayIsThatOfItsReverse) {
  const auto degrees = [](std::vector<Vec3> way, bool reversed) {
    if (reversed) std::reverse(way.begin(), way.end());
    return roam::measure::steepest(way).degrees;
  };
  const double by_three = std::atan(3.0) * 180.0 / std::numbers::pi;
  for (const bool reversed : {false, true}) {
    EXPECT_NEAR(degrees({{0, 0, 0}, {1, 0, 0}, {1, 0, 3}}, reversed), by_three, 1e-9);
    EXPECT_NEAR(degrees({{0, 0, 0}, {0, 0, 3}, {1, 0, 0}}, reversed), by_three, 1e-9);
    EXPECT_NEAR(degrees({{0, 0, 0}, {1, 0, 0}, {1, 0, 3}, {1, 0, 0}, {2, 0, 0}}, reversed), by_three, 1e-9);
    EXPECT_NEAR(degrees({{0, 0, 0}, {0.7, 0, 0}, {1.7, 0, 0}, {1.7, 0, 3}, {2.5, 0, 3}}, reversed), by_three, 1e-9);
  }
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(seed);
    std::vector<Vec3> way{{0, 0, 0}};
    for (int i = 0; i < 12; ++i) {
      const double level = random.chance(0.4) ? 0.0 : 1.0;
      way.push_back(way.back() + Vec3(level * random.between(0.0, 0.8), level * random.between(-0.5, 0.5),
                                      random.between(-0.3, 0.3)));
    }
    EXPECT_NEAR(degrees(way, false), degrees(way, true), 1e-6) << seed;
  }
}

TEST(MeasureSlope, BelowABodyIsThatOfTheFaceThatItMeets) {
  for (const double degrees : {0.0, 30.0, 46.0, 75.0}) {
    SCOPED_TRACE(degrees);
    const double slope = degrees * std::numbers::pi / 180.0, down = 10.0 * std::tan(slope);
    Mesh mesh;
    scenes::add_quad(mesh, {0, -5, 0}, {10, -5, -down}, {10, 5, -down}, {0, 5, 0});
    const World world = scenes::build(mesh);
    const Body body = Body::capsule(0.3, 1.8);
    const auto below = [&](double x, double gap) {
      const Vec3 axis = Vec3(x, 0, -x * std::tan(slope)) + 0.3 * Vec3(std::sin(slope), 0, std::cos(slope));
      return roam::measure::slope_below(world, body, axis + Vec3(0, 0, gap + body.half_height));
    };
    ASSERT_TRUE(below(4.0, 0.01));
    EXPECT_NEAR(*below(4.0, 0.01), degrees, 0.1);
    EXPECT_FALSE(below(4.0, 0.2));                                                                    // it falls
    EXPECT_FALSE(roam::measure::slope_below(world, body, {-0.2, 0, 0.3 + body.half_height - 0.05}));  // over the edge
  }
}

// Each edge against each other, by positions.
TEST(MeasureEdges, AreOpenWhereOneTriangleAloneHasThem) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    std::vector<Mesh> meshes(2);
    scenes::add_box(meshes[0], {0, 0, 0}, {1, 1, 1});
    scenes::add_box(meshes[1], {1, 0, 0}, {2, 1, 1});
    for (Mesh& mesh : meshes) {
      for (std::size_t i = mesh.triangles.size(); i-- > 0;)
        if (random.chance(0.3)) mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(i));
    }
    std::vector<std::pair<Vec3, Vec3>> edges;
    for (const Mesh& mesh : meshes) {
      for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const roam::Triangle t = mesh.triangle(i);
        for (std::size_t k = 0; k < 3; ++k) edges.emplace_back(t[k], t[(k + 1) % 3]);
      }
    }
    std::uint64_t open = 0;
    for (const auto& [a, b] : edges) {
      int same = 0;
      for (const auto& [c, d] : edges) same += (a == c && b == d) || (a == d && b == c) ? 1 : 0;
      open += same == 1 ? 1 : 0;
    }
    const roam::measure::Edges found = roam::measure::count_edges(meshes);
    EXPECT_EQ(found.open, open) << seed;
    EXPECT_EQ(found.hole.has_value(), open > 0);
  }
  Mesh box;
  scenes::add_box(box, {0, 0, 0}, {1, 1, 1});
  EXPECT_EQ(roam::measure::count_edges({&box, 1}).all, 18u);
  EXPECT_EQ(roam::measure::count_edges({&box, 1}).open, 0u);
}

TEST(MeasureAlong, MeasuresNothingForAGhost) {
  Mesh mesh;
  add_corridor(mesh);
  const World world = scenes::build(mesh);
  Along along(world, {}, Mode::ghost);
  along.put({2, 2, 0.902});
  along.go({18, 2, 0.902}, Body::capsule(0.3, 1.8));
  EXPECT_FALSE(along.narrowest());
  EXPECT_EQ(along.measured(), 0u);
}

}  // namespace
