// The size of a store's tiles on disk, and the times to encode and decode them.

#include <xxhash.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cli/values.h"
#include "program.h"
#include "roam/error.h"
#include "scene.h"
#include "store/codec/streams.h"
#include "thread_clock.h"
#include "tiles_made.h"
#include "timing.h"

namespace {

using namespace store_codec;
using roam::store::shape_of;

/// Seconds.
double now() { return 1e-9 * roam::bench::thread_time(); }

/// Bytes that an ideal coder takes for letters of these frequencies.
double entropy(std::span<const std::byte> letters) {
  std::array<double, 256> count{};
  for (const std::byte b : letters) ++count[std::to_integer<std::size_t>(b)];
  double bits = 0.0;
  for (const double c : count) bits += c > 0.0 ? c * std::log2(double(letters.size()) / c) : 0.0;
  return bits / 8.0;
}

constexpr std::array<const char*, roam::store::stream_count> name_stream{
    "tree",   "counts", "gates",  "seeds",  "names",     "gate x",    "gate y",
    "gate z", "free x", "free y", "free z", "name bits", "gate bits", "free bits"};

using Streams = std::array<double, roam::store::stream_count>;

/// Adds the entropy of each stream of a tile, by the letters' frequencies in that tile. Bits count as incompressible.
void add_entropy(std::span<const std::byte> coded, const TileShape& shape, Streams& sum) {
  const Unpacked u = unpack(coded);
  const auto& n = u.numbers;
  const std::array<std::size_t, roam::store::stream_count> sizes{
      shape.nodes, shape.leaves, n[0], n[1], n[2], n[3], n[3], n[3], n[4], n[4], n[4], n[5], n[6], n[7]};
  const std::byte* at = u.streams.data();
  for (int s = 0; s < roam::store::stream_count; ++s) {
    sum[s] += s >= roam::store::name_bit_stream ? double(sizes[s]) : entropy({at, sizes[s]});
    at += sizes[s];
  }
}

/// The numbers of a tile's triangles in the scene, in the order of the tile.
std::vector<roam::store::SourceNumber> numbers_of(const BuiltTile& tile) {
  std::vector<roam::store::SourceNumber> numbers;
  for (const Leaf& leaf : tile.leaves) {
    for (int t = 0; t < leaf.triangle_count; ++t) {
      numbers.push_back({1, roam::index::read_id(tile.ids.data(), leaf, t)});
    }
  }
  return numbers;
}

struct Options {
  roam::bench::SceneChoice scene;
  bool lossless = false;
  bool streams = false;
  int rounds = 15;
};

int run(const Options& options) {
  const roam::bench::Scene scene = make_scene(options.scene);
  std::printf("%s%s\n", scene.name.c_str(), options.lossless ? ", lossless" : "");
  std::vector<BuiltTile> tiles = tiles_of(scene.meshes, options.lossless);
  const std::size_t all = tiles.size();
  std::erase_if(tiles, [](const BuiltTile& t) { return shape_of(t).bytes() > roam::store::tile_bytes; });
  double triangles = 0.0, disk = 0.0, resident = 0.0, number_bytes = 0.0;
  std::vector<std::vector<std::byte>> coded;
  const double encode_begin = now();
  for (BuiltTile& t : tiles) coded.push_back(roam::store::encode_tile(t));
  const double encode = now() - encode_begin;
  Streams floor{};
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    triangles += double(shape_of(tiles[i]).triangles);
    disk += double(coded[i].size());
    resident += double(shape_of(tiles[i]).bytes());
    number_bytes += double(roam::store::encode_numbers(numbers_of(tiles[i])).size());
    add_entropy(coded[i], shape_of(tiles[i]), floor);
  }
  double floor_bytes = 0.0;
  for (const double f : floor) floor_bytes += f;

  roam::store::TileDecoder decoder;
  Room room;
  std::vector<double> best(tiles.size(), 1e9);
  double hash = 1e9;
  std::uint64_t sum = 0;
  for (int round = 0; round < options.rounds; ++round) {
    double hashing = 0.0;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      const TileShape shape = shape_of(tiles[i]);
      const std::span<std::byte> out = room.tile(shape);
      const double begin = now();
      const std::uint64_t checksum = XXH3_64bits(coded[i].data(), coded[i].size());
      const char* why = decoder.decode(coded[i], shape, out);
      best[i] = std::min(best[i], now() - begin);
      sum += checksum;
      if (why != nullptr || std::memcmp(out.data(), memory_of(tiles[i]).data(), shape.bytes()) != 0) {
        throw roam::Error("a tile is not what it was: " + std::string(why != nullptr ? why : "other bits"));
      }
      const double hash_begin = now();
      sum += roam::store::geometry_hash(tiles[i].tile, tiles[i].leaves, tiles[i].fine_leaves);
      hashing += now() - hash_begin;
    }
    hash = std::min(hash, hashing);
  }
  double decode = 0.0;
  for (const double b : best) decode += b;
  std::sort(best.begin(), best.end());
  std::printf("%zu tiles (%zu more are too large for a store), %.0f triangles a tile\n", tiles.size(),
              all - tiles.size(), triangles / double(tiles.size()));
  std::printf("disk %.3f bytes a triangle, floor %.3f, ratio %.2f; source numbers %.3f; resident %.2f\n",
              disk / triangles, floor_bytes / triangles, disk / floor_bytes, number_bytes / triangles,
              resident / triangles);
  const auto at = [&](double part) { return 1e6 * roam::bench::quantile(best, part); };
  std::printf("encode %.0f ns a triangle, hash %.1f, decode %.1f; a tile: p50 %.0f us, p99 %.0f, most %.0f\n",
              1e9 * encode / triangles, 1e9 * hash / triangles, 1e9 * decode / triangles, at(0.5), at(0.99), at(1.0));
  if (sum == 0) std::printf("the hashes sum up to nothing\n");  // so that no compiler leaves them out
  if (options.streams) {
    for (int s = 0; s < roam::store::stream_count; ++s)
      std::printf("  %-9s %.4f\n", name_stream[s], floor[s] / triangles);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app{"Times encoding and decoding of a store's tiles, and prints their size on disk"};
  app.add_option("--scene", options.scene.scene, "gallery, terrain, city, or a file")->capture_default_str();
  roam::app::add_triangles(app, "--triangles", options.scene.triangles, "triangles of a made scene");
  app.add_option("--rounds", options.rounds, "repetitions; the least time of a tile counts")
      ->capture_default_str()
      ->check(roam::app::at_least_one());
  app.add_flag("--lossless", options.lossless, "tiles that keep the source's floats");
  app.add_flag("--streams", options.streams, "print the entropy of each stream, bytes a triangle");
  return roam::bench::run_program(app, argc, argv, [&] { return run(options); });
}
