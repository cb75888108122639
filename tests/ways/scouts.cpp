// Steps of the lattice that other cores ask ahead change nothing: neither what is found, nor its numbers.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cstdint>
#include <vector>

#include "seeded_gallery.h"
#include "ways/lattice/lattice.h"

namespace {

using roam::Survey;
using roam::Vec3;
using roam::ways::AheadLimits;
using roam::ways::Measure;
using roam::ways::NodeId;
using roam::ways::WidestTree;

/// All that is known of a lattice that was grown whole, or until `most` places were known and then whole.
struct Grown {
  std::vector<Vec3> places;
  std::vector<float> clearances;
  std::vector<NodeId> parents, neighbours;
  bool operator==(const Grown&) const = default;
};
/// And how many steps scouts had computed.
struct Scouted {
  Grown grown;
  std::uint64_t computed = 0;
};

Scouted grown(const seeded::Gallery& gallery, const Measure& measure, std::uint64_t most, int threads,
              const AheadLimits& ahead = {}) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  const Survey survey = Survey::build({gallery.mesh}, {.threads = 1, .lossless = true, .progress = {}});
  WidestTree tree(survey, measure, 0.2, roam::ways::everywhere, ahead);
  const auto root = tree.seed(gallery.from);
  Grown found;
  if (!root) return {};
  tree.grow(*root, roam::ways::no_node, [&](std::uint64_t places) { return places < most; });
  tree.grow(*root, roam::ways::no_node);
  for (NodeId id = 0; id < tree.size(); ++id) {
    found.places.push_back(tree.node(id).place);
    found.clearances.push_back(tree.node(id).clearance);
    found.parents.push_back(tree.parent(id));
    for (const NodeId other : tree.neighbours(id)) found.neighbours.push_back(other);
  }
  return {found, tree.computed_ahead()};
}

TEST(Scouts, ChangeNoPlaceOfTheLattice) {
  std::uint64_t computed = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const seeded::Gallery gallery = seeded::gallery(seed);
    for (const double height : {1.9, 0.0}) {
      for (const std::uint64_t most : {500u, 1'000'000u}) {
        const Measure measure{.height = height};
        const Scouted alone = grown(gallery, measure, most, 1), scouted = grown(gallery, measure, most, 4);
        EXPECT_GT(alone.grown.places.size(), 1'000u);
        EXPECT_EQ(alone.computed, 0u);
        EXPECT_TRUE(alone.grown == scouted.grown) << "seed " << seed << ", height " << height;
        computed += scouted.computed;
      }
    }
  }
  // How many depends on what else the machine does.
  EXPECT_GT(computed, 0u);
}

TEST(Scouts, ChangeNoPlaceWhereTheyAreForgotten) {
  std::uint64_t computed = 0;
  for (const std::uint64_t seed : {1u, 2u}) {
    const seeded::Gallery gallery = seeded::gallery(seed);
    const Measure measure{.height = 1.9};
    const Scouted alone = grown(gallery, measure, 1'000'000, 1);
    for (const AheadLimits& ahead : {AheadLimits{3, 1 << 20}, AheadLimits{8192, 20}, AheadLimits{1, 1}}) {
      const Scouted scouted = grown(gallery, measure, 1'000'000, 4, ahead);
      EXPECT_TRUE(alone.grown == scouted.grown) << seed << " " << ahead.most_requests << " " << ahead.most_points;
      computed += scouted.computed;
    }
  }
  EXPECT_GT(computed, 0u);
}

TEST(Scouts, AreWaitedForWhereALatticeEndsBeforeThem) {
  const seeded::Gallery gallery = seeded::gallery(4);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 4);
  const Survey survey = Survey::build({gallery.mesh}, {.threads = 1, .lossless = true, .progress = {}});
  for (int i = 0; i < 200; ++i) {
    WidestTree tree(survey, {.height = 1.9}, 0.2);
    const auto root = tree.seed(gallery.from);
    ASSERT_TRUE(root);
    EXPECT_FALSE(tree.grow(*root, roam::ways::no_node, [&](std::uint64_t places) { return places < 100; }));
  }
}

}  // namespace
