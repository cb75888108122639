#pragma once
// Checks of made scenes: closed surfaces, promised counts, areas, distances. Brute force in doubles; the tested
// distances are centimetres, far above their rounding.

#include <gtest/gtest.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "roam/generate.h"

namespace roam::generate {

inline Vec3 crossed(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double dotted(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double length_of(const Vec3& a) { return std::sqrt(dotted(a, a)); }

inline Box box_of(const std::vector<Mesh>& meshes) {
  Box box;
  for (const Mesh& m : meshes) {
    for (const Vec3& p : m.vertices) box.include(p);
  }
  return box;
}

/// Everything in the scene: names, coordinates, indices.
inline std::uint64_t hash_of(const Scene& scene) {
  XXH3_state_t* state = XXH3_createState();
  XXH3_64bits_reset(state);
  scene.stream([&](const Mesh& m) {
    XXH3_64bits_update(state, m.name.data(), m.name.size());
    XXH3_64bits_update(state, m.vertices.data(), m.vertices.size() * sizeof(Vec3));
    XXH3_64bits_update(state, m.triangles.data(), m.triangles.size() * sizeof m.triangles[0]);
  });
  const std::uint64_t h = XXH3_64bits_digest(state);
  XXH3_freeState(state);
  return h;
}

/// Checks counts, box, size of the pieces and names, and that all vertices are finite and used.
inline void expect_promises_kept(const Scene& scene) {
  std::uint64_t triangles = 0, vertices = 0, objects = 0;
  std::set<std::string> names;
  Box box;
  scene.stream([&](const Mesh& m) {
    triangles += m.triangles.size();
    vertices += m.vertices.size();
    ++objects;
    EXPECT_GT(m.triangles.size(), 0u) << m.name;
    EXPECT_LE(m.triangles.size(), piece_triangles) << m.name;
    EXPECT_FALSE(m.name.empty());
    EXPECT_TRUE(names.insert(m.name).second) << m.name;
    std::vector<char> used(m.vertices.size());
    for (const auto& t : m.triangles) {
      for (const std::uint32_t i : t) {
        ASSERT_LT(i, m.vertices.size());
        used[i] = 1;
      }
    }
    EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0) << m.name;
    for (const Vec3& p : m.vertices) {
      ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << m.name;
      box.include(p);
    }
  });
  EXPECT_EQ(triangles, scene.triangles());
  EXPECT_EQ(vertices, scene.vertices());
  EXPECT_EQ(objects, scene.objects());
  const Box promised = scene.bounds();
  for (int k = 0; k < 3; ++k) {
    EXPECT_GE(box.lower[k], promised.lower[k]);
    EXPECT_LE(box.upper[k], promised.upper[k]);
  }
}

struct BitwiseHash {
  std::size_t operator()(const Vec3& p) const { return XXH3_64bits(&p, sizeof p); }
};

/// Directed edges between vertices that are equal bit by bit, over all meshes, with the number of each.
struct Edges {
  std::unordered_map<Vec3, std::uint32_t, BitwiseHash> ids;
  std::vector<Vec3> points;
  std::unordered_map<std::uint64_t, int> directed;

  explicit Edges(const std::vector<Mesh>& meshes) {
    for (const Mesh& m : meshes) {
      std::vector<std::uint64_t> id(m.vertices.size());
      for (std::size_t i = 0; i < id.size(); ++i) {
        const auto [at, fresh] = ids.try_emplace(m.vertices[i], static_cast<std::uint32_t>(points.size()));
        if (fresh) points.push_back(m.vertices[i]);
        id[i] = at->second;
      }
      for (const auto& t : m.triangles) {
        for (std::size_t k = 0; k < 3; ++k) ++directed[id[t[k]] << 32 | id[t[(k + 1) % 3]]];
      }
    }
  }
  [[nodiscard]] bool matched(std::uint64_t edge, int times) const {
    const auto back = directed.find(edge << 32 | edge >> 32);
    return times == 1 && back != directed.end() && back->second == 1;
  }
};

/// The number of edges that do not belong to exactly two triangles with opposite directions: 0 for a closed,
/// consistently wound surface.
inline std::size_t unmatched_edges(const std::vector<Mesh>& meshes) {
  const Edges edges(meshes);
  EXPECT_FALSE(edges.directed.empty());
  return static_cast<std::size_t>(std::count_if(edges.directed.begin(), edges.directed.end(),
                                                [&](const auto& e) { return !edges.matched(e.first, e.second); }));
}

/// The ends of the edges that are not matched.
inline std::vector<Vec3> open_rim(const std::vector<Mesh>& meshes) {
  const Edges edges(meshes);
  std::vector<Vec3> rim;
  for (const auto& [edge, times] : edges.directed) {
    if (edges.matched(edge, times)) continue;
    rim.push_back(edges.points[edge >> 32]);
    rim.push_back(edges.points[edge & 0xffffffffu]);
  }
  return rim;
}

/// Enclosed volume, m^3: positive if wound to be seen from outside.
inline double volume(const std::vector<Mesh>& meshes) {
  const Vec3 center = box_of(meshes).center();
  double sum = 0.0;
  for (const Mesh& m : meshes) {
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
      const Triangle t = m.triangle(i);
      sum += dotted(t[0] - center, crossed(t[1] - center, t[2] - center)) / 6.0;
    }
  }
  return sum;
}

inline double least_area(const Mesh& m) {
  double least = 1e9;
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    const Triangle t = m.triangle(i);
    least = std::min(least, 0.5 * length_of(crossed(t[1] - t[0], t[2] - t[0])));
  }
  return least;
}

