#pragma once
/// \file
/// The places of a component as a graph, and its basins, which are the rooms.

#include <cstdint>
#include <vector>

#include "training/places/places.h"

namespace roam::training {

/// A place of a component by its index in Component::nodes.
using Place = std::uint32_t;

struct PlaceEdge {
  float clearance = 0.0F;  ///< at its narrowest place, as far as known
  Place a = 0, b = 0;      ///< a < b
};

/// The places of a component, their clearances, and the edges between them.
struct PlaceGraph {
  std::vector<float> clearance;            ///< of each place
  std::vector<Vec3> where;                 ///< of each place
  std::vector<PlaceEdge> edges;            ///< by a, then b
  std::vector<std::vector<Place>> beside;  ///< neighbours of each place, ascending
  double spacing = 0.0;                    ///< m: the least distance of two neighbours; on foot, seen from above
};

/// Between places of clearance >= `radius`, an edge gets less clearance if a body of `radius` cannot go straight along
/// it.
[[nodiscard]] PlaceGraph place_graph(const Survey& survey, const ways::Measure& measure, const ways::WidestTree& tree,
                                     const Component& component, double radius);

/// The room of each place, numbered 0, 1, ... by their first place. Rooms are basins of the clearance, filled from the
/// wide to the narrow (watershed by flooding: Vincent & Soille, "Watersheds in digital spaces", 1991). Two basins stay
/// separate if both are rooms: see find_rooms.
[[nodiscard]] std::vector<std::uint32_t> find_basins(const PlaceGraph& graph, double radius);

}  // namespace roam::training
