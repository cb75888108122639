// Search for the first impact of a moving body. Included once per instruction set by traverse.cpp.

#if defined(ROAM_INDEX_SWEEP_TRAVERSAL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ROAM_INDEX_SWEEP_TRAVERSAL_INL_H_
#undef ROAM_INDEX_SWEEP_TRAVERSAL_INL_H_
#else
#define ROAM_INDEX_SWEEP_TRAVERSAL_INL_H_
#endif

#include <type_traits>

#include "index/leaf-inl.h"
#include "index/ray-inl.h"
#include "index/search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace roam::index::HWY_NAMESPACE {

/// `Line`: Ray if the body is hardly more than a point, else NoRay. `skips`: whether the index skips triangles.
template <class Line, bool skips = false>
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
    const Swept swept = swept_in(frame, round_up(margin_of(index_)));
    const InFrame in_frame(frame, motion_, line_, grown_for(round_up(radius), top_steps, frame));
    Stack stack;
    search(
        stack, [this](float key) { return key >= t_max_; },
        [&](const Stack::Entry& e) {
          if (e.leaf) {
            prefetch_roots(index_, stack);
            return tile(e.number);
          }
          const Descent met = descend(index_.top, e.number, in_frame, swept, few_tiles(index_));
          if (met.single) return tile(met.first);
          push_children(*met.node, met.children, index_.top, nullptr, stack);
          prefetch_tiles(index_, *met.node, met.children);
        });
    return best_;
  }

  Impact run(std::span<const Root> roots) {
    prefetch_tiles(index_, roots);
    for (const Root& root : roots) tile(root.tile, &root);
    return best_;
  }

 private:
  /// The line in a frame, as node tests need it.
  using InFrame = std::conditional_t<Line::is_ray, RayFrame, NoRayFrame>;

  [[nodiscard]] float grown_for(float radius, float steps, const Frame& frame) const {
    return grown_radius(radius, motion_.half_height, motion_.longest, steps * frame.step, frame.step);
  }

  /// The box of a short motion, `more` metres wider. Longer motions do without.
  [[nodiscard]] HWY_INLINE Swept swept_in(const Frame& frame, float more) const {
    return short_ ? Swept(frame, reach_, more) : Swept();
  }

  /// Searches a tile for the first impact, from its root or from a gathered root.
  void tile(std::uint32_t number, const Root* gathered = nullptr) {
    const Tile& t = index_.tiles[number];
    if (t.absent()) return take(index_.absent->sweep(index_.absent->context, number, best_.time), {number, 0, 0});
    Inside in(t, number, index_, piece_);
    const Swept swept = swept_in(in.frame, t.error);
    // Boxes enclose the vertices without their low bits.
    const InFrame in_frame(in.frame, motion_, line_,
                           grown_for(round_up(piece_.body.radius + double(t.error)), tile_steps, in.frame));
    const Block* nodes = index_.blocks + t.nodes;
    const auto beyond = [this](float key) { return key >= t_max_; };
    const auto visit = [&](const Stack::Entry& e) {
      std::uint32_t only = e.number;
      if (!e.leaf) {
        const Descent met = descend(nodes, e.number, in_frame, swept, 1);
        if (!met.single) return push_children(*met.node, met.children, nodes, in.leaves, stack_);
        only = met.first;
      }
      leaf(in, only, e.key);
    };
    if (gathered == nullptr) return search(stack_, beyond, visit);
    begin(*gathered, in_frame, swept, nodes, in.leaves);
    go_on(stack_, beyond, visit);
  }

  /// A tile as its leaves need it.
  struct Inside {
    const Tile& tile;
    std::uint32_t number;
    const Block* leaves;
    const FineLeaf* low;
    Frame frame;
    float radius, hit_limit;  ///< see sweep_leaf()
    bool entered = false;     ///< by a ray: Ray::enter() has been called

    HWY_INLINE Inside(const Tile& t, std::uint32_t n, const Index& index, const Piece& piece)
        : tile(t),
          number(n),
          leaves(index.blocks + t.leaves),
          low(fine_leaves(index, t)),
          frame(t.origin, t.step, piece.start),
          radius(round_up(piece.body.radius + double(t.fine_error))),
          hit_limit(-1.0F) {
      // Beyond it, a distance to a stored triangle does not prove that the true distance is within the limit.
      if (piece.body.radius > wide_body) return;
      const bool precise = low != nullptr && t.fine_error < 0.5F * fine_hit_distance;
      const auto limit = double(precise ? fine_hit_distance : hit_limit_distance);
      hit_limit =
          static_cast<float>(piece.body.radius + limit - double(t.fine_error)) * (1.0F - radius_roundings * float_unit);
    }
  };

  /// Starts from the gathered root of a tile.
  HWY_INLINE void begin(const Root& root, const InFrame& in_frame, const Swept& swept, const Block* nodes,
                        const Block* leaves) {
    Children children;
    const std::uint32_t met = met_children(root.node, swept);
    if ((met & (met - 1)) == 0) {
      children.take(met);
    } else {
      choose(root.node, in_frame, met, children);
    }
    stack_.clear();
    push_children(root, children, nodes, leaves, stack_);
  }

  /// Selects among the children `met`, and computes times.
  HWY_INLINE void choose(const Node& node, const InFrame& in_frame, std::uint32_t met, Children& out) const {
    if constexpr (Line::is_ray) {
      ray_node(node, in_frame, motion_, t_max_, out);
      out.mask &= met;
    } else {
      sweep_node(node, in_frame.frame, motion_, in_frame.grown, t_max_, out);
      out.mask &= met;
      if ((out.mask & (out.mask - 1)) != 0) delay_children(node, in_frame.frame, motion_, in_frame.grown, t_max_, out);
    }
  }

  /// The result of a descent: a single leaf, or the children of one node.
  struct Descent {
    bool single;
    std::uint32_t first;  ///< the leaf
    const Node* node;
    Children children;
  };

  /// Visits a node and, as long as there is only one child, that child, without a detour through the stack: a visit is
  /// latency. Integer boxes settle most visits of short motions at a third of the cost. Times of entry matter only
  /// where more than `few` children are met.
  HWY_INLINE Descent descend(const Block* nodes, std::uint32_t number, const InFrame& in_frame, const Swept& swept,
                             int few) {
    Descent out;
    out.single = false;
    out.node = &nodes[number].node;
    if (!Line::is_ray && !short_) {
      choose(*out.node, in_frame, ~0U, out.children);
      // cppcheck-suppress[uninitvar,uninitStructMember] ; `first` counts only with `single`
      return out;
    }
    for (;;) {
      const Node& node = *out.node;
      if (short_) {
        out.children.mask = met_children(node, swept);
      } else {
        choose(node, in_frame, ~0U, out.children);  // a long ray
      }
      const std::uint32_t met = out.children.mask;
      if (met == 0) return out;
      if ((met & (met - 1)) != 0) break;
      const auto child = static_cast<std::uint32_t>(std::countr_zero(met));
      if (child >= node.inner_count) {
        out.single = true;
        out.first = node.first_leaf + (child - node.inner_count);
        return out;
      }
      out.node = &nodes[node.first_node + child].node;
    }
    if (!short_) return out;
    const std::uint32_t met = out.children.mask;
    if (std::popcount(met) <= few) {
      out.children.take(met);
    } else {
      choose(*out.node, in_frame, met, out.children);
    }
    return out;
  }

  void leaf(Inside& in, std::uint32_t number, float entry) {
    const Leaf& leaf = in.leaves[number].leaf;
    const FineLeaf* const low = in.low == nullptr ? nullptr : in.low + number;
    const auto each = [&](std::uint32_t left, const auto& visit) {
      if (left != 0) prefetch_ids(index_, in.tile, leaf);
      for (; left != 0; left &= left - 1) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
        const Place place{in.number, in.tile.leaves + number, i};
        if constexpr (skips) {
          if (index_.skip->skips(index_.skip->context, place)) continue;
        }
        visit(i, place);
      }
    };
    if constexpr (Line::is_ray) {
      if (!in.entered) line_.enter(in.frame, motion_, in.radius, tile_steps);
      in.entered = true;
      each(pierced(leaf, low, line_),
           [&](std::uint32_t, const Place& place) { decide(in.tile, place, double(entry)); });
    } else {
      Met met;
      sweep_leaf<!skips>(leaf, low, in.frame, motion_, in.radius, in.hit_limit, entry, t_max_, met);
      each(met.arrived, [&](std::uint32_t i, const Place& place) { take(double(met.time[i]), place); });
      each(met.open, [&](std::uint32_t i, const Place& place) {
        if (double(met.time[i]) < best_.time) decide(in.tile, place, double(met.time[i]));
      });
    }
  }

  void decide(const Tile& t, const Place& place, double from) {
    const Body body{piece_.body.radius + double(t.fine_error), piece_.body.half_height};
    const auto triangle = local_triangle(index_, place, piece_.start);
    if constexpr (Line::is_ray) {
      take(certified::sphere_impact_time(body, piece_.motion, triangle, from, best_.time, arrival_exact), place);
    } else {
      const SweepResult s = certified::sweep(body, piece_.motion, triangle, from, best_.time, arrival_exact);
      if (s.hit) take(s.time, place);
    }
  }

  void take(double time, const Place& place) {
    if (time >= best_.time) return;
    // Number by number: a wider store would wait for those of a temporary.
    best_.hit = true;
    best_.time = time;
    best_.place.tile = place.tile;
    best_.place.leaf = place.leaf;
    best_.place.triangle = place.triangle;
    t_max_ = round_up(time);
  }

  /// Metres. Arrival distance in double precision: negligible beside the grid, small beside 1e-5 m.
  static constexpr double arrival_exact = 1e-6;

  const Index& index_;
  const Piece& piece_;
  Motion motion_;
  Reach reach_;
  Line line_{motion_};
  bool short_ = motion_.longest <= short_motion;
  Impact best_;
  float t_max_ = 1.0F;
  Stack stack_;
};

}  // namespace roam::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ROAM_INDEX_SWEEP_TRAVERSAL_INL_H_
