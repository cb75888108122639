#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "roam/error.h"
#include "verify/piece_log.h"
#include "verify/swept_distance.h"
#include "verify/verification.h"

namespace {

using roam::Triangle;
using roam::Vec3;
using roam::verification::Piece;
using roam::verification::swept_distance;

const Triangle floor_triangle{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

double distance(const Vec3& from, const Vec3& to, double half_height, const Triangle& triangle = floor_triangle) {
  return static_cast<double>(swept_distance(from, to, half_height, triangle));
}

TEST(SweptDistance, OfARestingPointIsThatToFaceEdgeAndVertex) {
  EXPECT_DOUBLE_EQ(distance({1, 1, 2}, {1, 1, 2}, 0), 2.0);
  EXPECT_DOUBLE_EQ(distance({1, -3, 4}, {1, -3, 4}, 0), 5.0);
  EXPECT_DOUBLE_EQ(distance({-3, -4, 0}, {-3, -4, 0}, 0), 5.0);
}

TEST(SweptDistance, OfAMoveIsTheLeastOnTheWay) {
  EXPECT_DOUBLE_EQ(distance({-10, 1, 2}, {10, 1, 2}, 0), 2.0);    // over the face, both ends far away
  EXPECT_DOUBLE_EQ(distance({-10, -3, 4}, {10, -3, 4}, 0), 5.0);  // along an edge
  EXPECT_DOUBLE_EQ(distance({5, -5, 1}, {5, 5, 1}, 0), std::sqrt(2.0));
}

TEST(SweptDistance, IsZeroForAMoveThroughTheTriangle) {
  EXPECT_EQ(distance({1, 1, 5}, {1, 1, -5}, 0), 0.0);
  EXPECT_EQ(distance({1, 1, 0}, {2, 1, 0}, 0), 0.0);          // inside its plane
  EXPECT_NEAR(distance({-1, 1, 0}, {9, 1, 0}, 0), 0, 1e-17);  // across it, in its plane
  EXPECT_EQ(distance({-10, 1, 1}, {10, 1, 1}, 1.5), 0.0);     // the swept axis cuts it, its ends do not
}

TEST(SweptDistance, OfACapsuleCountsFromItsAxis) {
  EXPECT_DOUBLE_EQ(distance({1, 1, 3}, {1, 1, 3}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(distance({-10, 1, 3}, {10, 1, 3}, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(distance({5, -5, 0.2}, {5, 9, 0.2}, 0.5), 1.0);  // beside the vertex (4, 0, 0)
  EXPECT_DOUBLE_EQ(distance({1, 1, 9}, {1, 1, 4}, 0.5), 3.5);       // straight down
}

TEST(SweptDistance, HoldsForTrianglesThatArePointsAndSegments) {
  const Triangle point{Vec3(1, 2, 3), Vec3(1, 2, 3), Vec3(1, 2, 3)};
  const Triangle segment{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(2, 0, 0)};
  EXPECT_DOUBLE_EQ(distance({1, 2, 0}, {1, 2, 2}, 0, point), 1.0);
  EXPECT_DOUBLE_EQ(distance({3, -1, 1}, {3, 1, 1}, 0, segment), 1.0);
  EXPECT_DOUBLE_EQ(distance({3, -1, 3}, {3, 1, 3}, 1, segment), 2.0);
}

TEST(SweptDistance, KeepsItsDigitsWhereSegmentsAreLongAndAlmostParallel) {
  // They cross, seen from above, 1 m apart, and their ends are 0.5 mm aside.
  const Triangle sliver{Vec3(-5e4, -5e-4, 0), Vec3(5e4, 5e-4, 0), Vec3(0, 0, -1)};
  EXPECT_NEAR(distance({-5e4, 5e-4, 1}, {5e4, -5e-4, 1}, 0, sliver), 1.0, 1e-13);
}

TEST(SweptDistance, AgreesWithManyPlacesOfTheAxisAtAnyOrigin) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  const auto point = [&] { return Vec3(coordinate(random), coordinate(random), coordinate(random)); };
  for (const Vec3& origin : {Vec3(0.0), Vec3(-13739, 253, 182), Vec3(6.4e6, -6.4e6, 6.4e6)}) {
    for (int i = 0; i < 1000; ++i) {
      const Triangle t{origin + point(), origin + point(), origin + point()};
      const Vec3 from = origin + 3.0 * point();
      const Vec3 to = origin + 3.0 * point();
      const double half_height = i % 3 == 0 ? 0.0 : std::abs(coordinate(random));
      const double least = distance(from, to, half_height, t);
      double sampled = 1e300;
      constexpr int samples = 16;
      for (int a = 0; a <= samples; ++a) {
        const Vec3 centre = from + (a / double(samples)) * (to - from);
        for (int b = -samples; b <= samples; ++b) {
          const Vec3 p = centre + Vec3(0, 0, half_height * b / double(samples));
          sampled = std::min(sampled, distance(p, p, 0, t));
        }
      }
      // No place of the axis is farther from a sample than half the samples' spacing along and across.
      const double spacing = 0.5 * (glm::length(to - from) + half_height) / samples;
      EXPECT_LE(least, sampled + 1e-8);
      EXPECT_GE(least, sampled - spacing - 1e-8);
    }
  }
}

/// A floor of `side` x `side` cells of 1 m at height 0.
roam::Mesh floor_mesh(std::uint32_t side) {
  roam::Mesh mesh{"floor", {}, {}};
  for (std::uint32_t y = 0; y <= side; ++y) {
    for (std::uint32_t x = 0; x <= side; ++x) mesh.vertices.emplace_back(x, y, 0);
  }
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t a = y * (side + 1) + x;
      mesh.triangles.push_back({a, a + 1, a + side + 1});
      mesh.triangles.push_back({a + 1, a + side + 2, a + side + 1});
    }
  }
  return mesh;
}

/// Steps of 0.1 m along the floor at height `z`.
std::vector<Piece> walk_over(double z, double radius, double clearance, std::uint64_t steps) {
  std::vector<Piece> pieces;
  for (std::uint64_t i = 0; i < steps; ++i) {
    const double x = 1.0 + 0.001 * static_cast<double>(i);
    pieces.push_back({i + 1, {x, 5.3, z}, {x + 0.001, 5.3, z}, {radius, 0.0}, clearance});
  }
  return pieces;
}

TEST(Verification, FindsNothingWrongWithAWalkThatKeepsItsDistance) {
  const std::vector<roam::Mesh> scene{floor_mesh(20)};
  const auto result = roam::verification::verify(scene, walk_over(0.31, 0.3, 0.31, 5000));
  EXPECT_EQ(result.pieces, 5000u);
  EXPECT_EQ(result.violations, 0u);
  EXPECT_EQ(result.overstated, 0u);
  EXPECT_FALSE(result.worst);
  ASSERT_TRUE(result.least_gap);
  EXPECT_NEAR(*result.least_gap, 0.01, 1e-12);
}

TEST(Verification, CountsEachStepThatCameTooNearOnce) {
  const std::vector<roam::Mesh> scene{floor_mesh(20)};
  std::vector<Piece> pieces = walk_over(0.31, 0.3, 0.0, 5000);
  pieces[1023].to.z = 0.25;  // the last of one run of pieces, the first of the next, and one amid
  pieces[1024].to.z = 0.20;
  pieces[1024].step = pieces[1023].step;
  pieces[3000].to.z = 0.29;
  const auto result = roam::verification::verify(scene, pieces);
  EXPECT_EQ(result.violations, 2u);
  ASSERT_TRUE(result.worst);
  EXPECT_EQ(result.worst->step, pieces[1024].step);
  EXPECT_DOUBLE_EQ(result.worst->distance, 0.20);
  const Triangle worst = scene[0].triangle(result.worst->triangle);
  EXPECT_DOUBLE_EQ(distance(pieces[1024].from, pieces[1024].to, 0, worst), 0.20);
}

TEST(Verification, AllowsWhatTheWorldPromisesAndNoMore) {
  const std::vector<roam::Mesh> scene{floor_mesh(20)};
  EXPECT_EQ(roam::verification::verify(scene, walk_over(0.3 - 0.9e-6, 0.3, 0.0, 10)).violations, 0u);
  EXPECT_EQ(roam::verification::verify(scene, walk_over(0.3 - 1.1e-6, 0.3, 0.0, 10)).violations, 10u);
}

TEST(Verification, FindsAMoveThroughAWallWhoseEndsAreFree) {
  const std::vector<roam::Mesh> scene{{"wall", {{0, -9, -9}, {0, 9, -9}, {0, 0, 9}}, {{0, 1, 2}}}};
  const std::vector<Piece> pieces{{1, {-5, 0, 0}, {5, 0, 0}, {0.3, 0.6}, 0.0}};
  const auto result = roam::verification::verify(scene, pieces);
  EXPECT_EQ(result.violations, 1u);
  ASSERT_TRUE(result.worst);
  EXPECT_EQ(result.worst->distance, 0.0);
}

TEST(Verification, FindsCertificatesThatSayTooMuch) {
  const std::vector<roam::Mesh> scene{floor_mesh(20)};
  EXPECT_EQ(roam::verification::verify(scene, walk_over(0.5, 0.3, 0.5, 100)).overstated, 0u);
  EXPECT_EQ(roam::verification::verify(scene, walk_over(0.5, 0.3, 0.5 + 1e-8, 100)).overstated, 100u);
}

TEST(Verification, AnswersAsMeasuringEveryPairDoes) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-6.0, 6.0);
  std::uniform_real_distribution<double> small(-0.5, 0.5);
  const auto point = [&] { return Vec3(coordinate(random), coordinate(random), coordinate(random)); };
  const auto near = [&](const Vec3& p) { return p + Vec3(small(random), small(random), small(random)); };
  std::vector<roam::Mesh> scene(3);
  for (roam::Mesh& mesh : scene) {
    for (std::uint32_t i = 0; i < 100; ++i) {
      const Vec3 p = point();
      mesh.vertices.insert(mesh.vertices.end(), {p, near(p), near(p)});
      mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
  }
  std::vector<Piece> pieces;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Vec3 p = point();
    pieces.push_back({i, p, near(p), {0.2, i % 2 == 0 ? 0.0 : 0.4}, 0.25});
  }
  std::uint64_t violations = 0;
  std::uint64_t overstated = 0;
  for (const Piece& piece : pieces) {
    long double least = 1e9L;
    for (const roam::Mesh& mesh : scene) {
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        least = std::min(least, swept_distance(piece.from, piece.to, piece.body.half_height, mesh.triangle(t)));
      }
    }
    violations += least < 0.2L - 1e-6L ? 1 : 0;
    overstated += least < 0.25L - 1e-9L ? 1 : 0;
  }
  const auto result = roam::verification::verify(scene, pieces);
  EXPECT_GT(violations, 20u);
  EXPECT_GT(overstated, violations);
  EXPECT_EQ(result.violations, violations);
  EXPECT_EQ(result.overstated, overstated);
}

