#include <cmath>

#include "training/places/columns.h"
#include "training/places/inside.h"

namespace roam::training {
namespace {

/// m: side of the columns for looking up places, and the largest difference in height between a place and a triangle.
constexpr double column = 0.3;
/// The number of examined triangles, about.
constexpr std::size_t triangles_examined = 10'000;

}  // namespace

std::vector<std::size_t> floor_details(const Survey& survey, const ways::WidestTree& tree,
                                       std::span<const Component> components) {
  Columns places{column};
  for (std::uint32_t i = 0; i < components.size(); ++i)
    for (const ways::NodeId node : components[i].nodes) places.add(tree.node(node).place, i);
  const auto ids = survey.floor_triangles();
  const std::size_t step = 1 + ids.size() / triangles_examined;
  std::vector<std::size_t> counts(components.size(), 0), counted(components.size(), ids.size());
  for (std::size_t i = 0; i < ids.size(); i += step) {
    const Triangle t = survey.triangle(ids[i]);
    const Vec3 middle = (t[0] + t[1] + t[2]) / 3.0;
    (void)places.any(middle, 0, [&](const auto& e) {
      if (std::abs(e.z - middle.z) <= column && counted[e.owner] != i) {
        counted[e.owner] = i;
        ++counts[e.owner];
      }
      return false;
    });
  }
  return counts;
}

}  // namespace roam::training
