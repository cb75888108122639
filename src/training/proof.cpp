// The trials that prove the ends of an interval: sizes just inside must get through, sizes just outside must not.
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "cracks/floor_plan.h"
#include "motion/carrying.h"
#include "training/interval.h"
#include "training/judgement.h"
#include "training/over_gap.h"
#include "ways/refine/refine.h"
#include "ways/trials/on_way.h"

namespace roam::training {

namespace {

/// m of the way on both sides of an opening or a crack that a trial covers at least.
constexpr double run_up = 1.5;
/// m: the longest run-up. Within it, a body that an opening must stop needs room to stand.
constexpr double longest_run_up = 12.0;

/// m: a path must continue beyond an opening by this and a body's radius, or the opening stops no body.
constexpr double past_opening = 0.1;
/// Radii: sides of an opening are at most this far from the body that just passes. An opening that was measured too
/// narrow by less is still tried.
constexpr double side_reach = 0.25;
/// m, seen from above, between two points of a way on both sides of an edge.
constexpr double edge = 0.1;

/// m/s. A body that must fall moves slowly: at walking pace it would hop across the last centimetres of a narrow crack.
constexpr double slow = 0.4;

/// m along a way between two samples of the floor near a support disc.
constexpr double look_every = 0.0025;
/// m: a body that must fall finds no floor for at least this length. Straight over a gap it is 2 support_margin.
constexpr double long_enough = 1.7 * support_margin;

/// m: sides of a crack that differ by less are level.
constexpr double same_level = 0.02;

using TriedBody = Contradiction::Body;

/// A trial to make.
struct Attempt {
  std::size_t path = 0;
  double radius = 0.0, support_radius = 0.0;
  std::vector<Vec3> way;
  TriedBody body = TriedBody::chosen;
};

/// The result that a trial must have.
Judgement expected_of(TriedBody body) {
  switch (body) {
    case TriedBody::outside_opening:
      return Judgement::cannot_enter;
    case TriedBody::small_disc:
      return Judgement::flies_off;
    case TriedBody::chosen:
    case TriedBody::chosen_back:
    case TriedBody::inside_opening:
    case TriedBody::wide_disc:
      break;
  }
  return Judgement::passed;
}

/// Whether it is the chosen body.
bool is_chosen(TriedBody body) { return body == TriedBody::chosen || body == TriedBody::chosen_back; }

class Proof {
 public:
  Proof(const Survey& survey, const ways::BodyKind& kind, const Layout& layout, const Evidence& evidence,
        Training& training)
      : survey_(survey),
        kind_(kind),
        layout_(layout),
        evidence_(evidence),
        training_(training),
        floor_(survey, layout.measure.step),
        support_(evidence.least_support) {}

  /// The chosen body on every path, then the sizes beside the ends.
  std::vector<Attempt> attempts() {
    std::vector<Attempt> all;
    for (std::size_t i = 0; i < training_.paths.size(); ++i) {
      const TrainedPath& path = training_.paths[i];
      if (path.largest && *path.largest < training_.radius) continue;  // excluded when the body was chosen
      if (sinks_into_shallow(i)) continue;                             // reported as a trench
      all.push_back({i, training_.radius, training_.support_radius, path.way, TriedBody::chosen});
      add_way_back(i, all);
    }
    for (std::size_t i = 0; i < training_.paths.size(); ++i) add_opening(i, all);
    for (const PathCrossing& crossing : evidence_.crossings) {
      if (evidence_.cracks[crossing.crossing.crack].radius == training_.paths[crossing.path].smallest)
        add_crack(crossing, all);
    }
    return all;
  }

 private:
  /// A body that comes down over a gap may drop onto its lower side. That does not show that it can come up again.
  void add_way_back(std::size_t path, std::vector<Attempt>& all) {
    for (const PathCrossing& c : evidence_.crossings) {
      const cracks::FoundCrack& crack = evidence_.cracks[c.crossing.crack];
      if (c.path != path || crack.shallow_depth > 0.0) continue;
      const std::vector<Vec3>& way = training_.paths[path].way;
      const auto gap = gap_on(survey_, way, c.crossing.at, crack.radius, layout_.measure.step);
      if (!gap) continue;
      std::vector<Vec3> back = back_over(survey_, way, *gap, training_.radius, layout_.measure.step);
      if (back.empty()) continue;
      all.push_back({path, training_.radius, training_.support_radius, std::move(back), TriedBody::chosen_back});
    }
  }

