#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "math/level_distance.h"
#include "ways/lattice/graph.h"
#include "ways/lattice/walk_scouts.h"
#include "ways/lattice/walk_step.h"

namespace roam::ways {
namespace {

constexpr std::uint8_t all_directions = 0xFF;

/// Metres. Feet over one lattice point whose heights differ by less are one place. Balls dropped beside different
/// obstacles rest at slightly different heights.
constexpr double same_height = 0.1;
/// Spacings. A given place is moved to a lattice point at most this far away.
constexpr double seed_reach = 1.5;

/// State of a place beside its Node.
struct Column {
  LatticePoint at;
  NodeId next = no_node;              ///< another place over the same point of the lattice, made earlier
  std::uint8_t settled = 0;           ///< bit set of the directions already examined
  std::uint8_t tried = 0;             ///< bit set of the directions in which a walker got through
  bool over_gap = false;              ///< whether the foot is over a gap
  bool is_scouted = false;            ///< no more scouts are needed
  std::array<NodeId, directions> to;  ///< the neighbour in each direction, or no_node
  double level = 0.0;                 ///< of the foot
};

class WalkLattice final : public LatticeGraph {
 public:
  WalkLattice(const Survey& survey, const Measure& measure, double spacing, const Box& within, const AheadLimits& ahead)
      : survey_(survey), measure_(measure), plan_{spacing}, within_(within), ahead_(ahead), steps_(survey, measure) {}

  std::optional<NodeId> seed(const Vec3& place) override;
  Neighbours expand(NodeId id) override;
  void let_look_ahead(bool may) override { looks_ahead_ = may; }
  void look_ahead(NodeId id) override;
  bool confirm_step(NodeId from, NodeId to) override;
  [[nodiscard]] NodeId floor_under_gap(NodeId id) const override;
  void close(NodeId id) override;
  [[nodiscard]] Neighbours neighbours(NodeId id) const override;
  [[nodiscard]] std::uint64_t computed_ahead() const override { return computed_ahead_; }

 private:
  [[nodiscard]] Standing standing(NodeId id) const {
    return {nodes_[id].place, columns_[id].level, nodes_[id].clearance, columns_[id].over_gap};
  }
  NodeId make(const LatticePoint& at, const FloorPlace& foot, float clearance);
  [[nodiscard]] NodeId nearest_over(const LatticePoint& at, double level, double tolerance) const;
  [[nodiscard]] bool covers(const LatticePoint& at) const;
  [[nodiscard]] NodeId look(NodeId from, std::size_t direction, const ScoutedSteps* ahead);

