#include "cracks/open_drops.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <queue>
#include <tuple>

namespace roam::cracks {

namespace {

/// Metres of distance from floor gained per metre towards the open disc, in a corner that belongs to its pit. A right
/// angle has 0.707.
constexpr double corner_rate = 0.65;
/// Smallest radii: how much a notch in an edge may shorten the distance from floor.
constexpr double notch = 3.0;
/// Shares of the probe's radius and of the body's radius: spacing of the examined places on the way out.
constexpr double probe_share = 0.7, body_share = 0.15;
/// m: an outlet narrower by less than this does not count as narrower; the spacing of places along a way.
constexpr double narrower = 0.003, between_places = 0.01;
/// The largest cosine between the directions to two floors on different sides: 96 degrees, so that a right angle is one
/// side.
constexpr double opposite = -0.1;

/// Floor under a wall, such as the foot of a post, does not count: no body comes to it.
bool has_floor_on_both_sides(const VoidProbe& probe, const std::function<bool(const Vec3& foot)>& is_reached,
                             const Disc& disc) {
  std::vector<Vec3> ways;
  for (const TouchedFloor& floor : touched_floor(probe.floor(), disc)) {
    const Vec3 beyond = disc.centre + (floor.near.distance + probe.rim_offset()) * floor.way;
    if (is_reached(floor.near.point) && probe.sees(disc.centre, beyond)) ways.push_back(floor.way);
  }
  return std::any_of(ways.begin(), ways.end(), [&](const Vec3& a) {
    return std::any_of(ways.begin(), ways.end(), [&](const Vec3& b) { return a.x * b.x + a.y * b.y < opposite; });
  });
}

/// The way out of a place for the largest body that stands there.
class WayOut {
 public:
  WayOut(const CrackOptions& options, const VoidProbe& probe, const Disc& body)
      : probe_(probe),
        body_(body),
        spacing_(std::max(probe_share * probe.radius(), body_share * body.radius)),
        least_(body.radius - narrower),
        reach_(body.radius + options.support_max) {}

  bool leads_to_drop(const std::atomic<bool>& ended) {
    std::priority_queue<Outlet> next;
    std::map<std::pair<std::int64_t, std::int64_t>, std::optional<Vec3>> seen{{{0, 0}, body_.centre}};
    next.push({body_.radius, 0, 0});
    while (!next.empty() && !ended) {
      const Outlet at = next.top();
      next.pop();
      if (at.floor >= probe_.open_radius()) return true;
      const Vec3 from = *seen.at({at.x, at.y});
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const std::pair<std::int64_t, std::int64_t> to(at.x + dx, at.y + dy);
        if (seen.count(to) > 0) continue;
        const std::optional<Vec3> place =
            room_near(body_.centre + Vec3(double(to.first) * spacing_, double(to.second) * spacing_, 0.0));
        if (place && !goes(from, *place)) continue;  // the place may still be reached from another side
        seen.emplace(to, place);
        if (place) next.push({probe_.floor().nearest(*place, probe_.open_radius()).distance, to.first, to.second});
      }
    }
    return false;
  }

 private:
  /// A place of the lattice; those farther from floor come first.
  struct Outlet {
    double floor = 0.0;
    std::int64_t x = 0, y = 0;
    bool operator<(const Outlet& other) const {
      return std::tie(floor, x, y) < std::tie(other.floor, other.x, other.y);
    }
  };

  double room(const Vec3& place, double enough) const { return probe_.body().nearest(place, enough).distance; }

  /// A place for the body at or near a lattice place. If a ridge passes beside the lattice place, it is on that ridge.
  std::optional<Vec3> room_near(const Vec3& place) const {
    if (level_distance(place, body_.centre) > reach_) return std::nullopt;
    const double here = room(place, least_);
    if (here >= least_) return place;
    if (here + spacing_ < least_) return std::nullopt;
    const Disc disc = grow(probe_.body(), place, least_, 0.3 * narrower,
                           [&](const Vec3&, const Vec3& to) { return level_distance(to, place) <= spacing_; });
    return disc.radius >= least_ ? std::optional(disc.centre) : std::nullopt;
  }

