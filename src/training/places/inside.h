#pragma once
/// \file
/// The parts of a scene to walk in, judged by surfaces above, behind and around them.

#include <span>
#include <vector>

#include "training/places/places.h"

namespace roam::training {

/// Summary of rays from a place in all directions.
struct Surroundings {
  bool backs = false;  ///< most rays that hit anything hit the back of a triangle
  bool open = false;   ///< most upward rays hit nothing
};
[[nodiscard]] Surroundings look_around(const Survey& survey, const Vec3& eye);

/// The eye of a body at a place: the middle of the free height above it.
[[nodiscard]] Vec3 eye_over(const ways::Measure& measure, const ways::Node& node);

/// The share of shared edges whose two triangles run along them in opposite directions, as in a surface with a front
/// and a back. Edges of more than two triangles count as wrong; duplicate triangles with the same winding count as one.
/// 0 if less than half of all edges are shared: then nothing is known.
[[nodiscard]] double winding_share(const Survey& survey);

/// Whether winding_share() is at least 0.9.
[[nodiscard]] bool windings_can_be_trusted(const Survey& survey);

/// Windings are reversed if the places that look at backs are more than this many times those that look at fronts. Then
/// the fronts face outside, or into the walls. In a city the streets have a larger share of the places than that.
inline constexpr double reversed_ratio = 2.0;

/// Whether a component has too few places for a path.
[[nodiscard]] bool is_scrap(const Component& component);

/// For each component, the number of sampled triangles of the scene that it sees from nearby. A component that sees
/// much of the scene is an important part of it.
[[nodiscard]] std::vector<std::size_t> surfaces_seen(const Survey& survey, const ways::WidestTree& tree,
                                                     std::span<const Component> components);

/// For each component, the number of sampled floor triangles under its places. Detailed parts of a scene are the
/// important ones.
[[nodiscard]] std::vector<std::size_t> floor_details(const Survey& survey, const ways::WidestTree& tree,
                                                     std::span<const Component> components);

/// Sets the shares and verdicts of components. They must be sorted by size, largest first, with known nodes. `trusted`:
/// whether windings can be trusted.
void judge(const Survey& survey, const ways::Measure& measure, const ways::WidestTree& tree, bool trusted,
           std::vector<Component>& components);

}  // namespace roam::training
