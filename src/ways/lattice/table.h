#pragma once
/// \file
/// The place at each lattice point: a hash table with open addressing, at most half full. An entry is a square of 4 by
/// 4 points, so that neighbouring points lie together in memory.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ways/lattice/lattice.h"

namespace roam::ways {

/// A point of the lattice: whole spacings from its origin.
struct LatticePoint {
  std::int32_t x = 0, y = 0, z = 0;
};

class LatticeTable {
 public:
  /// Absolute coordinates below this are distinct keys.
  static constexpr std::int32_t limit = 1 << 20;

  LatticeTable() : slots_(1024) {}

  /// Whether a point has a key of its own.
  [[nodiscard]] static bool holds(const LatticePoint& p) {
    const auto is_near = [](std::int32_t v) { return v > -limit && v < limit; };
    return is_near(p.x) && is_near(p.y) && is_near(p.z);
  }

  [[nodiscard]] NodeId find(const LatticePoint& point) const {
    const Slot& slot = slots_[slot_of(key(point))];
    return slot.key == empty ? no_node : squares_[slot.square][within(point)];
  }
  void set(const LatticePoint& point, NodeId value) {
    if (2 * (squares_.size() + 1) > slots_.size()) grow();
    const std::uint64_t k = key(point);
    Slot& slot = slots_[slot_of(k)];
    if (slot.key == empty) {
      slot = {k, static_cast<std::uint32_t>(squares_.size())};
      squares_.emplace_back().fill(no_node);
    }
    squares_[slot.square][within(point)] = value;
  }

 private:
  /// Base-2 logarithm of the points along one side of a square.
  static constexpr int square_bits = 2;
  static constexpr std::uint64_t empty = ~std::uint64_t{0};

  struct Slot {
    std::uint64_t key = empty;
    std::uint32_t square = 0;
  };

  /// The square that a point lies in.
  static std::uint64_t key(const LatticePoint& p) {
    constexpr int bits = 21;
    constexpr std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    const auto part = [](std::int32_t v, int shift) { return (static_cast<std::uint64_t>(v + limit) & mask) >> shift; };
    return part(p.x, square_bits) | part(p.y, square_bits) << bits | part(p.z, 0) << (2 * bits);
  }
  /// The index of a point in its square.
  static std::size_t within(const LatticePoint& p) {
    constexpr std::uint32_t last = (1U << square_bits) - 1;
    const auto part = [](std::int32_t v) { return static_cast<std::uint32_t>(v + limit) & last; };
    return part(p.x) | part(p.y) << square_bits;
  }
  [[nodiscard]] std::size_t slot_of(std::uint64_t k) const {
    const std::size_t last = slots_.size() - 1;  // a power of two less one
    constexpr std::uint64_t golden = 0x9E3779B97F4A7C15ULL;
    constexpr int high = 32;
    std::size_t i = static_cast<std::size_t>(k * golden >> high) & last;
    while (slots_[i].key != empty && slots_[i].key != k) i = (i + 1) & last;
    return i;
  }
  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.key != empty) slots_[slot_of(slot.key)] = slot;
  }

  std::vector<Slot> slots_;
  std::vector<std::array<NodeId, 1U << (2 * square_bits)>> squares_;  ///< in order of first use
};

}  // namespace roam::ways
