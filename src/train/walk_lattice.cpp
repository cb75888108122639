#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "train/lattice_graph.h"
#include "train/walk_lattice_place.h"

namespace roam::training {
namespace {

constexpr int directions = 8;
/// Counter-clockwise, so that the opposite of one is four further.
constexpr std::array<LatticePoint, directions> to_neighbour = {
    {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}, {0, -1, 0}, {1, -1, 0}}};
constexpr int opposite(int direction) { return (direction + directions / 2) % directions; }

/// Metres. Feet over one point of the lattice that differ by less are the same place: balls that come down beside
/// different things rest at slightly different heights.
constexpr double same_height = 0.1;
/// Spacings: a place that is asked for is taken to one of the lattice at most so far away.
constexpr double seed_reach = 1.5;

/// What a place of the lattice knows of itself, beside its Node.
struct Column {
  LatticePoint at;
  NodeId next = no_node;              ///< another place over the same point of the lattice, made earlier
  std::uint8_t settled = 0;           ///< bit set of the directions that were looked at
  std::array<NodeId, directions> to;  ///< the neighbour in each direction, or no_node
};

class WalkLattice final : public LatticeGraph {
 public:
  WalkLattice(const Survey& survey, const Measure& measure, double spacing, const Box& within)
      : survey_(survey), measure_(measure), spacing_(spacing), within_(within), largest_(largest_radius(measure)) {}

  std::optional<NodeId> seed(const Vec3& place) override;
  Neighbours expand(NodeId id) override;
  Neighbours beside(NodeId id) override { return expand(id); }
  [[nodiscard]] Neighbours neighbours(NodeId id) const override;

 private:
  [[nodiscard]] Vec3 point(const LatticePoint& p) const { return origin_ + Vec3(spacing_ * p.x, spacing_ * p.y, 0.0); }
  NodeId make(const LatticePoint& at, const Vec3& foot);
  [[nodiscard]] NodeId nearest_over(const LatticePoint& at, double height, double tolerance) const;
  [[nodiscard]] std::optional<Vec3> foot_from(const Node& from, const Vec3& to) const;
  [[nodiscard]] NodeId look(NodeId from, int direction);
  [[nodiscard]] bool linked(const Vec3& a, double free_at_a, const Vec3& b, double free_at_b) const;

