#pragma once
/// \file
/// Pages, part files and manifests of stores that are not there, with all that they may hold.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "store/manifest.h"
#include "store/page.h"
#include "store/part.h"

namespace made {

inline constexpr std::uint64_t pack_bytes = 1 << 30;

inline std::vector<roam::store::TileEntry> some_tiles(std::size_t count, double spread, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-spread, spread), side(0.0, 64.0);
  std::vector<roam::store::TileEntry> tiles(count);
  for (std::size_t i = 0; i < count; ++i) {
    roam::store::TileEntry& t = tiles[i];
    for (int k = 0; k < 3; ++k) {
      t.lower[k] = place(random);
      t.upper[k] = t.lower[k] + side(random);
      t.origin[k] = std::floor(t.lower[k]);
    }
    t.step = 0x1p-10F;
    t.error = t.fine_error = 0.5e-3F;
    t.triangles = 1 + random() % 16384;
    t.leaves = static_cast<std::uint16_t>(1 + std::min<std::uint32_t>(t.triangles - 1, random() % 1500));
    t.nodes = static_cast<std::uint16_t>(1 + random() % std::min<std::uint32_t>(t.leaves, 100));
    t.offset = random() % (pack_bytes / 2);
    t.bytes = 1 + random() % 100'000;
    t.number_bytes = static_cast<std::uint32_t>(random() % (1 + roam::store::most_number_bytes(t.triangles)));
    t.hash = i;
    for (auto& m : t.mask) m = random();
  }
  return tiles;
}

/// A copy of bytes, aligned as PageView demands.
struct AlignedCopy {
  explicit AlignedCopy(std::span<const std::byte> bytes)
      : memory(std::make_unique<roam::index::Block[]>(bytes.size() / sizeof(roam::index::Block) + 1)),
        size(bytes.size()) {
    if (!bytes.empty()) std::memcpy(memory.get(), bytes.data(), bytes.size());
  }
  [[nodiscard]] std::span<std::byte> bytes() const { return {reinterpret_cast<std::byte*>(memory.get()), size}; }
  std::unique_ptr<roam::index::Block[]> memory;
  std::size_t size;
};

inline roam::store::PartFile some_part() {
  roam::store::PartFile part;
  part.cell_bits = 42;
  std::mt19937_64 random(3);
  roam::store::CurveKey key = 0;
  for (int i = 0; i < 1000; ++i) {
    key += roam::store::CurveKey{1 + random() % 1000} << (random() % 20 + 42);
    part.cells.push_back({key, 1 + random() % 100});
    part.triangles += part.cells.back().triangles;
  }
  part.objects = {{0, "floor"}, {10, ""}, {11, "wall"}};
  return part;
}

inline roam::store::ShardInfo some_shard(std::uint64_t triangles) {
  using roam::Vec3;
  roam::store::ShardInfo shard;
  shard.key = std::string(64, 'a');
  shard.pack = std::string(64, 'b');
  shard.bytes = 123'456'789'012ULL;
  shard.triangles = triangles;
  shard.tiles = 3;
  shard.geometry_bytes = 5;
  shard.number_bytes = 6;
  shard.resident_bytes = 7;
  shard.bounds = {Vec3(-0.1, 1e-300, 2.0 / 3.0), Vec3(6.4e6, 1.0, 2.0)};
  shard.largest_error = 0x1.fp-11;
  shard.geometry_hash = 0xfedcba9876543210ULL;
  shard.pages = {{shard.bounds, 64, 456, 0xffffffffffffffffULL, 1}, {shard.bounds, 2000, 784, 1, 2}};
  return shard;
}

inline roam::store::Manifest some_manifest() {
  using roam::Vec3;
  roam::store::Manifest manifest;
  manifest.lossless = true;
  manifest.options = "up z, metres";
  manifest.bounds = {Vec3(-1.0), Vec3(1.0)};
  manifest.geometry_hash = 1;
  manifest.parts = {{"a \"quoted\" ünïcode.ply", "f", std::string(64, 'c'), 10, 40, 1},
                    {"b", "g", std::string(64, 'd'), 11, 2, 7}};
  manifest.shards = {some_shard(30), some_shard(12)};
  manifest.shards[1].pack = std::string(64, 'e');
  manifest.notes = {"A note."};
  return manifest;
}

}  // namespace made
