// Pages, part files and manifests of a store, by which its tiles are found.
#include <algorithm>
#include <cstring>

#include "fuzz.h"
#include "index/binary_tree.h"
#include "packed_part.h"
#include "store_files_made.h"

namespace fuzz {
namespace {

using namespace roam::store;

/// Whatever is accepted as a page leads a traversal to each tile once, and nowhere else.
void run_page(Bytes input) {
  const made::AlignedCopy copy(std::as_bytes(input));
  PageView view;
  if (const char* why = view_page(copy.bytes(), made::pack_bytes, view)) {
    demand(*why != '\0', "a page is refused without a reason");
    return;
  }
  std::vector<int> tiles(view.tiles.size());
  struct Open {
    std::uint32_t node;
    int depth;
  };
  std::vector<Open> open{{0, 0}};
  std::size_t visited = 0;
  while (!open.empty()) {
    const auto [number, depth] = open.back();
    open.pop_back();
    demand(number < view.nodes.size() && ++visited <= view.nodes.size(), "a node that is none");
    demand(depth < roam::index::max_depth, "too deep");
    const roam::index::Node& node = view.nodes[number];
    for (std::uint32_t c = 0; c < node.child_count; ++c) {
      if (c < node.inner_count) {
        open.push_back({node.first_node + c, depth + 1});
        continue;
      }
      demand(node.first_leaf + c - node.inner_count < tiles.size(), "a tile that is none");
      ++tiles[node.first_leaf + c - node.inner_count];
    }
  }
  demand(std::all_of(tiles.begin(), tiles.end(), [](int count) { return count == 1; }), "a tile is not reached once");
  for (const TileEntry& t : view.tiles) {
    demand(shape_of(t).bytes() <= tile_bytes && t.offset + t.bytes + t.number_bytes <= made::pack_bytes,
           "a tile out of range");
  }
}

std::vector<std::string> page_seeds() {
  std::vector<std::string> all;
  for (const std::size_t count : {3, 1, 20, 100}) {
    for (const double spread : {100.0, 0.0, 1e8})
      all.push_back(text_of(encode_page(made::some_tiles(count, spread, 7)).bytes));
  }
  return all;
}

/// A part file that is accepted has no more objects and cells than it says, in order.
void check_part(std::span<const std::byte> bytes) {
  (void)complaint([&] {
    const PartFile part = decode_part(bytes, "p");
    std::uint64_t next = 0;
    for (const PartFile::Object& object : part.objects) {
      demand(object.first >= next && object.first < part.triangles, "objects in no order");
      demand(object.name.size() <= longest_part_name, "a name that is too long");
      next = object.first + 1;
    }
    demand(part.cells.size() <= most_cells, "too many cells");
  });
}

/// The first byte says whether the rest is a part file, or its numbers and its content before compression.
void run_part(Bytes input) {
  Values values(input);
  if (values.take<std::uint8_t>() % 2 != 0) return check_part(std::as_bytes(values.rest()));
  const auto triangles = values.take<std::uint32_t>();
  const auto objects = values.take<std::uint16_t>(), cells = values.take<std::uint16_t>();
  constexpr int least_window = 10;
  check_part(packed_parts::packed_part(triangles, objects, cells, std::string(text_of(values.rest())), least_window));
}

std::vector<std::string> part_seeds() {
  const auto unpacked = [](std::uint32_t triangles, std::uint16_t objects, std::uint16_t cells,
                           const std::string& content) {
    std::string input(1, '\0');
    input.append(reinterpret_cast<const char*>(&triangles), sizeof triangles);
    input.append(reinterpret_cast<const char*>(&objects), sizeof objects);
    input.append(reinterpret_cast<const char*>(&cells), sizeof cells);
    return input + content;
  };
  using packed_parts::number;
  return {
      '\1' + text_of(encode_part(made::some_part())),
      unpacked(9, 2, 2,
               number(0) + number(4) + "wall" + number(3) + number(0) + number(5) + number(4) + number(1) + number(5)),
      unpacked(1, 1, 1, number(0) + number(300) + std::string(300, 'n') + number(1) + number(1))};
}

/// An accepted manifest is written to a text that is also accepted and means the same.
void run_manifest(Bytes input) {
  constexpr std::uint64_t memory = 16 << 20;
  std::string text;
  if (complaint([&] { text = to_text(parse_manifest(text_of(input), "m", memory)); }).empty()) {
    const std::string said = complaint([&] { demand(to_text(parse_manifest(text, "m")) == text, "it changes"); });
    demand(said.empty(), "a manifest that is written is refused");
  }
  if (complaint([&] { text = to_text(parse_shard(text_of(input), "s", memory)); }).empty()) {
    const std::string said = complaint([&] { demand(to_text(parse_shard(text, "s")) == text, "it changes"); });
    demand(said.empty(), "a shard that is written is refused");
  }
}

std::vector<std::string> manifest_seeds() {
  return {to_text(made::some_manifest()), to_text(made::some_shard(12)), "{}", "[1e999, null, \"\\ud800\"]"};
}

const Known page_target({"page", run_page, page_seeds, {"ROAMPAGE"}});
const Known part_target({"part", run_part, part_seeds, {"ROAMPART", "\x28\xb5\x2f\xfd"}});
const Known manifest_target({"manifest",
                             run_manifest,
                             manifest_seeds,
                             {"\"format\"", "\"options\"", "\"parts\"", "\"shards\"", "\"pages\"", "\"tiles\"",
                              "\"bytes\"", "\"offset\"", "\"bounds\"", "\"references\"", "\"notes\"", "\"xxh3\"",
                              "null", "-0", "1e308", "18446744073709551615"}});

}  // namespace
}  // namespace fuzz
