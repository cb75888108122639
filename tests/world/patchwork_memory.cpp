// A patchwork whose memory runs out lets nobody through: patches are as announced, or all of it is solid.

#include <gtest/gtest.h>
#include <malloc.h>

#include <optional>

#include "fallible_calls.h"
#include "roam/patchwork.h"
#include "roam/walker.h"
#include "walker_scenes.h"
#include "world/box_tree.h"

// Instrumented builds have an operator new of their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {

using roam::Body;
using roam::PatchId;
using roam::Patchwork;
using roam::Vec3;

constexpr Body ball{0.2, 0.0};
const roam::Box box{Vec3(-5.0), Vec3(5.0)};

roam::Mesh wall() {
  roam::Mesh mesh;
  scenes::add_wall(mesh, 0.0, -4.0, 0.0, 4.0, -4.0, 4.0);
  return mesh;
}

TEST(PatchworkMemory, WhereAnUpdateRunsOutOfItAllIsSolid) {
  std::optional<Patchwork> space;
  std::optional<roam::Walker> walker;
  std::optional<std::uint64_t> revision;
  const auto begin = [&] {
    walker.reset();
    space.emplace();
    const PatchId known = space->expect({Vec3(10.0), Vec3(11.0)});
    space->update();
    space->deliver(known, scenes::build(wall()));
    walker.emplace(*space, roam::WalkerSettings::sphere(0.2), roam::Mode::fly, Vec3(-9.0, 0.0, 0.0));
    ASSERT_FALSE(walker->held());
    revision = space->facts().revision;
    static_cast<void>(space->expect(box));
  };
  begin();
  fail_calls({{"update",
               [&] {
                 space->update(ball, {-9.0, 0.0, 0.0});
                 return std::string("updated");
               },
               [&](bool failed) {
                 if (!failed) return begin();
                 EXPECT_NE(space->facts().revision, revision);
                 EXPECT_THROW(space->update(), roam::Error);
                 for (const Vec3& from : {Vec3(-9.0, 0.0, 0.0), Vec3(0.0), Vec3(900.0, 1e6, -3e8)}) {
                   const roam::Impact met = space->sweep(ball, from, {18.0, 0.0, 0.0});
                   EXPECT_TRUE(met.hit && met.unknown && met.time == 0.0);
                   EXPECT_EQ(space->object_name(met.triangle), "memory ran out");
                   EXPECT_LE(space->gap_bound(ball, from, {1.0, 0.0, 0.0}, 1.0), 0.0);
                   const roam::Clearance near = space->clearance(ball, from, 1.0);
                   EXPECT_TRUE(near.unknown);
                   EXPECT_EQ(Patchwork::patch(near.triangle), PatchId{});
                 }
                 for (int i = 0; i < 3; ++i) walker->step({.velocity = {100.0, 0.0, 0.0}}, 0.1);
                 EXPECT_TRUE(walker->held() && walker->report().met_unknown);
                 EXPECT_EQ(walker->position(), Vec3(-9.0, 0.0, 0.0));
                 begin();
               }}});
}

TEST(PatchworkMemory, WhereAMessageRunsOutOfItNothingIsAnnounced) {
  std::optional<Patchwork> space;
  PatchId patch{};
  const auto begin = [&] {
    space.emplace();
    patch = space->expect(box);
    space->update();
  };
  const auto met = [&] {
    space->update();
    return space->sweep(ball, {-9.0, 0.0, 0.0}, {18.0, 0.0, 0.0});
  };
  std::optional<roam::World> world;
  const auto deliver = [&] {
    space->deliver(patch, std::move(*world));
    return std::string("delivered");
  };
  const auto renew = [&] {
    begin();
    world = scenes::build(wall());
  };
  renew();
  fail_calls({{"expect",
               [&] {
                 static_cast<void>(space->expect({Vec3(10.0), Vec3(11.0)}));
                 return std::string("announced");
               },
               [&](bool /*failed*/) {
                 EXPECT_TRUE(met().unknown);
                 deliver();
                 EXPECT_TRUE(met().hit && !met().unknown);
                 renew();
               }},
              {"deliver", deliver, [&](bool failed) {
                 EXPECT_EQ(met().unknown, failed);
                 if (failed) {
                   world = scenes::build(wall());
                   deliver();
                 }
                 EXPECT_TRUE(met().hit && !met().unknown);
                 EXPECT_EQ(Patchwork::patch(met().triangle), patch);
                 renew();
               }}});
}

TEST(BoxTreeMemory, DoesNotGrowWhereAllItemsAreReplaced) {
  const auto bytes = [] {
    const auto all = ::mallinfo2();
    return all.uordblks + all.hblkhd;
  };
  std::vector<roam::BoxTree::Item> items;
  for (std::uint32_t i = 0; i < 10'000; ++i) items.push_back({{Vec3(i), Vec3(i + 1.0)}, i});
  roam::BoxTree tree;
  tree.change(items, {});
  const auto before = bytes();
  for (int again = 0; again < 3; ++again) tree.change(items, {});
  EXPECT_LE(bytes(), before + 10'000);
}

}  // namespace

#endif
