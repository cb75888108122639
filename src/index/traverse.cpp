#include "index/traverse.h"

#include <algorithm>
#include <limits>

#include "index/stack.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "index/traverse.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/cache_control.h>

#include "index/leaf-inl.h"

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

/// Visits what is on the stack, beginning with a root, nearest first, as long as it is not `beyond` what matters.
template <class Beyond, class VisitEntry>
HWY_INLINE void search(Stack& stack, const Beyond& beyond, const VisitEntry& visit) {
  stack.start();
  while (!stack.empty()) {
    const Stack::Entry e = stack.pop();
    if (!beyond(e.key)) {
      visit(e);
    } else if (stack.ordered()) {
      break;
    }
  }
}

/// The widest node of a tile and of the tree over tiles, in steps.
constexpr float kTileSteps = 0x1p16F;
constexpr float kTopSteps = 0x1p29F;

/// How much farther than triangles the boxes of tiles matter, metres.
HWY_INLINE double margin_of(const Index& index) { return index.absent ? index.absent->margin : 0.0; }

/// Whether what is in a tile that is in memory is of no interest.
HWY_INLINE bool only_absent(const Index& index) { return index.absent && index.absent->only; }

/// The tiles that are left of a node over tiles.
HWY_INLINE void prefetch_tiles(const Index& index, const Node& node, const Children& children) {
  for (std::uint32_t left = children.mask >> node.inner_count; left != 0; left &= left - 1) {
    hwy::Prefetch(index.tiles + node.first_leaf + std::countr_zero(left));
  }
}

/// The roots of the tiles that come next, all of them while one is visited: their memory would be waited for one after
/// the other.
HWY_INLINE void prefetch_roots(const Index& index, const Stack& stack) {
  constexpr int kAhead = 4;
  for (int i = 0; i < std::min(kAhead, stack.size()); ++i) {
    const Stack::Entry next = stack.next(i);
    if (!next.leaf) continue;
    const Tile& t = index.tiles[next.number];
    if (!t.absent()) prefetch(index.blocks + t.nodes);
  }
}

class SweepTraversal {
 public:
  SweepTraversal(const Index& index, const Piece& piece, double until)
      : index_(index),
        piece_(piece),
        motion_(piece.motion, piece.body.half_height),
        reach_(piece.motion, piece.body.radius, piece.body.half_height) {
    best_.time = until;
    if (until < 1.0) t_max_ = round_up(until);
  }

  Impact run() {
    const Frame frame(index_.grid.origin, index_.grid.step, piece_.start);
    const double radius = piece_.body.radius + margin_of(index_);
    const Swept swept(frame, reach_, round_up(margin_of(index_)));
    const float grown = grown_for(round_up(radius), kTopSteps, frame);
    Stack stack;
    search(
        stack, [this](float key) { return key >= t_max_; },
        [&](const Stack::Entry& e) {
          if (e.leaf) {
            prefetch_roots(index_, stack);
            return tile(e.number);
          }
          const Descent met = descend(index_.top, e.number, frame, swept, grown);
          if (met.single) return tile(met.first);
          push_children(*met.node, met.children, index_.top, nullptr, stack);
          prefetch_tiles(index_, *met.node, met.children);
        });
    return best_;
  }

 private:
  [[nodiscard]] float grown_for(float radius, float steps, const Frame& frame) const {
    return grown_radius(radius, motion_.half_height, motion_.longest, steps * frame.step, frame.step);
  }

  void tile(std::uint32_t number) {
    const Tile& t = index_.tiles[number];
    if (t.absent()) return take(index_.absent->sweep(index_.absent->context, number, best_.time), {number, 0, 0});
    const Frame frame(t.origin, t.step, piece_.start);
    const Swept swept(frame, reach_, t.error);
    const float radius = round_up(piece_.body.radius + double(t.error));
    const float grown = grown_for(radius, kTileSteps, frame);
    // Beyond it, a distance to a stored triangle does not show that the true one is within the limit.
    const bool exact = t.fine || piece_.body.radius > kWideBody;
    const float hit_limit = exact ? -1.0F
                                  : static_cast<float>(piece_.body.radius + double(kHitLimit) - double(t.error)) *
                                        (1.0F - kRadiusRoundings * kUnit);
    const Block* nodes = index_.blocks + t.nodes;
    const Block* leaves = index_.blocks + t.leaves;
    search(
        stack_, [this](float key) { return key >= t_max_; },
        [&](const Stack::Entry& e) {
          std::uint32_t only = e.number;
          if (!e.leaf) {
            const Descent met = descend(nodes, e.number, frame, swept, grown);
            if (!met.single) return push_children(*met.node, met.children, nodes, leaves, stack_);
            only = met.first;
          }
          leaf(number, t, leaves[only].leaf, only, frame, radius, hit_limit, e.key);
        });
  }

