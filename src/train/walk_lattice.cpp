#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "train/lattice_graph.h"
#include "train/trials.h"
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

/// Metres: two levels differ by a step when they differ by no more than that and this.
constexpr double level_tolerance = 2e-3;

/// A foot, and how wide a body may be there.
struct Standing {
  Vec3 place{0.0};
  double level = 0.0;  ///< see Foot
  double free = 0.0;
  bool carried = false;
};

/// What a place of the lattice knows of itself, beside its Node.
struct Column {
  LatticePoint at;
  NodeId next = no_node;              ///< another place over the same point of the lattice, made earlier
  std::uint8_t settled = 0;           ///< bit set of the directions that were looked at
  std::uint8_t tried = 0;             ///< likewise, that walkers were sent in and got through
  std::array<NodeId, directions> to;  ///< the neighbour in each direction, or no_node
  double level = 0.0;                 ///< of its foot
  bool carried = false;               ///< likewise
};

class WalkLattice final : public LatticeGraph {
 public:
  WalkLattice(const Survey& survey, const Measure& measure, double spacing, const Box& within)
      : survey_(survey), measure_(measure), spacing_(spacing), within_(within), largest_(largest_radius(measure)) {}

  std::optional<NodeId> seed(const Vec3& place) override;
  Neighbours expand(NodeId id) override;
  bool goes(NodeId from, NodeId to) override;
  [[nodiscard]] NodeId floor_under_gap(NodeId id) const override;
  void close(NodeId id) override;
  [[nodiscard]] Neighbours neighbours(NodeId id) const override;

 private:
  [[nodiscard]] Vec3 point(const LatticePoint& p) const { return origin_ + Vec3(spacing_ * p.x, spacing_ * p.y, 0.0); }
  [[nodiscard]] Standing standing(NodeId id) const {
    return {nodes_[id].place, columns_[id].level, nodes_[id].clearance, columns_[id].carried};
  }
  NodeId make(const LatticePoint& at, const Foot& foot);
  [[nodiscard]] NodeId nearest_over(const LatticePoint& at, double level, double tolerance) const;
  [[nodiscard]] std::optional<Foot> foot_from(const Standing& from, const Vec3& to) const;
  [[nodiscard]] NodeId look(NodeId from, int direction);
  [[nodiscard]] bool linked(const Standing& a, const Standing& b) const;
  [[nodiscard]] bool walked(const Standing& a, const Standing& b) const;

  const Survey& survey_;
  const Measure measure_;
  const double spacing_;
  const Box within_;
  const double largest_;
  Vec3 origin_{0.0};
  LatticeTable table_;
  std::vector<Column> columns_;
};

NodeId WalkLattice::make(const LatticePoint& at, const Foot& foot) {
  const auto id = static_cast<NodeId>(nodes_.size());
  const auto stand = stand_at(survey_, measure_, foot.place, largest_, measure_.narrowest);
  float clearance = stand ? static_cast<float>(stand->radius) : 0.0F;
  if (stand && clearance > stand->radius) clearance = std::nextafter(clearance, 0.0F);
  nodes_.push_back({foot.place, clearance});
  Column column{.at = at, .next = table_.find(at), .to = {}, .level = foot.level, .carried = foot.carried};
  column.to.fill(no_node);
  columns_.push_back(column);
  table_.set(at, id);
  return id;
}

NodeId WalkLattice::nearest_over(const LatticePoint& at, double level, double tolerance) const {
  NodeId best = no_node;
  for (NodeId id = table_.find(at); id != no_node; id = columns_[id].next) {
    const double apart = std::abs(columns_[id].level - level);
    if (apart > tolerance) continue;
    if (best == no_node || apart < std::abs(columns_[best].level - level)) best = id;
  }
  return best;
}

