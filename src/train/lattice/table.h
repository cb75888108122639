#pragma once
/// \file
/// Which place lies at a point of the lattice: a hash table with open addressing, 12 bytes an entry and half full.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "train/lattice/lattice.h"

namespace roam::training {

/// A point of the lattice: whole spacings from its origin.
struct LatticePoint {
  std::int32_t x = 0, y = 0, z = 0;
};

class LatticeTable {
 public:
  /// Coordinates within this are told apart.
  static constexpr std::int32_t limit = 1 << 20;

  LatticeTable() : keys_(1024, empty), values_(1024, no_node) {}

  [[nodiscard]] NodeId find(const LatticePoint& point) const { return values_[slot(key(point))]; }
  void set(const LatticePoint& point, NodeId value) {
    if (2 * (count_ + 1) > keys_.size()) grow();
    const std::uint64_t k = key(point);
    const std::size_t i = slot(k);
    if (keys_[i] == empty) ++count_;
    keys_[i] = k;
    values_[i] = value;
  }

 private:
  static constexpr std::uint64_t empty = ~std::uint64_t{0};

  static std::uint64_t key(const LatticePoint& p) {
    constexpr int bits = 21;
    constexpr std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    const auto part = [](std::int32_t v) { return static_cast<std::uint64_t>(v + limit) & mask; };
    return part(p.x) | part(p.y) << bits | part(p.z) << (2 * bits);
  }
  [[nodiscard]] std::size_t slot(std::uint64_t k) const {
    const std::size_t last = keys_.size() - 1;  // a power of two less one
    constexpr std::uint64_t golden = 0x9E3779B97F4A7C15ULL;
    constexpr int high = 32;
    std::size_t i = static_cast<std::size_t>(k * golden >> high) & last;
    while (keys_[i] != empty && keys_[i] != k) i = (i + 1) & last;
    return i;
  }
  void grow() {
    std::vector<std::uint64_t> keys(2 * keys_.size(), empty);
    std::vector<NodeId> values(2 * keys_.size(), no_node);
    keys.swap(keys_);
    values.swap(values_);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (keys[i] == empty) continue;
      const std::size_t to = slot(keys[i]);
      keys_[to] = keys[i];
      values_[to] = values[i];
    }
  }

  std::vector<std::uint64_t> keys_;
  std::vector<NodeId> values_;
  std::size_t count_ = 0;
};

}  // namespace roam::training
