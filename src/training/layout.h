#pragma once
/// \file
/// What of a scene is roamed: its components, their rooms, and the paths that are planned through them.

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
  bool is_widest = true;             ///< false: planned round a place where a walker was stopped
  std::optional<Trial> walked = {};  ///< the last that came through the passage
};

/// A way that was planned and that no walker came along.
struct Unwalked {
  Ends ends;
  Vec3 from{0.0}, to{0.0};  ///< of the feet
  Trial last;               ///< that was made of it
  Vec3 end{0.0};            ///< of that, of the feet
};

struct Layout {
  ways::Measure measure;
  ways::WidestTree tree;
  std::vector<Component> components;  ///< that are roamed
  std::vector<Rooms> rooms;           ///< of each
  std::vector<ConnectedPart> parts;   ///< these, then those that are not, for what they were taken for
  std::vector<PlannedPath> paths;
  std::size_t uncertain = 0;       ///< ways that were planned and then certified for no body: not among the paths
  std::vector<Unwalked> unwalked;  ///< nor are these
};

/// What is measured for a training.
[[nodiscard]] ways::Measure measure_of(const TrainOptions& options);
[[nodiscard]] ways::BodyKind kind_of(const Survey& survey, const TrainOptions& options);

/// The way between two places of a component, refined.
[[nodiscard]] Passage plan_path(const Survey& survey, const Layout& layout, double spacing, const Ends& ends);

/// The same along places of the lattice.
[[nodiscard]] Passage plan_along(const Survey& survey, const Layout& layout, double spacing,
                                 std::span<const ways::NodeId> nodes);

/// Components, rooms and paths; where `stages` says to end, what was found by then.
[[nodiscard]] Layout lay_out(const Survey& survey, const TrainOptions& options, Stages& stages);

/// Whether a place of the floor is one that bodies come to: it lies within the clearance of a place of `components`,
/// or hardly more than a spacing beside one, at its level.
class Reached {
 public:
  /// `survey` and `layout` must outlive it.
  Reached(const Survey& survey, const Layout& layout, double spacing, std::span<const Component> components);
  [[nodiscard]] bool operator()(const Vec3& foot) const { return near(foot) != ways::no_node; }
  /// The nearest of the places that reach it; no_node where it is not reached.
  [[nodiscard]] ways::NodeId near(const Vec3& foot) const { return nearest(foot, false); }
  /// Whether no wall is between such a place and `foot`, at knee height: the floor beside may be behind a thin wall.
  [[nodiscard]] bool in_sight(const Vec3& foot) const { return nearest(foot, true) != ways::no_node; }

 private:
  struct Cell {
    std::int64_t x, y;
    ways::NodeId node;
  };
  [[nodiscard]] std::int64_t cell(double at) const;
  [[nodiscard]] ways::NodeId nearest(const Vec3& foot, bool in_sight) const;
  /// No wall between a place of the lattice and a place of the floor, as voids are seen.
  [[nodiscard]] bool sees(const Vec3& place, const Vec3& foot) const;

  const Survey* survey_;
  const ways::WidestTree* tree_;
  double side_, beside_, level_, knee_, narrowest_;
  std::vector<Cell> cells_;  ///< sorted by x, y, node
};

}  // namespace roam::training
