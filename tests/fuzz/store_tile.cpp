// Feeds TileDecoder with tiles whose streams, shape and compression are edited. With clang:
//   cmake -B build-fuzz -DCMAKE_CXX_COMPILER=clang++ -DROAM_FUZZ=ON && cmake --build build-fuzz --target
//   fuzz_store_tile build-fuzz/fuzz_store_tile -max_len=512 -max_total_time=600

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "clutter.h"
#include "tiles_made.h"

namespace {

using namespace store_codec;

struct Sample {
  TileShape shape;
  std::vector<std::byte> coded;
  Unpacked unpacked;
};

/// A patch of a grid, which has gates, and clutter, which has none.
std::vector<Sample> samples() {
  std::vector<Sample> all;
  clutter::Random random(1);
  roam::Mesh patch;
  for (int i = 0; i < 81; ++i) patch.vertices.push_back(roam::Vec3(i % 9, i / 9, random.unit()));
  for (std::uint32_t i = 0; i < 72; ++i) {
    if (i % 9 == 8) continue;
    patch.triangles.push_back({i, i + 1, i + 9});
    patch.triangles.push_back({i + 1, i + 10, i + 9});
  }
  const roam::Mesh soup = clutter::make(random, {60, 5.0, 0.05, 3.0, roam::Vec3(0.0)});
  for (const roam::Mesh& mesh : {patch, soup}) {
    for (const bool lossless : {false, true}) {
      BuiltTile tile = tile_of({&mesh, 1}, lossless);
      Sample s{roam::store::shape_of(tile), roam::store::encode_tile(tile), {}};
      s.unpacked = unpack(s.coded);
      all.push_back(std::move(s));
    }
  }
  return all;
}

}  // namespace

/// The first byte chooses the sample and what is edited; then each three bytes are a place and what is added to the
/// byte there. The first eleven places are the numbers before the frame and those of the shape.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<Sample> all = samples();
  static roam::store::TileDecoder decoder;
  static Room room;
  if (size < 1) return 0;
  const Sample& sample = all[data[0] % all.size()];
  const bool behind = data[0] / all.size() % 2 == 0;  // the compression
  TileShape shape = sample.shape;
  Unpacked unpacked = sample.unpacked;
  std::vector<std::byte> coded = sample.coded;
  std::vector<std::byte>& bytes = behind ? unpacked.streams : coded;
  for (std::size_t i = 1; i + 2 < size; i += 3) {
    std::size_t place = data[i] | std::size_t{data[i + 1]} << 8;
    const auto add = static_cast<std::int8_t>(data[i + 2]);
    if (place < unpacked.numbers.size()) {
      unpacked.numbers[place] = (unpacked.numbers[place] + static_cast<std::uint64_t>(std::int64_t{add})) & 0xfffffffU;
    } else if (place < 11) {
      (place == 8 ? shape.triangles : place == 9 ? shape.nodes : shape.leaves) += static_cast<std::uint32_t>(add);
    } else {
      place = (place - 11) % bytes.size();
      bytes[place] = std::byte(std::to_integer<unsigned>(bytes[place]) + static_cast<unsigned>(add));
    }
  }
  if (behind) coded = pack(unpacked);
  if (shape.nodes > 4096 || shape.leaves > 4096 || shape.bytes() > roam::store::tile_bytes) return 0;
  const std::span<std::byte> out = room.tile(shape);
  const char* why = decoder.decode(coded, shape, out);
  if (!room.kept_inside(shape.bytes())) std::abort();
  if (why == nullptr) {
    if (const std::string danger = danger_of(out, shape); !danger.empty()) {
      std::fprintf(stderr, "not safe to walk: %s\n", danger.c_str());
      std::abort();
    }
  }
  return 0;
}
