#include "import/reader/tileset/tile_volume.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "import/reader/tileset/earth.h"
#include "roam/mesh.h"

namespace roam::reader {
namespace {

/// The box along the axes around a point with three half axes on each side.
Box box_around(const glm::dmat4& matrix, const Vec3& center, const std::array<Vec3, 3>& halves) {
  Vec3 half(0.0);
  for (const Vec3& one : halves) half += glm::abs(Vec3(matrix * glm::dvec4(one, 0.0)));
  const Vec3 middle(matrix * glm::dvec4(center, 1.0));
  return {middle - half, middle + half};
}

/// The box around a region: places on it, and how far the Earth bulges between them.
Box box_around(const glm::dmat4& earth, const std::array<double, 12>& n) {
  constexpr int steps = 4;
  constexpr double earth_radius = 6.4e6;
  const double east = n[2] < n[0] ? n[2] + 2.0 * std::numbers::pi : n[2];
  Box box;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; j <= steps; ++j) {
      for (const double height : {n[4], n[5]}) {
        const Geodetic place{n[1] + (n[3] - n[1]) * i / steps, n[0] + (east - n[0]) * j / steps, height};
        box.include(Vec3(earth * glm::dvec4(earth_centred(place), 1.0)));
      }
    }
  }
  const double step = std::max(std::abs(n[3] - n[1]), std::abs(east - n[0])) / steps;
  return box.grown(earth_radius * step * step / 4.0);
}

bool is_usable(const Box& box) {
  for (int k = 0; k < 3; ++k) {
    // False for a NaN.
    if (!(std::abs(box.lower[k]) <= coordinate_limit && std::abs(box.upper[k]) <= coordinate_limit)) return false;
  }
  return !box.empty();
}

}  // namespace

TileVolume::TileVolume(const Json& tile) {
  const Json& volume = member(tile, "boundingVolume");
  for (const auto& [name, kind, count] : {std::tuple{"box", Kind::box, std::size_t{12}},
                                          {"sphere", Kind::sphere, std::size_t{4}},
                                          {"region", Kind::region, std::size_t{6}}}) {
    const auto read = numbers(member(volume, name), count);
    if (!read) continue;
    kind_ = kind;
    std::copy_n(read->begin(), count, n_.begin());
    return;
  }
}

TileVolume TileVolume::part(const ImplicitTile& tile, unsigned dimensions) const {
  TileVolume divided = *this;
  const double count = std::exp2(static_cast<double>(tile.level));
  const std::array<double, 3> at{static_cast<double>(tile.x), static_cast<double>(tile.y), static_cast<double>(tile.z)};
  for (std::size_t axis = 0; axis < dimensions; ++axis) {
    if (kind_ == Kind::box) {
      // The axis from one side to the other is cut into `count` pieces.
      const double middle = (2.0 * at[axis] + 1.0) / count - 1.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double half = n_[3 + 3 * axis + k];
        divided.n_[k] += middle * half;
        divided.n_[3 + 3 * axis + k] = half / count;
      }
    } else if (kind_ == Kind::region) {
      // West, south, east, north, lowest, highest.
      const std::size_t from = axis == 2 ? 4 : axis, to = axis == 2 ? 5 : axis + 2;
      const double turn = axis == 0 && n_[to] < n_[from] ? 2.0 * std::numbers::pi : 0.0;
      const double step = (n_[to] + turn - n_[from]) / count;
      divided.n_[from] = n_[from] + step * at[axis];
      divided.n_[to] = n_[from] + step * (at[axis] + 1.0);
    }
  }
  return divided;
}

std::optional<Box> TileVolume::around(const glm::dmat4& matrix, const glm::dmat4& earth) const {
  Box box;
  const Vec3 center(n_[0], n_[1], n_[2]);
  switch (kind_) {
    case Kind::none:
      return std::nullopt;
    case Kind::box:
      box = box_around(matrix, center, {{{n_[3], n_[4], n_[5]}, {n_[6], n_[7], n_[8]}, {n_[9], n_[10], n_[11]}}});
      break;
    case Kind::sphere: {
      const double scale = std::max({glm::length(matrix[0]), glm::length(matrix[1]), glm::length(matrix[2])});
      const Vec3 middle(matrix * glm::dvec4(center, 1.0));
      box = {middle - std::abs(n_[3]) * scale, middle + std::abs(n_[3]) * scale};
      break;
    }
    case Kind::region:
      box = box_around(earth, n_);
      break;
  }
  return is_usable(box) ? std::optional(box) : std::nullopt;
}

}  // namespace roam::reader
