#include "ways/flight/search.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>
#include <utility>

namespace roam::ways {
namespace {

/// Cubes followed between two calls of `goes_on`.
constexpr std::uint64_t steps_between_checks = 256;
/// Sides. For a radius at least this large, no cube reaches through a wall without thickness. If its middle is half a
/// side from the wall, its farthest corner is sqrt(1 + 1/4 + 1/4) sides from the nearest point of the wall.
constexpr double through_wall = 1.25;
/// Radii: the side of cubes near surfaces that the sphere may touch. A row of such cubes fits into a door a third wider
/// than the sphere.
constexpr double side_share = 1.0 / 1.5;
/// Spacings: the side of cubes for small radii.
constexpr double finest_share = 0.5;
/// m: cubes along an unsure way are not split below this side.
constexpr double least_side = 2e-3;
/// Radii. Ways keep this far from walls if that costs little.
constexpr double roomy = 1.5;
/// The cost of a cube that may be closed, relative to a free cube.
constexpr double unsure_cost = 8.0;
/// m: pairs of middles farther apart are not near each other.
constexpr double near = 2.0;
constexpr double largest_near = 1.0;

/// The middle of a cube.
struct Middle {
  Vec3 place;
  CellId cell;
};

double distance_between(const Box& a, const Box& b) {
  return glm::length(glm::max(glm::max(a.lower - b.upper, b.lower - a.upper), Vec3(0.0)));
}

/// The two nearest of two sets of middles, found by halving both sets. Halves farther apart than a known pair are
/// skipped: both sides of a wall may hold ten thousands of cubes.
class NearestPair {
 public:
  /// Calls `goes_on` now and then; if it returns false, the search ends without a pair.
  explicit NearestPair(std::function<bool()> goes_on) : goes_on_(std::move(goes_on)) {}

  void look(std::span<Middle> one, std::span<Middle> other) {
    if (ended_ || one.empty() || other.empty()) return;
    const Box box = box_of(one), other_box = box_of(other);
    if (distance_between(box, other_box) >= least_) return;
    if (one.size() <= few && other.size() <= few) {
      look_at_all(one, other);
      return;
    }
    const bool first = one.size() >= other.size();
    auto [near_half, far_half] = first ? halves(one, box) : halves(other, other_box);
    const Box& rest = first ? other_box : box;
    if (distance_between(box_of(far_half), rest) < distance_between(box_of(near_half), rest))
      std::swap(near_half, far_half);
    for (const std::span<Middle>& half : {near_half, far_half}) first ? look(half, other) : look(one, half);
  }

  [[nodiscard]] std::optional<std::array<Vec3, 2>> pair() const {
    return ended_ || !(least_ > 0.0) ? std::nullopt : pair_;
  }

 private:
  static constexpr std::size_t few = 8;

  static Box box_of(std::span<const Middle> middles) {
    Box box;
    for (const Middle& m : middles) box.include(m.place);
    return box;
  }

  /// Halves by the longest side of their box. The halves depend on nothing else.
  static std::pair<std::span<Middle>, std::span<Middle>> halves(std::span<Middle> all, const Box& box) {
    const Vec3 size = box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t half = all.size() / 2;
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(half), all.end(),
                     [axis](const Middle& a, const Middle& b) {
                       return a.place[axis] != b.place[axis] ? a.place[axis] < b.place[axis] : a.cell < b.cell;
                     });
    return {all.first(half), all.subspan(half)};
  }

  void look_at_all(std::span<const Middle> one, std::span<const Middle> other) {
    if (++looks_ % steps_between_checks == 0 && !goes_on_()) ended_ = true;
    for (const Middle& a : one) {
      for (const Middle& b : other) {
        const double apart = glm::distance(a.place, b.place);
        const std::pair cells{a.cell, b.cell};
        if (apart > least_ || (apart == least_ && (!pair_ || cells >= cells_))) continue;
        least_ = apart;
        cells_ = cells;
        pair_ = {a.place, b.place};
      }
    }
  }

  std::function<bool()> goes_on_;
  double least_ = near;
  std::optional<std::array<Vec3, 2>> pair_;
  std::pair<CellId, CellId> cells_{no_cell, no_cell};
  std::uint64_t looks_ = 0;
  bool ended_ = false;
};

}  // namespace

FlySearch::FlySearch(const Survey& survey, const Measure& measure, double spacing, const Vec3& from, const Vec3& to,
                     std::function<bool(std::uint64_t)> goes_on)
    : survey_(survey),
      measure_(measure),
      spacing_(spacing),
      cells_(survey, measure, spacing, from, to),
      goes_on_(std::move(goes_on)) {
  sides_[0].end = sides_[1].goal = from;
  sides_[1].end = sides_[0].goal = to;
}

double FlySearch::least_closed() const { return through_wall * finest_share * spacing_; }
double FlySearch::side_for(double radius) const { return std::max(finest_share * spacing_, side_share * radius); }

