#pragma once
/// \file
/// Where in a scene a body can be, what belongs together, and where paths should lead.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "roam/survey.h"
#include "train/lattice.h"

namespace roam::training {

/// Places that hang together for a body of `narrowest`.
struct Component {
  NodeId root = no_node;
  std::vector<NodeId> nodes;
  double back_share = 0.0;  ///< of places from which most rays hit backs of triangles: outside, or within rock
  bool inside = true;       ///< taken for a part of the scene that is meant to be walked in
};

/// All components of the scene: sampled on its floors by area (flying: in its box), each grown whole in `tree`, most
/// places first. Which are outside is voted by component, where the triangles' windings can be trusted (shared edges
/// run both ways); else only the one with the most places is inside. docs/training.md has the rules.
[[nodiscard]] std::vector<Component> find_components(const Survey& survey, const Measure& measure, WidestTree& tree,
                                                     std::uint64_t seed,
                                                     const std::function<bool(double)>& goes_on = {});

/// A part of a component in which a body of `radius` moves freely.
struct Room {
  std::vector<NodeId> nodes;
  NodeId widest = no_node;  ///< its place of most clearance: where a path begins or ends
};
/// What joins rooms and only a smaller body passes.
struct Neck {
  std::vector<NodeId> nodes;
  std::vector<std::uint32_t> rooms;  ///< that it touches, ascending
  double radius = 0.0;               ///< of the widest way through it between two of them, at lattice precision
};
struct Rooms {
  std::vector<Room> rooms;
  std::vector<Neck> necks;
  [[nodiscard]] std::size_t dead_ends() const;  ///< rooms that one neck touches
};

/// Rooms are connected places of clearance >= `radius`; necks those in [narrowest, radius) farther than `radius`, in
/// sight, from any of them (morphological opening: Serra, "Image Analysis and Mathematical Morphology", 1982), or every
/// foot of a wall would be one. A dead end that only a smaller body enters is a room of its own.
[[nodiscard]] Rooms find_rooms(const Survey& survey, const Measure& measure, const WidestTree& tree,
                               const Component& component, double radius);

/// Pairs of places between which paths are planned: `count` of them (0: 5, or the dead ends where there are more),
/// every room on one of them and every neck crossed, drawn by `seed`. Each end is at the widest place within 2 m.
struct Ends {
  NodeId from = no_node, to = no_node;
};
[[nodiscard]] std::vector<Ends> draw_paths(const WidestTree& tree, const Component& component, const Rooms& rooms,
                                           int count, std::uint64_t seed);

}  // namespace roam::training
