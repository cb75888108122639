// Search for everything near a moving or resting body. Included once per instruction set by traverse.cpp.

#if defined(ROAM_INDEX_NEAR_TRAVERSAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ROAM_INDEX_NEAR_TRAVERSAL_INL_H_
#undef ROAM_INDEX_NEAR_TRAVERSAL_INL_H_
#else
#define ROAM_INDEX_NEAR_TRAVERSAL_INL_H_
#endif

#include <limits>

#include "index/leaf-inl.h"
#include "index/search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace roam::index::HWY_NAMESPACE {

/// The nearest of the remaining children; there must be at least one.
HWY_INLINE std::uint32_t nearest_of(const Children& children) {
  auto nearest = static_cast<std::uint32_t>(std::countr_zero(children.mask));
  for (std::uint32_t left = children.mask & (children.mask - 1); left != 0; left &= left - 1) {
    const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
    if (children.key[i] < children.key[nearest]) nearest = i;
  }
  return nearest;
}

/// Drops the children that are `beyond` the bound.
template <class Beyond>
HWY_INLINE void leave_out(Children& children, const Beyond& beyond) {
  for (std::uint32_t left = children.mask; left != 0; left &= left - 1) {
    const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
    if (beyond(children.key[i])) children.mask &= ~(1U << i);
  }
}

/// Visits everything near a body during its motion, nearest boxes first, within a reach that visits may shrink.
/// `Bounds` is Slack for a gap that may lose part of itself, Layer for triangles between two heights, else Tight.
template <class Bounds>
class NearTraversal {
 public:
  // cppcheck-suppress uninitMemberVar ; the stack is cleared before each use
  NearTraversal(const Index& index, const Piece& piece, const Near& near, Visit visit, void* context)
      : index_(index),
        piece_(piece),
        way_(piece.motion, piece.body.half_height),
        near_(near),
        reach_(near.reach),
        visit_(visit),
        context_(context) {}

  double run() {
    const Frame frame(index_.grid.origin, index_.grid.step, piece_.start);
    const double more = margin_of(index_);
    const Around around = around_of(frame, axis_reach(more), more);
    Passed passed;
    Stack stack;
    search(
        stack, [&](float key) { return passed.over(key, axis_reach(more)); },
        [&](const Stack::Entry& e) {
          if (e.leaf) {
            prefetch_roots(index_, stack);
            return tile(e.number);
          }
          Children children;
          const Node& node = look_at(index_.top, e.number, frame, around, margin(top_steps, frame), axis_reach(more),
                                     Bounds::is_loose ? few_tiles(index_) : 0, passed, children);
          push_children(node, children, index_.top, nullptr, stack);
          prefetch_tiles(index_, node, children);
        });
    note(passed, more);
    return left_;
  }

  double run(std::span<const Root> roots) {
    prefetch_tiles(index_, roots);
    // Triangles that were not gathered, or were cut off, are farther.
    left_ = reach_;
    for (const Root& root : roots) tile(root.tile, &root);
    return left_;
  }

 private:
  /// Lower bounds of the distance from the axis for everything out of reach.
  struct Passed {
    VF lanes;
    float entry;

    HWY_INLINE Passed()
        : lanes(set(std::numeric_limits<float>::infinity())), entry(std::numeric_limits<float>::infinity()) {}
    HWY_INLINE bool over(float key, float reach) {
      if (!(key > reach)) return false;
      entry = std::min(entry, key);
      return true;
    }
  };

  /// The box of everything within `reach` of the axis in whole steps; unused where boxes are not tested first.
  struct Around {
    Swept box;
    float reach;
  };
  /// `error`: metres by which stored triangles are grown.
  [[nodiscard]] HWY_INLINE Around around_of(const Frame& frame, float reach, double error) const {
    if (!Bounds::is_boxed || !boxed_) return {Swept(), reach};
    Reach around(piece_.motion, double(reach), piece_.body.half_height);
    if constexpr (!Bounds::is_loose) {
      around.lower[2] = std::max(around.lower[2], -round_up(error - near_.lowest));
      around.upper[2] = std::min(around.upper[2], round_up(error + near_.highest));
    }
    return {Swept(frame, around, 0.0F), reach};
  }

