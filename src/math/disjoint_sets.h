#pragma once
/// \file
/// Union and find (Tarjan & van Leeuwen, "Worst-case analysis of set union algorithms", 1984, with path halving).

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace roam {

/// Disjoint sets of consecutive numbers, each alone at first. A set is named by its least number, whatever the order of
/// unions.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size = 0) {
    for (std::size_t i = 0; i < size; ++i) add();
  }
  [[nodiscard]] std::size_t size() const { return parent_.size(); }
  /// Adds one number, alone in its set, and returns it.
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    return parent_.back();
  }
  [[nodiscard]] std::uint32_t find(std::uint32_t number) {
    while (parent_[number] != number) number = parent_[number] = parent_[parent_[number]];
    return number;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace roam
