#include "train/cracks/shared_edges.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <span>
#include <tuple>
#include <utility>

namespace roam::training {

namespace {

/// Of an edge, told from others by 84 bits of a hash of its corners: looking the corners up again would be most of the
/// work, for what shares an edge lies anywhere in memory.
struct Edge {
  std::uint64_t hash;
  std::uint64_t more_hash : 20, side : 2, number : 42;  ///< 3 * floor + corner
  [[nodiscard]] bool is_same(const Edge& other) const { return hash == other.hash && more_hash == other.more_hash; }
};

/// On which side of an edge, from its lesser corner to its greater, the triangle lies in the plan.
enum Side : std::uint64_t { neither = 0, left = 1, right = 2 };

/// Edges are compared within parts that fit into a core's cache.
constexpr std::size_t parts = 512;
constexpr int part_shift = 64 - std::countr_zero(parts);
/// Floors that are gone through together.
constexpr std::size_t block = 16'384;

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

Side side_of(const Vec3& from, const Vec3& to, const Vec3& inner) {
  const bool forward = std::tie(from.x, from.y, from.z) < std::tie(to.x, to.y, to.z);
  const Vec3 &a = forward ? from : to, &b = forward ? to : from;
  const double turn = (b.x - a.x) * (inner.y - a.y) - (b.y - a.y) * (inner.x - a.x);
  return turn > 0.0 ? left : turn < 0.0 ? right : neither;
}

/// Calls take(edge) with each edge of some floors.
template <class Take>
void each_edge(const Survey& survey, std::size_t begin, std::size_t end, const Take& take) {
  for (std::size_t floor = begin; floor < end; ++floor) {
    const Triangle t = survey.triangle(survey.floor_triangles()[floor]);
    const std::array<std::uint64_t, 3> corners{hash_of(t[0]), hash_of(t[1]), hash_of(t[2])};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      // Sums: either order of the corners.
      const std::uint64_t more = mixed(corners[k]) + mixed(corners[next]);
      take(Edge{corners[k] + corners[next], more >> 44, side_of(t[k], t[next], t[(k + 2) % 3]), 3 * floor + k});
    }
  }
}

std::size_t part_of(const Edge& edge) { return static_cast<std::size_t>(edge.hash >> part_shift); }

/// All edges, by their parts: those of part i end at ends[i].
std::vector<Edge> in_parts(const Survey& survey, std::array<std::size_t, parts>& ends) {
  const std::size_t floors = survey.floor_triangles().size(), blocks = (floors + block - 1) / block;
  std::vector<std::array<std::size_t, parts>> at(blocks);
  const auto of_block = [&](std::size_t i, const auto& take) {
    each_edge(survey, i * block, std::min(floors, (i + 1) * block), take);
  };
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t i) {
    at[i].fill(0);
    of_block(i, [&](const Edge& edge) { ++at[i][part_of(edge)]; });
  });
  std::size_t begin = 0;
  for (std::size_t part = 0; part < parts; ++part) {
    for (std::array<std::size_t, parts>& counts : at) begin += std::exchange(counts[part], begin);
    ends[part] = begin;
  }
  std::vector<Edge> edges(3 * floors);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t i) {
    of_block(i, [&](const Edge& edge) { edges[at[i][part_of(edge)]++] = edge; });
  });
  return edges;
}

/// Marks what is shared of some edges, in any order.
void mark_shared(std::span<Edge> edges, std::vector<std::uint8_t>& shared) {
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return a.hash != b.hash ? a.hash < b.hash : a.number < b.number; });
  constexpr std::size_t most_compared = 8;  // of edges with one hash: more meet only in damaged meshes
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size() && j - i <= most_compared && edges[j].hash == edges[i].hash; ++j) {
      if (!edges[i].is_same(edges[j]) || (edges[i].side | edges[j].side) != (left | right)) continue;
      for (const std::size_t e : {i, j})
        std::atomic_ref(shared[edges[e].number / 3])
            .fetch_or(static_cast<std::uint8_t>(1u << (edges[e].number % 3)), std::memory_order_relaxed);
    }
  }
}

}  // namespace

std::vector<std::uint8_t> shared_edges(const Survey& survey) {
  std::array<std::size_t, parts> ends{};
  std::vector<Edge> edges = in_parts(survey, ends);
  std::vector<std::uint8_t> shared(survey.floor_triangles().size());
  tbb::parallel_for(std::size_t{0}, parts, [&](std::size_t part) {
    const std::size_t begin = part == 0 ? 0 : ends[part - 1];
    mark_shared({edges.data() + begin, ends[part] - begin}, shared);
  });
  return shared;
}

}  // namespace roam::training