  /// Tests the children of a node. A node with only one inner child around the motion is replaced by that child,
  /// repeatedly. Returns the node that `children` belong to. Distances are not computed if at most `few` children are
  /// around the motion.
  HWY_INLINE const Node& look_at(const Block* nodes, std::uint32_t at, const Frame& frame, const Around& around,
                                 float grown, float reach, int few, Passed& passed, Children& children) const {
    std::uint32_t met = ~0U;
    const Node* node = &nodes[at].node;
    if (Bounds::is_boxed && boxed_) {
      passed.entry = std::min(passed.entry, around.reach);  // the boxes exclude only triangles farther than that
      for (;;) {
        met = met_children(*node, around.box);
        const auto child = static_cast<std::uint32_t>(std::countr_zero(met));
        const int count = std::popcount(met);
        if (count == 1 && child < node->inner_count) {
          node = &nodes[node->first_node + child].node;
          continue;
        }
        if (count > few) break;
        children.take(met);
        return *node;
      }
    }
    near_node(*node, frame, way_, grown, reach, passed.lanes, children);
    children.mask &= met;
    return *node;
  }

  /// Metres from the axis within which stored triangles still matter.
  [[nodiscard]] float axis_reach(double error) const {
    return round_up(std::max(0.0, piece_.body.radius + reach_ + error));
  }
  /// A bound that is too low may be less than half of the distance, and its rounding is that of the distance.
  [[nodiscard]] float margin(float steps, const Frame& frame) const {
    return grown_radius(0.0F, way_.half_height, way_.longest + 2.0F * axis_reach(margin_of(index_)), steps * frame.step,
                        frame.step);
  }
  void note(const Passed& passed, double error) {
    alignas(64) float lanes[lane_count];
    hn::Store(passed.lanes, kF, lanes);
    const float least = std::min(passed.entry, *std::min_element(lanes, lanes + lane_count));
    left_ = std::min(left_, double(least) - piece_.body.radius - error);
  }

  /// Visits the near triangles of a tile, from its root or from a gathered root.
  void tile(std::uint32_t number, const Root* gathered = nullptr) {
    const Tile& t = index_.tiles[number];
    if (t.absent()) {
      reach_ = index_.absent->near(index_.absent->context, number);
      return;
    }
    if (only_absent(index_)) return;
    const Frame frame(t.origin, t.step, piece_.start);
    const Block* nodes = index_.blocks + t.nodes;
    const Block* leaves = index_.blocks + t.leaves;
    // Boxes enclose the vertices without their low bits.
    const auto error = double(t.error), fine_error = double(t.fine_error);
    const FineLeaf* low = fine_leaves(index_, t);
    const Bounds bounds(near_.part, piece_.body.radius, fine_error, near_.reach);
    float reach = axis_reach(error), leaf_reach = axis_reach(fine_error);
    const float grown = margin(tile_steps, frame);
    Passed passed, passed_triangles;
    const auto beyond = [&](float key) { return passed.over(key, reach); };
    const Around around = around_of(frame, reach, error);
    const auto look = [&](std::uint32_t at, Children& children) -> const Node& {
      return look_at(nodes, at, frame, around, grown, reach, Bounds::is_loose ? 1 : 0, passed, children);
    };
    const auto look_at_leaf = [&](std::uint32_t leaf) {
      looked_ = true;
      if constexpr (!Bounds::is_loose) prefetch_ids(index_, t, leaves[leaf].leaf);
      Children triangles;
      alignas(64) float most[node_width];
      near_leaf(leaves[leaf].leaf, low == nullptr ? nullptr : low + leaf, frame, way_, leaf_reach, bounds,
                passed_triangles.lanes, triangles, most);
      while (triangles.mask != 0) {
        const std::uint32_t nearest = nearest_of(triangles);
        if (passed_triangles.over(triangles.key[nearest], leaf_reach)) break;
        triangles.mask &= ~(1U << nearest);
        reach_ = visit_(context_, {number, t.leaves + leaf, nearest}, {triangles.key[nearest], most[nearest]});
        reach = axis_reach(error);
        leaf_reach = axis_reach(fine_error);
      }
    };
    if (gathered != nullptr) {
      begin(*gathered, frame, around, grown, reach, nodes, leaves, passed, beyond, look_at_leaf);
    } else if (Bounds::is_loose && !looked_) {
      dive(nodes, leaves, beyond, look, look_at_leaf);
    } else {
      stack_.start();
    }
    go_on(stack_, beyond, [&](const Stack::Entry& e) {
      if (e.leaf) return look_at_leaf(e.number);
      Children children;
      const Node& node = look(e.number, children);
      push_children(node, children, nodes, leaves, stack_);
    });
    note(passed, error);
    note(passed_triangles, fine_error);
  }

