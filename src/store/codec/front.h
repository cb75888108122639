#pragma once
/// \file
/// The front: the border between the known triangles of a tile and those still to come. Encoder and decoder move it in
/// the same way, and name the vertices of the next triangle by their position on it. The idea is from Rossignac,
/// "Edgebreaker", 1999. On non-manifold surfaces it names fewer vertices; nothing requires that it is a closed line.

#include <array>
#include <cstdint>
#include <utility>

#include "index/block.h"

namespace roam::store {

inline constexpr std::uint16_t no_vertex = UINT16_MAX;

/// A vertex of a tile, numbered by first use. 24 bytes, so that the vertices of a tile stay in the second-level cache.
///
/// A front that touches itself at a vertex passes it twice: once from `previous` to `after`, once from `before` to
/// `next`. If it passes once, `after` and `before` are no_vertex.
struct FrontVertex {
  std::array<std::uint32_t, 3> at;  ///< on the tile's grid; in fine tiles on the fine grid, from -fine_steps / 2
  std::uint16_t next;               ///< the next vertex of the front; a known triangle lies to the left of the edge
  std::uint16_t previous;
  std::uint16_t after;
  std::uint16_t before;
  std::uint16_t across;  ///< the third corner of the triangle at the edge to `next`
  std::uint16_t place;   ///< 16 * leaf + slot in the last leaf that contains the vertex

  /// The successor on the pass that came from `previous`.
  [[nodiscard]] std::uint16_t onward() const { return after != no_vertex ? after : next; }
  /// The predecessor on the pass that goes to `next`.
  [[nodiscard]] std::uint16_t backward() const { return before != no_vertex ? before : previous; }
};

/// An edge of the front from a vertex to its next, both in the growing leaf. A triangle beyond it has the corners `to`,
/// `from` and a third.
struct Gate {
  std::uint16_t from, to;
  std::uint8_t from_slot, to_slot;
};

/// How the third corner of a triangle beyond a gate is named.
enum class Apex : std::uint8_t {
  none,      ///< no triangle of this leaf lies beyond
  fresh,     ///< a vertex not seen before
  next,      ///< the next vertex on the front after the gate
  previous,  ///< the vertex before the gate
  other,     ///< named by slot or age
};
inline constexpr unsigned apex_stream = 5;

/// The result of adding a triangle.
enum class Step : std::uint8_t {
  full,    ///< nothing was added: the leaf is full, or the vertex does not exist
  open,    ///< the gate is now the next gate to visit
  closed,  ///< the triangle has no gate newer than those on the stack
};

/// One growing leaf and the front.
template <bool fine>
class Growth {
 public:
  explicit Growth(FrontVertex* vertices) : vertices_(vertices) {}

  /// Starts a leaf. Every field of it will be written except its ids.
  void begin(std::uint32_t leaf_number, index::Leaf& leaf, index::FineLeaf* low) {
    first_place_ = leaf_number * index::node_width;
    leaf_ = &leaf;
    low_ = low;
    slots_ = triangles_ = gates_ = 0;
    corners_ = {};
  }

  [[nodiscard]] unsigned triangles() const { return triangles_; }
  [[nodiscard]] unsigned slots() const { return slots_; }
  [[nodiscard]] std::uint16_t in_slot(unsigned slot) const { return in_slot_[slot]; }

  /// The vertex's slot in the leaf; node_width if it has none.
  [[nodiscard]] unsigned slot_of(std::uint16_t v) const {
    const unsigned slot = vertices_[v].place - first_place_;
    return slot < index::node_width ? slot : index::node_width;
  }

  /// The newest gate of the leaf that is still on the front. False if there is none.
  bool pop(Gate& gate) {
    while (gates_ > 0) {
      const std::uint8_t slots = open_[--gates_];
      gate.from_slot = slots & 15U;
      gate.to_slot = slots >> 4U;
      gate.from = in_slot_[gate.from_slot];
      gate.to = in_slot_[gate.to_slot];
      if (vertices_[gate.from].next == gate.to) return true;
    }
    return false;
  }

  /// The gate that begins at a vertex, in any leaf. False if there is none or the leaf is full.
  bool enter(std::uint16_t from, Gate& gate) {
    gate.from = from;
    gate.to = vertices_[from].next;
    return gate.to != no_vertex && place(gate.from, gate.from_slot) && place(gate.to, gate.to_slot);
  }

