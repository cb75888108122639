#include "training/places/basins.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "math/disjoint_sets.h"
#include "math/level_distance.h"

namespace roam::training {

namespace {

/// A room's neck is narrower than this share of the room's own clearance.
constexpr double neck_share = 0.8;
/// Places wider than its neck that a room needs; a group with fewer is a niche.
constexpr std::uint32_t least_places = 4;
/// m2: the least area of the places in a room; a room of 1 m2 has 0.8.
constexpr double least_area = 0.5;

}  // namespace

PlaceGraph place_graph(const Survey& survey, const ways::Measure& measure, const ways::WidestTree& tree,
                       const Component& component, double radius) {
  PlaceGraph graph;
  const std::vector<ways::NodeId>& nodes = component.nodes;
  graph.clearance.reserve(nodes.size());
  graph.where.reserve(nodes.size());
  for (const ways::NodeId id : nodes) {
    graph.clearance.push_back(tree.node(id).clearance);
    graph.where.push_back(tree.node(id).place);
  }
  graph.beside.resize(nodes.size());
  std::vector<Place> place_of(tree.size(), ~Place(0));
  for (Place p = 0; p < nodes.size(); ++p) place_of[nodes[p]] = p;
  graph.spacing = std::numeric_limits<double>::infinity();
  for (Place a = 0; a < nodes.size(); ++a) {
    for (const ways::NodeId neighbour : tree.neighbours(nodes[a])) {
      const Place b = place_of[neighbour];
      if (b == ~Place(0)) continue;
      graph.beside[a].push_back(b);
      if (b < a) continue;
      graph.edges.push_back({std::min(graph.clearance[a], graph.clearance[b]), a, b});
      const double apart = measure.mode == Mode::walk ? level_distance(graph.where[a], graph.where[b])
                                                      : glm::length(graph.where[a] - graph.where[b]);
      graph.spacing = std::min(graph.spacing, apart);
    }
    std::sort(graph.beside[a].begin(), graph.beside[a].end());
  }
  if (graph.edges.empty()) graph.spacing = 0.0;
  // A thin wall with an opening may lie between two lattice lines. Then both ends of an edge have more clearance than
  // the opening.
  const float narrower = std::nextafter(static_cast<float>(radius), 0.0F);
  tbb::parallel_for(std::size_t{0}, graph.edges.size(), [&](std::size_t i) {
    PlaceEdge& edge = graph.edges[i];
    const Vec3& from = graph.where[edge.a];
    const Vec3& to = graph.where[edge.b];
    if (edge.clearance < radius) return;
    // Clearance changes by at most the distance moved.
    const double ends = double(graph.clearance[edge.a]) + double(graph.clearance[edge.b]);
    if (ends - glm::length(to - from) >= 2.0 * radius) return;
    if (!goes_straight(survey, measure, from, to, radius)) edge.clearance = std::min(edge.clearance, narrower);
  });
  return graph;
}

namespace {

/// Places connected above some clearance.
struct Pool {
  float widest = 0.0F;
  std::uint32_t places = 1;
  bool rooms = false;  ///< contains rooms that are already separate, so it stays a room
};

class Flood {
 public:
  Flood(const PlaceGraph& graph, double radius)
      : radius_(radius), connected_(graph.where.size()), room_(graph.where.size()) {
    for (const float clearance : graph.clearance) pools_.push_back({clearance, 1, false});
  }

  void join(const PlaceEdge& edge) {
    const std::uint32_t a = connected_.find(edge.a), b = connected_.find(edge.b);
    if (a == b) return;
    const Pool& pool_a = pools_[a];
    const Pool& pool_b = pools_[b];
    const bool a_stays = is_room(pool_a, edge.clearance), b_stays = is_room(pool_b, edge.clearance);
    Pool both;
    both.places = pool_a.places + pool_b.places;
    both.rooms = pool_a.rooms || pool_b.rooms || (a_stays && b_stays);
    if (a_stays == b_stays)
      both.widest = std::max(pool_a.widest, pool_b.widest);
    else
      both.widest = a_stays ? pool_a.widest : pool_b.widest;
    if (!(a_stays && b_stays)) room_.unite(edge.a, edge.b);
    connected_.unite(a, b);
    pools_[connected_.find(a)] = both;
  }

  /// Joins basins of fewer than `least` places with the neighbour behind the widest neck. The edges must be sorted
  /// widest first.
  void fill_small(std::span<const PlaceEdge> edges, double least) {
    std::vector<std::uint32_t> places(room_.size(), 0);
    for (std::uint32_t i = 0; i < room_.size(); ++i) ++places[room_.find(i)];
    for (const PlaceEdge& edge : edges) {
      const std::uint32_t a = room_.find(edge.a), b = room_.find(edge.b);
      if (a == b || double(std::min(places[a], places[b])) >= least) continue;
      room_.unite(a, b);
      places[room_.find(a)] = places[a] + places[b];
    }
  }

  [[nodiscard]] std::vector<std::uint32_t> rooms() {
    std::vector<std::uint32_t> number(room_.size());
    std::uint32_t next = 0;
    for (std::uint32_t i = 0; i < room_.size(); ++i) {
      // A set's name is its least member, which is already numbered.
      const std::uint32_t set = room_.find(i);
      number[i] = set == i ? next++ : number[set];
    }
    return number;
  }

 private:
  /// Whether a pool is a room that stays separate from another pool at a clearance of `neck`.
  [[nodiscard]] bool is_room(const Pool& pool, double neck) const {
    if (pool.rooms) return neck < radius_;
    if (neck >= radius_ || pool.places < least_places) return false;
    return pool.widest >= radius_ || neck < neck_share * double(pool.widest);
  }

  double radius_;
  DisjointSets connected_, room_;
  std::vector<Pool> pools_;  ///< of each set of connected_, by the set's name
};

}  // namespace

std::vector<std::uint32_t> find_basins(const PlaceGraph& graph, double radius) {
  std::vector<PlaceEdge> edges = graph.edges;
  std::stable_sort(edges.begin(), edges.end(),
                   [](const PlaceEdge& a, const PlaceEdge& b) { return a.clearance > b.clearance; });
  Flood flood(graph, radius);
  for (const PlaceEdge& edge : edges) flood.join(edge);
  const double cell = graph.spacing * graph.spacing;
  if (cell > 0.0) flood.fill_small(edges, least_area / cell);
  return flood.rooms();
}

}  // namespace roam::training
