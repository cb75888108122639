// Common parts of both traversals. Included once per instruction set by traverse.cpp.

#if defined(ROAM_INDEX_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ROAM_INDEX_SEARCH_INL_H_
#undef ROAM_INDEX_SEARCH_INL_H_
#else
#define ROAM_INDEX_SEARCH_INL_H_
#endif

#include <hwy/cache_control.h>

#include <algorithm>
#include <bit>

#include "index/lanes-inl.h"
#include "index/stack.h"
#include "index/traverse.h"

HWY_BEFORE_NAMESPACE();
namespace roam::index::HWY_NAMESPACE {

HWY_INLINE void prefetch(const Block* block) {
  hwy::Prefetch(block);
  hwy::Prefetch(reinterpret_cast<const char*>(block) + 64);
}

/// Prefetches the numbers of a leaf's triangles. The result needs one of them, and would wait for it at the end.
HWY_INLINE void prefetch_ids(const Index& index, const Tile& tile, const Leaf& leaf) {
  if (index.ids != nullptr) hwy::Prefetch(index.ids + tile.ids + leaf.ids);
}

/// Pushes the remaining children of a node. `nodes` and `leaves` are the bases of their numbers.
HWY_INLINE void push_children(const Node& node, const Children& children, const Block* nodes, const Block* leaves,
                              Stack& stack) {
  stack.begin_children();
  for (std::uint32_t left = children.mask; left != 0; left &= left - 1) {
    const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
    const bool leaf = i >= node.inner_count;
    const std::uint32_t number = leaf ? node.first_leaf + (i - node.inner_count) : node.first_node + i;
    if (const Block* base = leaf ? leaves : nodes) prefetch(base + number);
    stack.push(children.key[i], number, leaf);
  }
}

/// The same for a gathered root.
HWY_INLINE void push_children(const Root& root, const Children& children, const Block* nodes, const Block* leaves,
                              Stack& stack) {
  stack.begin_children();
  for (std::uint32_t left = children.mask; left != 0; left &= left - 1) {
    const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
    const bool leaf = i >= root.node.inner_count;
    prefetch((leaf ? leaves : nodes) + root.number[i]);
    stack.push(children.key[i], root.number[i], leaf);
  }
}

/// Visits `e` and then the entries of the stack, nearest first, until they are `beyond` the bound.
template <class Beyond, class VisitEntry>
HWY_INLINE void go_on_from(Stack::Entry e, Stack& stack, const Beyond& beyond, const VisitEntry& visit) {
  for (;; e = stack.pop()) {
    if (!beyond(e.key)) {
      visit(e);
    } else if (stack.ordered()) {
      break;
    }
    if (stack.empty()) break;
  }
}

/// The same for the stack alone.
template <class Beyond, class VisitEntry>
HWY_INLINE void go_on(Stack& stack, const Beyond& beyond, const VisitEntry& visit) {
  if (!stack.empty()) go_on_from(stack.pop(), stack, beyond, visit);
}

/// The same, beginning with the root.
template <class Beyond, class VisitEntry>
HWY_INLINE void search(Stack& stack, const Beyond& beyond, const VisitEntry& visit) {
  stack.clear();
  go_on_from({0.0F, 0, false}, stack, beyond, visit);
}

/// The widest node of a tile and of the tree over tiles, in steps.
constexpr float tile_steps = 0x1p16F;
constexpr float top_steps = 0x1p29F;

/// Metres by which the boxes of tiles matter farther than triangles do.
HWY_INLINE double margin_of(const Index& index) { return index.absent ? index.absent->margin : 0.0; }

/// True if tiles in memory are passed over.
HWY_INLINE bool only_absent(const Index& index) { return index.absent && index.absent->only; }

/// Up to this many tiles may be visited in any order. If tiles may be absent it is 1, so that the last bits of a result
/// do not depend on which tiles behind the first impact are loaded.
HWY_INLINE int few_tiles(const Index& index) { return index.absent ? 1 : few_tile_count; }

/// Prefetches all gathered tiles.
HWY_INLINE void prefetch_tiles(const Index& index, std::span<const Root> roots) {
  for (const Root& root : roots) hwy::Prefetch(index.tiles + root.tile);
}

/// Prefetches the remaining tiles of a node over tiles.
HWY_INLINE void prefetch_tiles(const Index& index, const Node& node, const Children& children) {
  for (std::uint32_t left = children.mask >> node.inner_count; left != 0; left &= left - 1) {
    hwy::Prefetch(index.tiles + node.first_leaf + std::countr_zero(left));
  }
}

/// Prefetches the roots of the next tiles while one tile is visited; otherwise each would be waited for in turn.
HWY_INLINE void prefetch_roots(const Index& index, const Stack& stack) {
  constexpr int levels_ahead = 4;
  for (int i = 0; i < std::min(levels_ahead, stack.size()); ++i) {
    const Stack::Entry next = stack.next(i);
    if (!next.leaf) continue;
    const Tile& t = index.tiles[next.number];
    if (!t.absent()) prefetch(index.blocks + t.nodes);
  }
}

}  // namespace roam::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ROAM_INDEX_SEARCH_INL_H_