  /// Adds the triangle beyond a gate.
  Step add(Gate& gate, Apex apex, std::uint16_t third) {
    std::uint8_t slot = 0;
    if (!(apex == Apex::fresh ? place_new(third, slot) : place(third, slot))) return Step::full;
    put(gate.to_slot, gate.from_slot, slot);
    FrontVertex &from = vertices_[gate.from], &to = vertices_[gate.to], &v = vertices_[third];
    switch (apex) {
      case Apex::next:
        leave_onward(to);
        if (v.next == gate.from) {
          v.next = from.previous = from.next = no_vertex;
          return Step::closed;
        }
        if (v.before == gate.to) {
          const std::uint16_t previous = v.previous;
          join(gate.from, third, gate.to);
          v.before = gate.from;
          v.previous = previous;
        } else {
          join(gate.from, third, gate.to);
        }
        gate.to = third;
        gate.to_slot = slot;
        return Step::open;
      case Apex::previous:
        leave_backward(from);
        if (v.after == gate.from) {  // the pass with `next` is the one that changes
          v.after = v.next;
          std::swap(v.previous, v.before);
        }
        break;
      case Apex::other:
        if (v.next != no_vertex) {
          v.after = v.next;
          v.before = v.previous;
        }
        [[fallthrough]];
      default:
        join(gate.from, third, gate.to);
        push(gate.from_slot, slot);
    }
    join(third, gate.to, gate.from);
    gate.from = third;
    gate.from_slot = slot;
    return Step::open;
  }

  /// Adds a triangle that lies beyond no gate.
  Step add(const std::array<std::uint16_t, 3>& corners) {
    std::array<std::uint8_t, 3> slots{};
    for (int c = 0; c < 3; ++c) {
      if (!place(corners[c], slots[c])) return Step::full;
    }
    put(slots[0], slots[1], slots[2]);
    for (int c = 0; c < 3; ++c) {
      const int to = (c + 1) % 3;
      if (corners[c] == corners[to]) continue;
      FrontVertex& other = vertices_[corners[to]];
      if (other.next == corners[c]) {  // the triangle at the other side is known
        other.next = no_vertex;
        vertices_[corners[c]].previous = no_vertex;
      } else {
        join(corners[c], corners[to], corners[(c + 2) % 3]);
        push(slots[c], slots[to]);
      }
    }
    return Step::closed;
  }

  /// Fills the unused triangles and vertices of the leaf.
  void finish() {
    for (int k = 0; k < 3; ++k) {
      std::uint64_t c = corners_[k];
      if (triangles_ < index::node_width) c |= (c & 15U) * 0x1111111111111111U << (4 * triangles_);
      leaf_->corner[k][0] = static_cast<std::uint32_t>(c);
      leaf_->corner[k][1] = static_cast<std::uint32_t>(c >> 32U);
      for (unsigned s = slots_; s < index::node_width; ++s) {
        leaf_->vertex[k][s] = leaf_->vertex[k][0];
        if (fine) low_->vertex[k][s] = low_->vertex[k][0];
      }
    }
    leaf_->triangle_count = static_cast<std::uint8_t>(triangles_);
    leaf_->unused[0] = leaf_->unused[1] = 0;
  }

 private:
  /// The vertex's slot in the leaf. Assigns a new one if it has none. False if the leaf is full.
  bool place(std::uint16_t v, std::uint8_t& slot) {
    const unsigned known = slot_of(v);
    slot = static_cast<std::uint8_t>(known);
    return known < index::node_width || place_new(v, slot);
  }
  bool place_new(std::uint16_t v, std::uint8_t& slot) {
    if (slots_ == index::node_width) return false;
    FrontVertex& vertex = vertices_[v];
    vertex.place = static_cast<std::uint16_t>(first_place_ + slots_);
    for (int k = 0; k < 3; ++k) {
      leaf_->vertex[k][slots_] = static_cast<std::uint16_t>(fine ? vertex.at[k] >> 16U : vertex.at[k]);
      if (fine) low_->vertex[k][slots_] = static_cast<std::int16_t>((vertex.at[k] & 0xffffU) ^ 0x8000U);
    }
    in_slot_[slots_] = v;
    slot = static_cast<std::uint8_t>(slots_++);
    return true;
  }

  void put(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    const unsigned shift = 4 * triangles_++;
    corners_[0] |= a << shift;
    corners_[1] |= b << shift;
    corners_[2] |= c << shift;
  }

  /// Ends the pass from `previous`.
  static void leave_onward(FrontVertex& v) {
    if (v.after == no_vertex) v.next = no_vertex;
    v.previous = v.before;
    v.after = v.before = no_vertex;
  }
  /// Ends the pass to `next`.
  static void leave_backward(FrontVertex& v) {
    if (v.before == no_vertex) v.previous = no_vertex;
    v.next = v.after;
    v.after = v.before = no_vertex;
  }

  void join(std::uint16_t from, std::uint16_t to, std::uint16_t third) {
    vertices_[from].next = to;
    vertices_[from].across = third;
    vertices_[to].previous = from;
  }
  void push(std::uint8_t from_slot, std::uint8_t to_slot) {
    open_[gates_++] = static_cast<std::uint8_t>(from_slot | to_slot << 4U);
  }

  FrontVertex* vertices_;
  index::Leaf* leaf_ = nullptr;
  index::FineLeaf* low_ = nullptr;
  unsigned first_place_ = 0;  ///< the place of the leaf's slot 0
  unsigned slots_ = 0, triangles_ = 0, gates_ = 0;
  std::array<std::uint64_t, 3> corners_{};
  std::array<std::uint16_t, index::node_width> in_slot_{};
  std::array<std::uint8_t, std::size_t{3} * index::node_width> open_{};  ///< gates: from_slot | to_slot << 4
};

}  // namespace roam::store
