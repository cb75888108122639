#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "ways/lattice/graph.h"

namespace roam::ways {
namespace {

constexpr int directions = 26;
/// Spacings. A given place is moved to a lattice point at most this far away.
constexpr double seed_reach = 1.5;
/// Times `widest`: the lattice ends this far outside the box of all triangles.
constexpr double outside_reach = 2.0;

/// All steps of -1, 0 or 1 along each axis, except (0, 0, 0). The opposite of step `i` is step `directions - 1 - i`.
constexpr std::array<LatticePoint, directions> make_steps() {
  std::array<LatticePoint, directions> steps{};
  std::size_t n = 0;
  for (int z = -1; z <= 1; ++z)
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x)
        if (x != 0 || y != 0 || z != 0) steps[n++] = {x, y, z};
  return steps;
}
constexpr std::array<LatticePoint, directions> to_neighbour = make_steps();
constexpr int opposite(int direction) { return directions - 1 - direction; }

LatticePoint sum(const LatticePoint& a, const LatticePoint& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }

Box near_scene(const Survey& survey, const Measure& measure, const Box& within) {
  Box box = survey.world().bounds();
  for (int k = 0; k < 3; ++k) {
    box.lower[k] = std::max(box.lower[k] - outside_reach * measure.widest, within.lower[k]);
    box.upper[k] = std::min(box.upper[k] + outside_reach * measure.widest, within.upper[k]);
  }
  return box;
}

/// State of a lattice point beside its Node: sets of directions, one bit each.
struct Cell {
  LatticePoint at;
  std::uint32_t settled = 0;  ///< directions already examined
  std::uint32_t linked = 0;   ///< directions with a neighbour
};

class FlyLattice final : public LatticeGraph {
 public:
  FlyLattice(const Survey& survey, const Measure& measure, double spacing, const Box& within)
      : survey_(survey), measure_(measure), spacing_(spacing), within_(near_scene(survey, measure, within)) {}

  std::optional<NodeId> seed(const Vec3& place) override;
  Neighbours expand(NodeId id) override;
  bool confirm_step(NodeId, NodeId) override { return true; }
  [[nodiscard]] Neighbours neighbours(NodeId id) const override;

 private:
  [[nodiscard]] Vec3 point(const LatticePoint& p) const { return origin_ + spacing_ * Vec3(p.x, p.y, p.z); }
  [[nodiscard]] bool covers(const LatticePoint& at) const;
  NodeId find_or_make(const LatticePoint& at);
  [[nodiscard]] bool linked(const Vec3& a, double free_at_a, const Node& b) const;

  const Survey& survey_;
  const Measure measure_;
  const double spacing_;
  const Box within_;
  Vec3 origin_{0.0};
  LatticeTable table_;
  std::vector<Cell> cells_;
};

bool FlyLattice::covers(const LatticePoint& at) const {
  const Vec3 p = point(at);
  for (int k = 0; k < 3; ++k)
    if (!(p[k] >= within_.lower[k] && p[k] <= within_.upper[k])) return false;
  return LatticeTable::holds(at);
}

NodeId FlyLattice::find_or_make(const LatticePoint& at) {
  const NodeId known = table_.find(at);
  if (known != no_node) return known;
  const auto id = static_cast<NodeId>(nodes_.size());
  const double free = clearance_at(survey_, measure_, point(at));
  float clearance = static_cast<float>(free);
  if (clearance > free) clearance = std::nextafter(clearance, 0.0F);
  nodes_.push_back({point(at), clearance});
  cells_.push_back({at, 0, 0});
  table_.set(at, id);
  return id;
}

/// Whether a sphere of `narrowest` gets from one free place to another: inside two overlapping free spheres, or by a
/// sweep.
bool FlyLattice::linked(const Vec3& a, double free_at_a, const Node& b) const {
  if (free_at_a == 0.0 || b.clearance == 0.0F) return false;
  if (free_at_a + b.clearance - glm::length(b.place - a) >= 2.0 * measure_.narrowest) return true;
  return goes_straight(survey_, measure_, a, b.place, measure_.narrowest);
}

Neighbours FlyLattice::expand(NodeId id) {
  for (int direction = 0; direction < directions; ++direction) {
    const std::uint32_t bit = 1U << direction;
    if (cells_[id].settled & bit) continue;
    cells_[id].settled |= bit;
    const LatticePoint at = sum(cells_[id].at, to_neighbour[static_cast<std::size_t>(direction)]);
    if (!covers(at)) continue;
    const NodeId there = find_or_make(at);
    const std::uint32_t back = 1U << opposite(direction);
    cells_[there].settled |= back;
    if (!linked(nodes_[id].place, nodes_[id].clearance, nodes_[there])) continue;
    cells_[id].linked |= bit;
    cells_[there].linked |= back;
  }
  return neighbours(id);
}

Neighbours FlyLattice::neighbours(NodeId id) const {
  Neighbours found;
  for (int direction = 0; direction < directions; ++direction) {
    if (cells_[id].linked & 1U << direction)
      found.push(table_.find(sum(cells_[id].at, to_neighbour[static_cast<std::size_t>(direction)])));
  }
  return found;
}

std::optional<NodeId> FlyLattice::seed(const Vec3& place) {
  if (nodes_.empty()) origin_ = place;
  const double free = clearance_at(survey_, measure_, place);
  const Vec3 steps = (place - origin_) / spacing_;
  const auto whole = [](double v) { return static_cast<std::int32_t>(std::lround(v)); };
  const LatticePoint middle{whole(steps.x), whole(steps.y), whole(steps.z)};
  struct Candidate {
    double distance;
    LatticePoint at;
  };
  std::vector<Candidate> candidates{{glm::length(point(middle) - place), middle}};
  for (const LatticePoint& step : to_neighbour) {
    const LatticePoint at = sum(middle, step);
    candidates.push_back({glm::length(point(at) - place), at});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
  for (const Candidate& c : candidates) {
    if (c.distance > seed_reach * spacing_ || !covers(c.at)) continue;
    const NodeId id = find_or_make(c.at);
    if (linked(place, free, nodes_[id])) return id;
  }
  return std::nullopt;
}

}  // namespace

std::unique_ptr<LatticeGraph> fly_lattice(const Survey& survey, const Measure& measure, double spacing,
                                          const Box& within) {
  return std::make_unique<FlyLattice>(survey, measure, spacing, within);
}

}  // namespace roam::ways
