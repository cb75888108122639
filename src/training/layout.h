#pragma once
/// \file
/// The trained part of a scene: its components, their rooms, and the paths planned through them.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "roam/train.h"
#include "training/places/places.h"
#include "training/stages.h"
#include "ways/lattice/lattice.h"
#include "ways/trials/trials.h"

namespace roam::training {

struct PlannedPath {
  Ends ends;
  Passage passage;                   ///< between them, refined
  bool is_widest = true;             ///< false: planned around a place where a walker was stopped
  std::optional<Trial> walked = {};  ///< the last walker that passed along the passage
};

/// A planned way that no walker completed.
struct Unwalked {
  Ends ends;
  Vec3 from{0.0}, to{0.0};  ///< of the feet
  Trial last;               ///< the last one on this way
  Vec3 end{0.0};            ///< its end, of the feet
};

struct Layout {
  ways::Measure measure;
  ways::WidestTree tree;
  std::vector<Component> components;  ///< those that are trained
  std::vector<Rooms> rooms;           ///< of each
  std::vector<ConnectedPart> parts;   ///< the trained ones, then the others with the reason
  std::vector<PlannedPath> paths;
  std::size_t uncertain = 0;       ///< planned ways that no body is certified for; not among the paths
  std::vector<Unwalked> unwalked;  ///< not among the paths either
};

/// The Measure and BodyKind of a training.
[[nodiscard]] ways::Measure measure_of(const TrainOptions& options);
[[nodiscard]] ways::BodyKind kind_of(const Survey& survey, const TrainOptions& options);

/// The refined way between two places of a component.
[[nodiscard]] Passage plan_path(const Survey& survey, const Layout& layout, double spacing, const Ends& ends);

/// The same along places of the lattice.
[[nodiscard]] Passage plan_along(const Survey& survey, const Layout& layout, double spacing,
                                 std::span<const ways::NodeId> nodes);

/// Finds components, rooms and paths. If `stages` ends it, returns what was found so far.
[[nodiscard]] Layout lay_out(const Survey& survey, const TrainOptions& options, Stages& stages);

/// Whether bodies reach a place of the floor: it lies within the clearance of a place of `components` at its level, or
/// hardly more than a spacing beside one.
class ReachedFloor {
 public:
  /// `survey` and `layout` must outlive it.
  ReachedFloor(const Survey& survey, const Layout& layout, double spacing, std::span<const Component> components);
  [[nodiscard]] bool operator()(const Vec3& foot) const { return near(foot) != ways::no_node; }
  /// The nearest place that reaches `foot`; no_node if none does.
  [[nodiscard]] ways::NodeId near(const Vec3& foot) const { return nearest(foot, false); }
  /// Whether no wall lies between such a place and `foot` at knee height. Nearby floor may be behind a thin wall.
  [[nodiscard]] bool in_sight(const Vec3& foot) const { return nearest(foot, true) != ways::no_node; }

 private:
  struct Cell {
    std::int64_t x, y;
    ways::NodeId node;
  };
  [[nodiscard]] std::int64_t cell(double at) const;
  [[nodiscard]] ways::NodeId nearest(const Vec3& foot, bool in_sight) const;
  /// Whether no wall lies between a lattice place and a place of the floor, as in sees_at_knee().
  [[nodiscard]] bool sees(const Vec3& place, const Vec3& foot) const;

  const Survey* survey_;
  const ways::WidestTree* tree_;
  double side_, beside_, level_, knee_, narrowest_;
  std::vector<Cell> cells_;  ///< sorted by x, y, node
};

}  // namespace roam::training
