#include "cracks/voids.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>

#include "cracks/rim_edges.h"

namespace roam::cracks {

namespace {

/// m: ground lower than a step by less than this is within reach, such as a kerb as high as a step in a store of 2 mm.
constexpr double step_slack = 0.003;
/// Shares of the smallest gap: the sphere that sinks into it, and the one that tests for walls at knee height.
constexpr double probe_share = 0.9, sight_share = 0.2 * probe_share;
/// m: precision of a climb. Before the measurement only its place matters, not its exact size.
constexpr double climb_precision = 0.004;
/// m: two corners of an edge nearer than this in the plan define no side.
constexpr double shortest_way = 1e-9;

}  // namespace

bool sees_at_knee(const World& world, const Vec3& from, const Vec3& to, double knee, double smallest) {
  const double sphere = sight_share * smallest;
  const Vec3 eye = from + Vec3(0.0, 0.0, knee);
  FirstImpact met = world.first_impact({sphere, 0.0}, eye, to - from);
  // A sphere in contact with a wall may be unable to leave it; a smaller one can.
  if (met.hit && met.time == 0.0) met = world.first_impact({0.7 * sphere, 0.0}, eye, to - from);
  return !met.hit;
}

VoidProbe::VoidProbe(const Survey& survey, const CrackOptions& options)
    : survey_(survey),
      options_(options),
      step_(options.step + step_slack),
      radius_(probe_share * options.smallest),
      rim_offset_(1.02 * radius_ + 2.0 * survey.world().largest_error()),
      floor_(survey, step_),
      body_(survey, floor_, options.knee) {}

bool VoidProbe::has_floor(const Vec3& place) const {
  return survey_.floor().first_impact({0.0, 0.0}, place + Vec3(0.0, 0.0, step_), Vec3(0.0, 0.0, -2.0 * step_)).hit;
}

bool VoidProbe::sees(const Vec3& from, const Vec3& to) const {
  return sees_at_knee(survey_.world(), from, to, options_.knee, options_.smallest);
}

bool VoidProbe::lets_pass(const Vec3& from, const Vec3& to, double body) const {
  if (body <= 0.0) return true;
  return !survey_.world().first_impact({body, 0.0}, from + Vec3(0.0, 0.0, options_.knee + body), to - from).hit;
}

bool VoidProbe::sinks(const Vec3& place, double radius) const {
  const Vec3 knee = place + Vec3(0.0, 0.0, options_.knee);
  return !survey_.world().first_impact({radius, 0.0}, knee, {0.0, 0.0, radius - step_ - options_.knee}).hit;
}

std::optional<Vec3> VoidProbe::bottom(const Vec3& place) const {
  const double depth = std::min(place.z - survey_.world().bounds().lower.z + 1.0, Space::motion_limit);
  const FirstImpact down = survey_.world().first_impact({0.0, 0.0}, place, {0.0, 0.0, -depth});
  if (!down.hit) return std::nullopt;
  return place - Vec3(0.0, 0.0, down.time * depth);
}

namespace {

/// A place of a rim, the direction out of the floor, and a place just outside.
struct Rim {
  Vec3 at{0.0}, out{0.0}, outside{0.0};
};

/// The rims of one floor triangle.
class Rims {
 public:
  Rims(const VoidProbe& probe, const CrackOptions& options) : probe_(probe), smallest_(options.smallest) {}

  /// Finds rim places with a void outside, on the edges without a bit in `known`. Examines places for which `wants`
  /// returns true, and calls take(rim) for each that has a void; false from `take` ends that edge. Returns `known` plus
  /// the edges without a void.
  template <class Wants, class Take>
  std::uint8_t with_void(const Triangle& t, std::uint8_t known, const Wants& wants, const Take& take) const {
    for (std::size_t k = 0; k < 3; ++k) {
      if ((known >> k & 1u) != 0) continue;
      if (!of_edge(t[k], t[(k + 1) % 3], t[(k + 2) % 3], wants, take))
        known = static_cast<std::uint8_t>(known | 1u << k);
    }
    return known;
  }

 private:
  /// Whether the edge may have a void.
  template <class Wants, class Take>
  bool of_edge(const Vec3& a, const Vec3& b, const Vec3& inner, const Wants& wants, const Take& take) const {
    const Vec3 along = b - a;
    const double level = std::hypot(along.x, along.y);
    if (level < shortest_way) return false;
    Vec3 out(along.y / level, -along.x / level, 0.0);
    if (out.x * (inner.x - a.x) + out.y * (inner.y - a.y) > 0.0) out = -out;
    const double length = std::hypot(level, along.z);
    const double parts = rim_places(length, smallest_);
    bool any = false;
    for (double i = 0.5; i < parts; i += 1.0) {
      const Vec3 at = a + (i / parts) * along;
      const Rim rim{at, out, at + probe_.rim_offset() * out};
      const bool is_wanted = wants(at);
      if (is_wanted && !is_void(rim)) continue;
      any = true;
      if (is_wanted && !take(rim)) break;
    }
    return any;
  }

  /// The cheap tests first: most edges have floor on both sides, and most others have a wall.
  bool is_void(const Rim& rim) const {
    // The sight line starts a little inside: a wall on the rim itself would count as touched from its far side.
    return !probe_.has_floor(rim.outside) && probe_.sees(rim.at - probe_.rim_offset() * rim.out, rim.outside) &&
           probe_.sinks(rim.outside, probe_.radius());
  }

  const VoidProbe& probe_;
  double smallest_;
};

Disc climb(const VoidProbe& probe, const Vec3& outside) {
  return grow(probe.floor(), outside, probe.open_radius(), climb_precision,
              [&](const Vec3& from, const Vec3& to) { return probe.sees(from, to); });
}

}  // namespace

std::uint8_t edges_without_void(const VoidProbe& probe, const CrackOptions& options, const Triangle& floor,
                                std::uint8_t known, const std::atomic<bool>& stop) {
  // A place that is not examined may have a void.
  return Rims(probe, options)
      .with_void(
          floor, known, [&](const Vec3&) { return !stop; }, [](const Rim&) { return false; });
}

std::vector<RimPlace> find_voids(const Survey& survey, const CrackOptions& options, const VoidProbe& probe,
                                 RimEdges& edges, const std::function<bool(const Vec3& foot)>& is_reached,
                                 const std::function<bool(double)>& goes_on, std::atomic<bool>& ended) {
  const auto floors = survey.floor_triangles();
  const Rims rims(probe, options);
  std::vector<RimPlace> all;
  std::mutex mutex;
  const auto look = [&](std::size_t f, std::uint8_t& without, bool is_known) {
    std::vector<RimPlace> found;
    // Most edges left have a void somewhere, so test first whether they are reached.
    without = rims.with_void(
        survey.triangle(floors[f]), without, [&](const Vec3& at) { return !is_known || is_reached(at); },
        [&](const Rim& rim) {
          if (is_known || is_reached(rim.at)) found.push_back({rim.at, rim.outside, climb(probe, rim.outside)});
          return true;
        });
    if (found.empty()) return;
    const std::lock_guard lock(mutex);
    all.insert(all.end(), found.begin(), found.end());
  };
  if (!edges.look_at_all(look, goes_on)) ended = true;
  std::sort(all.begin(), all.end(), lies_before);
  return all;
}

}  // namespace roam::cracks
