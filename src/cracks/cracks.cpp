#include "cracks/cracks.h"

#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <cmath>

#include "cracks/rim_edges.h"
#include "cracks/void_measure.h"
#include "motion/carrying.h"
#include "text/names.h"

namespace roam {

const char* to_string(Crack::Kind kind) { return name_in({"crack", "step_down", "open_drop"}, kind); }

}  // namespace roam

namespace roam::cracks {

namespace {

/// Share of time for finding voids; the rest measures them.
constexpr double find_share = 0.8;
/// m: storing changes a depth by less than this.
constexpr double same_depth = 2e-3;

/// The direction from the first floor that a disc touches to the floor most nearly opposite.
Vec3 across(const FloorPlan& plan, const Disc& disc) {
  const std::vector<TouchedFloor> touched = touched_floor(plan, disc);
  if (touched.empty()) return {1.0, 0.0, 0.0};
  const TouchedFloor& first = touched.front();
  const auto along = [&](const TouchedFloor& t) { return first.way.x * t.way.x + first.way.y * t.way.y; };
  const auto other =
      std::min_element(touched.begin(), touched.end(),
                       [&](const TouchedFloor& a, const TouchedFloor& b) { return along(a) < along(b); });
  // Beside a wall there is floor on one side only.
  Vec3 direction = along(*other) < 0.0 ? other->near.point - first.near.point : first.way;
  direction.z = 0.0;
  direction /= std::hypot(direction.x, direction.y);
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
  crack.support_radius = measured.support_radius;
  const double depth = bottom ? crack.point.z - bottom->z : 0.0;
  if (depth <= carrying_band + same_depth) crack.shallow_depth = depth;
  crack.rim = measured.rim;
  return crack;
}

/// Groups discs into drops: discs that overlap at about one level are one drop.
std::vector<FoundCrack> drops_of(const CrackOptions& options, const std::vector<RimPlace>& open) {
  std::vector<FoundCrack> all;
  std::vector<Vec3> centres;
  for (const RimPlace& place : open) centres.push_back(place.disc.centre);
  for (const std::vector<std::size_t>& group : groups_within(centres, options.support_max, options.step)) {
    FoundCrack& drop = all.emplace_back();
    const RimPlace& first = open[group.front()];
    drop.kind = Crack::Kind::open_drop;
    drop.point = first.disc.centre;
    drop.radius = drop.support_radius = options.support_max;
    const Vec3 out = drop.point - first.rim;
    const double length = std::hypot(out.x, out.y);
    drop.direction = length > 0.0 ? Vec3(out.x / length, out.y / length, 0.0) : Vec3(1.0, 0.0, 0.0);
    for (const std::size_t i : group) drop.rim.push_back(open[i].rim);
  }
  return all;
}

std::vector<FoundCrack> find(const Survey& survey, RimEdges& edges,
                             const std::function<bool(const Vec3& foot)>& is_reached,
                             const std::function<bool(double)>& goes_on) {
  const CrackOptions& options = edges.options();
  const VoidProbe probe(survey, options);
  std::atomic<bool> ended{false};
  std::function<bool(double)> finding, measuring;
  if (goes_on) {
    finding = [&](double done) { return goes_on(find_share * done); };
    measuring = [&](double done) { return goes_on(find_share + (1.0 - find_share) * done); };
  }
  const std::vector<RimPlace> voids = find_voids(survey, options, probe, edges, is_reached, finding, ended);
  std::vector<RimPlace> open, rest;
  for (const RimPlace& place : voids) (place.disc.radius >= probe.open_radius() ? open : rest).push_back(place);
  const OpenDrops drops(options, probe, open);
  // The rim's position assigns it to a drop, not the end of its climb, which may be at the far end of a long gap.
  const auto split = std::stable_partition(open.begin(), open.end(),
                                           [&](const RimPlace& place) { return drops.cover(place.outside); });
  rest.insert(rest.end(), split, open.end());
  open.erase(split, open.end());
  std::sort(rest.begin(), rest.end(), lies_before);
  std::vector<FoundCrack> cracks;
  for (const MeasuredVoid& measured : measure_voids(options, probe, drops, rest, is_reached, measuring, ended)) {
    if (measured.disc.radius >= probe.open_radius()) {
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
  RimEdges edges(survey, options);
  return find_cracks(survey, edges, is_reached, goes_on);
}

std::vector<FoundCrack> find_cracks(const Survey& survey, RimEdges& edges,
                                    const std::function<bool(const Vec3& foot)>& is_reached,
                                    const std::function<bool(double)>& goes_on) {
  const int cores = tbb::info::default_concurrency(), threads = edges.options().threads;
  tbb::task_arena arena(threads > 0 ? std::min(threads, cores) : cores);
  std::vector<FoundCrack> cracks;
  arena.execute([&] { cracks = find(survey, edges, is_reached, goes_on); });
  return cracks;
}

}  // namespace roam::cracks
