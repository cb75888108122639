#include "training/layout.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>

#include "cracks/cracks.h"
#include "cracks/voids.h"
#include "math/level_distance.h"
#include "training/places/inside.h"
#include "ways/flight/way.h"
#include "ways/refine/refine.h"

namespace roam::training {

namespace {

/// m. The narrowest searched ways, unless narrower bodies are requested: people and devices on wheels need more.
constexpr double narrowest = 0.05;

/// Components with fewer places than the largest one's divided by this get no paths: tops of plinths, closets without a
/// door.
constexpr std::size_t least_part = 100;
/// m2. A component with less floor than this, and less than a tenth of the largest one's, is no room: the bottom of a
/// shaft.
constexpr double least_room = 2.0;
constexpr std::size_t beside_room = 10;

/// How many paths each component gets; 0: as many as it needs. If `wanted` is 0, each component gets one per dead end,
/// at least one. Otherwise each gets one as far as they go, and the largest one gets the rest.
std::vector<std::optional<int>> shares(const Layout& layout, int wanted) {
  std::vector<std::optional<int>> counts(layout.components.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (wanted == 0) {
      counts[i] = i == 0 ? 0 : std::max(1, static_cast<int>(layout.rooms[i].dead_ends()));
    } else if (static_cast<int>(i) < wanted) {
      counts[i] = 1;
    }
  }
  if (wanted > 0 && !counts.empty()) *counts[0] += std::max(0, wanted - static_cast<int>(counts.size()));
  return counts;
}

/// The reason why a component of that verdict is not trained.
LeftOut why_left_out(Verdict verdict) {
  constexpr std::array<LeftOut, 6> of{LeftOut::much_smaller, LeftOut::backs,         LeftOut::over_low_rooms,
                                      LeftOut::on_top,       LeftOut::small_or_open, LeftOut::unfinished};
  return of[static_cast<std::size_t>(verdict)];
}

ConnectedPart part_of(const ways::Measure& measure, const ways::WidestTree& tree, const Component& component,
                      bool roamed) {
  ConnectedPart part;
  part.places = component.nodes.size();
  part.trained = roamed;
  part.whole = component.whole;
  if (!roamed) part.left_out = why_left_out(component.verdict);
  const auto widest =
      std::max_element(component.nodes.begin(), component.nodes.end(),
                       [&](ways::NodeId a, ways::NodeId b) { return tree.node(a).clearance < tree.node(b).clearance; });
  part.place = tree.node(*widest).place;
  if (measure.mode == Mode::walk) {
    const double cell = tree.spacing();
    part.area = static_cast<double>(part.places) * cell * cell;
  }
  return part;
}

void refine_paths(const Survey& survey, double spacing, Layout& layout, Stages& stages) {
  stages.begin(TrainStage::planning);
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t(0), layout.paths.size(), [&](std::size_t i) {
    PlannedPath& path = layout.paths[i];
    if (!stages.ended()) {
      path.passage = plan_path(survey, layout, spacing, path.ends);
      if (layout.measure.mode == Mode::fly) {
        ways::FlyOptions options{.spacing = spacing};
        options.goes_on = [&](std::uint64_t) { return !stages.ended(); };
        path.passage = widened_flight(survey, layout.measure, std::move(path.passage), options);
      }
    }
    stages.at(static_cast<double>(++done) / static_cast<double>(layout.paths.size()));
  });
  std::erase_if(layout.paths, [](const PlannedPath& path) { return path.passage.way.size() < 2; });
  layout.uncertain = std::erase_if(layout.paths, [](const PlannedPath& path) { return !path.passage.found; });
}

}  // namespace

ways::Measure measure_of(const TrainOptions& options) {
  ways::Measure measure;
  measure.mode = options.mode;
  measure.height = options.mode == Mode::walk ? options.height : 0.0;
  measure.step = options.step;
  measure.widest = options.radius_max;
  measure.narrowest = std::min({narrowest, options.radius_min, 0.5 * options.radius_max});
  measure.support_max = options.support_max;
  return measure;
}

ways::BodyKind kind_of(const Survey& survey, const TrainOptions& options) {
  ways::BodyKind kind;
  kind.mode = options.mode;
  kind.height = options.mode == Mode::walk ? options.height : 0.0;
  kind.step = options.step;
  kind.slope_degrees = survey.slope_degrees();
  kind.speed = options.speed;
  return kind;
}

namespace {

/// m, precision of moving an end of a path to its widest place.
constexpr double end_precision = 1e-4;

/// m, how far an end may move.
constexpr double farthest_end = 1.0;

/// The widest place beside a lattice place. Otherwise the wall beside an end would limit the path.
Vec3 widest_beside(const Survey& survey, const ways::Measure& measure, double spacing, const Vec3& from) {
  const bool flies = measure.mode == Mode::fly;
  Vec3 best = from;
  double most = clearance_at(survey, measure, from);
  for (double step = 0.5 * spacing; step > end_precision; step *= 0.5) {
    for (bool moved = true; moved;) {
      moved = false;
      // In a corner, only a diagonal step gains room on both sides.
      for (int direction = 0; direction < (flies ? 27 : 9); ++direction) {
        const Vec3 way(direction % 3 - 1, direction / 3 % 3 - 1, flies ? direction / 9 - 1 : 0);
        Vec3 place = best + step * way;
        if (glm::distance(Vec3(place.x, place.y, flies ? place.z : from.z), from) > farthest_end) continue;
        if (measure.mode == Mode::walk) {
          const auto foot = foot_at(survey, measure, place);
          if (!foot) continue;
          place = *foot;
        }
        const double room = clearance_at(survey, measure, place);
        if (room <= most || !passes(survey, measure, from, place, measure.narrowest)) continue;
        best = place;
        most = room;
        moved = true;
      }
    }
  }
  return best;
}

}  // namespace

