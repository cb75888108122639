#pragma once
/// \file
/// Places in the plan, grouped by squares of a lattice.

#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <vector>

#include "math/disjoint_sets.h"
#include "math/level_distance.h"
#include "roam/math.h"

namespace roam::cracks {

/// The number of a square of a lattice in the plan; squares 2^32 apart share one.
[[nodiscard]] inline std::uint64_t square_number(std::int64_t x, std::int64_t y) {
  return std::uint64_t(std::uint32_t(x)) << 32 | std::uint32_t(y);
}

/// The number of a square of the plan, `side` wide; squares 2^32 apart share one.
[[nodiscard]] inline std::uint64_t square_at(double x, double y, double side) {
  return square_number(std::int64_t(std::floor(x / side)), std::int64_t(std::floor(y / side)));
}

/// Groups of places within `reach` of each other, level, and within `step` in height, as indices. Each group is
/// ascending; groups are in the order of their first members.
[[nodiscard]] inline std::vector<std::vector<std::size_t>> groups_within(const std::vector<Vec3>& places, double reach,
                                                                         double step) {
  DisjointSets sets(places.size());
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> squares;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const Vec3& c = places[i];
    for (int k = 0; k < 9; ++k) {
      const auto near = squares.find(square_at(c.x + (k % 3 - 1) * reach, c.y + (k / 3 - 1) * reach, reach));
      if (near == squares.end()) continue;
      for (const std::uint32_t other : near->second) {
        if (level_distance(places[other], c) <= reach && std::abs(places[other].z - c.z) <= step) sets.unite(i, other);
      }
    }
    squares[square_at(c.x, c.y, reach)].push_back(i);
  }
  std::map<std::uint32_t, std::vector<std::size_t>> groups;  // a set's name is its least number
  for (std::uint32_t i = 0; i < places.size(); ++i) groups[sets.find(i)].push_back(i);
  std::vector<std::vector<std::size_t>> all;
  for (auto& [set, group] : groups) all.push_back(std::move(group));
  return all;
}

/// Groups of places farther than `side` from each other, level, as indices. Each group is ascending; groups are in the
/// order of their first members.
[[nodiscard]] inline std::vector<std::vector<std::size_t>> groups_apart(const std::vector<Vec3>& places, double side) {
  std::unordered_map<std::uint64_t, std::uint32_t> squares;
  DisjointSets sets;
  std::vector<std::uint32_t> square_of;
  for (const Vec3& c : places) {
    const auto [square, is_new] = squares.try_emplace(square_at(c.x, c.y, side), std::uint32_t(sets.size()));
    if (is_new) sets.add();
    square_of.push_back(square->second);
    for (int k = 0; is_new && k < 9; ++k) {
      const auto beside = squares.find(square_at(c.x + (k % 3 - 1) * side, c.y + (k / 3 - 1) * side, side));
      if (beside != squares.end()) sets.unite(beside->second, square->second);
    }
  }
  std::vector<std::vector<std::size_t>> parts;
  std::unordered_map<std::uint32_t, std::size_t> part_of;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [part, is_new] = part_of.try_emplace(sets.find(square_of[i]), parts.size());
    if (is_new) parts.emplace_back();
    parts[part->second].push_back(i);
  }
  return parts;
}

}  // namespace roam::cracks
