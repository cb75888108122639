#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <tuple>
#include <vector>

#include "math/random.h"
#include "training/places/inside.h"

namespace roam::training {

namespace {

/// The number of examined edges, about. Edges are sampled by position, so that all triangles of an edge are included.
constexpr std::uint64_t edges_looked_at = 1'000'000;

using Key = std::array<double, 6>;  ///< both ends of an edge, the lesser first

struct Side {
  Key edge{};
  std::array<double, 3> third{};  ///< the triangle's other corner
  bool forward = false;           ///< runs from the lesser end to the greater
  auto operator<=>(const Side&) const = default;
};

bool before(const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

Side side_of(const Vec3& from, const Vec3& to, const Vec3& third) {
  Side side;
  side.forward = before(from, to);
  const Vec3& a = side.forward ? from : to;
  const Vec3& b = side.forward ? to : from;
  // Adding 0 makes -0 a 0.
  side.edge = {a.x + 0.0, a.y + 0.0, a.z + 0.0, b.x + 0.0, b.y + 0.0, b.z + 0.0};
  side.third = {third.x + 0.0, third.y + 0.0, third.z + 0.0};
  return side;
}

std::uint64_t hash(const Key& edge) {
  std::uint64_t h = 0;
  for (const double number : edge) h = mix(h ^ std::bit_cast<std::uint64_t>(number));
  return h;
}

/// The sampled sides of some triangles of a mesh.
std::vector<Side> sides(const Mesh& mesh, std::size_t begin, std::size_t end, std::uint64_t one_in) {
  std::vector<Side> all;
  for (std::size_t i = begin; i < end; ++i) {
    const Triangle t = mesh.triangle(i);
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Side side = side_of(t[k], t[(k + 1) % 3], t[(k + 2) % 3]);
      if (hash(side.edge) % one_in == 0) all.push_back(side);
    }
  }
  return all;
}

std::vector<Side> sides(const Survey& survey) {
  constexpr std::size_t block = 65'536;  // triangles
  const std::uint64_t one_in = 1 + 3 * survey.triangles() / edges_looked_at;
  std::vector<Side> all;
  for (const Mesh& mesh : survey.meshes()) {
    const std::size_t triangles = mesh.triangles.size();
    std::vector<std::vector<Side>> parts((triangles + block - 1) / block);
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
      parts[i] = sides(mesh, i * block, std::min(triangles, (i + 1) * block), one_in);
    });
    for (const std::vector<Side>& part : parts) all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace

double winding_share(const Survey& survey) {
  std::vector<Side> all = sides(survey);
  tbb::parallel_sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  std::uint64_t edges = 0, shared = 0, opposite = 0;
  for (std::size_t i = 0; i < all.size();) {
    std::size_t end = i;
    while (end < all.size() && all[end].edge == all[i].edge) ++end;
    ++edges;
    if (end - i >= 2) ++shared;
    if (end - i == 2 && all[i].forward != all[i + 1].forward && all[i].third != all[i + 1].third) ++opposite;
    i = end;
  }
  return 2 * shared < edges || edges == 0 ? 0.0 : static_cast<double>(opposite) / static_cast<double>(shared);
}

}  // namespace roam::training