  const Survey& survey_;
  const Measure measure_;
  const double spacing_;
  const Box within_;
  const double largest_;
  Vec3 origin_{0.0};
  LatticeTable table_;
  std::vector<Column> columns_;
};

NodeId WalkLattice::make(const LatticePoint& at, const Vec3& foot) {
  const auto id = static_cast<NodeId>(nodes_.size());
  const auto stand = stand_at(survey_, measure_, foot, largest_, measure_.narrowest);
  float clearance = stand ? static_cast<float>(stand->radius) : 0.0F;
  if (stand && clearance > stand->radius) clearance = std::nextafter(clearance, 0.0F);
  nodes_.push_back({foot, clearance});
  Column column{at, table_.find(at), 0, {}};
  column.to.fill(no_node);
  columns_.push_back(column);
  table_.set(at, id);
  return id;
}

NodeId WalkLattice::nearest_over(const LatticePoint& at, double height, double tolerance) const {
  NodeId best = no_node;
  for (NodeId id = table_.find(at); id != no_node; id = columns_[id].next) {
    const double apart = std::abs(nodes_[id].place.z - height);
    if (apart > tolerance) continue;
    if (best == no_node || apart < std::abs(nodes_[best].place.z - height)) best = id;
  }
  return best;
}

/// Where a foot comes to that goes from a place to (x, y): straight, else with one step between; over cracks only where
/// the knee meets no wall.
std::optional<Vec3> WalkLattice::foot_from(const Node& from, const Vec3& to) const {
  if (const auto foot = floor_below(survey_, measure_, to.x, to.y, from.place.z)) return foot;
  const Vec3 half = 0.5 * (from.place + to);
  if (const auto between = floor_below(survey_, measure_, half.x, half.y, from.place.z)) {
    if (const auto foot = floor_below(survey_, measure_, to.x, to.y, between->z)) return foot;
  }
  const Vec3 level(to.x, to.y, from.place.z);
  if (!goes_straight(survey_, measure_, from.place, level, measure_.narrowest)) return std::nullopt;
  return carried_over(survey_, measure_, to.x, to.y, from.place.z);
}

/// Whether a body of `narrowest` gets from one free place to another. Two free bodies that overlap leave no room for a
/// wall between them.
bool WalkLattice::linked(const Vec3& a, double free_at_a, const Vec3& b, double free_at_b) const {
  const double rise = std::abs(a.z - b.z), along = std::hypot(a.x - b.x, a.y - b.y);
  const double least = measure_.narrowest;
  // Centres of spheres differ in height by their radii and lifts too.
  const double apart =
      measure_.height == 0.0 ? std::hypot(along, rise + std::abs(free_at_a - free_at_b) + measure_.step) : along;
  if (rise <= measure_.step && free_at_a + free_at_b - apart >= 2.0 * least) return true;
  if (goes_straight(survey_, measure_, a, b, least)) return true;
  const Vec3 half = 0.5 * (a + b);
  const auto between = floor_below(survey_, measure_, half.x, half.y, a.z);
  return between && goes_straight(survey_, measure_, a, *between, least) &&
         goes_straight(survey_, measure_, *between, b, least);
}

NodeId WalkLattice::look(NodeId from, int direction) {
  const Node here = nodes_[from];
  LatticePoint at = columns_[from].at;
  at.x += to_neighbour[static_cast<std::size_t>(direction)].x;
  at.y += to_neighbour[static_cast<std::size_t>(direction)].y;
  const Vec3 to = point(at);
  if (std::abs(at.x) >= LatticeTable::limit || std::abs(at.y) >= LatticeTable::limit) return no_node;
  if (to.x < within_.lower.x || to.x > within_.upper.x || to.y < within_.lower.y || to.y > within_.upper.y)
    return no_node;
  NodeId there = nearest_over(at, here.place.z, measure_.step);
  if (there == no_node) {
    const auto foot = foot_from(here, to);
    if (!foot || foot->z < within_.lower.z || foot->z > within_.upper.z) return no_node;
    there = nearest_over(at, foot->z, same_height);
    if (there == no_node) there = make(at, *foot);
  }
  const Node& other = nodes_[there];
  // Its own way back may already lead to another floor here.
  if (columns_[there].settled & 1U << opposite(direction)) return no_node;
  const float free = other.clearance;
  if (free == 0.0F || !linked(here.place, here.clearance, other.place, free)) return no_node;
  return there;
}

Neighbours WalkLattice::expand(NodeId id) {
  for (int direction = 0; direction < directions; ++direction) {
    if (columns_[id].settled & 1U << direction) continue;
    const NodeId there = look(id, direction);
    columns_[id].settled = static_cast<std::uint8_t>(columns_[id].settled | 1U << direction);
    if (there == no_node) continue;
    columns_[id].to[static_cast<std::size_t>(direction)] = there;
    Column& other = columns_[there];
    other.settled = static_cast<std::uint8_t>(other.settled | 1U << opposite(direction));
    other.to[static_cast<std::size_t>(opposite(direction))] = id;
  }
  return neighbours(id);
}

Neighbours WalkLattice::neighbours(NodeId id) const {
  Neighbours found;
  for (const NodeId to : columns_[id].to)
    if (to != no_node) found.push(to);
  return found;
}

std::optional<NodeId> WalkLattice::seed(const Vec3& place) {
  if (nodes_.empty()) origin_ = Vec3(place.x, place.y, 0.0);
  const double free = clearance_at(survey_, measure_, place);
  const LatticePoint middle{static_cast<std::int32_t>(std::lround((place.x - origin_.x) / spacing_)),
                            static_cast<std::int32_t>(std::lround((place.y - origin_.y) / spacing_)), 0};
  struct Candidate {
    double distance;
    LatticePoint at;
  };
  std::vector<Candidate> candidates;
  for (int dx = -2; dx <= 2; ++dx) {
    for (int dy = -2; dy <= 2; ++dy) {
      const LatticePoint at{middle.x + dx, middle.y + dy, 0};
      const Vec3 to = point(at);
      const double distance = std::hypot(to.x - place.x, to.y - place.y);
      if (distance <= seed_reach * spacing_) candidates.push_back({distance, at});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
  for (const Candidate& c : candidates) {
    const auto foot = foot_from({place, static_cast<float>(free)}, point(c.at));
    if (!foot) continue;
    NodeId id = nearest_over(c.at, foot->z, same_height);
    if (id == no_node) id = make(c.at, *foot);
    const float there = nodes_[id].clearance;
    if (there > 0.0F && (c.distance == 0.0 || (free > 0.0 && linked(place, free, nodes_[id].place, there)))) return id;
  }
  return std::nullopt;
}

}  // namespace

std::unique_ptr<LatticeGraph> walk_lattice(const Survey& survey, const Measure& measure, double spacing,
                                           const Box& within) {
  return std::make_unique<WalkLattice>(survey, measure, spacing, within);
}

}  // namespace roam::training
