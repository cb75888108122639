// A pager of which everything is in memory answers as a World of the very tiles of its store: contacts and floor bit
// for bit, sweeps and rays but for the last bit of a time, clearances within what they may be less than the gap.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>

#include "clutter.h"
#include "index/binary_tree.h"
#include "index/collapse.h"
#include "index/grid.h"
#include "judged_queries.h"
#include "pager_made.h"
#include "roam/filtered.h"
#include "roam/generate.h"
#include "store/tile_reader.h"
#include "world/data.h"
#include "world/query.h"

namespace {

using judged::along;
using roam::Box;
using roam::Clearance;
using roam::Contact;
using roam::Impact;
using roam::Mesh;
using roam::Pager;
using roam::TriangleId;
using roam::Vec3;
using roam::WorldData;
namespace query = roam::query;

/// What World::build holds, but for the tiles, which come from a store: so its triangles are the store's own, in the
/// store's order.
class StoredWorld final : public roam::Space {
 public:
  explicit StoredWorld(const roam::Store& store) {
    read(store);
    const roam::index::WideTree top = tree();
    data_.tiles.allocate(tiles_.size());
    std::size_t blocks = top.nodes.size(), fine = 0;
    for (const Read& r : tiles_) blocks += r.blocks, fine += r.tile.fine.size();
    data_.blocks.allocate(blocks);
    data_.fine.allocate(fine);
    for (std::size_t i = 0; i < top.nodes.size(); ++i) data_.blocks.items[i].node = top.nodes[i];
    std::size_t block = top.nodes.size();
    fine = 0;
    for (std::size_t i = 0; i < tiles_.size(); ++i) {
      const Read& r = tiles_[order_[i]];
      roam::index::Tile tile = r.tile.tile;
      tile.nodes = static_cast<std::uint32_t>(block);
      tile.leaves = static_cast<std::uint32_t>(block + r.tile.tile.leaves);
      tile.fine_leaves = fine * sizeof(roam::index::FineLeaf);
      data_.tiles.items[i] = tile;
      number_.push_back(r.id);
      std::memcpy(&data_.blocks.items[block], r.tile.memory.get(), r.blocks * sizeof(roam::index::Block));
      if (tile.fine) std::memcpy(&data_.fine.items[fine], r.tile.fine.data(), r.tile.fine.size_bytes());
      block += r.blocks;
      fine += r.tile.fine.size();
    }
    data_.index = data_.view();
  }

  [[nodiscard]] roam::SpaceFacts facts() const override { return {}; }
  [[nodiscard]] roam::Object object(TriangleId) const override { return {}; }

 protected:
  [[nodiscard]] roam::FirstImpact find_first(const roam::Query& query, roam::Vicinity*) const override {
    roam::FirstImpact first = query::first_impact(data_, query);
    if (first.hit) first.triangle = number(first.triangle);
    return first;
  }
  void find_near(const roam::Query& query, roam::Collector& collector, roam::Vicinity*) const override {
    if (collector.only() != nullptr) return query::collect_one(data_.index, query, collector);
    if (data_.lossless) collector.demand(query::lossless_tolerance);
    query::collect(data_, query, {}, 0, collector);
    for (Contact& c : collector.kept()) c.triangle = number(c.triangle);
  }

 private:
  struct Read {
    roam::store::LoadedTile tile;
    Box box;
    TriangleId id = 0;  ///< of its first triangle, in the store
    std::size_t blocks = 0;
  };

  void read(const roam::Store& store) {
    roam::store::TileReader reader(store.state());
    for (std::uint64_t p = 0; p < store.state().pages.size(); ++p) {
      const auto page = reader.page(p);
      for (std::uint32_t t = 0; t < page.view.tiles.size(); ++t) {
        const auto& entry = page.view.tiles[t];
        tiles_.push_back({reader.tile(p, entry, t), roam::store::box_of(entry), roam::store::stored_id(p, t, 0),
                          std::size_t{entry.nodes} + entry.leaves});
        data_.reach.include(tiles_.back().box);
      }
    }
    data_.lossless = store.info().lossless;
    data_.first = {0, store.info().triangles};
    data_.grid = roam::index::Grid::over(data_.reach);
  }

