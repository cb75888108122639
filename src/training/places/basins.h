#pragma once
/// \file
/// The places of a component as a graph, and its basins: which room each place belongs to.

#include <cstdint>
#include <vector>

#include "training/places/places.h"

namespace roam::training {

/// A place of a component by its index in Component::nodes.
using Place = std::uint32_t;

struct PlaceEdge {
  float clearance = 0.0F;  ///< of the narrowest place along it, as far as is known
  Place a = 0, b = 0;      ///< a < b
};

/// What of a component the rooms are made of.
struct PlaceGraph {
  std::vector<float> clearance;            ///< of each place
  std::vector<Vec3> where;                 ///< of each place
  std::vector<PlaceEdge> edges;            ///< by a, then b
  std::vector<std::vector<Place>> beside;  ///< neighbours of each place, ascending
  double spacing = 0.0;                    ///< m: the least distance of two neighbours, seen from above on foot
};

/// Edges between places of clearance >= `radius` that a body of `radius` does not go along straight are given less.
[[nodiscard]] PlaceGraph place_graph(const Survey& survey, const ways::Measure& measure, const ways::WidestTree& tree,
                                     const Component& component, double radius);

/// The room of each place, numbered 0, 1, ... by their first place: basins of the clearance, as water would fill them
/// from the wide to the narrow (watershed by flooding: Vincent & Soille, "Watersheds in digital spaces", 1991), where
/// two basins stay apart when both are rooms: see find_rooms.
[[nodiscard]] std::vector<std::uint32_t> find_basins(const PlaceGraph& graph, double radius);

}  // namespace roam::training
