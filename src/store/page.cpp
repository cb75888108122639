#include "store/page.h"

#include <array>
#include <bitset>
#include <cmath>
#include <cstring>

#include "index/binary_tree.h"
#include "index/collapse.h"
#include "index/partition.h"
#include "roam/mesh.h"

namespace roam::store {
namespace {

using index::Node;
using index::StepBox;

struct PageHeader {
  char magic[8];
  std::uint32_t tiles;
  std::uint32_t nodes;
  double origin[3];
  double step;
  std::uint64_t zero[10];
};
static_assert(sizeof(PageHeader) == 128);
constexpr char page_magic[8] = {'R', 'O', 'A', 'M', 'P', 'A', 'G', 'E'};

/// Metres. Boxes also hold stored triangles, which may lie slightly beyond the limit for source coordinates.
constexpr double farthest_off = coordinate_limit * 1.001;

bool finite(const double (&v)[3]) {
  return std::abs(v[0]) <= farthest_off && std::abs(v[1]) <= farthest_off && std::abs(v[2]) <= farthest_off;
}

const char* check_entry(const TileEntry& t, std::uint64_t pack_bytes) {
  if (!finite(t.origin) || !finite(t.lower) || !finite(t.upper) || box_of(t).empty()) return "a tile's box is none";
  int exponent = 0;
  if (!(t.step >= 0x1p-19F && t.step <= 0x1p20F) || std::frexp(t.step, &exponent) != 0.5F) {
    return "a tile's step is no power of two in range";
  }
  if (!(t.error >= 0.0F && t.error <= t.step + 1e-5F) || !(t.fine_error >= 0.0F && t.fine_error <= t.error)) {
    return "a tile's error is out of range";
  }
  if (t.fine == 1 && !(double(t.fine_error) <= t.step * (1.0 / double(index::fine_steps)) + 1e-6)) {
    return "a tile's error is out of range";
  }
  if (t.triangles < 1 || t.triangles > index::most_tile_triangles || t.nodes < 1 || t.leaves < 1 ||
      t.nodes > t.leaves || t.leaves > t.triangles || t.fine > 1 || t.zero != 0 || shape_of(t).bytes() > tile_bytes) {
    return "a tile's counts are out of range";
  }
  if (t.bytes > tile_bytes || t.number_bytes > most_number_bytes(t.triangles)) {
    return "a tile has more bytes than a tile may have";
  }
  if (t.bytes < 1 || t.offset > pack_bytes || std::uint64_t{t.bytes} + t.number_bytes > pack_bytes - t.offset) {
    return "a tile lies outside its pack";
  }
  return nullptr;
}

StepBox child_box(const Node& node, int i) {
  StepBox box;
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = node.origin[k] + (std::int32_t{node.lower[k][i]} << node.shift[k]);
    box.upper[k] = node.origin[k] + (std::int32_t{node.upper[k][i]} << node.shift[k]);
  }
  return box;
}

bool holds(const StepBox& outer, const StepBox& inner) {
  for (int k = 0; k < 3; ++k) {
    if (inner.lower[k] < outer.lower[k] || inner.upper[k] > outer.upper[k]) return false;
  }
  return true;
}

/// Checks that children come after their parents, that each node and each tile has one parent, and that each box lies
/// in its parent's.
const char* check_tree(const PageView& view) {
  const std::size_t count = view.nodes.size();
  std::array<std::uint8_t, page_tiles> depth{};
  std::bitset<page_tiles> nodes, tiles;
  nodes.set(0);
  for (std::size_t i = 0; i < count; ++i) {
    const Node& node = view.nodes[i];
    if (node.child_count < 1 || node.child_count > index::node_width || node.inner_count > node.child_count) {
      return "a node's counts are out of range";
    }
    for (const std::uint8_t byte : node.unused) {
      if (byte != 0) return "there is something where nothing should be";
    }
    const std::size_t inner = node.inner_count, leaves = node.child_count - inner;
    if (leaves > view.tiles.size() || inner > count) return "a node has too many children";
    if (inner > 0 && (node.first_node <= i || node.first_node > count - inner)) return "a node's children are no nodes";
    if (leaves > 0 && node.first_leaf > view.tiles.size() - leaves) return "a node's children are no tiles";
    if (inner > 0 && depth[i] >= index::max_depth - 1) return "the tree is too deep";
    for (std::size_t c = 0; c < inner; ++c) {
      const std::size_t child = node.first_node + c;
      if (nodes.test(child)) return "a node has two parents";
      nodes.set(child);
      depth[child] = static_cast<std::uint8_t>(depth[i] + 1);
    }
    for (std::size_t c = 0; c < leaves; ++c) {
      if (tiles.test(node.first_leaf + c)) return "a tile has two parents";
      tiles.set(node.first_leaf + c);
    }
    for (int k = 0; k < 3; ++k) {
      // The grid has 2^29 steps; 255 of them, shifted, still fit.
      if (node.shift[k] > 22 || node.origin[k] < 0 || node.origin[k] > (1 << 29)) return "a node's box is out of range";
    }
  }
  if (nodes.count() != count || tiles.count() != view.tiles.size()) return "a node or a tile has no parent";
  std::array<StepBox, page_tiles> all;  // for each node, the box of the tiles below it
  for (std::size_t i = count; i-- > 0;) {
    const Node& node = view.nodes[i];
    for (std::uint32_t c = 0; c < node.child_count; ++c) {
      const bool inner = c < node.inner_count;
      const StepBox box = inner ? all[node.first_node + c]
                                : view.grid.steps(box_of(view.tiles[node.first_leaf + (c - node.inner_count)]));
      if (!holds(child_box(node, static_cast<int>(c)), box)) return "a tile lies outside a node that holds it";
      all[i].include(box);
    }
  }
  return nullptr;
}

}  // namespace

