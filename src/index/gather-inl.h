// Gathering of the contents of a box, for searches that stay in it. Included once per instruction set by traverse.cpp.

#if defined(ROAM_INDEX_GATHER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ROAM_INDEX_GATHER_INL_H_
#undef ROAM_INDEX_GATHER_INL_H_
#else
#define ROAM_INDEX_GATHER_INL_H_
#endif

#include <algorithm>
#include <array>
#include <bit>

#include "index/refit.h"
#include "index/roots.h"
#include "index/search-inl.h"
#include "index/traverse.h"

HWY_BEFORE_NAMESPACE();
namespace roam::index::HWY_NAMESPACE {

class Gathering {
 public:
  Gathering(const Index& index, std::uint32_t owner, const Box& box, Roots& out)
      : index_(index), owner_(owner), from_(box.lower), reach_(box.size(), 0.0, 0.0), out_(out) {}

  bool run() {
    const float margin = round_up(margin_of(index_));
    const Swept swept(Frame(index_.grid.origin, index_.grid.step, from_), reach_, margin);
    std::array<std::uint32_t, open_limit> open{0};
    int count = 1;
    while (count > 0) {
      const Node& node = index_.top[open[--count]].node;
      for (std::uint32_t met = met_children(node, swept); met != 0; met &= met - 1) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(met));
        if (i >= node.inner_count) {
          if (!tile(node.first_leaf + (i - node.inner_count))) return false;
        } else {
          if (count == open_limit) return false;
          open[count++] = node.first_node + i;
        }
      }
    }
    return true;
  }

 private:
  /// A node or a leaf of a tile, and the part of its box inside the query box.
  struct Part {
    StepBox box;
    std::uint32_t number;
    bool leaf;
  };

  /// Capacity for waiting nodes over tiles. A box that meets more is not gathered.
  static constexpr int open_limit = 64;

  bool tile(std::uint32_t number) {
    const Tile& t = index_.tiles[number];
    if (t.absent()) return false;
    const Swept swept(Frame(t.origin, t.step, from_), reach_, t.error);
    const Block* nodes = index_.blocks + t.nodes;
    std::array<Part, node_width> parts;
    int count = 0;
    count = open(nodes[0].node, swept, parts, count);
    // Opens nodes level by level, as long as their children fit into the array.
    for (int at = 0; at < count;) {
      const Part part = parts[at];
      if (part.leaf) {
        ++at;
        continue;
      }
      const Node& node = nodes[part.number].node;
      const int met = std::popcount(met_children(node, swept));
      if (count - 1 + met > node_width) {
        ++at;
        continue;
      }
      std::copy(parts.begin() + at + 1, parts.begin() + count, parts.begin() + at);
      count = open(node, swept, parts, count - 1);
    }
    if (count == 0) return true;
    if (out_.count == Roots::most_roots) return false;
    make(out_.root[out_.count++], number, parts, count);
    return true;
  }

  /// Adds the children of a node that meet the box.
  static int open(const Node& node, const Swept& swept, std::array<Part, node_width>& parts, int count) {
    for (std::uint32_t met = met_children(node, swept); met != 0; met &= met - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(met));
      Part& part = parts[count];
      bool apart = false;
      for (int k = 0; k < 3; ++k) {
        part.box.lower[k] =
            std::max(node.origin[k] + (std::int32_t{node.lower[k][i]} << node.shift[k]), swept.lower[k]);
        part.box.upper[k] =
            std::min(node.origin[k] + (std::int32_t{node.upper[k][i]} << node.shift[k]), swept.upper[k]);
        apart |= part.box.lower[k] > part.box.upper[k];
      }
      if (apart) continue;  // the box's grid is finer than the node's own
      part.leaf = i >= node.inner_count;
      part.number = part.leaf ? node.first_leaf + (i - node.inner_count) : node.first_node + i;
      ++count;
    }
    return count;
  }

  void make(Root& root, std::uint32_t tile, const std::array<Part, node_width>& parts, int count) const {
    std::array<StepBox, node_width> boxes;
    root.tile = tile;
    root.owner = owner_;
    root.node = {};
    root.node.child_count = static_cast<std::uint8_t>(count);
    int at = 0;
    for (const bool leaves : {false, true}) {
      if (leaves) root.node.inner_count = static_cast<std::uint8_t>(at);
      for (int i = 0; i < count; ++i) {
        if (parts[i].leaf != leaves) continue;
        boxes[at] = parts[i].box;
        root.number[at++] = parts[i].number;
      }
    }
    set_boxes(root.node, {boxes.data(), static_cast<std::size_t>(count)});
  }

  const Index& index_;
  std::uint32_t owner_;
  Vec3 from_;
  Reach reach_;
  Roots& out_;
};

}  // namespace roam::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ROAM_INDEX_GATHER_INL_H_