Passage plan_path(const Survey& survey, const Layout& layout, double spacing, const Ends& ends) {
  return plan_along(survey, layout, spacing, layout.tree.way(ends.from, ends.to));
}

Passage plan_along(const Survey& survey, const Layout& layout, double spacing, std::span<const ways::NodeId> nodes) {
  std::vector<Vec3> places;
  for (const ways::NodeId id : nodes) places.push_back(layout.tree.node(id).place);
  if (places.size() > 1) {
    const auto widest = [&](const Vec3& end) { return widest_beside(survey, layout.measure, spacing, end); };
    const Vec3 first = widest(places.front()), last = widest(places.back());
    if (first != places.front()) places.insert(places.begin(), first);
    if (last != places.back()) places.push_back(last);
  }
  return refine(survey, layout.measure, spacing, places);
}

Layout lay_out(const Survey& survey, const TrainOptions& options, Stages& stages) {
  const ways::Measure measure = measure_of(options);
  Layout layout{measure, ways::WidestTree(survey, measure, options.spacing), {}, {}, {}, {}, 0, {}};
  stages.begin(TrainStage::places);
  std::vector<Component> found =
      find_components(survey, measure, layout.tree, options.seed, [&](double done) { return stages.at(done); });
  // Components are sorted, largest first.
  const auto largest = std::find_if(found.begin(), found.end(), [](const Component& c) { return c.inside; });
  const std::size_t most = largest == found.end() ? 0 : largest->nodes.size();
  std::size_t least = most / least_part;
  if (options.mode == Mode::walk) {
    const auto room = static_cast<std::size_t>(least_room / (options.spacing * options.spacing));
    least = std::max(least, std::min(room, most / beside_room));
  }
  const auto is_roamed = [&](const Component& c) { return c.inside && c.nodes.size() >= least; };
  std::stable_partition(found.begin(), found.end(), is_roamed);
  for (Component& component : found) {
    const bool roamed = is_roamed(component);
    if (!is_scrap(component)) layout.parts.push_back(part_of(measure, layout.tree, component, roamed));
    if (roamed) layout.components.push_back(std::move(component));
  }
  for (const Component& component : layout.components)
    layout.rooms.push_back(find_rooms(survey, measure, layout.tree, component));
  const std::vector<std::optional<int>> counts = shares(layout, options.paths);
  for (std::size_t i = 0; i < layout.components.size(); ++i) {
    if (!counts[i]) continue;
    for (const Ends& ends :
         draw_paths(layout.tree, layout.components[i], layout.rooms[i], *counts[i], options.seed + i))
      layout.paths.push_back({ends, {}});
  }
  refine_paths(survey, options.spacing, layout, stages);
  return layout;
}

ReachedFloor::ReachedFloor(const Survey& survey, const Layout& layout, double spacing,
                           std::span<const Component> components)
    : survey_(&survey),
      tree_(&layout.tree),
      side_(std::max(2.0 * spacing, 0.5 * layout.measure.widest)),
      beside_(1.1 * spacing),
      level_(layout.measure.step),
      knee_(cracks::knee_height(layout.measure.step)),
      narrowest_(layout.measure.narrowest) {
  for (const Component& component : components) {
    for (const ways::NodeId id : component.nodes) {
      const ways::Node& node = tree_->node(id);
      cells_.push_back({cell(node.place.x), cell(node.place.y), id});
    }
  }
  std::sort(cells_.begin(), cells_.end(),
            [](const Cell& a, const Cell& b) { return std::tie(a.x, a.y, a.node) < std::tie(b.x, b.y, b.node); });
}

std::int64_t ReachedFloor::cell(double at) const { return static_cast<std::int64_t>(std::floor(at / side_)); }

bool ReachedFloor::sees(const Vec3& place, const Vec3& foot) const {
  return cracks::sees_at_knee(survey_->world(), place, foot, knee_, narrowest_);
}

ways::NodeId ReachedFloor::nearest(const Vec3& foot, bool in_sight) const {
  // Nodes farther than half of `widest` are not needed: nearer ones exist, unless the way there is closed.
  const std::int64_t x = cell(foot.x), y = cell(foot.y);
  ways::NodeId nearest = ways::no_node;
  double least = std::numeric_limits<double>::infinity();
  for (std::int64_t dx = -1; dx <= 1; ++dx) {
    auto at = std::lower_bound(
        cells_.begin(), cells_.end(), std::pair(x + dx, y - 1),
        [](const Cell& c, const auto& key) { return std::tie(c.x, c.y) < std::tie(key.first, key.second); });
    for (; at != cells_.end() && at->x == x + dx && at->y <= y + 1; ++at) {
      const ways::Node& node = tree_->node(at->node);
      const double apart = level_distance(foot, node.place);
      // Within a node's clearance there is no wall.
      const bool has_room = apart <= static_cast<double>(node.clearance);
      if (!(has_room || apart <= beside_) || std::abs(foot.z - node.place.z) > level_) continue;
      if (apart < least && (!in_sight || has_room || sees(node.place, foot))) {
        least = apart;
        nearest = at->node;
      }
    }
  }
  return nearest;
}

}  // namespace roam::training
