// A tile goes to bytes and comes back bit for bit.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <thread>

#include "clutter.h"
#include "roam/error.h"
#include "roam/generate.h"
#include "tiles_made.h"

namespace {

using namespace store_codec;
using roam::Mesh;
using roam::Vec3;

void expect_back(BuiltTile& tile, const std::string& what) {
  static roam::store::TileDecoder decoder;
  static Room room;
  const TileShape shape = roam::store::shape_of(tile);
  const auto coded = roam::store::encode_tile(tile);
  const std::span<std::byte> out = room.tile(shape);
  const char* why = decoder.decode(coded, shape, out);
  ASSERT_EQ(why, nullptr) << what << ": " << why;
  ASSERT_EQ(std::memcmp(out.data(), memory_of(tile).data(), shape.bytes()), 0) << what;
  ASSERT_TRUE(room.kept_inside(shape.bytes())) << what;
  ASSERT_EQ(danger_of(out, shape), "") << what;
}

std::size_t expect_all_back(std::span<const Mesh> meshes, bool lossless, const std::string& what) {
  std::size_t tiles = 0;
  for (BuiltTile& tile : tiles_of(meshes, lossless)) {
    if (roam::store::shape_of(tile).bytes() > roam::store::tile_bytes) continue;
    expect_back(tile, what);
    ++tiles;
  }
  return tiles;
}

/// A floor of n x m squares with waves.
Mesh floor_mesh(int n, int m, const Vec3& corner, double cell) {
  Mesh mesh;
  for (int y = 0; y <= m; ++y) {
    for (int x = 0; x <= n; ++x)
      mesh.vertices.push_back(corner + Vec3(x * cell, y * cell, cell * std::sin(0.3 * x + y)));
  }
  const auto at = [n](int x, int y) { return static_cast<std::uint32_t>(y * (n + 1) + x); };
  for (int y = 0; y < m; ++y) {
    for (int x = 0; x < n; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x, y + 1)});
      mesh.triangles.push_back({at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return mesh;
}

TEST(StoreCodec, BringsMadeScenesBack) {
  for (const bool lossless : {false, true}) {
    EXPECT_GT(expect_all_back(collect(roam::generate::gallery({.triangles = 60000})), lossless, "gallery"), 5U);
    EXPECT_GT(expect_all_back(collect(roam::generate::terrain({.triangles = 60000})), lossless, "terrain"), 5U);
    EXPECT_GT(expect_all_back(collect(roam::generate::city({.triangles = 60000})), lossless, "city"), 5U);
  }
}

TEST(StoreCodec, BringsClutterBack) {
  clutter::Random random(7);
  for (const double large : {0.1, 10.0, 1e5, 1e8}) {
    for (const double far : {0.0, 1e6, 9e8}) {
      const std::vector<Mesh> meshes{clutter::make(random, {2000, 30.0, 1e-3, large, {far, -far, far}})};
      EXPECT_GT(expect_all_back(meshes, false, "clutter"), 0U);
      EXPECT_GT(expect_all_back(meshes, true, "lossless clutter"), 0U);
    }
  }
}

TEST(StoreCodec, BringsTheSmallestAndTheLargestTileBack) {
  const Mesh one{"", {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.5}, {0.0, 1.0, 0.0}}, {{0, 1, 2}}};
  const Mesh full = floor_mesh(128, 64, {0.0, 0.0, 0.0}, 0.1);
  const Mesh far = floor_mesh(128, 64, {1e9 - 20.0, -1e9, 0.0}, 0.1);
  ASSERT_EQ(full.triangles.size(), roam::index::most_tile_triangles);
  for (const Mesh& mesh : {one, full, far}) {
    for (const bool lossless : {false, true}) {
      BuiltTile tile = tile_of({&mesh, 1}, lossless);
      if (roam::store::shape_of(tile).bytes() > roam::store::tile_bytes) {
        EXPECT_THROW((void)roam::store::encode_tile(tile), roam::Error);
      } else {
        expect_back(tile, "one or many");
      }
    }
  }
}

TEST(StoreCodec, BringsDegenerateAndRepeatedTrianglesBack) {
  Mesh mesh = floor_mesh(10, 10, {0.0, 0.0, 0.0}, 1.0);
  for (std::uint32_t i = 0; i < 50; ++i) {
    mesh.triangles.push_back({i, i, i});
    mesh.triangles.push_back({i, i + 1, i});
    mesh.triangles.push_back({i + 1, i + 1, i});
    mesh.triangles.push_back(mesh.triangles[i]);
    const auto t = mesh.triangles[i];
    mesh.triangles.push_back({t[1], t[0], t[2]});
  }
  for (const bool lossless : {false, true}) {
    BuiltTile tile = tile_of({&mesh, 1}, lossless);
    expect_back(tile, "degenerate");
  }
}

TEST(StoreCodec, RefusesATileThatIsTooLarge) {
  clutter::Random random(3);
  const Mesh mesh = clutter::make(random, {16000, 30.0, 1e-3, 0.1, Vec3(0.0)});
  BuiltTile tile = tile_of({&mesh, 1});
  ASSERT_GT(roam::store::shape_of(tile).bytes(), roam::store::tile_bytes);
  EXPECT_THROW((void)roam::store::encode_tile(tile), roam::Error);
}

TEST(StoreCodec, GivesTheSameBytesInAnyThread) {
  const auto meshes = collect(roam::generate::gallery({.triangles = 30000}));
  const auto encode_all = [&](bool backwards) {
    auto tiles = tiles_of(meshes, false);
    std::vector<std::vector<std::byte>> coded(tiles.size());
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      const std::size_t t = backwards ? tiles.size() - 1 - i : i;
      coded[t] = roam::store::encode_tile(tiles[t]);
    }
    return coded;
  };
  std::vector<std::vector<std::byte>> other;
  std::thread([&] { other = encode_all(true); }).join();
  EXPECT_EQ(encode_all(false), other);
}

