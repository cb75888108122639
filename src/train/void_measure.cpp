#include "train/void_measure.h"

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

#include "train/disjoint_sets.h"

namespace roam::training {

namespace {

constexpr double kWindow = 4.0;         ///< m around a rim's disc that one flood fills
constexpr double kSpacingShare = 0.7;   ///< of the probe's radius: each place of a ridge has a cell within half of it
constexpr double kSinkMargin = 0.003;   ///< m that a sphere is smaller than the disc it sinks in: a store's 2 mm
constexpr std::size_t kMostDiscs = 32;  ///< of one flood that are grown

/// A place of the lattice at the level of one void.
struct Cell {
  std::int64_t x = 0, y = 0;
  double level = 0.0;
  double distance = 0.0;  ///< of floor or wall
  double floor = 0.0;     ///< of floor
  std::uint32_t flood = 0;
  bool inside = false;  ///< of the flood; else floor, a wall, filled up, or an open drop
};

/// The voids of one part of the scene that no other part's floods come to.
class Floods {
 public:
  /// `ended`: what is being flooded is measured as far as it came.
  Floods(const CrackOptions& options, const VoidProbe& probe, const OpenDrops& drops,
         const std::function<bool(const Vec3& foot)>& is_reached, const std::atomic<bool>& ended)
      : options_(options),
        probe_(probe),
        drops_(drops),
        is_reached_(is_reached),
        ended_(ended),
        spacing_(kSpacingShare * probe.radius()) {}

  void add(const RimPlace& place) {
    if (drops_.cover(place.disc.centre)) return;
    std::optional<std::uint32_t> flood = flood_at(place.outside);
    if (!flood) flood = fill(place.outside);
    rims_[*flood].push_back(place.rim);
  }

  /// Whether a place lies in what was flooded already; then it belongs to that.
  bool add_to_known(const RimPlace& place) {
    const std::optional<std::uint32_t> flood = flood_at(place.outside);
    if (flood) rims_[*flood].push_back(place.rim);
    return flood.has_value();
  }

  std::vector<MeasuredVoid> measured() {
    std::map<std::uint32_t, MeasuredVoid> voids;
    for (std::uint32_t flood = 0; flood < discs_.size(); ++flood) {
      MeasuredVoid& whole = voids[sets_.find(flood)];
      whole.foot = std::max({whole.foot, discs_[flood].radius, feet_[flood]});
      const Disc& disc = discs_[flood];
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

  /// The cell of a flood at about the level, or what was looked at on just this level.
  Cell* find(std::int64_t x, std::int64_t y, double level) {
    const auto square = cells_.find(square_number(x, y));
    if (square == cells_.end()) return nullptr;
    for (Cell& cell : square->second) {
      const double apart = std::abs(cell.level - level);
      if (cell.x == x && cell.y == y && apart <= (cell.inside ? options_.step : 0.0)) return &cell;
    }
    return nullptr;
  }

  /// The four places of the lattice about a place, the nearest first.
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

  /// Floods the void about `seed`; answers the flood's number.
  std::uint32_t fill(const Vec3& seed) {
    const std::uint32_t flood = sets_.add();
    rims_.emplace_back();
    beside_open_.push_back(false);
    std::deque<Cell> open;
    std::vector<Cell> filled;
    const auto enter = [&](const Vec3& from, std::int64_t x, std::int64_t y) {
      if (level_distance(place_of(x, y, seed.z), seed) > kWindow) return;
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
    const OpenPart open_part = open_part_of(flood, filled);
    discs_.push_back(largest(seed, filled, open_part));
    feet_.push_back(foot_over(filled, open_part));
    return flood;
  }

  /// The cell at (x, y) if it is new to all floods and belongs to this one. What another has joins the two.
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
      square.push_back({x, y, level, body, floor, flood, false});
      cell = &square.back();
    }
    // A ridge where the probe just fits has cells on it with so much less.
    const double least = probe_.radius() - half_diagonal();
    if (cell->distance < least) return std::nullopt;
    if (drops_.cover(place)) {
      beside_open_[flood] = true;
      return std::nullopt;
    }
    const double sphere = std::min(cell->distance, probe_.radius()) - kSinkMargin;
    if (!probe_.sees(from, place) || !probe_.sinks(place, sphere)) return std::nullopt;
    cell->level = level;
    cell->flood = flood;
    cell->inside = true;
    return *cell;
  }

  bool is_highest(const Cell& cell) {
    for (std::int64_t x = cell.x - 1; x <= cell.x + 1; ++x) {
      for (std::int64_t y = cell.y - 1; y <= cell.y + 1; ++y) {
        if (const Cell* near = find(x, y, cell.level); near && near->distance > cell.distance) return false;
      }
    }
    return true;
  }

  /// What of a flood is an open drop.
  struct OpenPart {
    std::vector<Vec3> centres;  ///< of its own open discs
    bool any = false;           ///< it comes to one, of its own or of those that were climbed to
  };

  OpenPart open_part_of(std::uint32_t flood, const std::vector<Cell>& cells) const {
    OpenPart open{open_discs(cells), beside_open_[flood]};
    open.any = open.any || !open.centres.empty();
    return open;
  }

  /// Whether a place lies in an open disc that is known.
  bool is_open(const Vec3& place, const OpenPart& open) const {
    return drops_.cover(place) || std::any_of(open.centres.begin(), open.centres.end(), [&](const Vec3& centre) {
             return level_distance(centre, place) <= options_.support_max && probe_.sees(centre, place);
           });
  }

  bool belongs_to_drop(const Disc& disc, const OpenPart& open) const {
    return is_open(disc.centre, open) || (open.any && opens_into_drop(options_, probe_, is_reached_, disc));
  }

  /// The farthest from floor that the axis of a smallest body comes, outside open drops: no foot carries there.
  double foot_over(std::vector<Cell>& cells, const OpenPart& open) const {
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) {
      return a.floor != b.floor ? a.floor > b.floor : std::tie(a.x, a.y) < std::tie(b.x, b.y);
    });
    const auto carried = std::find_if(cells.begin(), cells.end(), [&](const Cell& cell) {
      return cell.distance >= probe_.radius() && cell.floor < probe_.open() && !is_open(place_of(cell), open);
    });
    return carried == cells.end() ? 0.0 : carried->floor;
  }