EncodedPage encode_page(std::span<const TileEntry> tiles) {
  Box all;
  for (const TileEntry& t : tiles) all.include(box_of(t));
  const index::Grid grid = index::Grid::over(all);
  std::vector<StepBox> boxes;
  boxes.reserve(tiles.size());
  for (const TileEntry& t : tiles) boxes.push_back(grid.steps(box_of(t)));
  index::WideTree wide = index::tree_over(boxes);

  EncodedPage page;
  PageHeader header{};
  std::memcpy(header.magic, page_magic, sizeof page_magic);
  header.tiles = static_cast<std::uint32_t>(tiles.size());
  header.nodes = static_cast<std::uint32_t>(wide.nodes.size());
  for (int k = 0; k < 3; ++k) header.origin[k] = grid.origin[k];
  header.step = grid.step;
  page.bytes.resize(sizeof header + wide.nodes.size() * sizeof(Node) + tiles.size() * sizeof(TileEntry));
  std::byte* at = page.bytes.data();
  const auto put = [&](const void* data, std::size_t bytes) {
    std::memcpy(at, data, bytes);
    at += bytes;
  };
  put(&header, sizeof header);
  put(wide.nodes.data(), wide.nodes.size() * sizeof(Node));
  for (const std::uint32_t tile : wide.leaves) put(&tiles[tile], sizeof(TileEntry));
  page.order = std::move(wide.leaves);
  return page;
}

const char* view_page(std::span<const std::byte> bytes, std::uint64_t pack_bytes, PageView& view) {
  PageHeader header{};
  if (bytes.size() < sizeof header) return "too short for a page";
  std::memcpy(&header, bytes.data(), sizeof header);
  if (std::memcmp(header.magic, page_magic, sizeof page_magic) != 0) return "not a page of an index";
  if (header.tiles < 1 || header.tiles > page_tiles || header.nodes < 1 || header.nodes > header.tiles) {
    return "its counts are out of range";
  }
  if (bytes.size() != sizeof header + header.nodes * sizeof(Node) + header.tiles * sizeof(TileEntry)) {
    return "its size is not that of its counts";
  }
  for (const std::uint64_t word : header.zero) {
    if (word != 0) return "there is something where nothing should be";
  }
  if (!finite(header.origin) || !(header.step >= 0x1p-29 && header.step <= 0x1p10)) return "its grid is out of range";
  const auto* nodes = bytes.data() + sizeof header;
  const auto* tiles = nodes + header.nodes * sizeof(Node);
  view.grid.origin = {header.origin[0], header.origin[1], header.origin[2]};
  view.grid.step = header.step;
  view.nodes = {reinterpret_cast<const Node*>(nodes), header.nodes};
  view.tiles = {reinterpret_cast<const TileEntry*>(tiles), header.tiles};
  Box all;
  for (const TileEntry& t : view.tiles) {
    if (const char* problem = check_entry(t, pack_bytes)) return problem;
    all.include(box_of(t));
  }
  // Only the grid of these very boxes is accepted: then all steps fit their integers.
  const index::Grid grid = index::Grid::over(all);
  if (grid.origin != view.grid.origin || grid.step != view.grid.step) return "its grid is not that of its tiles";
  return check_tree(view);
}

}  // namespace roam::store
