#include "cracks/void_measure.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>
#include <mutex>
#include <numbers>
#include <optional>
#include <tuple>

#include "math/disjoint_sets.h"

namespace roam::cracks {

namespace {

constexpr double window = 4.0;         ///< m around a rim place that one flood fills
constexpr double spacing_share = 0.7;  ///< of the probe's radius, so that a cell lies within half a radius of any place
constexpr double sink_margin = 0.003;  ///< m that the sinking sphere is smaller than its disc: a store rounds by 2 mm
constexpr double finest = 0.1 * VoidProbe::precision;  ///< m
constexpr std::size_t most_discs = 32;                 ///< discs grown for one flood
constexpr std::size_t most_beside = 3;                 ///< likewise, up to the border of an open drop, which is slow

/// A place of the lattice at the level of one void.
struct Cell {
  std::int64_t x = 0, y = 0;
  double level = 0.0;
  double distance = 0.0;        ///< from floor or wall
  double floor_distance = 0.0;  ///< from floor
  std::uint32_t flood = 0;
  bool inside = false;  ///< of the flood; else floor, a wall, too narrow, or an open drop
  bool drop = false;    ///< proved to belong to an open drop
};

/// The voids of one part of the scene, which floods of other parts do not reach.
class Floods {
 public:
  /// Once `ended` is set, the current flood is measured as far as it is.
  Floods(const CrackOptions& options, const VoidProbe& probe, const OpenDrops& drops,
         const std::function<bool(const Vec3& foot)>& is_reached, const std::atomic<bool>& ended)
      : options_(options),
        probe_(probe),
        drops_(drops),
        is_reached_(is_reached),
        ended_(ended),
        spacing_(spacing_share * probe.radius()) {}

  void add(const RimPlace& place) {
    if (drops_.cover(place.outside)) return;
    std::optional<std::uint32_t> flood = flood_at(place.outside);
    if (!flood) flood = fill(place.outside);
    rims_[*flood].push_back(place.rim);
  }

  /// Adds a place to the flood that contains it. Returns false if there is none.
  bool add_to_known(const RimPlace& place) {
    const std::optional<std::uint32_t> flood = flood_at(place.outside);
    if (flood) rims_[*flood].push_back(place.rim);
    return flood.has_value();
  }

  /// For each void, joined from its floods: the largest disc that is no open drop. Open drops are separate entries.
  std::vector<MeasuredVoid> measured() {
    std::map<std::pair<std::uint32_t, bool>, MeasuredVoid> voids;
    for (std::uint32_t flood = 0; flood < discs_.size(); ++flood) {
      const Disc& disc = discs_[flood];
      const bool is_open = disc.radius >= probe_.open_radius();
      MeasuredVoid& whole = voids[{sets_.find(flood), is_open}];
      whole.support_radius = std::max({whole.support_radius, disc.radius, supports_[flood]});
      if (disc.radius > whole.disc.radius ||
          (disc.radius == whole.disc.radius && comes_before(disc.centre, whole.disc.centre)))
        whole.disc = disc;
      whole.rim.insert(whole.rim.end(), rims_[flood].begin(), rims_[flood].end());
    }
    std::vector<MeasuredVoid> all;
    for (auto& [set, whole] : voids) {
      if (whole.disc.radius > 0.0) all.push_back(std::move(whole));
    }
    return all;
  }

 private:
  Vec3 place_of(std::int64_t x, std::int64_t y, double level) const {
    return {double(x) * spacing_, double(y) * spacing_, level};
  }
  Vec3 place_of(const Cell& cell) const { return place_of(cell.x, cell.y, cell.level); }
  double half_diagonal() const { return 0.5 * std::numbers::sqrt2 * spacing_; }