inline double point_segment_distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double t = std::clamp(dotted(p - a, d) / dotted(d, d), 0.0, 1.0);
  return length_of(p - a - d * t);
}

inline double segment_segment_distance(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) {
  // Alternating projection converges for a convex function of two parameters. The ends are tried too.
  const Vec3 u = q - p, v = b - a;
  double s = 0.5, t = 0.5;
  for (int i = 0; i < 40; ++i) {
    t = std::clamp(dotted(p + u * s - a, v) / dotted(v, v), 0.0, 1.0);
    s = std::clamp(dotted(a + v * t - p, u) / dotted(u, u), 0.0, 1.0);
  }
  return std::min({length_of(p + u * s - a - v * t), point_segment_distance(p, a, b), point_segment_distance(q, a, b),
                   point_segment_distance(a, p, q), point_segment_distance(b, p, q)});
}

/// Whether the segment pq pierces the triangle.
inline bool pierces(const Vec3& p, const Vec3& q, const Triangle& t) {
  const Vec3 n = crossed(t[1] - t[0], t[2] - t[0]);
  const double a = dotted(n, p - t[0]), b = dotted(n, q - t[0]);
  if (a * b > 0.0 || a == b) return false;
  const Vec3 x = p + (q - p) * (a / (a - b));
  for (std::size_t k = 0; k < 3; ++k) {
    if (dotted(n, crossed(t[(k + 1) % 3] - t[k], x - t[k])) < 0.0) return false;
  }
  return true;
}

/// The number of triangles that the segment pq pierces.
inline int crossings(const std::vector<Mesh>& meshes, const Vec3& p, const Vec3& q) {
  int n = 0;
  for (const Mesh& m : meshes) {
    for (std::size_t i = 0; i < m.triangles.size(); ++i) n += pierces(p, q, m.triangle(i));
  }
  return n;
}

/// Distance of the segment pq from the nearest triangle of the mesh, at most `reach`.
inline double clearance_of_segment(const Mesh& m, const Vec3& p, const Vec3& q, double reach) {
  double least = reach;
  for (std::size_t i = 0; i < m.triangles.size(); ++i) {
    const Triangle t = m.triangle(i);
    const Vec3 middle = (t[0] + t[1] + t[2]) / 3.0;
    const double size = std::max({length_of(t[0] - middle), length_of(t[1] - middle), length_of(t[2] - middle)});
    if (point_segment_distance(middle, p, q) > least + size) continue;
    if (pierces(p, q, t)) return 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      least = std::min(least, segment_segment_distance(p, q, t[k], t[(k + 1) % 3]));
    }
    for (const Vec3& end : {p, q}) {
      const Vec3 n = crossed(t[1] - t[0], t[2] - t[0]);
      const double h = dotted(n, end - t[0]) / length_of(n);
      if (pierces(end, end - n * (2.0 * h / length_of(n)), t)) least = std::min(least, std::fabs(h));
    }
  }
  return least;
}

/// Height of the first triangle straight below a point.
inline double floor_under(const std::vector<Mesh>& meshes, const Vec3& p) {
  constexpr double depth = 100.0;
  double highest = -1e9;
  for (const Mesh& m : meshes) {
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
      const Triangle t = m.triangle(i);
      if (!pierces(p, p - Vec3{0.0, 0.0, depth}, t)) continue;
      const Vec3 n = crossed(t[1] - t[0], t[2] - t[0]);
      highest = std::max(highest, p.z - dotted(n, p - t[0]) / n.z);
    }
  }
  return highest;
}

}  // namespace roam::generate