/// Where each triangle of a tile lies, by its id: the corners, whichever is first.
std::map<std::uint32_t, std::array<std::array<int, 3>, 3>> places_by_id(const BuiltTile& tile) {
  std::map<std::uint32_t, std::array<std::array<int, 3>, 3>> places;
  for (const Leaf& leaf : tile.leaves) {
    for (int t = 0; t < leaf.triangle_count; ++t) {
      std::array<std::array<int, 3>, 3> p{};
      for (int c = 0; c < 3; ++c) {
        const int v = leaf.vertex_of(c, t);
        p[c] = {leaf.vertex[0][v], leaf.vertex[1][v], leaf.vertex[2][v]};
      }
      const auto least = std::min({p, {p[1], p[2], p[0]}, {p[2], p[0], p[1]}});
      places[roam::index::read_id(tile.ids.data(), leaf, t)] = least;
    }
  }
  return places;
}

TEST(StoreCodec, KeepsTheIdOfEveryTriangleAndItsSides) {
  clutter::Random random(5);
  for (const Mesh& mesh :
       {floor_mesh(50, 50, {0.0, 0.0, 0.0}, 0.5), clutter::make(random, {900, 9.0, 0.1, 3.0, Vec3(0.0)})}) {
    BuiltTile tile = tile_of({&mesh, 1});
    const auto before = places_by_id(tile);
    ASSERT_EQ(before.size(), mesh.triangles.size());
    (void)roam::store::encode_tile(tile);
    EXPECT_EQ(places_by_id(tile), before);
  }
}

