#pragma once
/// \file
/// The front: the border between the triangles of a tile that are known and those still to come. Encoder and decoder
/// move it in the same way, and name the vertices of the next triangle by where they lie on it (the idea of Rossignac,
/// "Edgebreaker", 1999). On surfaces that are no manifolds it only names fewer vertices; nothing depends on its being
/// a closed line.

#include <array>
#include <cstdint>

#include "index/block.h"

namespace roam::store {

inline constexpr std::uint16_t kNoVertex = UINT16_MAX;

/// A vertex of a tile, numbered by first use. 20 bytes, so that those of a tile stay in the second cache.
struct FrontVertex {
  std::array<std::uint32_t, 3> at;  ///< on the tile's grid; of fine tiles on the fine one, from -kFineSteps / 2
  std::uint16_t next;               ///< the front goes from here to there: a known triangle lies at its left
  std::uint16_t previous;
  std::uint16_t across;  ///< the third corner of that triangle
  std::uint16_t place;   ///< 16 * leaf + slot in the last leaf that has the vertex
};

/// An edge of the front, from one vertex to its next. A triangle beyond it has the corners `to`, `from` and another.
struct Gate {
  std::uint16_t from, to;
};

/// How the third corner of a triangle beyond a gate is named.
enum class Apex : std::uint8_t {
  none,      ///< no triangle of this leaf lies beyond
  fresh,     ///< a vertex not seen before
  next,      ///< the next on the front after the gate
  previous,  ///< the one before the gate
  other,     ///< named by slot or age
};
inline constexpr unsigned kApexes = 5;

/// One leaf as it grows, triangle by triangle, and the front with it.
class Growth {
 public:
  explicit Growth(FrontVertex* vertices) : vertices_(vertices) {}

  void begin(std::uint32_t leaf_number, index::Leaf& leaf, index::FineLeaf* fine) {
    number_ = leaf_number;
    leaf_ = &leaf;
    fine_ = fine;
    slots_ = triangles_ = gates_ = 0;
  }

  /// The vertex's slot in the leaf, a new one if it has none; kWidth or more when the leaf is full.
  int slot(std::uint16_t v) {
    FrontVertex& vertex = vertices_[v];
    if (vertex.place / index::kWidth == number_) return vertex.place % index::kWidth;
    if (slots_ >= index::kWidth) return index::kWidth;
    vertex.place = static_cast<std::uint16_t>(number_ * index::kWidth + slots_);
    in_slot_[slots_] = v;
    return slots_++;
  }
  [[nodiscard]] int slots() const { return slots_; }
  [[nodiscard]] std::uint16_t in_slot(std::uint32_t slot) const { return in_slot_[slot]; }
  [[nodiscard]] int triangles() const { return triangles_; }
  [[nodiscard]] std::uint32_t number() const { return number_; }

  /// Adds the triangle to the leaf and moves the front over it. False when the leaf has no room for its corners.
  bool add(std::uint16_t a, std::uint16_t b, std::uint16_t c) {
    const int slot_a = slot(a), slot_b = slot(b), slot_c = slot(c);
    if (slot_a == index::kWidth || slot_b == index::kWidth || slot_c == index::kWidth) return false;
    const int word = triangles_ / 8, shift = 4 * (triangles_ % 8);
    leaf_->corner[0][word] |= static_cast<std::uint32_t>(slot_a) << shift;
    leaf_->corner[1][word] |= static_cast<std::uint32_t>(slot_b) << shift;
    leaf_->corner[2][word] |= static_cast<std::uint32_t>(slot_c) << shift;
    ++triangles_;
    add_edge(a, b, c);
    add_edge(b, c, a);
    add_edge(c, a, b);
    return true;
  }

  /// The newest gate of the leaf that is still on the front; false when there is none.
  bool pop(Gate& gate) {
    while (gates_ > 0) {
      gate = open_[--gates_];
      if (vertices_[gate.from].next == gate.to) return true;
    }
    return false;
  }

  /// Fills what the leaf has no triangles and no vertices for.
  template <bool fine>
  void finish() {
    for (auto& c : leaf_->corner) {
      const std::uint32_t all = (c[0] & 15U) * 0x11111111U;
      if (triangles_ < 8) c[0] |= all << (4 * triangles_);
      if (triangles_ < 16) c[1] |= all << (4 * (triangles_ < 8 ? 0 : triangles_ - 8));
    }
    for (int s = 0; s < index::kWidth; ++s) {
      const FrontVertex& v = vertices_[in_slot_[s < slots_ ? s : 0]];
      for (int k = 0; k < 3; ++k) {
        leaf_->vertex[k][s] = static_cast<std::uint16_t>(fine ? v.at[k] >> 16U : v.at[k]);
        if (fine) fine_->vertex[k][s] = static_cast<std::int16_t>((v.at[k] & 0xffffU) ^ 0x8000U);
      }
    }
    leaf_->triangle_count = static_cast<std::uint8_t>(triangles_);
  }

 private:
  void add_edge(std::uint16_t from, std::uint16_t to, std::uint16_t third) {
    if (from == to) return;
    FrontVertex &f = vertices_[from], &t = vertices_[to];
    if (t.next == from) {  // the triangle at the other side is known
      t.next = kNoVertex;
      if (f.previous == to) f.previous = kNoVertex;
      return;
    }
    f.next = to;
    f.across = third;
    t.previous = from;
    open_[gates_++] = {from, to};
  }

  FrontVertex* vertices_;
  index::Leaf* leaf_ = nullptr;
  index::FineLeaf* fine_ = nullptr;
  std::uint32_t number_ = 0;
  int slots_ = 0, triangles_ = 0, gates_ = 0;
  std::array<std::uint16_t, index::kWidth> in_slot_;
  std::array<Gate, std::size_t{3} * index::kWidth> open_;
};

}  // namespace roam::store