  void add_opening(std::size_t path, std::vector<Attempt>& all) {
    const Passage& passage = layout_.paths[path].passage;
    if (!training_.paths[path].largest || !passage.opening) return;
    const double largest = *training_.paths[path].largest, outside = outside_share * largest;
    const double place = ways::nearest_on(passage.way, passage.opening->point, kind_.mode).along;
    all.push_back(
        {path, inside_share * largest, support_, stretch(passage.way, place, run_up), TriedBody::inside_opening});
    // A way planned around something has a wider one beside it, which a larger body may find.
    if (!layout_.paths[path].is_widest) return;
    if (drops_off(stretch(passage.way, place, outside + layout_.measure.step))) return;
    if (!has_two_sides(passage, place)) return;
    std::vector<Vec3> through = stretch(passage.way, place, run_up);
    const auto has_room = [&] { return fits(through.front(), outside) && fits(through.back(), outside); };
    for (double reach = run_up; reach <= longest_run_up && !has_room(); reach += 0.5 * run_up)
      through = stretch(passage.way, place, reach);
    // If the path begins or ends in a narrow place, or within a radius of one, the opening need not stop the body.
    if (!has_room() || place < outside + past_opening || passage.length - place < outside + past_opening) return;
    all.push_back({path, outside, support_, std::move(through), TriedBody::outside_opening});
  }

  /// Whether the opening of a way has two sides. A larger body passes farther from a single side, where it may stand
  /// higher or lower than the lattice's foot.
  [[nodiscard]] bool has_two_sides(const Passage& passage, double place) const {
    bool found = false;
    // The place itself may lie beside a straight piece of the way.
    ways::for_each_station(stretch(passage.way, place, edge), 0.2 * edge, [&](const Vec3& at, const Vec3&, double) {
      found = found || ways::is_between(survey_, layout_.measure, at, *passage.opening, side_reach * passage.radius);
    });
    return found;
  }

  /// Whether a way leads over an edge higher than a step. A body of any width drops down there, and none comes up.
  [[nodiscard]] bool drops_off(std::span<const Vec3> way) const {
    for (std::size_t i = 0; i < way.size(); ++i) {
      for (std::size_t k = i + 1; k < way.size(); ++k) {
        const Vec3 apart = way[k] - way[i];
        if (std::hypot(apart.x, apart.y) <= edge && std::abs(apart.z) > layout_.measure.step) return true;
      }
    }
    return false;
  }

  [[nodiscard]] bool sinks_into_shallow(std::size_t path) const {
    return std::any_of(evidence_.crossings.begin(), evidence_.crossings.end(), [&](const PathCrossing& c) {
      const cracks::FoundCrack& crack = evidence_.cracks[c.crossing.crack];
      return c.path == path && crack.shallow_depth > 0.0 && sinks_into(training_.radius, crack);
    });
  }

  void add_crack(const PathCrossing& crossing, std::vector<Attempt>& all) {
    const cracks::FoundCrack& crack = evidence_.cracks[crossing.crossing.crack];
    if (crack.shallow_depth > 0.0) return;
    const TrainedPath& path = training_.paths[crossing.path];
    const double passes = path.largest ? inside_share * *path.largest : training_.radius;
    const double small = crack.radius - support_margin, body = std::min(passes, small);
    if (!(body > 0.0)) return;
    const double support = std::min(crack.radius + support_margin, layout_.measure.support_max);
    std::vector<Vec3> way = stretch(path.way, crossing.crossing.at, 2.0 * crack.radius + run_up);
    if (!stands_on_floor(survey_, way.front()) || !stands_on_floor(survey_, way.back()) || !over_gap(way, small) ||
        !is_carried(way, support)) {
      // The path begins or ends over the crack, or crosses it near its rim or where it is narrower. A body there need
      // not fall.
      way = way_over(survey_, crack, body + 0.5 * run_up);
      if (way.empty() || !fits(way.front(), body) || !fits(way.back(), body) || !is_carried(way, support)) return;
    }
    if (comes_from_above(way, small)) {
      if (ends_at_rim(way, crack, body)) {
        way = way_over(survey_, crack, body + 0.5 * run_up);
        if (way.empty() || !fits(way.front(), body) || !fits(way.back(), body) || !is_carried(way, support)) return;
      }
      if (comes_from_above(way, small)) std::reverse(way.begin(), way.end());
    }
    // No support disc carries a body above its band. A sphere climbs at most its radius, so one that passes below the
    // crack's width may fail at its higher rim.
    const double climbed = kind_.height > 0.0 ? carrying_band : std::min(body, carrying_band);
    if (rise_of(survey_, crack, layout_.measure.step) <= climbed)
      all.push_back({crossing.path, body, support, way, TriedBody::wide_disc});
    all.push_back({crossing.path, body, small > body ? small : 0.0, std::move(way), TriedBody::small_disc});
  }

  /// Whether a body that begins at the end of a way stands on a crack's rim there, not on floor.
  [[nodiscard]] bool ends_at_rim(const std::vector<Vec3>& way, const cracks::FoundCrack& crack, double body) const {
    const double over = over_gap(way, crack.radius - support_margin).value_or(0.0);
    const auto gap = gap_on(survey_, way, over - crack.radius, crack.radius, layout_.measure.step);
    return !gap || gap->beyond < body;
  }

