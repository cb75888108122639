#include "draw/way.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "draw/lines.h"
#include "math/level_distance.h"

namespace roam::draw {
namespace {

/// The distance of a place from the straight piece a-b, with the body's height as a fourth coordinate.
double deviation(const Place& p, const Place& a, const Place& b) {
  const double t = nearest_part(p.position, a.position, b.position);
  const double height = std::abs(p.height - (a.height + t * (b.height - a.height)));
  return std::max(glm::distance(p.position, a.position + t * (b.position - a.position)), height);
}

/// Marks with 1 the places from `begin` on that must stay, so that all others lie within `tolerance` of the lines
/// between them. All places before `begin` stay.
std::vector<char> corners_of(const std::vector<Place>& places, std::size_t begin, double tolerance) {
  std::vector<char> keep(places.size(), 0);
  std::fill_n(keep.begin(), begin, char{1});
  const auto deviation_of = [&places](std::size_t i, std::size_t from, std::size_t to) {
    return deviation(places[i], places[from], places[to]);
  };
  for (std::size_t first = begin; first < places.size();) {
    std::size_t last = first;
    while (last + 1 < places.size() && !places[last + 1].teleport) ++last;
    keep_corners(first, last, tolerance, deviation_of, keep);
    first = last + 1;
  }
  return keep;
}

/// Removes the places without a mark in `keep`. The place with the least clearance stays. The last place must have a
/// mark. After a removed teleport the next place is one.
void leave_out(Record& record, std::vector<char> keep) {
  auto& places = record.places;
  std::size_t nearest = places.size();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool nearer = nearest == places.size() || places[i].clearance < places[nearest].clearance;
    if (places[i].clearance > 0.0 && nearer) nearest = i;
  }
  if (nearest < places.size()) keep[nearest] = 1;
  std::vector<std::size_t> now(places.size());  // new index of each place, or of the next one that stays
  std::size_t count = 0;
  double least = 0.0;  // clearance of removed places since the last kept one; 0: none
  bool teleport = false;
  for (std::size_t i = 0; i < places.size(); ++i) {
    now[i] = count;
    const double clearance = places[i].clearance;
    if (clearance > 0.0) least = least > 0.0 ? std::min(least, clearance) : clearance;
    teleport = teleport || places[i].teleport;
    if (!keep[i]) continue;
    places[count] = places[i];
    places[count].teleport = teleport;
    places[count++].clearance = least;
    least = 0.0;
    teleport = false;
  }
  places.resize(count);
  for (Touch& touch : record.touches) touch.place = now[touch.place];
}

/// Removes every second run, with its touches, until there are few: the ends of all must stay. The first run stays, and
/// the last one.
void thin_runs(Record& record) {
  constexpr std::ptrdiff_t most_runs = Record::most / 4;
  auto& places = record.places;
  const auto runs = [&] {
    return std::count_if(places.begin(), places.end(), [](const Place& p) { return p.teleport; });
  };
  const std::ptrdiff_t all = runs();
  while (runs() > most_runs) {
    std::size_t last = places.size() - 1;  // begin of the last run
    while (!places[last].teleport) --last;
    std::vector<char> keep(places.size(), 1);
    bool removed = false;
    for (std::size_t i = 1; i < last; ++i) {
      removed = removed != places[i].teleport;
      keep[i] = removed ? 0 : 1;
    }
    std::erase_if(record.touches, [&](const Touch& touch) { return !keep[touch.place]; });
    leave_out(record, std::move(keep));
  }
  record.runs_left_out += static_cast<std::size_t>(all - runs());
}

/// Removes places until a quarter of the limit is free.
void thin_places(Record& record) {
  constexpr double finest = 1e-3;  // m
  const auto thin_from = [&](std::size_t begin) {
    leave_out(record, corners_of(record.places, begin, record.tolerance));
  };
  record.tolerance = std::max(finest, record.tolerance);
  // Places thinned before are not thinned again with the same tolerance, or deviations would add up.
  thin_from(record.thinned > 0 ? record.thinned - 1 : 0);
  thin_runs(record);
  while (record.places.size() > Record::most / 4 * 3) {
    record.tolerance *= 2.0;
    thin_from(0);
  }
  record.thinned = record.places.size();
}

/// Removes touches until half of the limit is left.
void thin_touches(Record& record) {
  auto& touches = record.touches;
  while (touches.size() > Record::most / 2) {
    record.spacing *= 2.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < touches.size(); ++i) {
      if (count > 0 && glm::distance(touches[count - 1].point, touches[i].point) < record.spacing) continue;
      touches[count++] = touches[i];
    }
    touches.resize(count);
  }
}

}  // namespace

void append(Record& record, const StepReport& report, bool is_start) {
  auto& places = record.places;
  if (is_start) {
    places.push_back({report.to, report.height, report.axis_clearance, true});
  } else if (report.segments.empty()) {
    if (!places.empty()) places.back().clearance = std::min(places.back().clearance, report.axis_clearance);
  } else {
    if (places.empty()) places.push_back({report.from, report.segments[0].height, 0.0, true});
    for (const roam::Segment& c : report.segments)
      places.push_back({c.position, c.height, c.axis_clearance, c.teleport});
  }
  for (const Contact& c : report.contacts) {
    // A body that slides along a wall touches the same triangle in many steps.
    const bool again = !record.touches.empty() && glm::distance(record.touches.back().point, c.point) < record.spacing;
    if (!again && !places.empty()) record.touches.push_back({c.point, c.normal, places.size() - 1});
  }
  if (places.size() > Record::most) thin_places(record);
  if (record.touches.size() > Record::most) thin_touches(record);
}

Way simplified(const Record& record, double tolerance) {
  const auto& places = record.places;
  const std::vector<char> keep = corners_of(places, 0, tolerance);
  Way way;
  way.tolerance = tolerance + 2.0 * record.tolerance;  // the tolerance doubles each time the record is thinned
  way.along.resize(places.size());
  way.nearest = places.size();
  double least = std::numeric_limits<double>::infinity();
  std::size_t before = 0;  // the last kept place
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place& p = places[i];
    if (p.clearance > 0.0 && p.clearance < least) {
      least = p.clearance;
      way.nearest = i;
    }
    if (!keep[i]) continue;
    const bool jump = i > 0 && p.teleport;
    const double step = i == 0 || jump ? 0.0 : level_distance(places[before].position, p.position);
    const double start = way.length;
    way.length += step;
    for (std::size_t k = before + 1; k < i; ++k) {
      way.along[k] = std::min(start + level_distance(places[before].position, places[k].position), way.length);
    }
    way.along[i] = way.length;
    way.points.push_back({p.position, p.height, way.length, jump});
    before = i;
  }
  return way;
}

WayPoint nearest_on(const Way& way, const Vec3& place) {
  WayPoint best = way.points.front();
  for (std::size_t i = 1; i < way.points.size(); ++i) {
    const WayPoint &a = way.points[i - 1], &b = way.points[i];
    const double t = b.jump ? 1.0 : nearest_part(place, a.position, b.position);
    const Vec3 at = a.position + t * (b.position - a.position);
    if (glm::distance(place, at) < glm::distance(place, best.position)) {
      best = {at, b.height, a.along + t * (b.along - a.along), false};
    }
  }
  return best;
}

}  // namespace roam::draw