/// Slanted ways of 2 m of spheres and capsules between small triangles, at `origin`.
struct Swarm {
  explicit Swarm(const Vec3& origin, std::uint32_t triangles, std::uint64_t steps) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> coordinate(-4.0, 4.0), small(-0.02, 0.02), move(-1.2, 1.2);
    const auto point = [&](auto& spread) { return Vec3(spread(random), spread(random), spread(random)); };
    for (std::uint32_t i = 0; i < triangles; ++i) {
      const Vec3 p = origin + point(coordinate);
      mesh.vertices.insert(mesh.vertices.end(), {p, p + point(small), p + point(small)});
      mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    for (std::uint64_t i = 0; i < steps; ++i) {
      const Vec3 p = origin + point(coordinate);
      // Some rest, some go straight up; what is certified is now and then too much.
      const Vec3 way = i % 7 == 0 ? Vec3(0.0) : i % 7 == 1 ? Vec3(0.0, 0.0, move(random)) : point(move);
      pieces.push_back({i, p, p + way, {0.15, i % 2 == 0 ? 0.0 : 0.5}, i % 3 == 0 ? 0.3 : 0.0});
    }
  }
  roam::Mesh mesh;
  std::vector<Piece> pieces;
};

TEST(Verification, MeasuresTheFloorUnderWhoWalksOnIt) {
  roam::Mesh floor;
  floor.vertices = {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}};
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  // 1.7 mm above it, as storing leaves it, of which 0.7 mm are certified.
  const Piece piece{1, Vec3(2, 3, 0.3017), Vec3(3, 3, 0.3017), {0.3, 0.0}, 0.3007};
  const auto result = roam::verification::verify({&floor, 1}, {&piece, 1});
  EXPECT_GT(result.distances, 0U);
  EXPECT_EQ(result.violations + result.overstated, 0U);
  EXPECT_NEAR(result.least_gap.value_or(0.0), 0.0017, 1e-12);
}