  /// m along a way: the place where a support disc of that radius is free of floor and stays so until it falls.
  [[nodiscard]] std::optional<double> over_gap(const std::vector<Vec3>& way, double support) const {
    double over = 0.0, gone = 0.0;
    for (std::size_t i = 1; i < way.size(); ++i) {
      const Vec3 along = way[i] - way[i - 1];
      const double level = std::hypot(along.x, along.y), looks = std::max(1.0, std::ceil(level / look_every));
      for (double k = 0.0; k < looks; k += 1.0) {
        const bool is_over = floor_.nearest(way[i - 1] + (k / looks) * along, support).distance >= support;
        over = is_over ? over + level / looks : 0.0;
        if (over >= long_enough) return gone + (k / looks) * glm::length(along);
      }
      gone += glm::length(along);
    }
    return std::nullopt;
  }

  /// Whether a way leads down over a gap. A body may then drop onto its lower side before it sinks.
  [[nodiscard]] bool comes_from_above(const std::vector<Vec3>& way, double support) const {
    const double at = over_gap(way, support).value_or(0.0), beside = support + layout_.measure.step;
    const auto highest = [&](double middle) {
      constexpr double apart = 0.02;  // m along the way
      const double step = layout_.measure.step;
      double z = -std::numeric_limits<double>::infinity();
      const std::vector<Vec3> part = stretch(way, middle, beside);
      for (std::size_t i = 1; i < part.size(); ++i) {
        const Vec3 along = part[i] - part[i - 1];
        const double looks = std::max(1.0, std::ceil(glm::length(along) / apart));
        for (double k = 0.0; k <= looks; k += 1.0) {
          const Vec3 above = part[i - 1] + (k / looks) * along + Vec3(0.0, 0.0, step);
          const FirstImpact floor = survey_.floor().first_impact({0.0, 0.0}, above, Vec3(0.0, 0.0, -2.0 * step));
          if (floor.hit) z = std::max(z, above.z - 2.0 * step * floor.time);
        }
      }
      return z;
    };
    return highest(at - beside) > highest(at + beside) + same_level;
  }

  /// Whether gaps along a way carry a support disc. Beside an open drop the support disc may find a free disc in the
  /// drop.
  [[nodiscard]] bool is_carried(const std::vector<Vec3>& way, double support) const {
    constexpr double apart = 0.05;  // m along the way
    const SupportDisc disc{support, survey_.slope_degrees(), cracks::knee_height(layout_.measure.step)};
    for (std::size_t i = 1; i < way.size(); ++i) {
      const Vec3 along = way[i] - way[i - 1];
      const double looks = std::max(1.0, std::ceil(std::hypot(along.x, along.y) / apart));
      for (double k = 0.0; k < looks; k += 1.0) {
        const Vec3 place = way[i - 1] + (k / looks) * along;
        if (!stands_on_floor(survey_, place) && carrying(survey_.world(), {place}, disc, place) != Carrying::yes)
          return false;
      }
    }
    return true;
  }

  [[nodiscard]] bool fits(const Vec3& place, double radius) const {
    return clearance_at(survey_, layout_.measure, place) >= std::min(radius, 0.999 * layout_.measure.widest);
  }

  const Survey& survey_;
  const ways::BodyKind& kind_;
  const Layout& layout_;
  const Evidence& evidence_;
  Training& training_;
  cracks::FloorPlan floor_;
  double support_ = 0.0;
};

/// The trial of the same body on the same path, made while confirming it.
std::optional<Trial> walked_before(const Layout& layout, const Attempt& attempt) {
  if (attempt.body != TriedBody::chosen) return std::nullopt;
  const std::optional<Trial>& walked = layout.paths[attempt.path].walked;
  const bool same = walked && walked->radius == attempt.radius && walked->support_radius == attempt.support_radius;
  return same ? walked : std::nullopt;
}

}  // namespace

void prove(const Survey& survey, const ways::BodyKind& kind, const Layout& layout, const Evidence& evidence,
           Stages& stages, Training& training) {
  stages.begin(TrainStage::trials);
  const std::vector<Attempt> attempts = Proof(survey, kind, layout, evidence, training).attempts();
  std::vector<Trial> trials(attempts.size());
  std::atomic<std::size_t> done{0};
  const auto progress = [&] { return stages.at(static_cast<double>(done) / static_cast<double>(attempts.size())); };
  tbb::parallel_for(std::size_t(0), attempts.size(), [&](std::size_t i) {
    const Attempt& attempt = attempts[i];
    if (stages.ended()) return;
    if (const auto known = walked_before(layout, attempt)) {
      trials[i] = *known;
      ++done;
      return;
    }
    ways::BodyKind body = kind;
    if (expected_of(attempt.body) == Judgement::flies_off) body.speed = std::min(body.speed, slow);
    trials[i] = try_way(survey, body, attempt.radius, attempt.support_radius, attempt.way, progress);
    ++done;
    progress();
  });
  if (stages.ended()) return;
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    const Attempt& attempt = attempts[i];
    trials[i].path = attempt.path;
    training.paths[attempt.path].trials.push_back(trials[i]);
    if (judged(trials[i].outcome) == expected_of(attempt.body)) continue;
    if (is_chosen(attempt.body)) training.feasible = false;
    training.contradictions.push_back({attempt.body, trials[i]});
  }
}

}  // namespace roam::training
