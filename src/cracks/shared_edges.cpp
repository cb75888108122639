#include "cracks/shared_edges.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <span>
#include <tuple>
#include <utility>

#include "math/random.h"

namespace roam::cracks {

namespace {

/// The side of an edge, from its lesser corner to its greater, on which the triangle lies in the plan.
enum Side : std::uint64_t { neither = 0, left = 1, right = 2 };

/// Floors of one block of work.
constexpr std::size_t block_floors = 16'384;

std::uint64_t hash_of(const Vec3& corner) { return hashed(corner + Vec3(0.0)); }  // -0 is 0

Side side_of(const Vec3& from, const Vec3& to, const Vec3& inner) {
  const bool forward = std::tie(from.x, from.y, from.z) < std::tie(to.x, to.y, to.z);
  const Vec3 &a = forward ? from : to, &b = forward ? to : from;
  const double turn = (b.x - a.x) * (inner.y - a.y) - (b.y - a.y) * (inner.x - a.x);
  return turn > 0.0 ? left : turn < 0.0 ? right : neither;
}

}  // namespace

SharedEdges::SharedEdges(const Survey& survey)
    : survey_(&survey), at_((survey.floor_triangles().size() + block_floors - 1) / block_floors) {}

std::size_t SharedEdges::pieces(int phase) const {
  constexpr std::array<bool, phases> by_block{true, false, true, false};
  if (by_block[static_cast<std::size_t>(phase)]) return at_.size();
  return phase == 1 ? 1 : parts;
}

void SharedEdges::run(int phase, std::size_t piece) {
  switch (phase) {
    case 0:
      return count(piece);
    case 1:
      return make_room();
    case 2:
      return each_edge(piece, [&](const Edge& edge) { edges_[at_[piece][part_of(edge)]++] = edge; });
    default:
      return mark(piece);
  }
}

std::vector<std::uint8_t> SharedEdges::take() {
  edges_ = {};
  at_ = {};
  return std::move(shared_);
}

/// Calls take(edge) with each edge of a block of floors.
template <class Take>
void SharedEdges::each_edge(std::size_t block, const Take& take) const {
  const auto floors = survey_->floor_triangles();
  const std::size_t end = std::min(floors.size(), (block + 1) * block_floors);
  for (std::size_t floor = block * block_floors; floor < end; ++floor) {
    const Triangle t = survey_->triangle(floors[floor]);
    const std::array<std::uint64_t, 3> corners{hash_of(t[0]), hash_of(t[1]), hash_of(t[2])};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      // Sums do not depend on the order of the corners.
      const std::uint64_t more = mix(corners[k]) + mix(corners[next]);
      take(Edge{corners[k] + corners[next], more >> 44, side_of(t[k], t[next], t[(k + 2) % 3]), 3 * floor + k});
    }
  }
}

std::size_t SharedEdges::part_of(const Edge& edge) {
  constexpr int shift = 64 - std::countr_zero(parts);
  return static_cast<std::size_t>(edge.hash >> shift);
}

void SharedEdges::count(std::size_t block) {
  at_[block].fill(0);
  each_edge(block, [&](const Edge& edge) { ++at_[block][part_of(edge)]; });
}

void SharedEdges::make_room() {
  const std::size_t floors = survey_->floor_triangles().size();
  edges_.resize(3 * floors);
  shared_.resize(floors);
  std::size_t begin = 0;
  for (std::size_t part = 0; part < parts; ++part) {
    begins_[part] = begin;
    for (std::array<std::size_t, parts>& counts : at_) begin += std::exchange(counts[part], begin);
  }
  begins_[parts] = begin;
}

void SharedEdges::mark(std::size_t part) {
  const std::span<Edge> edges(edges_.data() + begins_[part], edges_.data() + begins_[part + 1]);
  std::sort(edges.begin(), edges.end(),
            [](const Edge& a, const Edge& b) { return a.hash != b.hash ? a.hash < b.hash : a.number < b.number; });
  constexpr std::size_t most_compared = 8;  // edges with one hash; more occur only in damaged meshes
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = i + 1; j < edges.size() && j - i <= most_compared && edges[j].hash == edges[i].hash; ++j) {
      if (!edges[i].is_same(edges[j]) || (edges[i].side | edges[j].side) != (left | right)) continue;
      for (const std::size_t e : {i, j})
        std::atomic_ref(shared_[edges[e].number / 3])
            .fetch_or(static_cast<std::uint8_t>(1u << (edges[e].number % 3)), std::memory_order_relaxed);
    }
  }
}

}  // namespace roam::cracks
