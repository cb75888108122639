// The pieces of the builder: the division into shards, histograms, masks, fingerprints.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "clutter.h"
#include "memory_cost.h"
#include "program.h"
#include "sanitizer.h"
#include "store/build/divide.h"
#include "store/build/histogram.h"
#include "store/build/part_cells.h"
#include "store/build/plan.h"
#include "store/build/run.h"
#include "store/mask.h"
#include "store_builds.h"

namespace {

using namespace roam::store;
using roam::Box;
using roam::Triangle;
using roam::Vec3;

CurveKey key_at(const Vec3& p) { return place_of({p, p, p}).key; }

/// Keys of points, most of them crowded in a corner, some in one smallest cell.
std::vector<CurveKey> crowded_keys(clutter::Random& random, int count) {
  std::vector<CurveKey> keys;
  for (int i = 0; i < count; ++i) {
    const double size = std::pow(10.0, random.between(-4.0, 4.0));
    keys.push_back(i % 5 == 0 ? key_at({3.0, 4.0, 5.0}) : key_at(Vec3(3.0, 4.0, 5.0) + random.in_box(size)));
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

std::vector<PartCell> cells_of(const std::vector<CurveKey>& keys, std::uint32_t part, int bits) {
  std::map<CurveKey, std::uint64_t> counts;
  for (const CurveKey key : keys) ++counts[key >> bits << bits];
  std::vector<PartCell> cells;
  for (const auto& [key, count] : counts) cells.push_back({key, count, part, bits});
  return cells;
}

struct Divided {
  std::vector<Stretch> stretches;
  std::set<std::uint32_t> refined;  ///< parts that were counted in their triangles
};

constexpr std::size_t plenty_of_cells = std::size_t{1} << 62;

/// `bits`: of the cells in which each part is counted already.
Divided divided(const std::vector<std::vector<CurveKey>>& parts, const std::vector<int>& bits, ShardLimits limits,
                std::size_t most_cells = plenty_of_cells) {
  Divided result;
  result.stretches = divide(
      static_cast<std::uint32_t>(parts.size()),
      [&](std::uint32_t part, const CurveCell& cell) {
        const bool counted = bits[part] < cell.bits;
        if (!counted) result.refined.insert(part);
        std::vector<CurveKey> inside;
        for (const CurveKey key : parts[part]) {
          if (key >= cell.key && key <= cell.last()) inside.push_back(key);
        }
        return cells_of(inside, part, counted ? bits[part] : std::max(0, cell.bits - 12));
      },
      most_cells, limits);
  return result;
}

TEST(StoreDivision, CoversEveryTriangleOnceInShardsThatAreSmallEnough) {
  clutter::Random random(1);
  const std::vector<std::vector<CurveKey>> parts{crowded_keys(random, 9000), crowded_keys(random, 4000)};
  const ShardLimits limits{1000, 4000};
  const auto [stretches, refined] = divided(parts, {40, 61}, limits);
  EXPECT_FALSE(refined.empty());
  ASSERT_GT(stretches.size(), 10U);
  std::vector<CurveKey> all = parts[0];
  all.insert(all.end(), parts[1].begin(), parts[1].end());
  std::sort(all.begin(), all.end());
  std::size_t at = 0;
  for (const Stretch& s : stretches) {
    ASSERT_LE(s.triangles, limits.shard);
    ASSERT_FALSE(s.cells.empty());
    const std::size_t begin = at;
    for (; at < begin + s.triangles; ++at) {
      ASSERT_LT(at, all.size());
      ASSERT_TRUE(std::any_of(s.cells.begin(), s.cells.end(),
                              [&](const CurveCell& c) { return c.key <= all[at] && all[at] <= c.last(); }));
    }
    if (s.cells.front().bits == 0) continue;  // see ShardsOfOneSmallestCell...
    for (std::uint32_t p = 0; p < 2; ++p) {
      const bool has = std::any_of(parts[p].begin(), parts[p].end(), [&](CurveKey key) {
        return s.cells.front().key <= key && key <= s.cells.back().last();
      });
      EXPECT_EQ(std::count(s.parts.begin(), s.parts.end(), p), has ? 1 : 0);
    }
  }
  EXPECT_EQ(at, all.size());
}

TEST(StoreDivision, DoesNotDependOnHowFinelyTrianglesAreCounted) {
  clutter::Random random(2);
  const std::vector<std::vector<CurveKey>> parts{crowded_keys(random, 5000), crowded_keys(random, 5000)};
  const ShardLimits limits{700, 2000};
  const auto fine = divided(parts, {0, 0}, limits).stretches;
  for (const auto& bits : {std::vector{30, 55}, std::vector{90, 3}, std::vector{123, 123}}) {
    const auto coarse = divided(parts, bits, limits).stretches;
    ASSERT_EQ(coarse.size(), fine.size());
    for (std::size_t i = 0; i < fine.size(); ++i) {
      EXPECT_EQ(coarse[i].cells, fine[i].cells);
      EXPECT_EQ(coarse[i].skip, fine[i].skip);
      EXPECT_EQ(coarse[i].triangles, fine[i].triangles);
      EXPECT_EQ(coarse[i].parts, fine[i].parts);
    }
  }
}

TEST(StoreDivision, IsTheSameWhereFewCellsAreKept) {
  clutter::Random random(9);
  std::vector<std::vector<CurveKey>> parts;
  for (int p = 0; p < 6; ++p) parts.push_back(crowded_keys(random, 1500));
  for (int p = 0; p < 60; ++p) {
    std::vector<CurveKey>& keys = parts.emplace_back();
    for (int i = 0; i < 500; ++i) keys.push_back(key_at({30.0 * p + random.unit() * 30.0, random.unit() * 30.0, 0.0}));
    std::sort(keys.begin(), keys.end());
  }
  const ShardLimits limits{1500, 6000};
  const std::vector<int> bits(parts.size(), 33);
  const auto [stretches, refined] = divided(parts, bits, limits);
  EXPECT_FALSE(refined.empty());
  EXPECT_LT(refined.size(), parts.size());
  std::size_t cells = 0;
  for (std::uint32_t p = 0; p < parts.size(); ++p) cells += cells_of(parts[p], p, 33).size();
  for (const std::size_t most : {cells, cells / 3, cells / 6}) {
    const Divided few = divided(parts, bits, limits, most);
    EXPECT_EQ(few.refined, refined) << "no part must be read for want of memory";
    ASSERT_EQ(few.stretches.size(), stretches.size());
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      EXPECT_EQ(few.stretches[i].cells, stretches[i].cells);
      EXPECT_EQ(few.stretches[i].skip, stretches[i].skip);
      EXPECT_EQ(few.stretches[i].triangles, stretches[i].triangles);
      EXPECT_EQ(few.stretches[i].parts, stretches[i].parts);
    }
  }
  try {
    static_cast<void>(divided(parts, bits, limits, parts.size()));
    FAIL() << "there is no room for a cell of each part";
  } catch (const roam::Error& error) {
    EXPECT_NE(std::string(error.what()).find("--memory"), std::string::npos) << error.what();
  }
}

// 20,000 tiles of 60,000 triangles: their 5 million cells would take 160 MB. As many cells in 1 GiB are those of 1.3
// million tiles.
TEST(StoreDivision, TakesTheMemoryThatItIsGivenForAnyNumberOfParts) {
  ROAM_NEEDS_PLAIN_MEMORY();
  constexpr std::uint32_t parts = 20'000, row = 160, side = 16;
  constexpr int bits = 36;  // 4 m
  constexpr std::size_t most_cells = 1U << 18;
  std::vector<Stretch> stretches;
  const memory_cost::Cost cost = memory_cost::cost_of([&] {
    stretches = divide(
        parts,
        [&](std::uint32_t part, const CurveCell& cell) {
          std::vector<PartCell> cells;
          for (std::uint32_t i = 0; i < side * side; ++i) {
            const CurveKey key =
                key_at({4.0 * (side * (part % row) + i % side), 4.0 * (side * (part / row) + i / side), 0.0});
            if (key >= cell.key && key <= cell.last()) cells.push_back({key >> bits << bits, 234, part, bits});
          }
          std::sort(cells.begin(), cells.end(), [](const PartCell& a, const PartCell& b) { return a.key < b.key; });
          return cells;
        },
        most_cells);
  });
  EXPECT_EQ(cost.said, "");
  EXPECT_LT(cost.mebibytes, most_cells * sizeof(PartCell) / (1U << 20) + 8);
  std::uint64_t triangles = 0;
  for (const Stretch& s : stretches) triangles += s.triangles;
  EXPECT_EQ(triangles, std::uint64_t{parts} * side * side * 234);
}

TEST(StoreDivision, ShardsOfOneSmallestCellNameThePartsOfTheirOwnTriangles) {
  clutter::Random random(4);
  const ShardLimits limits{100, 400};
  std::vector<PartCell> cells;
  std::vector<std::uint32_t> all;  // the part of each triangle
  for (std::uint32_t part = 0; part < 200; ++part) {
    const std::uint64_t triangles = part % 6 == 0 ? 350 : 1 + static_cast<std::uint64_t>(random.between(0.0, 60.0));
    cells.push_back({7, triangles, part, 0});
    all.insert(all.end(), triangles, part);
  }
  std::size_t at = 0;
  const auto counted = [&](std::uint32_t part, const CurveCell&) { return std::vector{cells[part]}; };
  for (const Stretch& s : divide(200, counted, plenty_of_cells, limits)) {
    ASSERT_EQ(s.cells, (std::vector<CurveCell>{{7, 0}}));
    // The triangles of its parts, by part and number.
    std::vector<std::uint32_t> own;
    for (const std::uint32_t part : s.parts)
      own.insert(own.end(), static_cast<std::size_t>(cells[part].triangles), part);
    ASSERT_LE(s.skip + s.triangles, own.size());
    for (std::uint64_t i = s.skip; i < s.skip + s.triangles; ++i) EXPECT_EQ(own[i], all.at(at++));
    EXPECT_LT(s.skip, cells[s.parts.front()].triangles) << "a part without triangles here";
    EXPECT_GT(s.skip + s.triangles, own.size() - cells[s.parts.back()].triangles) << "a part without triangles here";
  }
  EXPECT_EQ(at, all.size());
}

// A stranger's parts may claim any number of triangles.
TEST(StoreDivision, OfAnyCountsOfOneCellTakesMemoryForItsPartsAndShards) {
  std::vector<PartCell> cells;
  for (std::uint32_t part = 0; part < 1100; ++part) cells.push_back({7, (1ULL << 38) / 1100, part, 0});
  std::size_t parts = 0;
  const std::vector<Stretch> stretches = divide(
      1100, [&](std::uint32_t part, const CurveCell&) { return std::vector{cells[part]}; }, plenty_of_cells);
  for (const Stretch& s : stretches) parts += s.parts.size();
  EXPECT_LE(parts, cells.size() + stretches.size());
}

TEST(StoreDivision, BordersLieOnlyWhereMoreThanAShardIsDivided) {
  clutter::Random random(3);
  const std::vector<std::vector<CurveKey>> parts{crowded_keys(random, 8000)};
  const ShardLimits limits{500, 1500};
  for (const Stretch& s : divided(parts, {20}, limits).stretches) {
    for (const CurveCell& cell : s.cells) {
      if (cell.bits == key_bits) continue;
      // The cell around it, up to where another triangle shares it.
      std::uint64_t inside = 0, around = 0;
      const CurveCell twice{cell.key >> (cell.bits + 1) << (cell.bits + 1), cell.bits + 1};
      for (const CurveKey key : parts[0]) {
        inside += key >= cell.key && key <= cell.last() ? 1 : 0;
        around += key >= twice.key && key <= twice.last() ? 1 : 0;
      }
      EXPECT_GT(inside, 0U);
      EXPECT_GT(around, limits.shard);
    }
  }
}

TEST(StoreDivision, AChangeMovesNoBordersFarAway) {
  clutter::Random random(4);
  std::vector<CurveKey> keys;
  for (int i = 0; i < 40'000; ++i) keys.push_back(key_at(random.in_box(1000.0)));
  const ShardLimits limits{1000, 4000};
  const auto before = divided({keys}, {30}, limits).stretches;
  for (int i = 0; i < 600; ++i) keys.push_back(key_at(Vec3(-900.0) + random.in_box(20.0)));
  const auto after = divided({keys}, {30}, limits).stretches;
  int moved = 0;
  for (const Stretch& s : after) {
    moved += std::none_of(before.begin(), before.end(),
                          [&](const Stretch& o) { return o.cells == s.cells && o.triangles == s.triangles; });
  }
  EXPECT_GT(moved, 0);
  EXPECT_LT(moved, 10);
  EXPECT_GT(after.size(), 40U);
}

TEST(StorePartCells, OfACellAreThoseOfThePartInIt) {
  const TestFolder folder;
  const auto o = store_builds::options(
      {store_builds::write_ply(folder.file("a.ply"), store_builds::field(200, 0.5, Vec3(0.0)))}, folder.file("s"));
  roam::StoreBuildReport report;
  static_cast<void>(roam::plan_store(o, report));
  Work work(o);
  std::vector<PartRecord> parts = read_plan(work).parts;
  PartCells cells(work, parts);
  const std::vector<PartCell> all = cells(0, {0, key_bits});
  ASSERT_GT(all.size(), 100U);
  const PartCell& middle = all[all.size() / 2];
  const auto sum = [](const std::vector<PartCell>& counted) {
    return std::accumulate(counted.begin(), counted.end(), std::uint64_t{0},
                           [](std::uint64_t n, const PartCell& c) { return n + c.triangles; });
  };
  EXPECT_EQ(sum(all), report.triangles);
  // From the file.
  for (const int more : {1, 3, 5}) {
    const CurveCell wide{middle.key >> (middle.bits + more) << (middle.bits + more), middle.bits + more};
    std::vector<PartCell> inside = all;
    std::erase_if(inside, [&](const PartCell& c) { return c.key < wide.key || c.key > wide.last(); });
    const std::vector<PartCell> counted = cells(0, wide);
    ASSERT_EQ(counted.size(), inside.size()) << more;
    EXPECT_LT(counted.size(), all.size());
    for (std::size_t i = 0; i < inside.size(); ++i) {
      EXPECT_EQ(counted[i].key, inside[i].key);
      EXPECT_EQ(counted[i].triangles, inside[i].triangles);
      EXPECT_EQ(counted[i].bits, inside[i].bits);
    }
  }
  // From the runs.
  const std::vector<PartCell> narrow = cells(0, {middle.key, middle.bits});
  EXPECT_GT(narrow.size(), 1U);
  EXPECT_LT(narrow.front().bits, middle.bits);
  EXPECT_EQ(sum(narrow), middle.triangles);
  EXPECT_TRUE(cells.unread().empty());
  parts[0].has_runs = false;
  EXPECT_EQ(sum(cells(0, {middle.key, middle.bits})), 1U);
  EXPECT_EQ(cells.unread(), std::set<std::size_t>{0});
}

TEST(StoreHistogram, DoesNotDependOnTheRuns) {
  clutter::Random random(5);
  std::vector<RunItem> items;
  for (std::uint32_t i = 0; i < 50'000; ++i) items.push_back({key_at(random.in_box(300.0)), i});
  const auto by_key = [](const RunItem& a, const RunItem& b) { return a.key < b.key; };
  PartFile parts[2];
  for (int way = 0; way < 2; ++way) {
    Histogram histogram;
    const std::size_t run = way == 0 ? items.size() : 777;
    for (std::size_t at = 0; at < items.size(); at += run) {
      std::vector<RunItem> some(items.begin() + static_cast<std::ptrdiff_t>(at),
                                items.begin() + static_cast<std::ptrdiff_t>(std::min(items.size(), at + run)));
      std::sort(some.begin(), some.end(), by_key);
      histogram.add(some);
    }
    parts[way].triangles = items.size();
    histogram.finish(parts[way]);
  }
  EXPECT_GT(parts[0].cells.size(), 100U);
  EXPECT_LE(parts[0].cells.size(), 256U);
  EXPECT_EQ(parts[0].cell_bits, parts[1].cell_bits);
  EXPECT_EQ(encode_part(parts[0]), encode_part(parts[1]));
}

TEST(StoreCurve, PlacesOfAnAxisComeBack) {
  clutter::Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const std::uint64_t x = random.engine() & ((std::uint64_t{1} << AbsoluteCurve::axis_bits) - 1);
    for (int k = 0; k < 3; ++k) {
      const CurveKey place = AbsoluteCurve::spread(x) << k;
      ASSERT_EQ(place >> AbsoluteCurve::class_shift, 0U);
      ASSERT_EQ(AbsoluteCurve::gather(place >> k & AbsoluteCurve::axis_mask), x);
    }
  }
}

TEST(StoreRun, GivesBackEveryTriangleOfARange) {
  const TestFolder folder;
  clutter::Random random(7);
  for (const bool floats : {false, true}) {
    const roam::Mesh mesh = clutter::make(random, {30'000, 50.0, 1e-3, 5.0, Vec3(100.0)});
    RunContent content{mesh, 1'000'000};
    if (floats) {
      for (Vec3& v : content.vertices) v = {float(v.x), float(v.y), float(v.z)};
    }
    const std::vector<RunItem> items = sort_run(content);
    const std::string file = floats ? "floats.run" : "doubles.run";
    const std::uint64_t hash = write_run(folder.file(""), file, content, items);
    EXPECT_TRUE(is_run(folder.file(""), file, hash));
    EXPECT_FALSE(is_run(folder.file(""), file, hash + 1));
    EXPECT_THROW(RunReader(folder.file(""), file, hash + 1), roam::Error);
    const RunReader run(folder.file(""), file, hash);
    const CurveKey first = items[7000].key, last = items[21'000].key;
    std::map<std::uint64_t, Triangle> found;
    RunBlock block;
    const auto range = run.blocks(first, last);
    EXPECT_LE(range.end - range.begin, 16U);
    for (std::size_t b = range.begin; b < range.end; ++b) {
      run.read(b, block);
      for (std::size_t i = 0; i < block.triangles.size(); ++i) found[block.numbers[i]] = block.triangles[i];
    }
    for (std::size_t i = 7000; i <= 21'000; ++i) {
      const auto it = found.find(1'000'000 + items[i].triangle);
      ASSERT_NE(it, found.end());
      ASSERT_EQ(it->second, content.triangle(items[i].triangle));
    }
  }
}

TEST(StoreMask, HasCellsInTheThinnestBox) {
  for (const double thin : {0.0, 5e-324, 1e-310, 1e-300}) {
    const CellRange range = CellGrid({Vec3(0.0), {1.0, 1.0, thin}}, 0.0).range(Vec3(0.0), {0.5, 1.0, thin});
    EXPECT_EQ(range.first[2], 0) << thin;
    EXPECT_TRUE(range.last[2] >= 0 && range.last[2] < mask_cells) << thin;
    EXPECT_EQ(range.last[1], mask_cells - 1);
  }
}

TEST(StoreMask, CoversTrianglesAndLittleMore) {
  clutter::Random random(8);
  int marked = 0, touched = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 centre = i % 2 == 0 ? Vec3(0.0) : Vec3(1e6, -2e6, 3e5);
    const Box box{centre - Vec3(8.0, 5.0, i % 3 == 0 ? 0.0 : 2.0), centre + Vec3(8.0, 5.0, i % 3 == 0 ? 0.0 : 2.0)};
    const double size = random.between(0.01, 12.0);
    Triangle t;
    for (Vec3& corner : t) {
      corner = centre + random.in_box(size);
      for (int k = 0; k < 3; ++k) corner[k] = std::clamp(corner[k], box.lower[k], box.upper[k]);
    }
    Mask mask(box, 1e-3);
    mask.add(t);
    const Vec3 cell = box.size() / 8.0;
    std::array<std::uint64_t, 8> hit{};
    for (int s = 0; s < 20'000; ++s) {
      double u = random.unit(), v = random.unit();
      if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
      }
      const Vec3 p = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
      int at[3];
      for (int k = 0; k < 3; ++k) {
        at[k] = cell[k] > 0.0 ? std::clamp(static_cast<int>((p[k] - box.lower[k]) / cell[k]), 0, 7) : 0;
      }
      const int bit = at[0] + 8 * (at[1] + 8 * at[2]);
      hit[static_cast<std::size_t>(bit / 64)] |= std::uint64_t{1} << (bit % 64);
    }
    for (std::size_t w = 0; w < 8; ++w) {
      ASSERT_EQ(hit[w] & ~mask.words[w], 0U) << "triangle " << i;
      marked += std::popcount(mask.words[w]);
      touched += std::popcount(hit[w]);
    }
  }
  EXPECT_LT(marked, 1.1 * touched);
}

}  // namespace
