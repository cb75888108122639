#pragma once
/// \file
/// Where in a scene a body can be, what belongs together, and where paths should lead.

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "roam/survey.h"
#include "ways/lattice/lattice.h"

namespace roam::training {

/// What a component is taken for; docs/training.md, "What is left out", has the rules.
enum class Verdict : std::uint8_t {
  inside,          ///< a part of the scene that is meant to be walked in
  backs,           ///< looks at the backs of triangles: outside of what is walked in, or within rock
  over_low_rooms,  ///< on top of what the body is too tall for
  on_top,          ///< of something: open to the sky over another component, or one falls from it into a larger one
  smaller,     ///< than another and open to the sky as it is, where windings cannot tell; or a scrap of a few places
  unfinished,  ///< not looked at whole, and without as much detail as another part: open country
};

/// "inside", "backs", "over low rooms", "on top", "smaller" or "unfinished".
[[nodiscard]] const char* to_string(Verdict verdict);

/// Places that hang together for a body of `narrowest`.
struct Component {
  ways::NodeId root = ways::no_node;
  std::vector<ways::NodeId> nodes;  ///< ascending
  double back_share = 0.0;          ///< of places from which most rays that hit something hit the backs of triangles
  double open_share = 0.0;          ///< of places from which most rays upwards meet nothing
  bool whole = true;                ///< false: ended early, by `most_places` or `goes_on`; it may go on, or join others
  bool inside = true;               ///< verdict == Verdict::inside
  Verdict verdict = Verdict::inside;
};

/// All components of the scene: sampled on its floors by area and by triangle (flying: in its box too), each grown
/// whole in `tree`, most places first, unfinished ones last. Each place that was reached is in one of them. At least
/// one is inside, where there is any but on top of rooms that are too low for the body. What only sees the backs of
/// triangles is left out where it is plain that the windings are right. `most_places`: no component is grown beyond so
/// many places, what is open to the sky not beyond as many as there are of what is closed, and all together not beyond
/// twice as many. `goes_on` is asked now and then with about how much of the work is done, in [0, 1]; false ends it
/// with what was found.
[[nodiscard]] std::vector<Component> find_components(const Survey& survey, const ways::Measure& measure,
                                                     ways::WidestTree& tree, std::uint64_t seed,
                                                     const std::function<bool(double)>& goes_on = {},
                                                     std::uint64_t most_places = 500'000);

/// Asks for the rooms of a component without naming a radius: see find_rooms.
inline constexpr double any_radius = std::numeric_limits<double>::infinity();

/// A part of a component in which a body moves freely.
struct Room {
  std::vector<ways::NodeId> nodes;      ///< ascending; each place of a component is in one room or one neck
  ways::NodeId widest = ways::no_node;  ///< its place of most clearance
};
/// What joins rooms and only a smaller body passes.
struct Neck {
  std::vector<ways::NodeId> nodes;   ///< ascending, not empty
  std::vector<std::uint32_t> rooms;  ///< that it touches, ascending, at least two
  double radius = 0.0;               ///< of the widest way through it between two of them, at lattice precision
};
struct Rooms {
  std::vector<Room> rooms;  ///< most places first
  std::vector<Neck> necks;  ///< widest first
  /// Rooms from which necks lead to one other room only.
  [[nodiscard]] std::size_t dead_ends() const;
};

/// The rooms of a component for a body of `radius`, and the necks between them. Connected places of clearance >=
/// `radius` are a room, whatever is narrow within; and so is what lies behind a neck of less than 0.8 of its own
/// clearance, even where all of it is less than `radius`. With `any_radius` only the second rule counts: rooms are
/// what comes apart when a body grows, at whatever radius that is.
///
/// A neck is where the basins of two rooms meet, with all of the passage to both sides that is farther than `radius`,
/// in sight, from where a body of `radius` can be (morphological opening: Serra, "Image Analysis and Mathematical
/// Morphology", 1982). Necks between the same rooms that lie within a body's width of each other are one.
[[nodiscard]] Rooms find_rooms(const Survey& survey, const ways::Measure& measure, const ways::WidestTree& tree,
                               const Component& component, double radius = any_radius);

/// Pairs of places between which paths are planned, joined by the tree's own way.
struct Ends {
  ways::NodeId from = ways::no_node, to = ways::no_node;
};

/// Draws `count` pairs (0: 5, or the dead ends where there are more), by `seed`: every room lies on the way between
/// two of them, as far as so many pairs can do that, and so does each neck that is the widest between its rooms. Each
/// end is at the widest place of its room within 2 m, or elsewhere in it where the way would else be narrowest before
/// it has left the room, or at its end. What is left over goes where no path has been yet. Empty when the component has
/// but one place.
[[nodiscard]] std::vector<Ends> draw_paths(const ways::WidestTree& tree, const Component& component, const Rooms& rooms,
                                           int count, std::uint64_t seed);

}  // namespace roam::training