  /// As World::build makes it over its tiles.
  roam::index::WideTree tree() {
    std::vector<roam::index::StepBox> boxes;
    for (const Read& r : tiles_) boxes.push_back(data_.grid.steps(r.box));
    roam::index::WideTree top = roam::index::tree_over(boxes);
    order_.assign(top.leaves.begin(), top.leaves.end());
    return top;
  }

  [[nodiscard]] TriangleId number(TriangleId own) const {
    constexpr TriangleId in_tile = (TriangleId{1} << roam::store::triangle_bits) - 1;
    return number_[own >> roam::store::triangle_bits] | (own & in_tile);
  }

  WorldData data_;
  std::vector<Read> tiles_;
  std::vector<std::size_t> order_;  ///< of the tiles below the tree
  std::vector<TriangleId> number_;
};

/// Bits, not values: -0 is not 0.
bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }
bool same_bits(const Vec3& a, const Vec3& b) {
  return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}
template <class Answer>
bool same_touch(const Answer& a, const Answer& b) {
  return same_bits(a.point, b.point) && same_bits(a.normal, b.normal) && a.feature == b.feature &&
         same_bits(a.distance, b.distance) && a.unknown == b.unknown;
}

struct IdentityTally {
  long sweeps = 0, hits = 0, contacts = 0, clearances = 0, floors = 0, other_time = 0, other_triangle = 0,
       other_clearance = 0;
};

void compare(const roam::Space& pager, const roam::Space& world, bool lossless, std::span<const Mesh> meshes,
             int queries, IdentityTally& tally) {
  clutter::Random random(11);
  for (int i = 0; i < queries; ++i) {
    const Mesh& mesh = meshes[random.engine() % meshes.size()];
    const roam::Triangle t = mesh.triangle(random.engine() % mesh.triangles.size());
    roam::Body body{random.engine() % 6 == 0 ? 0.0 : random.between(0.05, 0.6),
                    random.engine() % 3 == 0 ? random.between(0.0, 0.9) : 0.0};
    if (body.radius == 0.0 && i % 2 == 0) body.half_height = 0.0;  // a ray
    const Vec3 from = t[random.engine() % 3] + random.between(0.0, 3.0) * random.direction();
    const Vec3 motion = std::pow(10.0, random.between(-2.0, 2.3)) * random.direction();
    SCOPED_TRACE(i);
    const auto sweep = [&](const Vec3& way) {
      const Impact a = pager.sweep(body, from, way), b = world.sweep(body, from, way);
      ++tally.sweeps;
      tally.hits += b.hit ? 1 : 0;
      ASSERT_EQ(a.hit, b.hit);
      const double apart = std::abs(a.time - b.time) * glm::length(way);
      ASSERT_LE(apart, along(way, b));
      if (!same_bits(a.time, b.time)) {
        ++tally.other_time;
      } else if (a.hit && a.triangle != b.triangle) {
        ++tally.other_triangle;
      } else if (a.hit) {
        ASSERT_TRUE(same_touch(a, b));
      }
    };
    ASSERT_NO_FATAL_FAILURE(sweep(motion));
    if (i % 4 != 0) continue;
    ASSERT_NO_FATAL_FAILURE(sweep(Vec3(0.0)));
    const double reach = random.between(0.0, 2.0);
    for (const Vec3& way : {Vec3(0.0), motion}) {
      std::array<Contact, 40> left{}, right{};
      const std::size_t n = pager.contacts(body, from, way, 0.3, left), m = world.contacts(body, from, way, 0.3, right);
      ASSERT_EQ(n, m);
      for (std::size_t k = 0; k < n; ++k) {
        ++tally.contacts;
        ASSERT_TRUE(same_bits(left[k].distance, right[k].distance));
        if (n < left.size()) {  // else of those that are equally far others may be left out
          const auto b =
              std::find_if(right.begin(), right.end(), [&](auto& c) { return c.triangle == left[k].triangle; });
          ASSERT_NE(b, right.end());
          ASSERT_TRUE(same_touch(left[k], *b));
        }
      }
      const Clearance a = pager.clearance(body, from, way, reach), b = world.clearance(body, from, way, reach);
      ++tally.clearances;
      tally.other_clearance += same_bits(a.distance, b.distance) ? 0 : 1;
      ASSERT_NEAR(a.distance, b.distance, lossless ? query::lossless_tolerance : query::clearance_tolerance);
    }
    roam::Floor floor;
    if (i % 8 == 0) floor = {30.0, 0.4, from, Vec3(0.0, 0.0, 1.0)};
    const Clearance a = pager.floor_clearance(body, from, reach, floor);
    const Clearance b = world.floor_clearance(body, from, reach, floor);
    ++tally.floors;
    ASSERT_EQ(a.found, b.found);
    ASSERT_TRUE(same_bits(a.distance, b.distance));
    if (a.found && a.triangle == b.triangle) {
      ASSERT_TRUE(same_touch(a, b));
    }
  }
}