  bool goes(const Vec3& from, const Vec3& to) const {
    const double parts = std::ceil(level_distance(from, to) / between_places);
    for (double i = 1.0; i < parts; i += 1.0) {
      if (room(from + (i / parts) * (to - from), least_) < least_ - narrower) return false;
    }
    return probe_.sees(from, to) && probe_.sinks(to, 0.9 * std::min(least_, probe_.radius()));
  }

  const VoidProbe& probe_;
  Disc body_;
  double spacing_, least_, reach_;
};

}  // namespace

bool opens_into_drop(const CrackOptions& options, const VoidProbe& probe,
                     const std::function<bool(const Vec3& foot)>& is_reached, const Vec3& place,
                     const std::atomic<bool>& ended) {
  const double floor = probe.floor().nearest(place, options.support_max).distance;
  if (has_floor_on_both_sides(probe, is_reached, {place, floor})) return false;
  return WayOut(options, probe, {place, probe.body().nearest_wall(place, floor).distance}).leads_to_drop(ended);
}

bool takes_in(const CrackOptions& options, const VoidProbe& probe, const Vec3& centre, const Vec3& place,
              double floor) {
  const double distance = level_distance(centre, place), start = floor - notch * options.smallest;
  if (distance > options.support_max) {
    if (start + corner_rate * distance > options.support_max) return false;
    for (const double share : {0.5, 0.25, 0.75}) {
      const Vec3 between(place.x + share * (centre.x - place.x), place.y + share * (centre.y - place.y), place.z);
      const double least = start + corner_rate * share * distance;
      if (!(least > 0.0)) continue;  // true of every place
      if (probe.floor().nearest(between, least).distance < least) return false;
    }
  }
  if (!probe.sees(centre, place)) return false;
  return probe.lets_pass(place, centre, probe.body().nearest_wall(place, floor).distance - narrower);
}

OpenDrops::OpenDrops(const CrackOptions& options, const VoidProbe& probe, const std::vector<RimPlace>& open)
    : options_(options), probe_(probe), side_((options.support_max + notch * options.smallest) / corner_rate) {
  // Discs nearer to each other than this cover the same places.
  const double apart = 0.2 * options.smallest;
  std::unordered_map<std::uint64_t, std::vector<double>> seen;
  for (const RimPlace& place : open) {
    const Vec3& c = place.disc.centre;
    std::vector<double>& levels = seen[square_at(c.x, c.y, apart)];
    if (std::any_of(levels.begin(), levels.end(), [&](double z) { return std::abs(z - c.z) <= apart; })) continue;
    levels.push_back(c.z);
    centres_[square_at(c.x, c.y, side_)].push_back(c);
  }
}

template <typename Accept>
bool OpenDrops::any(const Vec3& place, int squares, const Accept& accept) const {
  if (centres_.empty()) return false;
  for (int x = -squares; x <= squares; ++x) {
    for (int y = -squares; y <= squares; ++y) {
      const auto near = centres_.find(square_at(place.x + x * side_, place.y + y * side_, side_));
      if (near == centres_.end()) continue;
      for (const Vec3& centre : near->second) {
        if (std::abs(centre.z - place.z) <= options_.step && accept(centre)) return true;
      }
    }
  }
  return false;
}

bool OpenDrops::cover(const Vec3& place, double floor) const {
  const auto is_in = [&](const Vec3& centre) { return level_distance(centre, place) <= options_.support_max; };
  const auto takes = [&](const Vec3& centre) { return takes_in(options_, probe_, centre, place, floor); };
  // The discs with the cheaper test first.
  return any(place, 1, [&](const Vec3& centre) { return is_in(centre) && takes(centre); }) ||
         any(place, 1, [&](const Vec3& centre) { return !is_in(centre) && takes(centre); });
}

bool OpenDrops::cover(const Vec3& place) const {
  return !centres_.empty() && cover(place, probe_.floor().nearest(place, options_.support_max).distance);
}

bool OpenDrops::any_near(const Vec3& place, double reach) const {
  return any(place, 2, [&](const Vec3& centre) { return level_distance(centre, place) <= reach; });
}

}  // namespace roam::cracks
