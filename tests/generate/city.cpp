// The made city: its count, its bits, closed buildings, doors that lead inside.
#include "roam/error.h"
#include "surface_check.h"

namespace roam::generate {
namespace {

std::vector<Mesh> of_prefix(const std::vector<Mesh>& meshes, const std::string& prefix) {
  std::vector<Mesh> some;
  std::copy_if(meshes.begin(), meshes.end(), std::back_inserter(some),
               [&](const Mesh& m) { return m.name.rfind(prefix, 0) == 0; });
  return some;
}

TEST(GenerateCity, MeetsTheAskedNumberWithinThreePerCent) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    for (const std::uint64_t asked : {10'000u, 12'345u, 30'000u, 130'000u, 1'000'000u, 20'000'000u}) {
      const double made = static_cast<double>(city({.triangles = asked, .seed = seed}).triangles());
      EXPECT_NEAR(made / static_cast<double>(asked), 1.0, 0.03) << asked << " seed " << seed;
    }
  }
  EXPECT_NEAR(static_cast<double>(city({.triangles = most_triangles}).triangles()), 1e9, 3e7);
}

TEST(GenerateCity, HandsOutWhatItPromised) {
  for (const std::uint64_t asked : {10'000u, 150'000u, 2'000'000u}) {
    expect_promises_kept(city({.triangles = asked, .seed = 9, .origin = {84'000.0, 447'000.0, 2.0}}));
  }
}

TEST(GenerateCity, SameSeedSameBits) {
  EXPECT_EQ(hash_of(city({.triangles = 10'000, .seed = 1})), 17951127501104720297u);
  EXPECT_EQ(hash_of(city({.triangles = 10'000, .seed = 2})), 6911464582962871466u);
  EXPECT_EQ(hash_of(city({.triangles = 300'000, .seed = 1})), 14331576743248787533u);
}

TEST(GenerateCity, BuildingsAndBridgesAreClosedAndTheStreetEndsAtTheEdgeOfTown) {
  for (const std::uint64_t asked : {10'000u, 200'000u, 1'500'000u}) {
    const std::vector<Mesh> meshes = collect(city({.triangles = asked}));
    EXPECT_EQ(unmatched_edges(of_prefix(meshes, "block_")), 0u);
    EXPECT_GT(volume(of_prefix(meshes, "block_")), 1'000.0);
    const std::vector<Mesh> bridges = of_prefix(meshes, "bridge_");
    EXPECT_EQ(bridges.empty(), asked < 100'000u);
    if (!bridges.empty()) {
      EXPECT_EQ(unmatched_edges(bridges), 0u);
    }
    const std::vector<Mesh> street = of_prefix(meshes, "street/");
    const Box box = box_of(street);
    for (const Vec3& p : open_rim(street)) {
      ASSERT_TRUE(p.x == box.lower.x || p.x == box.upper.x || p.y == box.lower.y || p.y == box.upper.y);
    }
  }
}

TEST(GenerateCity, NoTriangleIsDegenerate) {
  for (const std::uint64_t asked : {10'000u, 1'000'000u}) {
    double smallest = 1.0;
    city({.triangles = asked}).stream([&](const Mesh& m) { smallest = std::min(smallest, least_area(m)); });
    EXPECT_GT(smallest, 1e-6) << asked;  // m^2
  }
}

TEST(GenerateCity, EveryBuildingHasRoomsBehindADoor) {
  const std::vector<Mesh> meshes = collect(city({.triangles = 200'000}));
  std::size_t buildings = 0, interiors = 0;
  for (const Mesh& m : meshes) {
    if (m.name.rfind("block_", 0) != 0) continue;
    const bool inside = m.name.find("/interior") != std::string::npos;
    (inside ? interiors : buildings) += 1;
    // The door's way in is open: facades alone, or rooms alone, have the door's rim, 2 (0.9 m + 2.05 m) around.
    std::set<double> heights;
    for (const Vec3& p : open_rim({m})) heights.insert(p.z);
    ASSERT_FALSE(heights.empty()) << m.name;
    EXPECT_NEAR(*heights.rbegin() - *heights.begin(), 2.05, 1e-9) << m.name;
  }
  EXPECT_EQ(buildings, interiors);
}

TEST(GenerateCity, RefusesWhatItCannotMake) {
  EXPECT_THROW((void)city({.triangles = 0}), Error);
  EXPECT_THROW((void)city({.origin = {0.0, 0.0, -1e8}}), Error);
}

}  // namespace
}  // namespace roam::generate