/// `beyond`: what both leave out.
void compare(const char* name, const std::vector<Mesh>& meshes, const made::StoreOptions& options,
             std::span<const roam::HalfSpace> beyond = {}) {
  const made::Folder folder(std::string("pager_identity_") + name);
  const auto store = made::store(folder.path(), meshes, options);
  const StoredWorld world(*store);
  Pager pager(store, {.memory = 64 << 20, .loaders = 2});
  ASSERT_NO_FATAL_FAILURE(made::load_all(pager));
  constexpr int queries = 20'000;
  IdentityTally tally;
  roam::Filtered some(pager), of_world(world);
  some.ignore_beyond(beyond);
  of_world.ignore_beyond(beyond);
  ASSERT_NO_FATAL_FAILURE(compare(some, of_world, options.lossless, meshes, queries, tally));
  EXPECT_GT(tally.sweeps, queries);
  EXPECT_GT(tally.floors, queries / 10);
  EXPECT_GT(tally.hits, queries / 10);
  EXPECT_GT(tally.contacts, queries / 10);
  // These depend on the order in which tiles are visited: which of its tolerance an arrival uses; which of two
  // triangles with one edge is named; which triangles a clearance leaves out because they are not 2 mm nearer than what
  // it has found.
  EXPECT_LE(tally.other_time, tally.sweeps / 100);
  EXPECT_LE(tally.other_triangle, tally.hits / 100);
  EXPECT_LE(tally.other_clearance, tally.clearances / 100);
}

TEST(PagerIdentity, OfAGallery) {
  compare("gallery", roam::generate::collect(roam::generate::gallery({.triangles = 200'000, .seed = 1})),
          {.page_tiles = 7, .tile_triangles = 4000});
}
TEST(PagerIdentity, OfAGalleryOfOnePage) {
  compare("page", roam::generate::collect(roam::generate::gallery({.triangles = 200'000, .seed = 1})),
          {.page_tiles = 1024, .tile_triangles = 4000});
}
TEST(PagerIdentity, OfALosslessHeap) {
  clutter::Random random(3);
  const std::vector<Mesh> meshes{clutter::make(random, {60'000, 60.0, 0.05, 8.0, Vec3(5e4, -3e4, 100.0)})};
  compare("lossless", meshes, {.lossless = true, .page_tiles = 3, .tile_triangles = 3000});
}
TEST(PagerIdentity, OfAHeapWithoutTheTrianglesBeyondHalfSpaces) {
  clutter::Random random(4);
  const std::vector<Mesh> meshes{clutter::make(random, {60'000, 60.0, 0.05, 8.0, Vec3(0.0)})};
  const std::vector<roam::HalfSpace> beyond{{{0, 0, 1}, 20.0}, {{-1, 0, 0}, 0.0}};
  long gone = 0, cut = 0;
  for (std::size_t t = 0; t < meshes[0].triangles.size(); ++t) {
    const roam::Triangle corners = meshes[0].triangle(t);
    gone += roam::ObjectFilter{{}, nullptr, beyond}.ignores(corners);
    cut += std::any_of(corners.begin(), corners.end(), [&](const Vec3& p) { return beyond[0].holds(p); });
  }
  ASSERT_GT(gone, 20'000);
  ASSERT_GT(cut, 10'000);
  compare("beyond", meshes, {.page_tiles = 3, .tile_triangles = 3000}, beyond);
}

}  // namespace
