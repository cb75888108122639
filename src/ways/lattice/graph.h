#pragma once
/// \file
/// The places of a lattice and their neighbours, made on demand. WidestTree grows over it.

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
  /// All neighbours of a place. Makes and measures those that do not exist yet.
  virtual Neighbours expand(NodeId id) = 0;
  /// Allows look_ahead() to compute on other cores what expand() will need. Off at first. Changes no result.
  virtual void let_look_ahead(bool /*may*/) {}
  /// Hint: `id` will be expanded soon. Does nothing unless let_look_ahead(true).
  virtual void look_ahead(NodeId /*id*/) {}
  /// The number of steps that were computed ahead of their use.
  [[nodiscard]] virtual std::uint64_t computed_ahead() const { return 0; }
  /// Whether a body really goes from a place to one of its neighbours. If not, they stop being neighbours. Call it only
  /// for steps that will be used: on foot it sends walkers over gaps.
  virtual bool confirm_step(NodeId from, NodeId to) = 0;
  /// On foot, for a place over a gap: the next place straight below that stands on floor. no_node if there is none, or
  /// if the place itself stands on floor.
  [[nodiscard]] virtual NodeId floor_under_gap(NodeId /*id*/) const { return no_node; }
  /// Removes a place: it loses all neighbours, and no body can be there.
  virtual void close(NodeId /*id*/) {}
  /// The neighbours that are known already.
  [[nodiscard]] virtual Neighbours neighbours(NodeId id) const = 0;

  /// Whether floor was left out because it is farther from the origin than a LatticeTable reaches.
  [[nodiscard]] bool is_cut() const { return is_cut_; }
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }
  [[nodiscard]] const Node& node(NodeId id) const { return nodes_[id]; }

 protected:
  std::vector<Node> nodes_;
  bool is_cut_ = false;
};

[[nodiscard]] std::unique_ptr<LatticeGraph> walk_lattice(const Survey& survey, const Measure& measure, double spacing,
                                                         const Box& within, const AheadLimits& ahead);
[[nodiscard]] std::unique_ptr<LatticeGraph> fly_lattice(const Survey& survey, const Measure& measure, double spacing,
                                                        const Box& within);

}  // namespace roam::ways