/// A cube with a free middle never reaches through a wall, so it may be twice as large.
bool FlySearch::is_fine(CellId cell) const {
  const double limit = cells_.free(cell) >= radius_ ? 2.0 * side_limit_ : side_limit_;
  return cells_.side(cell) <= limit || cells_.most(cell) < radius_ || cells_.is_open(cell, radius_) ||
         cells_.is_smallest(cell);
}

/// Whether a cube may hold the sphere's centre, under the assumptions of this search.
bool FlySearch::may_hold(CellId cell) {
  if (cells_.free(cell) >= radius_) return true;
  if (certain_ || cells_.most(cell) < radius_) return false;
  cells_.tighten(cell);
  return cells_.most(cell) >= radius_;
}

double FlySearch::cost_of(CellId cell) const {
  const double free = cells_.free(cell);
  if (free < radius_) return unsure_cost;
  return std::max(1.0, roomy * radius_ / free);
}

bool FlySearch::goes(const Vec3& from, double free, const Vec3& to) const {
  if (free - glm::distance(from, to) >= radius_) return true;
  return !survey_.world().first_impact({radius_, 0.0}, from, to - from).hit;
}

/// Whether the sphere goes from the middle of a cube to that of its neighbour, through the face that they share.
bool FlySearch::links(CellId a, CellId b) const {
  const Vec3 one = cells_.centre(a), other = cells_.centre(b), between = cells_.portal(a, b);
  const double free = cells_.free(a), there = cells_.free(b);
  if (free < radius_ || there < radius_) return false;
  const double apart = glm::distance(one, between) + glm::distance(other, between);
  if (cells_.side(a) == cells_.side(b) && 0.5 * (free + there - apart) >= radius_) return true;
  return goes(one, free, between) && goes(other, there, between);
}

bool FlySearch::reached(const Side& side, CellId cell) const {
  return cell < side.visits.size() && side.visits[cell].search == search_;
}

void FlySearch::reach(Side& side, CellId cell, CellId before, double cost) {
  if (side.visits.size() <= cell) side.visits.resize(std::max<std::size_t>(cells_.size(), cell + 1));
  Visit& visit = side.visits[cell];
  if (visit.search == search_ && (visit.done || visit.cost <= static_cast<float>(cost))) return;
  visit = {search_, false, before, static_cast<float>(cost)};
  side.open.push_back({cost + glm::distance(cells_.centre(cell), side.goal), pushed_++, cell});
  std::push_heap(side.open.begin(), side.open.end(), Open::later);
}

/// Starts a search: splits the cubes at both ends as finely as it needs. False if an end lies outside the searched air.
bool FlySearch::begin(double radius, bool certain) {
  radius_ = radius;
  certain_ = certain;
  side_limit_ = side_for(radius);
  ++search_;
  met_ = no_cell;
  way_.clear();
  for (Side& side : sides_) {
    side.open.clear();
    side.done = 0;
    CellId cell = cells_.at(side.end);
    while (cell != no_cell && !is_fine(cell)) {
      cells_.split(cell);
      cell = cells_.at(side.end);
    }
    if (cell == no_cell) return false;
    const double free = clearance_at(survey_, measure_, side.end);
    if (!certain || goes(side.end, free, cells_.centre(cell))) {
      reach(side, cell, no_cell, 0.0);
    }
    if (!certain) continue;
    std::vector<CellId> around;
    cells_.beside(
        cell, [&](CellId id) { return is_fine(id); }, [&](CellId id) { around.push_back(id); });
    for (const CellId id : around) {
      if (goes(side.end, free, cells_.centre(id)) && cells_.free(id) >= radius_)
        reach(side, id, no_cell, glm::distance(side.end, cells_.centre(id)));
    }
  }
  // The ends may lie in one cube, or in two neighbouring ones.
  for (const Open& open : sides_[0].open) {
    if (reached(sides_[1], open.cell)) met_ = open.cell;
  }
  return true;
}

bool FlySearch::follow(Side& side, Side& other) {
  std::pop_heap(side.open.begin(), side.open.end(), Open::later);
  const CellId cell = side.open.back().cell;
  side.open.pop_back();
  if (side.visits[cell].done) return false;
  side.visits[cell].done = true;
  ++side.done;
  const double gone = side.visits[cell].cost;
  bool met = false;
  const Vec3 middle = cells_.centre(cell);
  const double here = cost_of(cell);
  cells_.beside(
      cell, [&](CellId id) { return is_fine(id); },
      [&](CellId id) {
        if (met || !may_hold(id)) return;
        if (reached(side, id) && side.visits[id].done) return;
        if (certain_ && !links(cell, id)) return;
        const Vec3 between = cells_.portal(cell, id), there = cells_.centre(id);
        reach(side, id, cell,
              gone + here * glm::distance(middle, between) + cost_of(id) * glm::distance(between, there));
        if (!reached(other, id)) return;
        met = true;
        met_ = id;
      });
  return met;
}

