#include "ways/passage/ends.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <map>
#include <tuple>
#include <vector>

#include "ways/lattice/walk_place.h"

namespace roam::ways {
namespace {

/// Metres.
constexpr double end_reach = 2.0;  ///< an end is moved at most this far to free space
constexpr double ring = 0.1;       ///< between one circle of tried places and the next
constexpr int ring_places = 16;
constexpr double probe = 0.01;      ///< radius of the sphere that is dropped to the floor
constexpr double above_feet = 0.1;  ///< feet at most this deep in the floor stand on it

std::optional<Vec3> foot_below(const Survey& survey, const Measure& measure, const Vec3& point) {
  if (const auto foot = foot_at(survey, measure, point)) return foot;
  const Vec3 from = point + Vec3(0.0, 0.0, above_feet + probe);
  const double depth = std::min(from.z - survey.floor().bounds().lower.z + 1.0, Space::motion_limit);
  if (!(depth > 0.0) || survey.floor().bounds().empty()) return std::nullopt;
  const Impact down = survey.floor().sweep({probe, 0.0}, from, Vec3(0.0, 0.0, -depth));
  if (!down.hit) return std::nullopt;
  return foot_at(survey, measure, {point.x, point.y, down.point.z});
}

bool fits(const Survey& survey, const Measure& measure, const Vec3& place) {
  return clearance_at(survey, measure, place) > 0.0;
}

struct Neighbour {
  NodeId id = no_node;
  double apart = std::numeric_limits<double>::infinity();  ///< m
};

/// The places of one tree, found by position.
class Hung {
 public:
  Hung(const WidestTree& tree, NodeId one) : tree_(tree) {
    for (NodeId id = 0; id < static_cast<NodeId>(tree.size()); ++id)
      if (tree.root(id) == tree.root(one)) cells_[cell_of(tree.node(id).place)].push_back(id);
  }
  /// The nearest place within one to two metres.
  [[nodiscard]] Neighbour nearest(const Vec3& place) const {
    Neighbour best;
    const auto [x, y, z] = cell_of(place);
    for (long k = 0; k < 27; ++k) {
      const auto near = cells_.find(Cell(x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1));
      if (near == cells_.end()) continue;
      for (const NodeId candidate : near->second) {
        const double apart = glm::length(tree_.node(candidate).place - place);
        if (apart < best.apart) best = {candidate, apart};
      }
    }
    return best;
  }

 private:
  using Cell = std::tuple<long, long, long>;
  static Cell cell_of(const Vec3& p) {
    constexpr double cell = 1.0;  // m
    return Cell(std::lround(p.x / cell), std::lround(p.y / cell), std::lround(p.z / cell));
  }

  const WidestTree& tree_;
  std::map<Cell, std::vector<NodeId>> cells_;
};

}  // namespace

std::optional<Vec3> free_end(const Survey& survey, const Measure& measure, const Vec3& point) {
  const bool walks = measure.mode == Mode::walk;
  const auto place_at = [&](const Vec3& p) { return walks ? foot_below(survey, measure, p) : std::optional(p); };
  const auto here = place_at(point);
  if (here && fits(survey, measure, *here)) return here;
  // On foot, sight lines start at the knee: lower obstacles are no walls.
  Vec3 eye = point;
  if (walks && here) eye.z = std::max(point.z, here->z + measure.step + probe);
  const int layers = walks ? 0 : 1;
  for (double away = ring; away <= end_reach; away += ring) {
    for (int layer = -layers; layer <= layers; ++layer) {
      for (int k = 0; k < ring_places; ++k) {
        const double angle = 2.0 * glm::pi<double>() * k / ring_places;
        Vec3 off(std::cos(angle), std::sin(angle), layer);
        off *= away / glm::length(off);
        if (survey.world().first_impact({0.0, 0.0}, eye, off).hit) continue;
        const auto place = place_at(point + off);
        if (place && fits(survey, measure, *place)) return place;
      }
    }
  }
  return std::nullopt;
}

std::optional<Opening> gap_between(const WidestTree& tree, NodeId one, NodeId other) {
  const Hung hung(tree, other);
  Neighbour nearest;
  NodeId from = no_node;
  for (NodeId id = 0; id < static_cast<NodeId>(tree.size()); ++id) {
    if (tree.root(id) != tree.root(one)) continue;
    const Neighbour near = hung.nearest(tree.node(id).place);
    if (!(near.apart < nearest.apart)) continue;
    nearest = near;
    from = id;
  }
  if (from == no_node || !(nearest.apart > 0.0)) return std::nullopt;
  const Vec3 a = tree.node(from).place, b = tree.node(nearest.id).place;
  Opening opening;
  opening.point = 0.5 * (a + b);
  opening.direction = (b - a) / nearest.apart;
  opening.width = 0.0;
  return opening;
}

bool only_floor_separates(const Survey& survey, const Measure& measure, const WidestTree& tree, NodeId one,
                          NodeId other) {
  const Hung hung(tree, other);
  for (NodeId id = 0; id < static_cast<NodeId>(tree.size()); ++id) {
    if (tree.root(id) != tree.root(one)) continue;
    const NodeId near = hung.nearest(tree.node(id).place).id;
    if (near != no_node &&
        goes_straight(survey, measure, tree.node(id).place, tree.node(near).place, measure.narrowest))
      return true;
  }
  return false;
}

}  // namespace roam::ways