  /// A cell of a flood at about that level, or an examined cell at exactly that level.
  Cell* find(std::int64_t x, std::int64_t y, double level) {
    const auto square = cells_.find(square_number(x, y));
    if (square == cells_.end()) return nullptr;
    for (Cell& cell : square->second) {
      const double apart = std::abs(cell.level - level);
      if (cell.x == x && cell.y == y && apart <= (cell.inside ? options_.step : 0.0)) return &cell;
    }
    return nullptr;
  }

  /// The four lattice places around a place, the nearest first.
  std::array<Cell, 4> about(const Vec3& place) const {
    const auto x = std::int64_t(std::floor(place.x / spacing_)), y = std::int64_t(std::floor(place.y / spacing_));
    std::array<Cell, 4> cells{{{.x = x, .y = y}, {.x = x + 1, .y = y}, {.x = x, .y = y + 1}, {.x = x + 1, .y = y + 1}}};
    for (Cell& cell : cells) cell.level = place.z;
    std::sort(cells.begin(), cells.end(), [&](const Cell& a, const Cell& b) {
      const double to_a = level_distance(place_of(a), place), to_b = level_distance(place_of(b), place);
      return std::tie(to_a, a.x, a.y) < std::tie(to_b, b.x, b.y);
    });
    return cells;
  }

  std::optional<std::uint32_t> flood_at(const Vec3& place) {
    for (const Cell& near : about(place)) {
      const Cell* cell = find(near.x, near.y, place.z);
      if (cell && cell->inside && probe_.sees(place, place_of(near))) return cell->flood;
    }
    return std::nullopt;
  }

  /// Floods the void around `seed`. Returns the flood's number.
  std::uint32_t fill(const Vec3& seed) {
    const std::uint32_t flood = sets_.add();
    rims_.emplace_back();
    std::deque<Cell> open;
    std::vector<Cell> filled;
    const auto enter = [&](const Vec3& from, std::int64_t x, std::int64_t y) {
      if (level_distance(place_of(x, y, seed.z), seed) > window) return;
      if (const std::optional<Cell> cell = entered(from, x, y, seed.z, flood)) {
        open.push_back(*cell);
        filled.push_back(*cell);
      }
    };
    for (const Cell& near : about(seed)) enter(seed, near.x, near.y);
    while (!open.empty() && !ended_) {
      const Cell cell = open.front();
      open.pop_front();
      const Vec3 from = place_of(cell);
      enter(from, cell.x + 1, cell.y);
      enter(from, cell.x - 1, cell.y);
      enter(from, cell.x, cell.y + 1);
      enter(from, cell.x, cell.y - 1);
    }
    std::vector<Vec3> own_drops = open_discs(filled);
    discs_.push_back(largest(seed, filled, own_drops));
    const Disc& disc = discs_.back();
    supports_.push_back(disc.radius > 0.0 && disc.radius < probe_.open_radius() ? support_over(filled, own_drops)
                                                                                : 0.0);
    return flood;
  }

  /// The cell at (x, y) if no flood has it yet and it belongs to this one. If another flood has it, the two are joined.
  std::optional<Cell> entered(const Vec3& from, std::int64_t x, std::int64_t y, double level, std::uint32_t flood) {
    Cell* cell = find(x, y, level);
    if (cell && cell->inside) {
      if (cell->flood != flood && probe_.sees(from, place_of(*cell) + Vec3(0.0, 0.0, level - cell->level)))
        sets_.unite(cell->flood, flood);
      return std::nullopt;
    }
    const Vec3 place = place_of(x, y, level);
    if (!cell) {
      const double floor = probe_.floor().nearest(place, options_.support_max).distance;
      const double body = probe_.body().nearest_wall(place, floor).distance;
      std::vector<Cell>& square = cells_[square_number(x, y)];
      square.push_back({x, y, level, body, floor, flood, false, false});
      cell = &square.back();
    }
    // Where the probe just fits on a ridge, the cells nearest to the ridge have this much less room.
    const double least = probe_.radius() - half_diagonal();
    if (cell->distance < least) return std::nullopt;
    if (drops_.cover(place, cell->floor_distance)) return std::nullopt;
    const double sphere = std::min(cell->distance, probe_.radius()) - sink_margin;
    if (!probe_.sees(from, place) || !probe_.sinks(place, sphere)) return std::nullopt;
    cell->level = level;
    cell->flood = flood;
    cell->inside = true;
    return *cell;
  }

