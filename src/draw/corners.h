#pragma once
/// \file
/// Finds the places of a line that keep its shape.

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

namespace roam::draw {

/// The position of the place of the segment from `a` (0) to `b` (1) nearest to `p`; 0 if the segment is no longer than
/// a point.
template <typename V>
[[nodiscard]] double nearest_part(const V& p, const V& a, const V& b) {
  const V d = b - a;
  const double square = glm::dot(d, d);
  return square > 0.0 ? std::clamp(glm::dot(p - a, d) / square, 0.0, 1.0) : 0.0;
}

/// Sets keep[i] to 1 for the places of [first, last] that must stay, including first and last. Every other place
/// deviates by at most `tolerance` from the straight piece between its kept neighbours (Douglas and Peucker, 1973).
/// `deviation(i, from, to)` is that of `i` from the piece between `from` and `to`.
template <typename Deviation>
void keep_corners(std::size_t first, std::size_t last, double tolerance, const Deviation& deviation,
                  std::vector<char>& keep) {
  std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
  keep[first] = keep[last] = 1;
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    double worst = tolerance;
    std::size_t at = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double d = deviation(i, from, to);
      if (d > worst) {
        worst = d;
        at = i;
      }
    }
    if (at == from) continue;
    keep[at] = 1;
    open.emplace_back(from, at);
    open.emplace_back(at, to);
  }
}

}  // namespace roam::draw