  /// What is left below a node: a single leaf, or the children of one node.
  struct Descent {
    bool single;
    std::uint32_t first;  ///< the leaf
    const Node* node;
    Children children;
  };

  /// Visits a node and, without a detour by the stack, the only child of each that has one: a visit is latency. Boxes
  /// in whole numbers settle most visits at a third of the price; times of entry matter only where there is a choice.
  HWY_INLINE Descent descend(const Block* nodes, std::uint32_t number, const Frame& frame, const Swept& swept,
                             float grown) {
    Descent out;
    for (;;) {
      const Node& node = nodes[number].node;
      out.single = false;
      out.node = &node;
      if (!short_) {
        sweep_node(node, frame, motion_, grown, t_max_, out.children);
        return out;
      }
      out.children.mask = met_children(node, swept);
      if (out.children.mask == 0) return out;
      const auto child = static_cast<std::uint32_t>(std::countr_zero(out.children.mask));
      if ((out.children.mask & (out.children.mask - 1)) == 0) {
        if (child < node.inner_count) {
          number = node.first_node + child;
          continue;
        }
        out.single = true;
        out.first = node.first_leaf + (child - node.inner_count);
        return out;
      }
      const std::uint32_t met = out.children.mask;
      sweep_node(node, frame, motion_, grown, t_max_, out.children);
      out.children.mask &= met;
      return out;
    }
  }

  void leaf(std::uint32_t tile_number, const Tile& t, const Leaf& leaf, std::uint32_t number, const Frame& frame,
            float radius, float hit_limit, float entry) {
    Met met;
    sweep_leaf(leaf, frame, motion_, radius, hit_limit, entry, t_max_, met);
    for (std::uint32_t left = met.arrived; left != 0; left &= left - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
      take(double(met.time[i]), {tile_number, t.leaves + number, i});
    }
    for (std::uint32_t left = met.open; left != 0; left &= left - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
      if (double(met.time[i]) >= best_.time) continue;
      decide(t, {tile_number, t.leaves + number, i}, double(met.time[i]));
    }
  }

  void decide(const Tile& t, const Place& place, double from) {
    Body body = piece_.body;
    body.radius += double(t.fine_error);
    const auto triangle = local_triangle(index_, place, piece_.start);
    const SweepResult s = certified::sweep(body, piece_.motion, triangle, from, best_.time, kArrivalExact);
    if (s.hit) take(s.time, place);
  }

  void take(double time, const Place& place) {
    if (time >= best_.time) return;
    best_ = {true, time, place};
    t_max_ = round_up(time);
  }

  /// Metres. What double precision calls arrived: of no consequence beside the grid, small beside 1e-5 m.
  static constexpr double kArrivalExact = 1e-6;

  const Index& index_;
  const Piece& piece_;
  Motion motion_;
  Reach reach_;
  bool short_ = motion_.longest <= kShortMotion;
  Impact best_;
  float t_max_ = 1.0F;
  Stack stack_;
};

Impact FirstImpact(const Index& index, const Piece& piece, double until) {
  return SweepTraversal(index, piece, until).run();
}

/// Everything that a body comes near to on its way, nearest boxes first, within a reach that visits may shrink.
class NearTraversal {
 public:
  NearTraversal(const Index& index, const Piece& piece, double reach, double part, Visit visit, void* context)
      : index_(index),
        piece_(piece),
        way_(piece.motion, piece.body.half_height),
        asked_(reach),
        reach_(reach),
        part_(part),
        visit_(visit),
        context_(context) {}