TEST(Verification, PassesOverOnlyWhatIsFartherThanNeedBe) {
  for (const Vec3& origin : {Vec3(0.0), Vec3(-13739, 253, 182), Vec3(6.4e6, -6.4e6, 6.4e6)}) {
    const Swarm swarm(origin, 800, 100);
    std::uint64_t violations = 0, overstated = 0, near = 0;
    long double least_gap = 1e9L;
    for (const Piece& piece : swarm.pieces) {
      long double least = 1e9L;
      for (std::size_t t = 0; t < swarm.mesh.triangles.size(); ++t) {
        const auto distance = swept_distance(piece.from, piece.to, piece.body.half_height, swarm.mesh.triangle(t));
        near += distance <= std::max(piece.body.radius, piece.clearance) + 0.01 ? 1 : 0;
        least = std::min(least, distance);
      }
      violations += least < piece.body.radius - 1e-6L ? 1 : 0;
      overstated += least < piece.clearance - 1e-9L ? 1 : 0;
      least_gap = std::min(least_gap, least - piece.body.radius);
    }
    const auto result = roam::verification::verify({&swarm.mesh, 1}, swarm.pieces);
    EXPECT_GT(violations, 10U);
    EXPECT_GT(overstated, 10U);
    EXPECT_EQ(result.violations, violations);
    EXPECT_EQ(result.overstated, overstated);
    ASSERT_TRUE(result.least_gap);
    EXPECT_EQ(*result.least_gap, static_cast<double>(least_gap));
    EXPECT_GE(result.distances, near);
    EXPECT_LE(result.distances, near + near / 2) << "what is measured is what is near, not what is in a box with it";
  }
}

