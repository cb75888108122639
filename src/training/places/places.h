#pragma once
/// \file
/// The places of a scene where a body can be, the components and rooms that they form, and the ends of paths.

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "roam/survey.h"
#include "ways/lattice/lattice.h"

namespace roam::training {

/// Classification of a component; docs/training.md, "What is left out", has the rules.
enum class Verdict : std::uint8_t {
  inside,          ///< a part of the scene to walk in
  backs,           ///< looks at the backs of triangles: outside the walkable part, or within rock
  over_low_rooms,  ///< on top of rooms that are too low for the body
  on_top,          ///< open to the sky over another component, or bodies fall from it into a larger one
  smaller,         ///< smaller than another one, if windings are not trusted; or a scrap of a few places
  unfinished,      ///< not explored whole, and less detailed than another part: open country
};

/// Places connected for a body of `narrowest`.
struct Component {
  ways::NodeId root = ways::no_node;
  std::vector<ways::NodeId> nodes;  ///< ascending
  double back_share = 0.0;          ///< of places where most rays that hit anything hit the backs of triangles
  double open_share = 0.0;          ///< of places where most upward rays hit nothing
  bool whole = true;                ///< false: ended early, by `most_places` or `goes_on`; it may go on, or join others
  bool inside = true;               ///< verdict == Verdict::inside
  Verdict verdict = Verdict::inside;
};

/// All components of the scene: sampled on its floors by area and by triangle (when flying, in its box too). Each is
/// grown whole in `tree`. Largest first, unfinished ones last. Each reached place is in one component. At least one is
/// inside, unless all are on top of rooms too low for the body. Components that see only backs of triangles are left
/// out if the windings are clearly right.
///
/// `most_places` limits each component. Open ground may not have more places than the closed components, and all
/// components together not more than twice the limit. Calls `goes_on` now and then with about the fraction of work
/// done; false ends the search with the components found.
[[nodiscard]] std::vector<Component> find_components(const Survey& survey, const ways::Measure& measure,
                                                     ways::WidestTree& tree, std::uint64_t seed,
                                                     const std::function<bool(double)>& goes_on = {},
                                                     std::uint64_t most_places = 500'000);

/// As `radius` of find_rooms: no particular radius.
inline constexpr double any_radius = std::numeric_limits<double>::infinity();

/// A part of a component in which a body moves freely.
struct Room {
  std::vector<ways::NodeId> nodes;      ///< ascending; each place of a component is in one room or in one neck
  ways::NodeId widest = ways::no_node;  ///< its place of most clearance
};
/// A passage between rooms that only a smaller body passes.
struct Neck {
  std::vector<ways::NodeId> nodes;   ///< ascending, not empty
  std::vector<std::uint32_t> rooms;  ///< the rooms that it touches, ascending, at least two
  double radius = 0.0;               ///< of the widest way through it between two of them, at lattice precision
};
struct Rooms {
  std::vector<Room> rooms;  ///< most places first
  std::vector<Neck> necks;  ///< widest first
  /// The number of rooms whose necks lead to one other room only.
  [[nodiscard]] std::size_t dead_ends() const;
};

/// The rooms of a component for a body of `radius`, and the necks between them. Connected places of clearance >=
/// `radius` form a room, even with narrow places inside. So do places behind a neck of less than 0.8 of their own
/// clearance, even if all of them are narrower than `radius`. With `any_radius` only the second rule applies: rooms are
/// the parts that separate as a body grows, at any radius.
///
/// A neck is where the basins of two rooms meet. It includes the passage on both sides as far as it is more than
/// `radius`, in sight, from places for a body of `radius` (morphological opening: Serra, "Image Analysis and
/// Mathematical Morphology", 1982). Necks between the same rooms that lie within a body's width of each other are one.
[[nodiscard]] Rooms find_rooms(const Survey& survey, const ways::Measure& measure, const ways::WidestTree& tree,
                               const Component& component, double radius = any_radius);

/// The ends of a path, which follows the tree's own way between them.
struct Ends {
  ways::NodeId from = ways::no_node, to = ways::no_node;
};

/// Draws `count` pairs by `seed`. 0: 5 pairs, or as many as there are dead ends if that is more. As far as that number
/// allows, every room lies on a way, and so does each neck that is the widest between its rooms. Each end is at the
/// widest place of its room within 2 m. It lies elsewhere in the room if the way would be narrowest at that end or
/// before it leaves the room. Further pairs lead where no path has been yet. Empty if the component has only one place.
[[nodiscard]] std::vector<Ends> draw_paths(const ways::WidestTree& tree, const Component& component, const Rooms& rooms,
                                           int count, std::uint64_t seed);

}  // namespace roam::training
