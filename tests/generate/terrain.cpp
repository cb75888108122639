// The made terrain: its count, its bits, one sheet without cracks, scarps.
#include "roam/error.h"
#include "surface_check.h"

namespace roam::generate {
namespace {

TEST(GenerateTerrain, MeetsTheAskedNumberWithinThreePerCent) {
  for (const std::uint64_t asked : {10'000u, 10'500u, 77'777u, 1'000'000u, 33'333'333u, 103'000'000u, 1'000'000'000u}) {
    const double made = static_cast<double>(terrain({.triangles = asked}).triangles());
    EXPECT_NEAR(made / static_cast<double>(asked), 1.0, 0.03) << asked;
  }
}

TEST(GenerateTerrain, HandsOutWhatItPromised) {
  for (const double size : {10.0, 700.0, 100'000.0}) {
    expect_promises_kept(terrain({.triangles = 200'000, .seed = 5, .origin = {10.0, -20.0, 30.0}, .size = size}));
  }
}

TEST(GenerateTerrain, SameSeedSameBits) {
  EXPECT_EQ(hash_of(terrain({.triangles = 10'000, .seed = 1})), 6551728173939666042u);
  EXPECT_EQ(hash_of(terrain({.triangles = 10'000, .seed = 2})), 6179225025488151463u);
}

TEST(GenerateTerrain, IsOneSheetBorderedByItsSquareAndSeenFromAbove) {
  const std::vector<Mesh> meshes = collect(terrain({.triangles = 300'000}));
  ASSERT_GT(meshes.size(), 4u);
  const Box box = box_of(meshes);
  EXPECT_EQ(box.size().x, 700.0);
  EXPECT_EQ(box.size().y, 700.0);
  for (const Vec3& p : open_rim(meshes)) {
    ASSERT_TRUE(p.x == box.lower.x || p.x == box.upper.x || p.y == box.lower.y || p.y == box.upper.y);
  }
  for (const Mesh& m : meshes) {
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
      const Triangle t = m.triangle(i);
      ASSERT_GT(crossed(t[1] - t[0], t[2] - t[0]).z, 0.0);
    }
  }
}

TEST(GenerateTerrain, HasScarpsToFallFromAndGroundToWalkOn) {
  std::size_t steep = 0, walkable = 0, all = 0;
  terrain({.triangles = 1'000'000}).stream([&](const Mesh& m) {
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
      const Triangle t = m.triangle(i);
      const Vec3 n = crossed(t[1] - t[0], t[2] - t[0]);
      const double cosine = n.z / length_of(n);
      steep += cosine < 0.5;  // over 60 degrees
      walkable += cosine > 0.75;
      ++all;
    }
  });
  EXPECT_GT(steep, all / 200);
  EXPECT_GT(walkable, all / 2);
}

TEST(GenerateTerrain, RefusesWhatItCannotMake) {
  EXPECT_THROW((void)terrain({.triangles = 1}), Error);
  EXPECT_THROW((void)terrain({.size = 9.0}), Error);
  EXPECT_THROW((void)terrain({.size = 200'000.0}), Error);
  EXPECT_THROW((void)terrain({.size = std::nan("")}), Error);
}

}  // namespace
}  // namespace roam::generate
