// Floor of a store is found where brute force finds it.

#include "floor_oracle.h"
#include "pager_made.h"

namespace {

using roam::Vec3;

TEST(PagerFloor, IsWhatBruteForceSays) {
  clutter::Random random(74);
  for (const Vec3 centre : {Vec3(0.0), Vec3(-13739.0, 253.0, 182.0)}) {
    const roam::Mesh mesh = floor_oracle::scene(random, centre, 200);
    const made::Folder folder("pager_floor");
    const auto store = made::store(folder.path(), {&mesh, 1}, {.page_tiles = 2, .tile_triangles = 16});
    roam::Pager pager(store, {.memory = 64 << 20, .loaders = 2});
    ASSERT_NO_FATAL_FAILURE(made::load_all(pager));
    floor_oracle::judge(pager, floor_oracle::triangles_of(mesh), centre, pager.largest_error(), 1500, 3);
  }
}

TEST(PagerFloor, IsUnknownBeforeItIsLoaded) {
  clutter::Random random(75);
  const roam::Mesh mesh = floor_oracle::scene(random, Vec3(0.0), 100);
  const made::Folder folder("pager_floor_unknown");
  roam::Pager pager(made::store(folder.path(), {&mesh, 1}, {}), {.memory = 64 << 20});
  const auto c = pager.floor_clearance({0.0, 0.25}, Vec3(0.0), 10.0, {.slope_degrees = 45.0});
  ASSERT_TRUE(c.found);
  EXPECT_TRUE(c.unknown);
}

}  // namespace
