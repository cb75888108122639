#pragma once
/// \file
/// Places of components, found by where they are.

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "roam/math.h"
#include "train/places_random.h"

namespace roam::training {

/// Places in columns, square cells of the plan.
class Columns {
 public:
  struct Entry {
    double z = 0.0;
    std::uint32_t owner = 0;
  };

  explicit Columns(double cell) : cell_(cell) {}

  void add(const Vec3& place, std::uint32_t owner) {
    columns_[key(index(place.x), index(place.y))].push_back({place.z, owner});
  }
  /// Whether `accept` says so of an entry in the column of `place`, or one up to `around` columns beside it.
  template <class Accept>
  [[nodiscard]] bool any(const Vec3& place, int around, const Accept& accept) const {
    const std::int64_t x = index(place.x), y = index(place.y);
    for (std::int64_t i = x - around; i <= x + around; ++i) {
      for (std::int64_t j = y - around; j <= y + around; ++j) {
        const auto column = columns_.find(key(i, j));
        if (column == columns_.end()) continue;
        for (const Entry& entry : column->second)
          if (accept(entry)) return true;
      }
    }
    return false;
  }

 private:
  [[nodiscard]] std::int64_t index(double x) const { return static_cast<std::int64_t>(std::floor(x / cell_)); }
  /// Coordinates of up to 1e9 m fit: no two columns share a key.
  [[nodiscard]] static std::uint64_t key(std::int64_t i, std::int64_t j) {
    return (static_cast<std::uint64_t>(i) << 32) ^ (static_cast<std::uint64_t>(j) & 0xFFFFFFFFULL);
  }
  struct Hash {
    std::size_t operator()(std::uint64_t key) const { return static_cast<std::size_t>(mixed(key)); }
  };

  double cell_;
  std::unordered_map<std::uint64_t, std::vector<Entry>, Hash> columns_;
};

}  // namespace roam::training
