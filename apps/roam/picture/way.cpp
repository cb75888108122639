#include "way.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "corners.h"

namespace roam::app::picture {
namespace {

double plan_distance(const Vec3& a, const Vec3& b) { return std::hypot(b.x - a.x, b.y - a.y); }

/// How far a place lies from the straight piece a-b, its height counted as a fourth coordinate.
double deviation(const Place& p, const Place& a, const Place& b) {
  const double t = nearest_part(p.position, a.position, b.position);
  const double height = std::abs(p.height - (a.height + t * (b.height - a.height)));
  return std::max(glm::distance(p.position, a.position + t * (b.position - a.position)), height);
}

}  // namespace

void append(Record& record, const StepReport& report, bool is_start) {
  auto& places = record.places;
  if (is_start) {
    places.push_back({report.to, report.height, report.clearance, true});
  } else if (report.corners.empty()) {
    if (!places.empty()) places.back().clearance = std::min(places.back().clearance, report.clearance);
  } else {
    if (places.empty()) places.push_back({report.from, report.corners[0].height, 0.0, true});
    for (const Corner& c : report.corners) places.push_back({c.position, c.height, c.clearance, c.teleport});
  }
  for (const Contact& c : report.contacts) {
    // A body that slides along a wall touches the same triangle in many steps.
    const bool again = !record.touches.empty() && glm::distance(record.touches.back().point, c.point) < 1e-2;
    if (!again && !places.empty()) record.touches.push_back({c.point, c.normal, places.size() - 1});
  }
}

Way simplified(const Record& record, double tolerance) {
  const auto& places = record.places;
  std::vector<char> keep(places.size(), 0);
  const auto deviation_of = [&places](std::size_t i, std::size_t from, std::size_t to) {
    return deviation(places[i], places[from], places[to]);
  };
  for (std::size_t first = 0; first < places.size();) {
    std::size_t last = first;
    while (last + 1 < places.size() && !places[last + 1].teleport) ++last;
    keep_corners(first, last, tolerance, deviation_of, keep);
    first = last + 1;
  }

  Way way;
  way.along.resize(places.size());
  way.nearest = places.size();
  double least = std::numeric_limits<double>::infinity();
  std::size_t before = 0;  // the last place that stayed
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place& p = places[i];
    if (p.clearance > 0.0 && p.clearance < least) {
      least = p.clearance;
      way.nearest = i;
    }
    if (!keep[i]) continue;
    const bool jump = i > 0 && p.teleport;
    const double step = i == 0 || jump ? 0.0 : plan_distance(places[before].position, p.position);
    const double start = way.length;
    way.length += step;
    for (std::size_t k = before + 1; k < i; ++k) {
      way.along[k] = std::min(start + plan_distance(places[before].position, places[k].position), way.length);
    }
    way.along[i] = way.length;
    way.points.push_back({p.position, p.height, way.length, jump});
    before = i;
  }
  return way;
}

}  // namespace roam::app::picture
