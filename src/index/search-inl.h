// What both ways through the tree have in common. Included once per instruction set by traverse.cpp.

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

/// Pushes the children that are left of a node. `nodes` and `leaves` are what their numbers count from.
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

/// The same of a root that was gathered.
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

/// Visits `e` and then what is on the stack, nearest first, as long as it is not `beyond` what matters.
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

/// The same, of the stack alone.
template <class Beyond, class VisitEntry>
HWY_INLINE void go_on(Stack& stack, const Beyond& beyond, const VisitEntry& visit) {
  if (!stack.empty()) go_on_from(stack.pop(), stack, beyond, visit);
}

/// The same, beginning with a root.
template <class Beyond, class VisitEntry>
HWY_INLINE void search(Stack& stack, const Beyond& beyond, const VisitEntry& visit) {
  stack.clear();
  go_on_from({0.0F, 0, false}, stack, beyond, visit);
}

/// The widest node of a tile and of the tree over tiles, in steps.
constexpr float tile_steps = 0x1p16F;
constexpr float top_steps = 0x1p29F;

/// How much farther than triangles the boxes of tiles matter, metres.
HWY_INLINE double margin_of(const Index& index) { return index.absent ? index.absent->margin : 0.0; }

/// Whether what is in a tile that is in memory is of no interest.
HWY_INLINE bool only_absent(const Index& index) { return index.absent && index.absent->only; }

/// So many tiles may be visited in any order. Where tiles come and go, only one: behind what is met first it should not
/// show in the last bits which have come.
HWY_INLINE int few_tiles(const Index& index) { return index.absent ? 1 : few_tile_count; }

/// All tiles of which something was gathered.
HWY_INLINE void prefetch_tiles(const Index& index, std::span<const Root> roots) {
  for (const Root& root : roots) hwy::Prefetch(index.tiles + root.tile);
}

/// The tiles that are left of a node over tiles.
HWY_INLINE void prefetch_tiles(const Index& index, const Node& node, const Children& children) {
  for (std::uint32_t left = children.mask >> node.inner_count; left != 0; left &= left - 1) {
    hwy::Prefetch(index.tiles + node.first_leaf + std::countr_zero(left));
  }
}

/// The roots of the tiles that come next, all of them while one is visited: their memory would be waited for one after
/// the other.
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