/// Where a foot comes to that goes from a place to (x, y): straight, else with one step between; over cracks only where
/// the knee meets no wall.
std::optional<Foot> WalkLattice::foot_from(const Standing& from, const Vec3& to) const {
  if (const auto foot = floor_below(survey_, measure_, to.x, to.y, from.level)) return foot;
  const Vec3 half = 0.5 * (from.place + to);
  if (const auto between = floor_below(survey_, measure_, half.x, half.y, from.level)) {
    if (const auto foot = floor_below(survey_, measure_, to.x, to.y, between->level)) return foot;
  }
  const Vec3 level(to.x, to.y, from.place.z);
  if (!goes_straight(survey_, measure_, from.place, level, measure_.narrowest)) return std::nullopt;
  return carried_over(survey_, measure_, to.x, to.y, from.level);
}

/// Whether a body of `narrowest` gets from one free place to another. Two free bodies that overlap leave no room for a
/// wall between them.
bool WalkLattice::linked(const Standing& a, const Standing& b) const {
  const double rise = std::abs(a.place.z - b.place.z), along = std::hypot(a.place.x - b.place.x, a.place.y - b.place.y);
  const double least = measure_.narrowest;
  const bool one_step = std::abs(a.level - b.level) <= measure_.step + level_tolerance;
  // Centres of spheres differ in height by their radii and lifts too.
  const double apart =
      measure_.height == 0.0 ? std::hypot(along, rise + std::abs(a.free - b.free) + measure_.step) : along;
  if (one_step && a.free + b.free - apart >= 2.0 * least) return true;
  if (one_step && goes_straight(survey_, measure_, a.place, b.place, least)) return true;
  const Vec3 half = 0.5 * (a.place + b.place);
  const auto between = floor_below(survey_, measure_, half.x, half.y, a.level);
  return between && std::abs(between->level - b.level) <= measure_.step + level_tolerance &&
         goes_straight(survey_, measure_, a.place, between->place, least) &&
         goes_straight(survey_, measure_, between->place, b.place, least);
}

/// Whether a walker gets from one place to another where one of them is over a gap: on the largest foot, for what lies
/// in the gap may still be within a step, or the gap go on into an open drop. So one goes there.
bool WalkLattice::walked(const Standing& a, const Standing& b) const {
  constexpr double person = 0.3;  // m
  constexpr double share = 0.97;  // of what is free
  if (!a.carried && !b.carried) return true;
  const BodyKind kind{.height = measure_.height, .step = measure_.step, .slope_degrees = survey_.slope_degrees()};
  const std::array<Vec3, 2> way = a.carried ? std::array{b.place, a.place} : std::array{a.place, b.place};
  const double radius = std::min(share * std::min(a.free, b.free), person);
  return try_way(survey_, kind, radius, measure_.support_max, way).outcome == Outcome::reached;
}