  /// Whether no neighbouring cell of the flood is higher. Cells of an open drop may rise slowly from this one, as along
  /// a ridge. If one rises steeply, this cell is on the flank of that drop's ridge.
  bool is_highest(const Cell& cell) {
    constexpr double slowly = 0.5;
    for (std::int64_t x = cell.x - 1; x <= cell.x + 1; ++x) {
      for (std::int64_t y = cell.y - 1; y <= cell.y + 1; ++y) {
        const Cell* near = find(x, y, cell.level);
        if (!near || !near->inside) continue;
        const double rise = near->distance - cell.distance;
        if (rise > (near->drop ? slowly * level_distance(place_of(*near), place_of(cell)) : 0.0)) return false;
      }
    }
    return true;
  }

  /// Whether an open disc of the flood itself covers a place of it.
  bool is_in(const std::vector<Vec3>& own_drops, const Vec3& place, double floor) const {
    return std::any_of(own_drops.begin(), own_drops.end(),
                       [&](const Vec3& centre) { return takes_in(options_, probe_, centre, place, floor); });
  }

  /// Whether a known open disc covers a place.
  bool is_open(const Vec3& place, const std::vector<Vec3>& own_drops) const {
    const double floor = probe_.floor().nearest(place, options_.support_max).distance;
    return drops_.cover(place, floor) || is_in(own_drops, place, floor);
  }

  /// Whether a place that no open disc covers belongs to a drop beside it.
  bool is_beside_drop(const Vec3& place, const std::vector<Vec3>& own_drops) const {
    // Covers the largest body, its way to the drop, and an arc around a corner with open discs at its ends.
    const double reach = 2.5 * options_.support_max;
    return (drops_.any_near(place, reach) || is_near(own_drops, place, reach)) &&
           opens_into_drop(options_, probe_, is_reached_, place, ended_);
  }

  /// The greatest distance from floor of a smallest body's axis, outside open drops, which no support disc bridges.
  double support_over(std::vector<Cell>& cells, const std::vector<Vec3>& own_drops) {
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) {
      return a.floor_distance != b.floor_distance ? a.floor_distance > b.floor_distance
                                                  : std::tie(a.x, a.y) < std::tie(b.x, b.y);
    });
    std::vector<Vec3> beside;
    for (const Cell& cell : cells) {
      const Vec3 place = place_of(cell);
      if (cell.distance < probe_.radius() || cell.floor_distance >= probe_.open_radius() ||
          is_in(own_drops, place, cell.floor_distance) || is_near(beside, place, 2.0 * options_.smallest))
        continue;
      if (!is_beside_drop(place, own_drops)) return cell.floor_distance;
      beside.push_back(place);
    }
    return 0.0;
  }

  static bool is_near(const std::vector<Vec3>& places, const Vec3& place, double reach) {
    return std::any_of(places.begin(), places.end(),
                       [&](const Vec3& other) { return level_distance(other, place) < reach; });
  }