  /// Starts from the gathered root of a tile: tests the nearest child first if it is a leaf, and then pushes the
  /// others.
  template <class Beyond, class LookAtLeaf>
  HWY_INLINE void begin(const Root& root, const Frame& frame, const Around& around, float grown, const float& reach,
                        const Block* nodes, const Block* leaves, Passed& passed, const Beyond& beyond,
                        const LookAtLeaf& look_at_leaf) {
    stack_.clear();
    std::uint32_t met = ~0U;
    if (Bounds::is_boxed && boxed_) {
      passed.entry = std::min(passed.entry, around.reach);
      met = met_children(root.node, around.box);
      if (met == 0) return;
    }
    Children children;
    near_node(root.node, frame, way_, grown, reach, passed.lanes, children);
    children.mask &= met;
    if (children.mask == 0) return;
    const std::uint32_t nearest = nearest_of(children);
    if (Bounds::is_loose && nearest >= root.node.inner_count) {
      children.mask &= ~(1U << nearest);
      look_at_leaf(root.number[nearest]);
      leave_out(children, beyond);
    }
    push_children(root, children, nodes, leaves, stack_);
  }

  /// Starts the search in a tile: descends from its root by the nearest child to a leaf and tests that leaf before
  /// pushing the other children. Most of them then need not be pushed, and keeping them in order takes as long as
  /// testing them. Only for gaps: it may be the wrong leaf, and other visits measure its triangles exactly.
  /// `look(number, children)` tests a node and returns it.
  template <class Beyond, class Look, class LookAtLeaf>
  HWY_INLINE void dive(const Block* nodes, const Block* leaves, const Beyond& beyond, const Look& look,
                       const LookAtLeaf& look_at_leaf) {
    constexpr int stack_levels = 4;
    Children beside[stack_levels];
    const Node* of[stack_levels];
    int depth = 0;
    stack_.clear();
    for (std::uint32_t at = 0;;) {
      Children& children = beside[depth];
      const Node& node = look(at, children);
      of[depth++] = &node;
      if (children.mask == 0) break;
      const std::uint32_t nearest = nearest_of(children);
      if (depth == stack_levels && nearest < node.inner_count) break;  // deeper trees are rare and left to the stack
      children.mask &= ~(1U << nearest);
      if (nearest >= node.inner_count) {
        look_at_leaf(node.first_leaf + (nearest - node.inner_count));
        break;
      }
      at = node.first_node + nearest;
    }
    while (depth > 0) {
      Children& children = beside[--depth];
      leave_out(children, beyond);
      push_children(*of[depth], children, nodes, leaves, stack_);
    }
  }

  const Index& index_;
  const Piece& piece_;
  Way way_;
  const Near& near_;
  double reach_;
  bool boxed_ = way_.longest <= short_motion;  ///< integer boxes are tested first, as in a sweep, if Bounds says so
  double left_ = std::numeric_limits<double>::infinity();
  bool looked_ = false;  ///< a leaf was tested
  Visit visit_;
  void* context_;
  Stack stack_;
};

}  // namespace roam::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ROAM_INDEX_NEAR_TRAVERSAL_INL_H_
