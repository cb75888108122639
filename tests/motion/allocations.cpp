// Where memory runs out, a call of a walker throws and has changed nothing. Instrumented builds have an operator new of
// their own.
#include <gtest/gtest.h>

#include "failing_allocations.h"
#include "walker_judged.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

using roam::SizeRegion;

TEST(WalkerAllocations, AWalkerIsMadeOrRefusedWhereverOneFails) {
  const scenes::World world = scenes::build(scenes::floor_mesh());
  const std::vector<SizeRegion> regions{
      {{{-1, -1, -1}, {1, 1, 3}}, 0.2, 0.0, "a reason that is too long for no allocation"}};
  EXPECT_GT(fail_each([&] {
              scenes::Walker walker(world, {}, scenes::Mode::walk, {0, 0, 1});
              walker.set_regions(regions);
              scenes::Walker copy(walker);
              copy.resize(0.25, 0.4);
              copy.set_mode(scenes::Mode::fly);
              for (int i = 0; i < 9; ++i) copy.step({{1, 0, 0}}, scenes::frame);
              walker = copy;
            }),
            4);
}

TEST(WalkerAllocations, RegionsStayAsTheyWereWhereverOneFails) {
  const scenes::World world = scenes::build(scenes::floor_mesh());
  scenes::Walker walker(world, {}, scenes::Mode::walk, {0, 0, 1});
  const auto region = [](double radius) {
    return SizeRegion{{{-1, -1, -1}, {1, 1, 3}}, radius, 0.0, "a reason that is too long for no allocation"};
  };
  const std::vector<SizeRegion> before{region(0.2)}, wanted{region(0.25), region(0.1)};
  walker.set_regions(before);
  bool whole = false;
  EXPECT_GT(fail_each(
                [&] {
                  whole = false;
                  walker.set_regions(wanted);
                  whole = true;
                },
                1,
                [&] {
                  const double radius = whole ? 0.25 : 0.2;
                  ASSERT_EQ(walker.regions().size(), whole ? 2U : 1U);
                  EXPECT_EQ(walker.regions()[0].radius, radius);
                  EXPECT_EQ(walker.regions()[0].why, wanted[0].why);
                  walker.set_regions(before);
                }),
            2);
}

}  // namespace
#endif