TEST(StoreCodec, TakesFewBytes) {
  const auto bytes_a_triangle = [](const std::vector<Mesh>& meshes) {
    double bytes = 0.0, triangles = 0.0;
    for (BuiltTile& tile : tiles_of(meshes, false)) {
      bytes += double(roam::store::encode_tile(tile).size());
      triangles += double(roam::store::shape_of(tile).triangles);
    }
    return bytes / triangles;
  };
  EXPECT_LT(bytes_a_triangle(collect(roam::generate::gallery({.triangles = 500000}))), 2.2);
  EXPECT_LT(bytes_a_triangle(collect(roam::generate::terrain({.triangles = 1000000}))), 1.8);
}

std::uint64_t hash_of(const BuiltTile& tile) {
  return roam::store::geometry_hash(tile.tile, tile.leaves, tile.fine_leaves);
}

TEST(StoreCodec, HashesGeometryInAnyOrder) {
  const Mesh mesh = floor_mesh(40, 40, {100.0, 2000.0, 3.0}, 0.5);
  Mesh reversed = mesh;
  std::reverse(reversed.triangles.begin(), reversed.triangles.end());
  for (auto& t : reversed.triangles) t = {t[1], t[2], t[0]};
  for (const bool lossless : {false, true}) {
    BuiltTile tile = tile_of({&mesh, 1}, lossless);
    const std::uint64_t hash = hash_of(tile);
    EXPECT_EQ(hash_of(tile_of({&reversed, 1}, lossless)), hash);
    (void)roam::store::encode_tile(tile);
    EXPECT_EQ(hash_of(tile), hash) << "after ordering its leaves";
    Mesh moved = mesh;
    moved.vertices[5].z += 0.25;
    EXPECT_NE(hash_of(tile_of({&moved, 1}, lossless)), hash);
    Mesh turned = mesh;
    std::swap(turned.triangles[7][0], turned.triangles[7][1]);
    EXPECT_NE(hash_of(tile_of({&turned, 1}, lossless)), hash);
  }
}

TEST(StoreCodec, HashesEveryBitOfAVertex) {
  const Mesh mesh = floor_mesh(4, 4, {0.0, 0.0, 0.0}, 0.5);
  BuiltTile tile = tile_of({&mesh, 1}, true);
  const std::uint64_t hash = hash_of(tile);
  tile.fine_leaves[0].vertex[2][0] = static_cast<std::int16_t>(tile.fine_leaves[0].vertex[2][0] ^ 1);
  EXPECT_NE(hash_of(tile), hash);
}

TEST(StoreCodec, SumsHashesOfTiles) {
  // Halves of a flat floor lie on other grids than the whole, but all of its vertices are whole steps of each.
  const Mesh whole = floor_mesh(8, 8, {0.0, 0.0, 0.0}, 0.5);
  Mesh flat = whole;
  for (Vec3& v : flat.vertices) v.z = 0.0;
  Mesh first = flat, second = flat;
  first.triangles.resize(flat.triangles.size() / 2);
  second.triangles.erase(second.triangles.begin(), second.triangles.begin() + std::ptrdiff_t(first.triangles.size()));
  EXPECT_EQ(hash_of(tile_of({&first, 1})) + hash_of(tile_of({&second, 1})), hash_of(tile_of({&flat, 1})));
}

TEST(StoreCodec, BringsSourceNumbersBack) {
  clutter::Random random(11);
  for (const int kind : {0, 1, 2, 3}) {
    std::vector<roam::store::SourceNumber> numbers(kind == 0 ? 1 : 3000);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i].part = kind < 2 ? 0x123456789abcdef0U : 77U * (i / 1000);
      numbers[i].number = kind < 3 ? i ^ 5U : UINT64_MAX / (i * i + 1);
    }
    const auto coded = roam::store::encode_numbers(numbers);
    EXPECT_EQ(roam::store::decode_numbers(coded, static_cast<std::uint32_t>(numbers.size())), numbers);
    EXPECT_THROW((void)roam::store::decode_numbers(coded, static_cast<std::uint32_t>(numbers.size()) + 1), roam::Error);
  }
}

}  // namespace
