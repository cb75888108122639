#pragma once
/// \file
/// Which places of a line must stay for its shape to stay.

#include <algorithm>
#include <cstddef>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

namespace roam::draw {

/// Where between `a` (0) and `b` (1) the straight piece comes nearest to `p`; 0 when it is no longer than a point.
template <typename V>
[[nodiscard]] double nearest_part(const V& p, const V& a, const V& b) {
  const V d = b - a;
  const double square = glm::dot(d, d);
  return square > 0.0 ? std::clamp(glm::dot(p - a, d) / square, 0.0, 1.0) : 0.0;
}

/// Sets those of `keep` to 1, first and last among them, that must stay so that every other of [first, last] deviates
/// by at most `tolerance` from the straight piece between its neighbours that stay (Douglas and Peucker, 1973).
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