Flight FlySearch::run() {
  if (met_ != no_cell) return Flight::found;
  for (std::uint64_t n = 0;; ++n) {
    for (int s = 0; s < 2; ++s) {
      Side& side = sides_[static_cast<std::size_t>(s)];
      if (side.open.empty()) return certain_ ? Flight::not_found : Flight::none;
      if (follow(side, sides_[static_cast<std::size_t>(1 - s)])) return Flight::found;
    }
    if (n % steps_between_checks == 0 && goes_on_ && !goes_on_(cells_.size())) return Flight::ended;
  }
}

/// The cubes from the start to the goal, through the cube where both sides met.
std::vector<CellId> FlySearch::met_cells() const {
  std::vector<CellId> cells;
  for (CellId id = met_; id != no_cell; id = sides_[0].visits[id].before) cells.push_back(id);
  std::reverse(cells.begin(), cells.end());
  for (CellId id = sides_[1].visits[met_].before; id != no_cell; id = sides_[1].visits[id].before) cells.push_back(id);
  return cells;
}

void FlySearch::set_way(const std::vector<CellId>& cells) {
  way_.push_back(sides_[0].end);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0 && cells_.side(cells[i - 1]) != cells_.side(cells[i]))
      way_.push_back(cells_.portal(cells[i - 1], cells[i]));
    way_.push_back(cells_.centre(cells[i]));
  }
  way_.push_back(sides_[1].end);
}

/// Splits the cubes of a way that are not known to be free, and neighbours of the same kind. Returns false if none can
/// be split or if the way is free already.
bool FlySearch::split_unsure(const std::vector<CellId>& cells) {
  std::vector<CellId> unsure;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    bool sure = cells_.free(cells[i]) >= radius_;
    if (i > 0 && !links(cells[i - 1], cells[i])) sure = false;
    if (i + 1 < cells.size() && !links(cells[i], cells[i + 1])) sure = false;
    if (i == 0 && !goes(sides_[0].end, 0.0, cells_.centre(cells[i]))) sure = false;
    if (i + 1 == cells.size() && !goes(sides_[1].end, 0.0, cells_.centre(cells[i]))) sure = false;
    if (!sure && !cells_.is_open(cells[i], radius_)) unsure.push_back(cells[i]);
  }
  const std::size_t on_way = unsure.size();
  for (std::size_t i = 0; i < on_way; ++i) {
    cells_.beside(
        unsure[i], [](CellId) { return true; },
        [&](CellId id) {
          if (cells_.free(id) < radius_ && cells_.most(id) >= radius_ && cells_.side(id) >= cells_.side(unsure[i]))
            unsure.push_back(id);
        });
  }
  bool any = false;
  for (const CellId id : unsure) {
    if (cells_.is_split(id) || cells_.side(id) < 2.0 * least_side || cells_.is_smallest(id)) continue;
    cells_.split(id);
    any = true;
  }
  return any;
}

Flight FlySearch::look(double radius, int most) {
  for (int turn = 0;; ++turn) {
    if (!begin(radius, false)) return Flight::none;
    const Flight flight = run();
    if (flight != Flight::found) return flight;
    const std::vector<CellId> cells = met_cells();
    bool sure = goes(sides_[0].end, 0.0, cells_.centre(cells.front())) &&
                goes(sides_[1].end, 0.0, cells_.centre(cells.back())) && cells_.free(cells.front()) >= radius;
    for (std::size_t i = 1; sure && i < cells.size(); ++i) sure = links(cells[i - 1], cells[i]);
    if (sure) {
      set_way(cells);
      return Flight::found;
    }
    if (turn == most || !split_unsure(cells)) return Flight::unsure;
  }
}

Flight FlySearch::search_free_cubes(double radius) {
  if (!begin(radius, true)) return Flight::not_found;
  const Flight flight = run();
  if (flight == Flight::found) set_way(met_cells());
  return flight;
}

std::optional<std::array<Vec3, 2>> FlySearch::nearest_approach() {
  std::uint64_t enough = std::max(sides_[0].done, sides_[1].done);
  for (int s = 0; s < 2; ++s) {
    Side& side = sides_[static_cast<std::size_t>(s)];
    while (side.done < enough && !side.open.empty() && !follow(side, sides_[static_cast<std::size_t>(1 - s)])) {
      if (side.done % steps_between_checks == 0 && goes_on_ && !goes_on_(cells_.size())) break;
    }
  }
  std::array<std::vector<Middle>, 2> reached;
  for (std::size_t s = 0; s < 2; ++s) {
    for (CellId id = 0; id < sides_[s].visits.size(); ++id)
      if (sides_[s].visits[id].search == search_ && cells_.side(id) < largest_near) {
        reached[s].push_back({cells_.centre(id), id});
      }
  }
  NearestPair nearest([this] { return !goes_on_ || goes_on_(cells_.size()); });
  nearest.look(reached[0], reached[1]);
  return nearest.pair();
}

}  // namespace roam::ways