  /// Grown from the best cells that none beside them exceeds, and from the seed. Of discs that grow into an open drop,
  /// or come to lie in one, nothing remains: what is left is measured without them. Radius 0 where nothing is left;
  /// open where the whole void is.
  Disc largest(const Vec3& seed, std::vector<Cell>& cells, const OpenPart& open) {
    std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) {
      return a.distance != b.distance ? a.distance > b.distance : std::tie(a.x, a.y) < std::tie(b.x, b.y);
    });
    Disc best, drop = open.centres.empty() ? Disc{} : Disc{open.centres.front(), options_.support_max};
    const auto try_from = [&](const Vec3& start) {
      if (is_open(start, open)) return;
      const Disc disc = grown(start);
      if (disc.radius >= probe_.open()) {
        drop = disc;
      } else if (disc.radius > best.radius && !belongs_to_drop(disc, open)) {
        best = disc;
      }
    };
    try_from(seed);
    std::vector<Vec3> starts;
    for (const Cell& cell : cells) {
      if (cell.distance + half_diagonal() <= best.radius || starts.size() == kMostDiscs) break;
      const Vec3 start = place_of(cell);
      const bool again = std::any_of(starts.begin(), starts.end(), [&](const Vec3& other) {
        return level_distance(other, start) < 0.5 * cell.distance;
      });
      if (again || !is_highest(cell) || is_open(start, open)) continue;
      starts.push_back(start);
      try_from(start);
    }
    return best.radius > 0.0 ? best : drop;
  }

  /// The centres of open discs among a flood's cells, in their order, none nearer to another than a probe.
  std::vector<Vec3> open_discs(const std::vector<Cell>& cells) const {
    std::vector<Vec3> discs;
    for (const Cell& cell : cells) {
      if (cell.floor < probe_.open()) continue;
      const Vec3 centre = place_of(cell);
      if (std::none_of(discs.begin(), discs.end(),
                       [&](const Vec3& other) { return level_distance(other, centre) < 2.0 * options_.smallest; }))
        discs.push_back(centre);
    }
    return discs;
  }

  /// The largest body that goes in near `start`, and a foot that carries it there. Where walls leave no room for a body
  /// as wide as the gap, it takes the foot that carries the widest bodies that they let in.
  Disc grown(const Vec3& start) const {
    constexpr double finest = 0.1 * VoidProbe::precision;
    constexpr double walls_decide = 0.001;  // m of floor's distance beyond the wall's
    constexpr double widest_share = 0.8;    // of the room between the walls, that bodies are thought to need
    const double sphere = probe_.radius() - kSinkMargin;
    const auto stays = [&](const Vec3& from, const Vec3& to) {
      return probe_.sees(from, to) && probe_.sinks(to, sphere);
    };
    const Disc body = grow(probe_.body(), start, probe_.open(), finest, stays);
    if (probe_.floor().nearest(body.centre, probe_.open()).distance <= body.radius + walls_decide) return body;
    return grow(probe_.floor(), body.centre, probe_.open(), finest, [&](const Vec3& from, const Vec3& to) {
      const double room = widest_share * body.radius;
      return stays(from, to) && probe_.body().nearest_wall(to, room).distance >= room;
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
  std::vector<double> feet_;             ///< likewise: the farthest that the axis of a smallest body is from floor
  std::vector<bool> beside_open_;        ///< likewise: it comes to open drops that were climbed to
};

/// What was climbed to and not measured: the widest disc of each void.
std::vector<MeasuredVoid> climbed(const CrackOptions& options, const OpenDrops& drops, std::vector<RimPlace> places) {
  std::erase_if(places, [&](const RimPlace& place) { return drops.cover(place.disc.centre); });
  std::vector<MeasuredVoid> voids;
  for (const std::vector<std::size_t>& group : together(places, options.support_max, options.step)) {
    MeasuredVoid& found = voids.emplace_back();
    for (const std::size_t i : group) {
      if (places[i].disc.radius > found.disc.radius) found.disc = places[i].disc;
      found.rim.push_back(places[i].rim);
    }
    found.foot = found.disc.radius;
  }
  return voids;
}

/// Places in parts that are farther from each other than two floods reach, in the order of their first places.
std::vector<std::vector<RimPlace>> apart(const std::vector<RimPlace>& places) {
  constexpr double side = 2.0 * kWindow + 0.5;
  std::unordered_map<std::uint64_t, std::uint32_t> squares;
  DisjointSets sets;
  std::vector<std::uint32_t> square_of;
  for (const RimPlace& place : places) {
    const Vec3& c = place.disc.centre;
    const auto [square, is_new] = squares.try_emplace(square_at(c.x, c.y, side), std::uint32_t(sets.size()));
    if (is_new) sets.add();
    square_of.push_back(square->second);
    for (int k = 0; is_new && k < 9; ++k) {
      const auto beside = squares.find(square_at(c.x + (k % 3 - 1) * side, c.y + (k / 3 - 1) * side, side));
      if (beside != squares.end()) sets.unite(beside->second, square->second);
    }
  }
  std::vector<std::vector<RimPlace>> parts;
  std::unordered_map<std::uint32_t, std::size_t> part_of;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto [part, is_new] = part_of.try_emplace(sets.find(square_of[i]), parts.size());
    if (is_new) parts.emplace_back();
    parts[part->second].push_back(places[i]);
  }
  return parts;
}

}  // namespace

