#include "train/open_drops.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <queue>
#include <set>
#include <tuple>

#include "train/disjoint_sets.h"

namespace roam::training {

namespace {

/// Of a disc's radius: floor that is so little farther counts as touched.
constexpr double touch_share = 0.02;
/// Of the probe's radius, and of a disc's: between the places that are looked at on the way out of it.
constexpr double probe_share = 0.7, disc_share = 0.15;

/// Floor under a wall, as the foot of a post, is none that one comes to.
bool has_floor_on_both_sides(const VoidProbe& probe, const std::function<bool(const Vec3& foot)>& is_reached,
                             const Disc& disc) {
  std::vector<NearPlace> near;
  const double reach = 2.0 * disc.radius;
  probe.floor().touching(disc.centre, reach, touch_share * disc.radius, near);
  std::vector<Vec3> ways;  // level, from the centre
  for (const NearPlace& n : near) {
    const Vec3 way(n.point.x - disc.centre.x, n.point.y - disc.centre.y, 0.0);
    const Vec3 beyond = disc.centre + (1.0 + probe.outside() / n.distance) * way;
    if (n.distance < reach && is_reached(n.point) && probe.sees(disc.centre, beyond)) ways.push_back(way);
  }
  return std::any_of(ways.begin(), ways.end(), [&](const Vec3& a) {
    return std::any_of(ways.begin(), ways.end(), [&](const Vec3& b) { return a.x * b.x + a.y * b.y < 0.0; });
  });
}

/// A place of a lattice about a disc; those farther from floor come first.
struct Outlet {
  double floor = 0.0;
  std::int64_t x = 0, y = 0;
  bool operator<(const Outlet& other) const { return std::tie(floor, x, y) < std::tie(other.floor, other.x, other.y); }
};

bool comes_to_drop(const CrackOptions& options, const VoidProbe& probe, const Disc& disc) {
  const double spacing = std::max(probe_share * probe.radius(), disc_share * disc.radius);
  const double least = disc.radius - 0.5 * std::numbers::sqrt2 * spacing, reach = disc.radius + options.support_max;
  const auto place_of = [&](std::int64_t x, std::int64_t y) {
    return disc.centre + Vec3(double(x) * spacing, double(y) * spacing, 0.0);
  };
  std::priority_queue<Outlet> next;
  std::set<std::pair<std::int64_t, std::int64_t>> seen{{0, 0}};
  next.push({disc.radius, 0, 0});
  while (!next.empty()) {
    const Outlet at = next.top();
    next.pop();
    if (at.floor >= probe.open()) return true;
    for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
      const Vec3 place = place_of(at.x + dx, at.y + dy);
      if (level_distance(place, disc.centre) > reach || !seen.emplace(at.x + dx, at.y + dy).second) continue;
      const double floor = probe.floor().nearest(place, options.support_max).distance;
      if (floor >= least && probe.body().nearest_wall(place, floor).distance >= least &&
          probe.sees(place_of(at.x, at.y), place))
        next.push({floor, at.x + dx, at.y + dy});
    }
  }
  return false;
}

}  // namespace

bool opens_into_drop(const CrackOptions& options, const VoidProbe& probe,
                     const std::function<bool(const Vec3& foot)>& is_reached, const Disc& disc) {
  return !has_floor_on_both_sides(probe, is_reached, disc) && comes_to_drop(options, probe, disc);
}

std::uint64_t square_at(double x, double y, double side) {
  return square_number(std::int64_t(std::floor(x / side)), std::int64_t(std::floor(y / side)));
}

OpenDrops::OpenDrops(const CrackOptions& options, const VoidProbe& probe, const std::vector<RimPlace>& open)
    : probe_(probe), reach_(options.support_max), step_(options.step) {
  // Discs nearer to one another than this cover the same.
  const double apart = 0.2 * options.smallest;
  std::unordered_map<std::uint64_t, std::vector<double>> seen;
  for (const RimPlace& place : open) {
    const Vec3& c = place.disc.centre;
    std::vector<double>& levels = seen[square_at(c.x, c.y, apart)];
    if (std::any_of(levels.begin(), levels.end(), [&](double z) { return std::abs(z - c.z) <= apart; })) continue;
    levels.push_back(c.z);
    centres_[square_at(c.x, c.y, reach_)].push_back(c);
  }
}

bool OpenDrops::cover(const Vec3& place) const {
  if (centres_.empty()) return false;
  for (int k = 0; k < 9; ++k) {
    const auto near = centres_.find(square_at(place.x + (k % 3 - 1) * reach_, place.y + (k / 3 - 1) * reach_, reach_));
    if (near == centres_.end()) continue;
    for (const Vec3& centre : near->second) {
      if (level_distance(centre, place) <= reach_ && std::abs(centre.z - place.z) <= step_ &&
          probe_.sees(centre, place))
        return true;
    }
  }
  return false;
}

std::vector<std::vector<std::size_t>> together(const std::vector<RimPlace>& places, double reach, double step) {
  DisjointSets sets(places.size());
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> squares;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    const Vec3& c = places[i].disc.centre;
    for (int k = 0; k < 9; ++k) {
      const auto near = squares.find(square_at(c.x + (k % 3 - 1) * reach, c.y + (k / 3 - 1) * reach, reach));
      if (near == squares.end()) continue;
      for (const std::uint32_t other : near->second) {
        const Vec3 apart = places[other].disc.centre - c;
        if (std::hypot(apart.x, apart.y) <= reach && std::abs(apart.z) <= step) sets.unite(i, other);
      }
    }
    squares[square_at(c.x, c.y, reach)].push_back(i);
  }
  std::map<std::uint32_t, std::vector<std::size_t>> groups;  // a set's name is its least number
  for (std::uint32_t i = 0; i < places.size(); ++i) groups[sets.find(i)].push_back(i);
  std::vector<std::vector<std::size_t>> all;
  for (auto& [set, group] : groups) all.push_back(std::move(group));
  return all;
}

}  // namespace roam::training