  /// The largest disc grown from local maxima of the cells and from the seed, outside open drops. Radius 0 if no place
  /// is left; an open disc if the flood itself is a drop. Adds the open discs that it finds to `own_drops`.
  Disc largest(const Vec3& seed, std::vector<Cell>& cells, std::vector<Vec3>& own_drops) {
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) {
      return a.distance != b.distance ? a.distance > b.distance : std::tie(a.x, a.y) < std::tie(b.x, b.y);
    });
    Disc best = grown_outside(seed, own_drops);
    if (best.radius > 0.0 && is_beside_drop(best.centre, own_drops)) best = {};
    std::vector<Vec3> starts, beside;
    std::size_t again = 0;
    for (const Cell& cell : cells) {
      const double most = cell.distance + half_diagonal();
      if (most <= std::max(best.radius, options_.smallest - VoidProbe::precision) || starts.size() == most_discs) break;
      const Vec3 start = place_of(cell);
      Cell& marked = *find(cell.x, cell.y, cell.level);
      marked.drop = cell.floor_distance >= probe_.open_radius() || is_in(own_drops, start, cell.floor_distance) ||
                    is_near(beside, start, std::max(0.25 * cell.distance, 2.0 * options_.smallest));
      if (marked.drop || is_near(starts, start, 0.5 * cell.distance) || !is_highest(cell)) continue;
      Disc disc = grown_outside(start, own_drops);
      if (disc.radius > best.radius && is_beside_drop(disc.centre, own_drops)) {
        marked.drop = is_beside_drop(start, own_drops);
        if (marked.drop) {
          beside.push_back(start);
          continue;
        }
        disc = again++ < most_beside ? grown_beside(start, own_drops) : Disc{start, cell.distance};
      }
      starts.push_back(start);
      if (disc.radius > best.radius) best = disc;
    }
    if (best.radius > 0.0 || own_drops.empty()) return best;
    return {own_drops.front(), options_.support_max};
  }

  /// As grown, but outside open discs. Adds the discs that it meets to `own_drops`. Radius 0 if one covers `start`.
  Disc grown_outside(const Vec3& start, std::vector<Vec3>& own_drops) const {
    while (!is_open(start, own_drops)) {
      const Disc disc = grown(start, [&](const Vec3& to) { return !is_open(to, own_drops); });
      if (disc.radius < probe_.open_radius()) return disc;
      own_drops.push_back(disc.centre);
    }
    return {};
  }

  /// As grown, but only over places that do not belong to an open drop, to a precision of `about`.
  Disc grown_beside(const Vec3& start, const std::vector<Vec3>& own_drops) const {
    constexpr double about = 0.01;  // m: the border of such places is no sharper than this
    const auto may_be = [&](const Vec3& to) { return !is_open(to, own_drops) && !is_beside_drop(to, own_drops); };
    const Disc near = grow(probe_.body(), start, probe_.open_radius(), about,
                           [&](const Vec3& from, const Vec3& to) { return stays(from, to) && may_be(to); });
    const auto in_reach = [&](const Vec3& to) {
      return level_distance(to, near.centre) <= about && !is_open(to, own_drops);
    };
    const Disc body = grow(probe_.body(), near.centre, probe_.open_radius(), finest,
                           [&](const Vec3& from, const Vec3& to) { return stays(from, to) && in_reach(to); });
    // Stopped before the ridge, it is that much nearer to a wall than to floor, although no wall limits the void.
    const double floor = probe_.floor().nearest(body.centre, probe_.open_radius()).distance;
    return floor <= body.radius + 2.0 * about ? body : grown(near.centre, in_reach);
  }

  /// The centres of open discs among a flood's cells, in their order, at least a probe apart.
  std::vector<Vec3> open_discs(const std::vector<Cell>& cells) const {
    std::vector<Vec3> discs;
    for (const Cell& cell : cells) {
      if (cell.floor_distance < probe_.open_radius()) continue;
      const Vec3 centre = place_of(cell);
      if (!is_near(discs, centre, 2.0 * options_.smallest)) discs.push_back(centre);
    }
    return discs;
  }

  /// Whether the straight way between two places stays in the void.
  bool stays(const Vec3& from, const Vec3& to) const {
    return probe_.sees(from, to) && probe_.sinks(to, probe_.radius() - sink_margin);
  }

  /// The largest body that fits into the void near `start`, within `may_be`, as the support disc that carries it. If
  /// walls leave no room for a body as wide as the gap, it is the support disc for the widest bodies that fit between
  /// the walls.
  Disc grown(const Vec3& start, const std::function<bool(const Vec3& to)>& may_be) const {
    constexpr double walls_decide = 0.001;  // m: walls limit the body if floor is farther than this beyond them
    constexpr double widest_share = 0.8;    // of the room between the walls; assumed width of bodies
    const auto may_move = [&](const Vec3& from, const Vec3& to) { return stays(from, to) && may_be(to); };
    const Disc body = grow(probe_.body(), start, probe_.open_radius(), finest, may_move);
    if (probe_.floor().nearest(body.centre, probe_.open_radius()).distance <= body.radius + walls_decide) return body;
    return grow(probe_.floor(), body.centre, probe_.open_radius(), finest, [&](const Vec3& from, const Vec3& to) {
      const double room = widest_share * body.radius;
      return may_move(from, to) && probe_.body().nearest_wall(to, room).distance >= room;
    });
  }

  const CrackOptions& options_;
  const VoidProbe& probe_;
  const OpenDrops& drops_;
  const std::function<bool(const Vec3& foot)>& is_reached_;
  const std::atomic<bool>& ended_;
  double spacing_;
  std::unordered_map<std::uint64_t, std::vector<Cell>> cells_;
  DisjointSets sets_;
  std::vector<Disc> discs_;              ///< of each flood
  std::vector<std::vector<Vec3>> rims_;  ///< likewise
  std::vector<double> supports_;         ///< likewise: the greatest distance from floor of a smallest body's axis
};

