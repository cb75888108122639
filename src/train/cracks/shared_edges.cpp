#include "train/cracks/shared_edges.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <atomic>
#include <bit>

namespace roam::training {

namespace {

struct Edge {
  std::uint64_t hash;
  std::uint64_t number;  ///< 3 * floor + corner
};

/// The finalizer of splitmix64 (Steele, Lea & Flood, 2014).
std::uint64_t mixed(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xBF58476D1CE4E5B9ULL;
  bits = (bits ^ (bits >> 27)) * 0x94D049BB133111EBULL;
  return bits ^ (bits >> 31);
}

std::uint64_t hash_of(const Vec3& corner) {
  std::uint64_t hash = 0x9E3779B97F4A7C15ULL;
  for (int k = 0; k < 3; ++k) hash = mixed(hash + std::bit_cast<std::uint64_t>(corner[k] + 0.0));  // -0 is 0
  return hash;
}

struct Side {
  Vec3 a, b, inner;
};

Side side_of(const Survey& survey, std::uint64_t number) {
  const Triangle t = survey.triangle(survey.floor_triangles()[number / 3]);
  const std::size_t k = number % 3;
  return {t[k], t[(k + 1) % 3], t[(k + 2) % 3]};
}

bool are_opposite(const Side& p, const Side& q) {
  if (!((p.a == q.a && p.b == q.b) || (p.a == q.b && p.b == q.a))) return false;
  const auto turn = [&](const Vec3& inner) {
    return (p.b.x - p.a.x) * (inner.y - p.a.y) - (p.b.y - p.a.y) * (inner.x - p.a.x);
  };
  const double of_p = turn(p.inner), of_q = turn(q.inner);
  return (of_p > 0.0 && of_q < 0.0) || (of_p < 0.0 && of_q > 0.0);
}

}  // namespace

std::vector<std::uint8_t> shared_edges(const Survey& survey) {
  const std::size_t floors = survey.floor_triangles().size();
  std::vector<Edge> edges(3 * floors);
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t i) {
    const Side side = side_of(survey, i);
    edges[i] = {hash_of(side.a) + hash_of(side.b), i};  // a sum: either order of the corners
  });
  tbb::parallel_sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.hash != b.hash ? a.hash < b.hash : a.number < b.number;
  });
  constexpr std::size_t most_compared = 8;  // of edges with one hash: more meet only in damaged meshes
  std::vector<std::uint8_t> shared(floors);
  tbb::parallel_for(std::size_t{0}, edges.size(), [&](std::size_t i) {
    if (i + 1 == edges.size() || edges[i + 1].hash != edges[i].hash) return;
    const Side side = side_of(survey, edges[i].number);
    for (std::size_t j = i + 1; j < edges.size() && j - i <= most_compared && edges[j].hash == edges[i].hash; ++j) {
      if (!are_opposite(side, side_of(survey, edges[j].number))) continue;
      for (const std::size_t e : {i, j})
        std::atomic_ref(shared[edges[e].number / 3])
            .fetch_or(static_cast<std::uint8_t>(1u << (edges[e].number % 3)), std::memory_order_relaxed);
    }
  });
  return shared;
}

}  // namespace roam::training
