#pragma once
/// \file
/// What of a scene is meant to be walked in, told from what lies on top of it, behind it and within its walls.

#include <span>
#include <vector>

#include "training/places/places.h"

namespace roam::training {

/// What rays from a place in all directions meet.
struct Surroundings {
  bool backs = false;  ///< most that meet something meet the back of a triangle
  bool open = false;   ///< most of those upwards meet nothing
};
[[nodiscard]] Surroundings look_around(const Survey& survey, const Vec3& eye);

/// Where a body looks from: the middle of what is free over a place.
[[nodiscard]] Vec3 eye_over(const ways::Measure& measure, const ways::Node& node);

/// The share of shared edges along which the two triangles run opposite ways, as those of a surface with a front and a
/// back do. Edges of more than two triangles count as wrong, triangles that are there twice, the same way round, as
/// one. 0 where less than half of all edges are shared: then nothing is known.
[[nodiscard]] double winding_share(const Survey& survey);

/// Whether nearly all of them do.
[[nodiscard]] bool windings_can_be_trusted(const Survey& survey);

/// What looks at fronts is the outside of a scene that is wound the wrong way round, or lies within its walls, when it
/// has not one place to so many that look at backs. The streets of a city have more to what is within its blocks.
inline constexpr double reversed_ratio = 2.0;

/// So few places that a body can make no way.
[[nodiscard]] bool is_scrap(const Component& component);

/// How many of some triangles of the scene each component sees from beside them: one is what a scene is for when it
/// sees much of it.
[[nodiscard]] std::vector<std::size_t> surfaces_seen(const Survey& survey, const ways::WidestTree& tree,
                                                     std::span<const Component> components);

/// How many of some triangles of the floors are under the places of each component: where a scene is detailed is what
/// people come for.
[[nodiscard]] std::vector<std::size_t> floor_details(const Survey& survey, const ways::WidestTree& tree,
                                                     std::span<const Component> components);

/// Sets shares and verdicts of components, most places first, whose nodes are known. `trusted`: windings can be.
void judge(const Survey& survey, const ways::Measure& measure, const ways::WidestTree& tree, bool trusted,
           std::vector<Component>& components);

}  // namespace roam::training
