// The dam gallery: its count, its bits, its closed tubes, and room for the bodies of Table 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "roam/error.h"
#include "roam/generate.h"
#include "surface_check.h"

namespace roam::generate {
namespace {

bool starts_with(const std::string& s, const char* prefix) { return s.rfind(prefix, 0) == 0; }

std::vector<Mesh> only(const std::vector<Mesh>& meshes, const std::vector<const char*>& prefixes) {
  std::vector<Mesh> some;
  for (const Mesh& m : meshes) {
    if (std::any_of(prefixes.begin(), prefixes.end(), [&](const char* p) { return starts_with(m.name, p); })) {
      some.push_back(m);
    }
  }
  return some;
}

/// Vertices of the meshes with this prefix that lie on the rim of a lone mesh: edges of one triangle only.
std::vector<Vec3> rim_of(const std::vector<Mesh>& meshes, const char* prefix) {
  return open_rim(only(meshes, {prefix}));
}

double along(const Path& path, const Vec3& p) {
  const Vec3 d = path.to - path.from;
  return ((p.x - path.from.x) * d.x + (p.y - path.from.y) * d.y) / std::sqrt(d.x * d.x + d.y * d.y);
}

TEST(GenerateGallery, MeetsTheAskedNumberWithinThreePerCent) {
  for (const std::uint64_t asked : {10'000u, 10'007u, 14'000u, 25'000u, 39'999u, 60'000u, 200'000u, 500'000u,
                                    1'500'000u, 5'000'000u, 20'000'000u, 103'000'000u, 1'000'000'000u}) {
    const double made = static_cast<double>(gallery({.triangles = asked}).triangles());
    EXPECT_NEAR(made / static_cast<double>(asked), 1.0, 0.03) << asked;
  }
}

TEST(GenerateGallery, HandsOutWhatItPromised) {
  for (const std::uint64_t asked : {10'000u, 300'000u, 4'000'000u}) {
    const Scene scene = gallery({.triangles = asked, .seed = 7});
    expect_promises_kept(scene);
  }
}

TEST(GenerateGallery, SameSeedSameBits) {
  EXPECT_EQ(hash_of(gallery({.triangles = 10'000, .seed = 1})), 14817307171976978788u);
  EXPECT_EQ(hash_of(gallery({.triangles = 10'000, .seed = 2})), 1166212885239508804u);
}

TEST(GenerateGallery, OtherSeedOtherBits) {
  std::set<std::uint64_t> hashes;
  for (std::uint64_t seed = 0; seed < 8; ++seed) hashes.insert(hash_of(gallery({.triangles = 10'000, .seed = seed})));
  EXPECT_EQ(hashes.size(), 8u);
}

TEST(GenerateGallery, TubesGrottosAndDamAreClosedAndWoundOneWay) {
  for (const std::uint64_t asked : {10'000u, 60'000u, 700'000u}) {
    const std::vector<Mesh> meshes = collect(gallery({.triangles = asked, .seed = 3}));
    EXPECT_EQ(unmatched_edges(only(meshes, {"upper_gallery/", "grotto_", "drain_"})), 0u) << asked;
    EXPECT_EQ(unmatched_edges(only(meshes, {"lower_gallery/"})), 0u) << asked;
    EXPECT_EQ(unmatched_edges(only(meshes, {"dam"})), 0u) << asked;
  }
}

TEST(GenerateGallery, OnlyTheTerrainHasABorder) {
  const std::vector<Mesh> meshes = collect(gallery({.triangles = 60'000}));
  const std::vector<Vec3> rim = open_rim(meshes);
  const Box all = box_of(only(meshes, {"terrain"}));
  ASSERT_FALSE(rim.empty());
  for (const Vec3& p : rim) {
    EXPECT_TRUE(p.x == all.lower.x || p.x == all.upper.x || p.y == all.lower.y || p.y == all.upper.y);
  }
}

TEST(GenerateGallery, TubesEncloseAirAndTheDamEnclosesConcrete) {
  const std::vector<Mesh> meshes = collect(gallery({.triangles = 60'000}));
  // Counter-clockwise seen from the air: a cavity has a negative volume, a solid a positive one.
  EXPECT_LT(volume(only(meshes, {"upper_gallery/", "grotto_", "drain_"})), -20'000.0);
  EXPECT_LT(volume(only(meshes, {"lower_gallery/"})), -400.0);
  EXPECT_GT(volume(only(meshes, {"dam"})), 1e7);
}

TEST(GenerateGallery, GalleriesLieInsideTheDamAndAboveTheGround) {
  for (const std::uint64_t asked : {10'000u, 500'000u}) {
    const std::vector<Mesh> meshes = collect(gallery({.triangles = asked}));
    const std::vector<Mesh> concrete = only(meshes, {"dam"}), ground = only(meshes, {"terrain"});
    for (const Mesh& m : meshes) {
      if (starts_with(m.name, "dam") || starts_with(m.name, "terrain")) continue;
      for (std::size_t i = 0; i < m.vertices.size(); i += 1 + m.vertices.size() / 2) {
        const Vec3& p = m.vertices[i];
        const Vec3 sky = p + Vec3{0.0, 0.0, 1000.0};
        EXPECT_EQ(crossings(concrete, p, sky) % 2, 1) << m.name;
        EXPECT_EQ(crossings(ground, p, sky), 0) << m.name;
      }
    }
  }
}

TEST(GenerateGallery, NoTriangleIsDegenerate) {
  for (const std::uint64_t asked : {10'000u, 500'000u, 5'000'000u}) {
    double smallest = 1.0;
    gallery({.triangles = asked}).stream([&](const Mesh& m) { smallest = std::min(smallest, least_area(m)); });
    EXPECT_GT(smallest, 1e-6) << asked;  // m^2
  }
}

TEST(GenerateGallery, PathOneIsClearUpToTheFloorAndPathTwoUpToTheGate) {
  constexpr double gate = 0.6;  // m, to either side of path 2
  for (const std::uint64_t asked : {10'000u, 500'000u, 3'000'000u}) {
    std::array<double, 2> least{1e9, 1e9};
    gallery({.triangles = asked}).stream([&](const Mesh& m) {
      for (std::size_t k = 0; k < 2; ++k) {
        least[k] = std::min(least[k], clearance_of_segment(m, gallery_paths[k].from, gallery_paths[k].to, 2.0));
      }
    });
    EXPECT_NEAR(least[0], gallery_floor_below_path, 0.003) << asked;
    EXPECT_NEAR(least[1], gate, 1e-6) << asked;
  }
}

TEST(GenerateGallery, AWalkerHasRoomAlongPathsOneAndTwo) {
  // Radius 0.3 m, height 1.8 m: its axis, 0.3 m to 1.5 m over the floor, keeps the radius from all but the floor.
  for (const int k : {0, 1}) {
    const Path& path = gallery_paths[static_cast<std::size_t>(k)];
    double least = 1e9;
    gallery({.triangles = 500'000}).stream([&](const Mesh& m) {
      for (const double z : {0.35, 0.9, 1.5}) {
        const Vec3 lift{0.0, 0.0, z - gallery_floor_below_path};
        least = std::min(least, clearance_of_segment(m, path.from + lift, path.to + lift, 2.0));
      }
    });
    EXPECT_GE(least, 0.3) << path.name;
  }
}

TEST(GenerateGallery, PathThreeIsClearButForTheSplit) {
  const Path& path = gallery_paths[2];
  double least = 1e9;
  gallery({.triangles = 1'000'000}).stream([&](const Mesh& m) {
    least = std::min(least, clearance_of_segment(m, path.from, path.to, 2.0));
  });
  EXPECT_GE(least, 0.9);
}

TEST(GenerateGallery, TheFloorLiesWhereItsHeaderSays) {
  const std::vector<Mesh> meshes =
      only(collect(gallery({.triangles = 1'000'000})), {"upper_gallery/", "lower_gallery/"});
  for (const Path& path : gallery_paths) {
    const double length = along(path, path.to);
    // The first metres of each path have neither joint nor split; floors are rough by 2.5 mm.
    for (double s = 0.0; s < std::min(length, 3.0); s += 0.25) {
      const Vec3 p = path.from + (path.to - path.from) * (s / length);
      EXPECT_NEAR(p.z - floor_under(meshes, p), gallery_floor_below_path, 0.004) << path.name << " at " << s;
    }
  }
}

TEST(GenerateGallery, TheSplitIsAsWideAndDeepAsItsHeaderSays) {
  const Path& path = gallery_paths[2];
  for (const std::uint64_t asked : {10'000u, 1'000'000u}) {
    const std::vector<Mesh> split = only(collect(gallery({.triangles = asked})), {"lower_gallery/split"});
    double near = 1e9, far = -1e9;
    for (const Mesh& m : split) {
      for (const Vec3& p : m.vertices) {
        near = std::min(near, along(path, p));
        far = std::max(far, along(path, p));
      }
    }
    EXPECT_NEAR(far - near, gallery_split_width, 1e-9);
    EXPECT_NEAR(near + far, along(path, path.to), 1e-9);  // in the middle of the path
    // Straight lips from wall to wall: every point of the rim lies on one of them, or on a wall between them.
    for (const Vec3& p : rim_of(split, "lower_gallery/split")) {
      const double s = along(path, p);
      const double z = path.from.z - s / along(path, path.to) - gallery_floor_below_path;
      EXPECT_GE(s, near - 1e-9);
      EXPECT_LE(s, far + 1e-9);
      EXPECT_NEAR(p.z, z, 0.003);
    }
    const Box box = box_of(split);
    EXPECT_NEAR(box.size().z, gallery_split_depth + gallery_split_width / along(path, path.to), 0.01);
  }
}

TEST(GenerateGallery, GrottoDoorsAreAsWideAndHighAsTheirHeaderSays) {
  for (const std::uint64_t asked : {10'000u, 1'000'000u}) {
    const std::vector<Mesh> meshes = collect(gallery({.triangles = asked, .seed = 4}));
    int doors = 0;
    for (const Mesh& m : meshes) {
      if (m.name.size() < 5 || m.name.substr(m.name.size() - 5) != "/door") continue;
      ++doors;
      const Path& path = starts_with(m.name, "lower")                   ? gallery_paths[2]
                         : along(gallery_paths[1], m.vertices[0]) > 0.0 ? gallery_paths[1]
                                                                        : gallery_paths[0];
      double near = 1e9, far = -1e9;
      for (const Vec3& p : m.vertices) {
        near = std::min(near, along(path, p));
        far = std::max(far, along(path, p));
      }
      const Box box = box_of({m});
      EXPECT_NEAR(far - near, gallery_door_width, 1e-9) << m.name;
      EXPECT_NEAR(box.size().z, gallery_door_height, 1e-9) << m.name;
    }
    EXPECT_GE(doors, 10);
  }
}

TEST(GenerateGallery, TheOriginMovesEverything) {
  const Vec3 origin{500'000.0, 4'000'000.0, -100.0};
  const std::vector<Mesh> here = collect(gallery({.triangles = 10'000}));
  const std::vector<Mesh> there = collect(gallery({.triangles = 10'000, .origin = origin}));
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    ASSERT_EQ(here[i].triangles, there[i].triangles);
    for (std::size_t k = 0; k < here[i].vertices.size(); ++k) {
      const Vec3 d = there[i].vertices[k] - here[i].vertices[k] - origin;
      ASSERT_LT(std::max({std::fabs(d.x), std::fabs(d.y), std::fabs(d.z)}), 1e-8);
    }
  }
  EXPECT_EQ(unmatched_edges(only(there, {"upper_gallery/", "grotto_", "drain_"})), 0u);
}

TEST(GenerateGallery, RefusesWhatItCannotMake) {
  EXPECT_THROW((void)gallery({.triangles = 9'999}), Error);
  EXPECT_THROW((void)gallery({.triangles = most_triangles + 1}), Error);
  EXPECT_THROW((void)gallery({.origin = {std::nan(""), 0.0, 0.0}}), Error);
  EXPECT_THROW((void)gallery({.origin = {0.0, 2e7, 0.0}}), Error);
}

}  // namespace
}  // namespace roam::generate