TEST(Verification, IsTheSameOfASceneThatComesPieceByPiece) {
  Swarm swarm(Vec3(-13739, 253, 182), 800, 3'000);
  const auto whole = roam::verification::verify({&swarm.mesh, 1}, swarm.pieces);
  EXPECT_GT(whole.violations, 0U);
  // As a reader gives it, with vertices of its own for each piece, and one far away in between.
  roam::verification::Verifier verifier(swarm.pieces);
  roam::TriangleId first = 0;
  for (std::size_t begin = 0; begin < swarm.mesh.triangles.size(); begin += 60) {
    roam::Mesh piece, far;
    for (std::size_t t = begin; t < std::min(begin + 60, swarm.mesh.triangles.size()); ++t) {
      for (const Vec3& corner : swarm.mesh.triangle(t)) piece.vertices.push_back(corner);
      const auto n = static_cast<std::uint32_t>(piece.vertices.size());
      piece.triangles.push_back({n - 3, n - 2, n - 1});
    }
    verifier.check({&piece, 1}, first);
    first += piece.triangles.size();
    far = piece;
    for (Vec3& v : far.vertices) v.x += 1000.0;
    verifier.check({&far, 1}, 1'000'000);
  }
  const auto pieces = verifier.result();
  EXPECT_EQ(pieces.pieces, whole.pieces);
  EXPECT_EQ(pieces.violations, whole.violations);
  EXPECT_EQ(pieces.overstated, whole.overstated);
  EXPECT_EQ(pieces.least_gap, whole.least_gap);
  ASSERT_TRUE(pieces.worst && whole.worst);
  EXPECT_EQ(pieces.worst->distance, whole.worst->distance);
}

TEST(Verification, IsTheSameOfPiecesThatLieInAFile) {
  Swarm swarm(Vec3(-13739, 253, 182), 100, 2 * roam::verification::PieceLog::held + 100);
  const auto whole = roam::verification::verify({&swarm.mesh, 1}, swarm.pieces);
  roam::verification::PieceLog log;
  for (const Piece& piece : swarm.pieces) log.add(piece);
  const auto logged = roam::verification::verify({&swarm.mesh, 1}, log);
  EXPECT_EQ(logged.pieces, whole.pieces);
  EXPECT_EQ(logged.violations, whole.violations);
  EXPECT_EQ(logged.overstated, whole.overstated);
  EXPECT_EQ(logged.least_gap, whole.least_gap);
}

/// Whether it is asked if this is the scene, as it lies; otherwise it must be said that nothing was measured.
bool asks(const roam::verification::Verification& found) {
  const std::vector<std::string> remarks = roam::verification::remarks(found);
  if (remarks.size() != 1) return false;
  EXPECT_NE(remarks[0].find("no triangle came near") != std::string::npos,
            remarks[0].find("nothing had to be measured") != std::string::npos);
  return remarks[0].find("--up, --unit") != std::string::npos;
}

TEST(Verification, AsksWhetherItIsTheSceneOnlyWhereNothingElseExplainsThatNothingWasNear) {
  // A hall of 20 m x 20 m, 60 m high.
  const std::vector<roam::Mesh> floor{floor_mesh(20)};
  roam::Mesh ceiling = floor_mesh(20);
  for (Vec3& v : ceiling.vertices) v.z = 60.0;
  const std::vector<roam::Mesh> hall{floor[0], ceiling};
  const auto found = roam::verification::verify(hall, walk_over(30.0, 0.3, 1.3, 100));
  EXPECT_EQ(found.distances, 0U);
  ASSERT_EQ(roam::verification::remarks(found).size(), 1U) << "a check that measured nothing says so";
  EXPECT_FALSE(asks(found)) << "through the middle of a hall";
  EXPECT_TRUE(asks(roam::verification::verify(hall, walk_over(30.0, 0.3, 0.301, 100)))) << "that stood on something";
  EXPECT_FALSE(asks(roam::verification::verify(hall, walk_over(30.0, 0.3, 0.0, 100)))) << "that was held";
  EXPECT_FALSE(asks(roam::verification::verify(floor, walk_over(9.9, 0.3, 1.3, 100)))) << "just above the scene";
  EXPECT_TRUE(asks(roam::verification::verify(floor, walk_over(10.1, 0.3, 1.3, 100)))) << "elsewhere";
  EXPECT_TRUE(asks(roam::verification::verify({}, walk_over(1.0, 0.3, 1.3, 100)))) << "in no scene";
  EXPECT_TRUE(roam::verification::remarks(roam::verification::verify(floor, walk_over(0.31, 0.3, 0.301, 100))).empty());

  // Who touches something now and then flies; who does so most of the time stands.
  std::vector<Piece> mixed = walk_over(30.0, 0.3, 1.3, 100);
  for (int i = 0; i < 50; ++i) mixed[static_cast<std::size_t>(i)].clearance = 0.301;
  EXPECT_FALSE(asks(roam::verification::verify(hall, mixed)));
  mixed[50].clearance = 0.301;
  EXPECT_TRUE(asks(roam::verification::verify(hall, mixed)));
}

TEST(Verification, JoinsWhatWasFoundOfOtherSteps) {
  const std::vector<roam::Mesh> floor{floor_mesh(20)};
  auto all = roam::verification::verify(floor, walk_over(9.9, 0.3, 1.3, 100));
  auto standing = roam::verification::verify({}, walk_over(99.0, 0.3, 0.301, 101));
  standing.unread = {"tile 7", "tile 8"};
  all.add(standing);
  EXPECT_EQ(all.touching, 101U);
  EXPECT_EQ(all.way.upper.z, 99.0);
  EXPECT_EQ(all.way.lower.z, 9.9);
  EXPECT_EQ(all.scene.upper, Vec3(20, 20, 0));
  standing.unread = {"tile 8", "tile 9"};
  all.add(standing);
  EXPECT_EQ(all.unread, (std::vector<std::string>{"tile 7", "tile 8", "tile 9"})) << "each once";
  EXPECT_TRUE(roam::verification::remarks(all).empty()) << "what was not read may have been near";
}

TEST(Verification, OfWhatCannotBeReadSaysWhereAndWhatToDo) {
  roam::verification::Verification found;
  EXPECT_NO_THROW(roam::verification::demand_all_read(found, "dam.roam"));
  EXPECT_TRUE(found.counted());
  found.unread = {"dam.roam: tile 7 cannot be used", "dam.roam: tile 8 cannot be used"};
  EXPECT_FALSE(found.counted()) << "there may be some where nothing was read";
  found.violations = 1;
  EXPECT_TRUE(found.counted());
  EXPECT_NE(roam::verification::summary(found).find("that can be read"), std::string::npos);
  try {
    roam::verification::demand_all_read(found, "dam.roam", "look at it");
    FAIL() << "it was not read";
  } catch (const roam::Error& error) {
    EXPECT_STREQ(error.what(),
                 "the way could not be verified everywhere: dam.roam: tile 7 cannot be used, nor could 1 more; look at "
                 "it, or mend "
                 "the store by `roam verify dam.roam --repair SCENE`");
  }
}

TEST(Verification, CanBeCancelled) {
  const std::vector<roam::Mesh> scene{floor_mesh(5)};
  EXPECT_THROW(
      (void)roam::verification::verify(scene, walk_over(0.31, 0.3, 0.0, 5000), [](std::uint64_t) { return false; }),
      roam::Cancelled);
}

}  // namespace