/// The voids that were climbed but not measured, with their widest discs.
std::vector<MeasuredVoid> climbed(const CrackOptions& options, const OpenDrops& drops, std::vector<RimPlace> places) {
  std::erase_if(places, [&](const RimPlace& place) { return drops.cover(place.outside); });
  std::vector<MeasuredVoid> voids;
  std::vector<Vec3> centres;
  for (const RimPlace& place : places) centres.push_back(place.disc.centre);
  for (const std::vector<std::size_t>& group : groups_within(centres, options.support_max, options.step)) {
    MeasuredVoid& found = voids.emplace_back();
    for (const std::size_t i : group) {
      if (places[i].disc.radius > found.disc.radius) found.disc = places[i].disc;
      found.rim.push_back(places[i].rim);
    }
    found.support_radius = found.disc.radius;
  }
  return voids;
}

}  // namespace

std::vector<MeasuredVoid> measure_voids(const CrackOptions& options, const VoidProbe& probe, const OpenDrops& drops,
                                        const std::vector<RimPlace>& places,
                                        const std::function<bool(const Vec3& foot)>& is_reached,
                                        const std::function<bool(double)>& goes_on, std::atomic<bool>& ended) {
  std::vector<Vec3> seeds;
  for (const RimPlace& place : places) seeds.push_back(place.outside);
  const std::vector<std::vector<std::size_t>> parts = groups_apart(seeds, 2.0 * window + 0.5);
  std::vector<std::vector<MeasuredVoid>> measured(parts.size());
  std::vector<std::vector<RimPlace>> left(parts.size());
  std::mutex mutex;
  std::size_t done = 0;
  const auto check_ended = [&] {
    if (!goes_on || ended) return;
    const std::lock_guard lock(mutex);
    if (!ended && !goes_on(double(done++) / double(places.size()))) ended = true;
  };
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
    Floods floods(options, probe, drops, is_reached, ended);
    for (const std::size_t k : parts[i]) {
      const RimPlace& place = places[k];
      check_ended();
      if (!ended)
        floods.add(place);
      else if (!floods.add_to_known(place))
        left[i].push_back(place);
    }
    measured[i] = floods.measured();
  });
  std::vector<MeasuredVoid> all;
  std::vector<RimPlace> rest;
  for (std::vector<RimPlace>& part : left) std::move(part.begin(), part.end(), std::back_inserter(rest));
  measured.push_back(climbed(options, drops, std::move(rest)));
  for (std::vector<MeasuredVoid>& part : measured) std::move(part.begin(), part.end(), std::back_inserter(all));
  return all;
}

}  // namespace roam::cracks
