#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <tuple>

#include "training/places/inside.h"

namespace roam::training {

namespace {

/// Triangles that are examined, at most, spread evenly over their order.
constexpr std::uint64_t triangles_examined = 4096;
/// m: side of the cells for looking up places. A place sees a triangle if it is in sight and in the cells around it.
constexpr double cell = 0.5;
/// m: sight lines start this far in front of a triangle.
constexpr double before = 0.02;
/// Places of one component tried in one cell.
constexpr int places_tried = 8;

using CellKey = std::array<std::int64_t, 3>;

CellKey cell_of(const Vec3& p) {
  CellKey key{};
  for (int k = 0; k < 3; ++k) key[static_cast<std::size_t>(k)] = static_cast<std::int64_t>(std::floor(p[k] / cell));
  return key;
}

/// A place, sorted by its cell.
struct Entry {
  CellKey key;
  std::uint32_t owner;
  ways::NodeId node;
  friend bool operator<(const Entry& a, const Entry& b) {
    return std::tie(a.key, a.owner, a.node) < std::tie(b.key, b.owner, b.node);
  }
};

}  // namespace

std::vector<std::size_t> surfaces_seen(const Survey& survey, const ways::WidestTree& tree,
                                       std::span<const Component> components) {
  std::vector<Entry> entries;
  for (std::uint32_t i = 0; i < components.size(); ++i)
    for (const ways::NodeId node : components[i].nodes) entries.push_back({cell_of(tree.node(node).place), i, node});
  std::sort(entries.begin(), entries.end());
  std::vector<std::size_t> seen(components.size(), 0);
  std::vector<TriangleId> seen_last(components.size(), survey.triangles());
  const auto look_from = [&](const CellKey& key, const Vec3& point, TriangleId triangle) {
    auto at = std::lower_bound(entries.begin(), entries.end(), Entry{key, 0, 0});
    std::uint32_t owner = 0;
    for (int tried = 0; at != entries.end() && at->key == key; ++at) {
      tried = at->owner == owner ? tried + 1 : 0;
      owner = at->owner;
      if (seen_last[owner] == triangle || tried >= places_tried) continue;
      if (survey.world().first_impact({0.0, 0.0}, point, tree.node(at->node).place - point).hit) continue;
      seen_last[owner] = triangle;
      ++seen[owner];
    }
  };
  const std::uint64_t stride = 1 + survey.triangles() / triangles_examined;
  for (TriangleId id = 0; id < survey.triangles(); id += stride) {
    const Triangle t = survey.triangle(id);
    const Vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]), middle = (t[0] + t[1] + t[2]) / 3.0;
    const double length = glm::length(normal);
    if (!(length > 0.0)) continue;
    for (const double side : {before, -before}) {
      const Vec3 point = middle + (side / length) * normal;
      const CellKey key = cell_of(point);
      for (int i = 0; i < 27; ++i)
        look_from({key[0] + i % 3 - 1, key[1] + i / 3 % 3 - 1, key[2] + i / 9 - 1}, point, id);
    }
  }
  return seen;
}

}  // namespace roam::training