NodeId WalkLattice::look(NodeId from, int direction) {
  const Standing here = standing(from);
  LatticePoint at = columns_[from].at;
  at.x += to_neighbour[static_cast<std::size_t>(direction)].x;
  at.y += to_neighbour[static_cast<std::size_t>(direction)].y;
  if (std::abs(at.x) >= LatticeTable::limit || std::abs(at.y) >= LatticeTable::limit) return no_node;
  const Vec3 to = point(at);
  if (to.x < within_.lower.x || to.x > within_.upper.x || to.y < within_.lower.y || to.y > within_.upper.y)
    return no_node;
  NodeId there = nearest_over(at, here.level, measure_.step);
  if (there == no_node) {
    const auto foot = foot_from(here, to);
    if (!foot || foot->place.z < within_.lower.z || foot->place.z > within_.upper.z) return no_node;
    there = nearest_over(at, foot->level, same_height);
    if (there == no_node) there = make(at, *foot);
  }
  // Its own way back may already lead to another floor here.
  if (columns_[there].settled & 1U << opposite(direction)) return no_node;
  if (nodes_[there].clearance == 0.0F || !linked(here, standing(there))) return no_node;
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

bool WalkLattice::goes(NodeId from, NodeId to) {
  auto& there = columns_[from].to;
  const auto found = std::find(there.begin(), there.end(), to);
  if (found == there.end()) return false;
  const auto direction = static_cast<int>(found - there.begin());
  const unsigned bit = 1U << direction;
  if (columns_[from].tried & bit) return true;
  if (!walked(standing(from), standing(to))) {
    *found = columns_[to].to[static_cast<std::size_t>(opposite(direction))] = no_node;
    return false;
  }
  columns_[from].tried = static_cast<std::uint8_t>(columns_[from].tried | bit);
  columns_[to].tried = static_cast<std::uint8_t>(columns_[to].tried | 1U << opposite(direction));
  return true;
}

NodeId WalkLattice::floor_under_gap(NodeId id) const {
  if (!columns_[id].carried) return no_node;
  NodeId best = no_node;
  for (NodeId other = table_.find(columns_[id].at); other != no_node; other = columns_[other].next) {
    if (columns_[other].carried || columns_[other].level >= columns_[id].level || nodes_[other].clearance == 0.0F)
      continue;
    if (best == no_node || columns_[other].level > columns_[best].level) best = other;
  }
  return best;
}

void WalkLattice::close(NodeId id) {
  constexpr std::uint8_t all_directions = 0xFF;
  for (int direction = 0; direction < directions; ++direction) {
    NodeId& there = columns_[id].to[static_cast<std::size_t>(direction)];
    if (there != no_node) columns_[there].to[static_cast<std::size_t>(opposite(direction))] = no_node;
    there = no_node;
  }
  columns_[id].settled = all_directions;
  nodes_[id].clearance = 0.0F;
}

Neighbours WalkLattice::neighbours(NodeId id) const {
  Neighbours found;
  for (const NodeId to : columns_[id].to)
    if (to != no_node) found.push(to);
  return found;
}

std::optional<NodeId> WalkLattice::seed(const Vec3& place) {
  constexpr int farthest = 2;  // points of the lattice that are looked at
  static_assert(farthest >= seed_reach);
  if (nodes_.empty()) origin_ = Vec3(place.x, place.y, 0.0);
  const Standing here{place, level_at(survey_, measure_, place), clearance_at(survey_, measure_, place)};
  if (!(std::abs(place.x - origin_.x) < spacing_ * (LatticeTable::limit - farthest) &&
        std::abs(place.y - origin_.y) < spacing_ * (LatticeTable::limit - farthest)))
    return std::nullopt;
  const LatticePoint middle{static_cast<std::int32_t>(std::lround((place.x - origin_.x) / spacing_)),
                            static_cast<std::int32_t>(std::lround((place.y - origin_.y) / spacing_)), 0};
  struct Candidate {
    double distance;
    LatticePoint at;
  };
  std::vector<Candidate> candidates;
  for (int dx = -farthest; dx <= farthest; ++dx) {
    for (int dy = -farthest; dy <= farthest; ++dy) {
      const LatticePoint at{middle.x + dx, middle.y + dy, 0};
      const Vec3 to = point(at);
      const double distance = std::hypot(to.x - place.x, to.y - place.y);
      if (distance <= seed_reach * spacing_) candidates.push_back({distance, at});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
  for (const Candidate& c : candidates) {
    const auto foot = foot_from(here, point(c.at));
    if (!foot) continue;
    NodeId id = nearest_over(c.at, foot->level, same_height);
    if (id == no_node) id = make(c.at, *foot);
    const Standing there = standing(id);
    if (there.free > 0.0 && (c.distance == 0.0 || (here.free > 0.0 && linked(here, there)))) return id;
  }
  return std::nullopt;
}

}  // namespace

std::unique_ptr<LatticeGraph> walk_lattice(const Survey& survey, const Measure& measure, double spacing,
                                           const Box& within) {
  return std::make_unique<WalkLattice>(survey, measure, spacing, within);
}

}  // namespace roam::training
