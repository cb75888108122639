#include "train/cracks.h"

#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

#include "motion/free_disc.h"
#include "train/void_measure.h"

namespace roam::training {

namespace {

/// Of the work, by time: finding voids. Measuring them is the rest.
constexpr double kFindShare = 0.8;
/// m: depths that storing makes of one.
constexpr double same_depth = 2e-3;

/// From the floor that a disc touches first to what it touches most nearly opposite.
Vec3 across(const FloorPlan& plan, const Disc& disc) {
  std::vector<NearPlace> near;
  plan.touching(disc.centre, 2.0 * disc.radius, 0.02 * disc.radius, near);
  const auto away = [&](const NearPlace& n) {
    const Vec3 d = disc.centre - n.point;
    const double length = std::hypot(d.x, d.y);
    return length > 0.0 ? Vec3(d.x / length, d.y / length, 0.0) : Vec3(1.0, 0.0, 0.0);
  };
  const Vec3 first = away(near.front());
  NearPlace other = near.front();
  double least = 1.0;
  for (const NearPlace& n : near) {
    const Vec3 from = away(n);
    if (const double along = first.x * from.x + first.y * from.y; along < least) {
      least = along;
      other = n;
    }
  }
  // Beside a wall there is floor on one side only.
  Vec3 direction = least < 0.0 ? other.point - near.front().point : first;
  direction /= std::hypot(direction.x, direction.y);
  direction.z = 0.0;
  return direction.x < 0.0 || (direction.x == 0.0 && direction.y < 0.0) ? -direction : direction;
}

FoundCrack crack_of(const VoidProbe& probe, const MeasuredVoid& measured,
                    const std::function<bool(const Vec3& foot)>& is_reached) {
  FoundCrack crack;
  const std::optional<Vec3> bottom = probe.bottom(measured.disc.centre);
  crack.kind = bottom && is_reached(*bottom) ? Crack::Kind::step_down : Crack::Kind::crack;
  crack.point = measured.disc.centre;
  crack.radius = measured.disc.radius;
  crack.direction = across(probe.floor(), measured.disc);
  crack.foot = measured.foot;
  const double depth = bottom ? crack.point.z - bottom->z : 0.0;
  if (depth <= walking::carrying_band + same_depth) crack.shallow_depth = depth;
  crack.rim = measured.rim;
  return crack;
}

/// Discs that overlap at about one level belong to one drop.
std::vector<FoundCrack> drops_of(const CrackOptions& options, const std::vector<RimPlace>& open) {
  std::vector<FoundCrack> all;
  for (const std::vector<std::size_t>& group : together(open, options.support_max, options.step)) {
    FoundCrack& drop = all.emplace_back();
    const RimPlace& first = open[group.front()];
    drop.kind = Crack::Kind::open_drop;
    drop.point = first.disc.centre;
    drop.radius = drop.foot = options.support_max;
    const Vec3 out = drop.point - first.rim;
    const double length = std::hypot(out.x, out.y);
    drop.direction = length > 0.0 ? Vec3(out.x / length, out.y / length, 0.0) : Vec3(1.0, 0.0, 0.0);
    for (const std::size_t i : group) drop.rim.push_back(open[i].rim);
  }
  return all;
}

std::vector<FoundCrack> find(const Survey& survey, const CrackOptions& options,
                             const std::function<bool(const Vec3& foot)>& is_reached,
                             const std::function<bool(double)>& goes_on) {
  const VoidProbe probe(survey, options);
  std::atomic<bool> ended{false};
  std::function<bool(double)> finding, measuring;
  if (goes_on) {
    finding = [&](double done) { return goes_on(kFindShare * done); };
    measuring = [&](double done) { return goes_on(kFindShare + (1.0 - kFindShare) * done); };
  }
  const std::vector<RimPlace> voids = find_voids(survey, options, probe, is_reached, finding, ended);
  std::vector<RimPlace> open, rest;
  for (const RimPlace& place : voids) (place.disc.radius >= probe.open() ? open : rest).push_back(place);
  std::vector<FoundCrack> cracks;
  const OpenDrops drops(options, probe, open);
  for (const MeasuredVoid& measured : measure_voids(options, probe, drops, rest, is_reached, measuring, ended)) {
    if (measured.disc.radius >= probe.open()) {
      for (const Vec3& rim : measured.rim) open.push_back({rim, measured.disc.centre, measured.disc});
    } else if (measured.disc.radius >= options.smallest - VoidProbe::precision) {
      cracks.push_back(crack_of(probe, measured, is_reached));
    }
  }
  for (FoundCrack& drop : drops_of(options, open)) cracks.push_back(std::move(drop));
  for (FoundCrack& crack : cracks) {
    std::sort(crack.rim.begin(), crack.rim.end(), comes_before);
    crack.rim.erase(std::unique(crack.rim.begin(), crack.rim.end()), crack.rim.end());
  }
  std::sort(cracks.begin(), cracks.end(), [](const FoundCrack& a, const FoundCrack& b) {
    return a.radius != b.radius ? a.radius > b.radius : comes_before(a.point, b.point);
  });
  if (goes_on && !ended) goes_on(1.0);
  return cracks;
}

}  // namespace

std::vector<FoundCrack> find_cracks(const Survey& survey, const CrackOptions& options,
                                    const std::function<bool(const Vec3& foot)>& is_reached,
                                    const std::function<bool(double)>& goes_on) {
  const int cores = tbb::info::default_concurrency();
  tbb::task_arena arena(options.threads > 0 ? std::min(options.threads, cores) : cores);
  std::vector<FoundCrack> cracks;
  arena.execute([&] { cracks = find(survey, options, is_reached, goes_on); });
  return cracks;
}

}  // namespace roam::training
