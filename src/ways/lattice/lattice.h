#pragma once
/// \file
/// Places where a small body can be, on a lattice that is made on demand, and how wide a body may be there.
///
/// Walking: columns of a square lattice; a place is that of the feet on the floor. A sphere is dropped to find a
/// neighbour's height. It collides only with floor below the knee, so cracks carry it, and both ends of the interval
/// stay independent. Flying: a cubic lattice; a place is the centre.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "roam/passage.h"
#include "roam/survey.h"
#include "roam/walker.h"

namespace roam::ways {

/// The kind of body that is measured, without its radius.
struct Measure {
  Mode mode = Mode::walk;
  double height = 0.0;  ///< 0: sphere
  double step = 0.3;
  double widest = 1.0;
  double narrowest = 0.05;
  /// m. A gap of the floor that holds a disc of this radius, or 0.2 % smaller, carries no body.
  double support_max = 1.0;
};

/// Walking or flying clearance at a place (m), at most measure.widest (or what `height` leaves, see passage.h). 0 if it
/// is less than measure.narrowest. Certified: a capsule of that radius less 0.1 mm is free there.
[[nodiscard]] double clearance_at(const Survey& survey, const Measure& measure, const Vec3& place);

/// The floor under `near` for feet at about that height: at most `measure.step` up or down. The rims of cracks count.
/// None if there is no such floor.
[[nodiscard]] std::optional<Vec3> foot_at(const Survey& survey, const Measure& measure, const Vec3& near);

/// Whether a body of `radius` goes straight between two places where it is free, at most a few spacings apart. On foot
/// it may also go up, across and down, as over a kerb. Certified by sweeps.
[[nodiscard]] bool goes_straight(const Survey& survey, const Measure& measure, const Vec3& from, const Vec3& to,
                                 double radius);

/// Spacings. A walking lattice may underestimate the width at a place by this much. Every place is within half a
/// diagonal of a lattice point.
inline constexpr double lattice_error = 0.72;

/// Metres: the least spacing. A finer lattice searches places that the walls' own errors make equal, or never comes on.
inline constexpr double least_spacing = 0.001;

using NodeId = std::uint32_t;
inline constexpr NodeId no_node = ~NodeId(0);

struct Node {
  Vec3 place{0.0};
  float clearance = 0.0F;  ///< as clearance_at, rounded down; 0: no body of `narrowest` can be there
};

/// At most 8 on foot, 26 flying.
using Neighbours = InlineList<NodeId, 26>;

/// The largest box: no bound.
inline constexpr Box everywhere{Vec3(-std::numeric_limits<double>::infinity()),
                                Vec3(std::numeric_limits<double>::infinity())};

/// Limits for steps computed ahead on other cores, on foot. If one is exceeded, all requests are forgotten. That
/// changes no result.
struct AheadLimits {
  std::size_t most_requests = 8192;   ///< places with steps in progress or not used yet
  std::size_t most_points = 1 << 20;  ///< lattice points with steps requested so far; some megabytes
};

/// A tree over all places reached from its root. Its path between two places is a widest one. Grown best first (Prim's
/// algorithm, with the largest minimum clearance): see Pollack, "The maximum capacity through a network", 1960.
class WidestTree {
 public:
  /// `survey` must outlive the tree. No place lies outside `within`. The first place given to seed() becomes the
  /// lattice's origin.
  WidestTree(const Survey& survey, const Measure& measure, double spacing, const Box& within = everywhere,
             const AheadLimits& ahead = {});

  /// The lattice place at or nearest to `place` (within 1.5 spacings, in sight), made if need be. None if no body of
  /// `narrowest` can be there.
  [[nodiscard]] std::optional<NodeId> seed(const Vec3& place);
  /// Grows from `root` until `until` is reached; with no_node, until everything in reach is. Calls `goes_on` now and
  /// then with the number of places. Returns false if `goes_on` ended the growth.
  bool grow(NodeId root, NodeId until, const std::function<bool(std::uint64_t)>& goes_on = {});

  /// Makes one tree, from `root`, of the places of `among` (by id; all have been reached once) that are connected with
  /// it, whichever trees they belong to now. Growths that were ended early take places from each other. Makes no
  /// places.
  void join(NodeId root, const std::vector<bool>& among);

  /// On foot: the places of `among` (by id) that hang over a step down instead of a gap. Another place of the same tree
  /// stands on the floor straight below such a place, so the place carries no body.
  [[nodiscard]] std::vector<NodeId> over_steps_down(const std::vector<bool>& among) const;
  /// Removes places from the lattice, and clears all trees that contained them: see join.
  void close(std::span<const NodeId> places);

  /// The lattice's spacing, metres.
  [[nodiscard]] double spacing() const;
  [[nodiscard]] std::size_t size() const;
  /// Whether floor was left out because it is a million spacings or more from the origin.
  [[nodiscard]] bool is_cut() const;
  /// The number of steps that other cores computed ahead of the growth.
  [[nodiscard]] std::uint64_t computed_ahead() const;
  [[nodiscard]] const Node& node(NodeId id) const;
  /// The root of the tree that a place belongs to; no_node if no growth has reached it.
  [[nodiscard]] NodeId root(NodeId id) const;
  [[nodiscard]] NodeId parent(NodeId id) const;
  /// The places from one to the other through the tree; empty if they belong to different trees.
  [[nodiscard]] std::vector<NodeId> way(NodeId from, NodeId to) const;
  /// A widest way that enters no `blocked` place, if one is wider than `least`. Independent of the tree, which stays as
  /// it is. Makes and measures the places that it needs. `goes_on` as in grow; empty if that ends the search.
  [[nodiscard]] std::vector<NodeId> way_round(NodeId from, NodeId to, const std::function<bool(const Node&)>& blocked,
                                              double least, const std::function<bool(std::uint64_t)>& goes_on = {});
  /// The neighbours that a body of `narrowest` can go to straight: all of them if the tree has grown past the place,
  /// else those examined so far. Neighbourhood is mutual.
  [[nodiscard]] Neighbours neighbours(NodeId id) const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace roam::ways
