#pragma once
/// \file
/// The places of a lattice and who is whose neighbour, made where they are asked for. WidestTree grows over it.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "ways/lattice/lattice.h"
#include "ways/lattice/table.h"

namespace roam::ways {

class LatticeGraph {
 public:
  virtual ~LatticeGraph() = default;

  [[nodiscard]] virtual std::optional<NodeId> seed(const Vec3& place) = 0;
  /// All neighbours, which are made and measured if need be.
  virtual Neighbours expand(NodeId id) = 0;
  /// Whether other cores may ask ahead what expand() needs to know; not at first. Changes no answer.
  virtual void let_look_ahead(bool /*may*/) {}
  /// They may: of a place that will be expanded soon.
  virtual void look_ahead(NodeId /*id*/) {}
  /// How many steps they had answered when they were gone.
  [[nodiscard]] virtual std::uint64_t answered_ahead() const { return 0; }
  /// Whether a body goes from a place to one of its neighbours after all, or they are none any more: asked only of what
  /// is to be gone, for on foot walkers are sent over gaps.
  virtual bool goes(NodeId from, NodeId to) = 0;
  /// On foot: of a place where a foot is carried over a gap, the next one straight below that stands on floor; no_node
  /// where there is none, or the place is on floor itself.
  [[nodiscard]] virtual NodeId floor_under_gap(NodeId /*id*/) const { return no_node; }
  /// Nobody can be at a place after all: it has no neighbours any more.
  virtual void close(NodeId /*id*/) {}
  /// Those neighbours that are known.
  [[nodiscard]] virtual Neighbours neighbours(NodeId id) const = 0;

  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  [[nodiscard]] const Node& node(NodeId id) const { return nodes_[id]; }

 protected:
  std::vector<Node> nodes_;
};

[[nodiscard]] std::unique_ptr<LatticeGraph> walk_lattice(const Survey& survey, const Measure& measure, double spacing,
                                                         const Box& within, const AheadLimits& ahead);
[[nodiscard]] std::unique_ptr<LatticeGraph> fly_lattice(const Survey& survey, const Measure& measure, double spacing,
                                                        const Box& within);

}  // namespace roam::ways