std::vector<MeasuredVoid> measure_voids(const CrackOptions& options, const VoidProbe& probe, const OpenDrops& drops,
                                        const std::vector<RimPlace>& places,
                                        const std::function<bool(const Vec3& foot)>& is_reached,
                                        const std::function<bool(double)>& goes_on, std::atomic<bool>& ended) {
  const std::vector<std::vector<RimPlace>> parts = apart(places);
  std::vector<std::vector<MeasuredVoid>> measured(parts.size());
  std::vector<std::vector<RimPlace>> left(parts.size());
  std::mutex mutex;
  std::size_t done = 0;
  const auto asked = [&] {
    if (!goes_on || ended) return;
    const std::lock_guard lock(mutex);
    if (!ended && !goes_on(double(done++) / double(places.size()))) ended = true;
  };
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
    Floods floods(options, probe, drops, is_reached, ended);
    for (const RimPlace& place : parts[i]) {
      asked();
      if (!ended)
        floods.add(place);
      else if (!floods.add_to_known(place))
        left[i].push_back(place);
    }
    measured[i] = floods.measured();
  });
  std::vector<MeasuredVoid> all;
  std::vector<RimPlace> rest;
  for (std::vector<MeasuredVoid>& part : measured) std::move(part.begin(), part.end(), std::back_inserter(all));
  for (std::vector<RimPlace>& part : left) std::move(part.begin(), part.end(), std::back_inserter(rest));
  for (MeasuredVoid& found : climbed(options, drops, std::move(rest))) all.push_back(std::move(found));
  return all;
}

}  // namespace roam::training
