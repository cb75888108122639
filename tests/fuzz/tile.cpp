// Tiles and source numbers of a store: a decoder writes nothing but its tile, and what it accepts is safe to walk.
#include "clutter.h"
#include "fuzz.h"
#include "tiles_made.h"

namespace fuzz {
namespace {

using namespace store_codec;

struct CodedTile {
  TileShape shape;
  std::vector<std::byte> coded;
  Unpacked unpacked;
};

/// A patch of a grid, which has gates, and clutter, which has none.
std::vector<CodedTile> coded_tiles() {
  std::vector<CodedTile> all;
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
      BuiltTile built = tile_of({&mesh, 1}, lossless);
      CodedTile tile{roam::store::shape_of(built), roam::store::encode_tile(built), {}};
      tile.unpacked = unpack(tile.coded);
      all.push_back(std::move(tile));
    }
  }
  return all;
}

/// The first byte chooses the tile and what is edited: its streams behind the compression, or its bytes. Then each
/// three bytes are a place and the number that is added to the byte there. The first eleven places are the numbers
/// before the frame and those of the shape.
void run_tile(Bytes input) {
  static const std::vector<CodedTile> all = coded_tiles();
  static roam::store::TileDecoder decoder;
  static Room room;
  Values values(input);
  const auto choice = values.take<std::uint8_t>();
  const CodedTile& tile = all[choice % all.size()];
  const bool behind = choice / all.size() % 2 == 0;
  TileShape shape = tile.shape;
  Unpacked unpacked = tile.unpacked;
  std::vector<std::byte> coded = tile.coded;
  std::vector<std::byte>& bytes = behind ? unpacked.streams : coded;
  while (!values.empty()) {
    std::size_t place = values.take<std::uint16_t>();
    const auto add = values.take<std::int8_t>();
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
  if (shape.nodes > 4096 || shape.leaves > 4096 || shape.bytes() > roam::store::tile_bytes) {
    demand(decoder.decode(coded, shape, room.tile(tile.shape)) != nullptr, "a shape of no tile is accepted");
    return;
  }
  const std::span<std::byte> out = room.tile(shape);
  const char* why = decoder.decode(coded, shape, out);
  demand(room.kept_inside(shape.bytes()), "the decoder writes beyond its tile");
  if (why != nullptr) return;
  if (const std::string danger = danger_of(out, shape); !danger.empty()) fail("not safe to walk: " + danger);
}

std::vector<std::string> tile_seeds() {
  return {std::string(1, '\0'), {1, 30, 0, 1}, {2, 40, 0, -1, 0, 0, 1}, {3, 9, 0, 1}, {4, 50, 0, 5}, {7, 8, 0, 1}};
}

constexpr std::uint32_t numbered_triangles = 500;

void run_numbers(Bytes input) {
  const std::string said = complaint([&] {
    const auto numbers = roam::store::decode_numbers(std::as_bytes(input), numbered_triangles);
    demand(numbers.size() == numbered_triangles, "numbers of other triangles");
  });
}

std::vector<std::string> numbers_seeds() {
  clutter::Random random(9);
  std::vector<roam::store::SourceNumber> numbers(numbered_triangles);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = {i / 100, random.engine() % 1000};
  std::vector<std::string> all{text_of(roam::store::encode_numbers(numbers))};
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = {7, i};
  all.push_back(text_of(roam::store::encode_numbers(numbers)));
  return all;
}

const Known tile_target({"tile", run_tile, tile_seeds});
const Known numbers_target({"numbers", run_numbers, numbers_seeds});

}  // namespace
}  // namespace fuzz
