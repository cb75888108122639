#pragma once
/// \file
/// Places where a small body can be, on a lattice that is made as it is looked at, and how wide a body may be there.
///
/// Walking: columns of a square lattice; a place is the foot on the floor. A neighbour's height is found by dropping a
/// sphere of `widest` that sees only floor below the knee, so that cracks are carried and both ends of the interval
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

/// What is measured at a place: the body's kind, without its radius.
struct Measure {
  Mode mode = Mode::walk;
  double height = 0.0;  ///< 0: sphere
  double step = 0.3;
  double widest = 1.0;
  double narrowest = 0.05;
  /// m: where a disc of this radius, or 0.2 % less, fits into a gap of the floor, nobody is carried.
  double support_max = 1.0;
};

/// Walking or flying clearance at a place (m), at most measure.widest (or what `height` leaves, see passage.h); 0 where
/// less than measure.narrowest. Certified: a capsule of that radius less 0.1 mm is free there.
[[nodiscard]] double clearance_at(const Survey& survey, const Measure& measure, const Vec3& place);

/// The floor under (x, y) that a foot at height about `z` would come to: at most `measure.step` up or down, carried
/// over cracks; none where there is none.
[[nodiscard]] std::optional<Vec3> foot_at(const Survey& survey, const Measure& measure, const Vec3& near);

/// Whether a body of `radius` that is free at two places at most a few spacings apart goes straight from one to the
/// other, or, on foot, up, across and down as over a kerb: certified by sweeps.
[[nodiscard]] bool goes_straight(const Survey& survey, const Measure& measure, const Vec3& from, const Vec3& to,
                                 double radius);

/// Of the spacing: how much narrower than it is a place may look on a lattice on foot. Every place is within half a
/// diagonal of one of the lattice.
inline constexpr double lattice_error = 0.72;

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

/// What may be asked ahead, on other cores, on foot: more is forgotten. No answer depends on it.
struct AheadLimits {
  std::size_t places = 8192;     ///< whose steps are asked about, and that nobody has come to
  std::size_t points = 1 << 20;  ///< that anybody has asked about: some megabytes
};

/// A tree over all places reached from the first one: of all ways between two of them, the one in it is a widest.
/// Grown best first (Prim, with the largest least clearance): see Pollack, "The maximum capacity through a network",
/// 1960.
class WidestTree {
 public:
  /// `survey` must outlive the tree. Nothing outside `within` is looked at. The lattice lies so that the first place
  /// that is asked for is one of it.
  WidestTree(const Survey& survey, const Measure& measure, double spacing, const Box& within = everywhere,
             const AheadLimits& ahead = {});

  /// The place of the lattice at or nearest to `place` (within 1.5 spacings, in sight), made if need be; none where no
  /// body of `narrowest` can be.
  [[nodiscard]] std::optional<NodeId> seed(const Vec3& place);
  /// Grows from `root` until `until` is reached, or (no_node) until everything in reach is. False: ended by `goes_on`,
  /// which is asked now and then with the number of places.
  bool grow(NodeId root, NodeId until, const std::function<bool(std::uint64_t)>& goes_on = {});

  /// Makes one tree, from `root`, of those of `among` (by id; all have been reached once) that hang together with it,
  /// whichever trees they hang in by now: growths that were ended take places from each other. Makes no places.
  void join(NodeId root, const std::vector<bool>& among);

  /// On foot: the places of `among` (by id) that hang over a gap of the floor which is none: another place of the same
  /// tree stands on the floor straight below, so that it is a step down, and carries nobody.
  [[nodiscard]] std::vector<NodeId> over_steps_down(const std::vector<bool>& among) const;
  /// Takes places out of the lattice, and all that hung in one tree with them out of that: see join.
  void close(std::span<const NodeId> places);

  /// Of its lattice, metres.
  [[nodiscard]] double spacing() const;
  [[nodiscard]] std::size_t size() const;
  /// Of how many steps other cores had answered ahead what growing asks.
  [[nodiscard]] std::uint64_t answered_ahead() const;
  [[nodiscard]] const Node& node(NodeId id) const;
  /// The root of the tree that a node hangs in; no_node where it was seen but not reached.
  [[nodiscard]] NodeId root(NodeId id) const;
  [[nodiscard]] NodeId parent(NodeId id) const;
  /// The places from one to the other through the tree; empty when they hang in different trees.
  [[nodiscard]] std::vector<NodeId> way(NodeId from, NodeId to) const;
  /// A widest way that enters no place that is `blocked`, if one is wider than `least`: whatever the tree is, and
  /// without changing it. Makes and measures places that it needs; `goes_on` as in grow, and empty when that ends it.
  [[nodiscard]] std::vector<NodeId> way_round(NodeId from, NodeId to, const std::function<bool(const Node&)>& blocked,
                                              double least, const std::function<bool(std::uint64_t)>& goes_on = {});
  /// The neighbours that a body of `narrowest` can go to straight: all of them where the tree has grown past the place,
  /// else those that were looked at so far. Who is a neighbour of whom is mutual.
  [[nodiscard]] Neighbours neighbours(NodeId id) const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace roam::ways