  double run() {
    const Frame frame(index_.grid.origin, index_.grid.step, piece_.start);
    const double more = margin_of(index_);
    Passed passed;
    Stack stack;
    search(
        stack, [&](float key) { return passed.over(key, axis_reach(more)); },
        [&](const Stack::Entry& e) {
          if (e.leaf) {
            prefetch_roots(index_, stack);
            return tile(e.number);
          }
          const Node& node = index_.top[e.number].node;
          Children children;
          near_node(node, frame, way_, margin(kTopSteps, frame), axis_reach(more), passed.lanes, children);
          push_children(node, children, index_.top, nullptr, stack);
          prefetch_tiles(index_, node, children);
        });
    note(passed, more);
    return left_;
  }

 private:
  /// What was out of reach: how far from the axis at least.
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

  /// How far from the axis stored triangles matter still.
  [[nodiscard]] float axis_reach(double error) const {
    return round_up(std::max(0.0, piece_.body.radius + reach_ + error));
  }
  /// A bound that is too low may say less than half of a distance, and is rounded as that is.
  [[nodiscard]] float margin(float steps, const Frame& frame) const {
    return grown_radius(0.0F, way_.half_height, way_.longest + 2.0F * axis_reach(margin_of(index_)), steps * frame.step,
                        frame.step);
  }
  void note(const Passed& passed, double error) {
    alignas(64) float lanes[kLanes];
    hn::Store(passed.lanes, kF, lanes);
    const float least = std::min(passed.entry, *std::min_element(lanes, lanes + kLanes));
    left_ = std::min(left_, double(least) - piece_.body.radius - error);
  }

  void tile(std::uint32_t number) {
    const Tile& t = index_.tiles[number];
    if (t.absent()) {
      reach_ = index_.absent->near(index_.absent->context, number);
      return;
    }
    if (only_absent(index_)) return;
    const Frame frame(t.origin, t.step, piece_.start);
    const Block* nodes = index_.blocks + t.nodes;
    const Block* leaves = index_.blocks + t.leaves;
    const auto error = double(t.error);
    const Slack slack(part_, piece_.body.radius, error, asked_);
    float reach = axis_reach(error);
    const float grown = margin(kTileSteps, frame);
    Passed passed;
    search(
        stack_, [&](float key) { return passed.over(key, reach); },
        [&](const Stack::Entry& e) {
          Children children;
          if (!e.leaf) {
            const Node& node = nodes[e.number].node;
            near_node(node, frame, way_, grown, reach, passed.lanes, children);
            push_children(node, children, nodes, leaves, stack_);
            return;
          }
          alignas(64) float most[kWidth];
          near_leaf(leaves[e.number].leaf, frame, way_, reach, slack, passed.lanes, children, most);
          while (children.mask != 0) {
            auto nearest = static_cast<std::uint32_t>(std::countr_zero(children.mask));
            for (std::uint32_t left = children.mask; left != 0; left &= left - 1) {
              const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
              if (children.key[i] < children.key[nearest]) nearest = i;
            }
            if (passed.over(children.key[nearest], reach)) break;
            children.mask &= ~(1U << nearest);
            reach_ = visit_(context_, {number, t.leaves + e.number, nearest}, {children.key[nearest], most[nearest]});
            reach = axis_reach(error);
          }
        });
    note(passed, error);
  }

  const Index& index_;
  const Piece& piece_;
  Way way_;
  double asked_, reach_;
  double part_;
  double left_ = std::numeric_limits<double>::infinity();
  Visit visit_;
  void* context_;
  Stack stack_;
};

double VisitNear(const Index& index, const Piece& piece, double reach, double part, Visit visit, void* context) {
  return NearTraversal(index, piece, reach, part, visit, context).run();
}

}  // namespace roam::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace roam::index {

HWY_EXPORT(FirstImpact);
HWY_EXPORT(VisitNear);

Impact first_impact(const Index& index, const Piece& piece, double until) {
  return HWY_DYNAMIC_DISPATCH(FirstImpact)(index, piece, until);
}

double visit_near(const Index& index, const Piece& piece, double reach, double part, Visit visit, void* context) {
  return HWY_DYNAMIC_DISPATCH(VisitNear)(index, piece, reach, part, visit, context);
}

}  // namespace roam::index
#endif  // HWY_ONCE