  const Survey& survey_;
  const Measure measure_;
  LatticePlan plan_;
  const Box within_;
  const AheadLimits ahead_;
  const WalkSteps steps_;
  LatticeTable table_;
  std::vector<Column> columns_;
  LatticeTable requested_;  ///< by storey: the place that sent scouts there
  std::size_t requested_points_ = 0;
  std::uint64_t computed_ahead_ = 0;
  bool looks_ahead_ = false;
  Scouts scouts_{steps_, plan_};
};

NodeId WalkLattice::make(const LatticePoint& at, const FloorPlace& foot, float clearance) {
  const auto id = static_cast<NodeId>(nodes_.size());
  nodes_.push_back({foot.place, clearance});
  Column column{.at = at, .next = table_.find(at), .over_gap = foot.over_gap, .to = {}, .level = foot.level};
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

/// Whether a point lies inside the searched box.
bool WalkLattice::covers(const LatticePoint& at) const {
  const Vec3 to = plan_.point(at);
  return LatticeTable::holds(at) && to.x >= within_.lower.x && to.x <= within_.upper.x && to.y >= within_.lower.y &&
         to.y <= within_.upper.y;
}

NodeId WalkLattice::look(NodeId from, std::size_t direction, const ScoutedSteps* ahead) {
  const LatticePoint at = beside(columns_[from].at, direction);
  if (!LatticeTable::holds(at)) is_cut_ = true;
  if (!covers(at)) return no_node;
  const Standing here = standing(from);
  bool is_new = false, is_ready = false;
  NodeId there = nearest_over(at, here.level, measure_.step);
  if (there == no_node) {
    is_ready = ahead != nullptr && ahead->is_ready(direction);
    if (is_ready) ++computed_ahead_;
    const auto foot = is_ready ? ahead->foot[direction] : steps_.foot_from(here, plan_.point(at));
    if (!foot || foot->place.z < within_.lower.z || foot->place.z > within_.upper.z) return no_node;
    there = nearest_over(at, foot->level, same_height);
    is_new = there == no_node;
    if (is_new) there = make(at, *foot, is_ready ? ahead->clearance[direction] : steps_.clearance(foot->place));
  }
  // The way back from there may already lead to another floor here.
  if (columns_[there].settled & 1U << opposite(direction)) return no_node;
  if (nodes_[there].clearance == 0.0F) return no_node;
  const bool is_linked = is_new && is_ready ? ahead->linked[direction] : steps_.linked(here, standing(there));
  return is_linked ? there : no_node;
}

void WalkLattice::look_ahead(NodeId id) {
  Column& column = columns_[id];
  // If nothing limits a body, queries are faster than sending scouts.
  if (column.is_scouted || column.settled == all_directions || nodes_[id].clearance >= steps_.unlimited()) return;
  column.is_scouted = true;
  const Standing here = standing(id);
  unsigned requested = 0;
  for (std::size_t direction = 0; direction < directions; ++direction) {
    const unsigned bit = 1U << direction;
    const LatticePoint at = beside(column.at, direction);
    if ((column.settled & bit) != 0 || !covers(at) || nearest_over(at, here.level, measure_.step) != no_node) continue;
    // Most points have neighbours on several sides. The first neighbour sends the scout.
    const auto storey = std::lround(here.level / std::max(measure_.step, same_height)) % LatticeTable::limit;
    const LatticePoint about{at.x, at.y, static_cast<std::int32_t>(storey)};
    if (requested_.find(about) != no_node) continue;
    requested_.set(about, id);
    requested |= bit;
  }
  if (requested == 0) return;
  requested_points_ += static_cast<std::size_t>(std::popcount(requested));
  if (scouts_.out() >= ahead_.most_requests || requested_points_ > ahead_.most_points) {
    scouts_.forget();
    requested_ = {};
    requested_points_ = 0;
  }
  scouts_.send(id, here, column.at, static_cast<std::uint8_t>(requested));
}

Neighbours WalkLattice::expand(NodeId id) {
  if (columns_[id].settled == all_directions) return neighbours(id);
  // A scout works from the last direction to the first.
  if (looks_ahead_) look_ahead(id);
  const auto ahead = scouts_.take(id);
  for (std::size_t direction = 0; direction < directions; ++direction) {
    if (columns_[id].settled & 1U << direction) continue;
    const NodeId there = look(id, direction, ahead.get());
    columns_[id].settled = static_cast<std::uint8_t>(columns_[id].settled | 1U << direction);
    if (there == no_node) continue;
    columns_[id].to[direction] = there;
    Column& other = columns_[there];
    other.settled = static_cast<std::uint8_t>(other.settled | 1U << opposite(direction));
    other.to[opposite(direction)] = id;
  }
  if (ahead) ahead->done = true;
  return neighbours(id);
}

bool WalkLattice::confirm_step(NodeId from, NodeId to) {
  auto& there = columns_[from].to;
  const auto found = std::find(there.begin(), there.end(), to);
  if (found == there.end()) return false;
  const auto direction = static_cast<std::size_t>(found - there.begin());
  const unsigned bit = 1U << direction;
  if (columns_[from].tried & bit) return true;
  if (!steps_.walked(standing(from), standing(to))) {
    *found = columns_[to].to[opposite(direction)] = no_node;
    return false;
  }
  columns_[from].tried = static_cast<std::uint8_t>(columns_[from].tried | bit);
  columns_[to].tried = static_cast<std::uint8_t>(columns_[to].tried | 1U << opposite(direction));
  return true;
}

NodeId WalkLattice::floor_under_gap(NodeId id) const {
  if (!columns_[id].over_gap) return no_node;
  NodeId best = no_node;
  for (NodeId other = table_.find(columns_[id].at); other != no_node; other = columns_[other].next) {
    if (columns_[other].over_gap || columns_[other].level >= columns_[id].level || nodes_[other].clearance == 0.0F)
      continue;
    if (best == no_node || columns_[other].level > columns_[best].level) best = other;
  }
  return best;
}

void WalkLattice::close(NodeId id) {
  for (std::size_t direction = 0; direction < directions; ++direction) {
    NodeId& there = columns_[id].to[direction];
    if (there != no_node) columns_[there].to[opposite(direction)] = no_node;
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
  constexpr int farthest = 2;  // lattice points around the given place
  static_assert(farthest >= seed_reach);
  if (nodes_.empty()) plan_.origin = Vec3(place.x, place.y, 0.0);
  const Standing here{place, level_at(survey_, measure_, place), clearance_at(survey_, measure_, place)};
  if (!(std::abs(place.x - plan_.origin.x) < plan_.spacing * (LatticeTable::limit - farthest) &&
        std::abs(place.y - plan_.origin.y) < plan_.spacing * (LatticeTable::limit - farthest))) {
    is_cut_ = true;
    return std::nullopt;
  }
  const LatticePoint middle{static_cast<std::int32_t>(std::lround((place.x - plan_.origin.x) / plan_.spacing)),
                            static_cast<std::int32_t>(std::lround((place.y - plan_.origin.y) / plan_.spacing)), 0};
  struct Candidate {
    double distance;
    LatticePoint at;
  };
  std::vector<Candidate> candidates;
  for (int dx = -farthest; dx <= farthest; ++dx) {
    for (int dy = -farthest; dy <= farthest; ++dy) {
      const LatticePoint at{middle.x + dx, middle.y + dy, 0};
      const Vec3 to = plan_.point(at);
      const double distance = level_distance(to, place);
      if (distance <= seed_reach * plan_.spacing) candidates.push_back({distance, at});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.distance < b.distance; });
  for (const Candidate& c : candidates) {
    const auto foot = steps_.foot_from(here, plan_.point(c.at));
    if (!foot) continue;
    NodeId id = nearest_over(c.at, foot->level, same_height);
    if (id == no_node) id = make(c.at, *foot, steps_.clearance(foot->place));
    const Standing there = standing(id);
    if (there.free > 0.0 && (c.distance == 0.0 || (here.free > 0.0 && steps_.linked(here, there)))) return id;
  }
  return std::nullopt;
}

}  // namespace

std::unique_ptr<LatticeGraph> walk_lattice(const Survey& survey, const Measure& measure, double spacing,
                                           const Box& within, const AheadLimits& ahead) {
  return std::make_unique<WalkLattice>(survey, measure, spacing, within, ahead);
}

}  // namespace roam::ways
