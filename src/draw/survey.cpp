#include "draw/survey.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace roam::draw {
namespace {

/// How far to measure: in radii to the sides, in heights up and down.
constexpr double side_reach = 12.0;
constexpr double height_reach = 5.0;
constexpr double most_stations = 10'000.0;
/// Metres by which the body is slimmer when the room around it is measured. A body may touch the ground, but a sweep
/// that begins in contact would end at once. More than the 2 mm within which a space reports a hit.
constexpr double slimmer = 0.005;
/// The narrowest place is measured again between its neighbours, this many times as densely.
constexpr int refinement = 24;

class Surveyor {
 public:
  Surveyor(const Space& space, const WalkerSettings& settings, Mode mode, const Arrive& arrive)
      : space_(space),
        arrive_(arrive),
        settings_(settings),
        mode_(mode),
        slope_cosine_(std::cos(glm::radians(settings.slope_degrees))) {}

  [[nodiscard]] double reach() const {
    return std::min(side_reach * settings_.radius, Space::reach_limit - settings_.radius);
  }

  /// Free metres beside the body on one side, measured with the body itself.
  [[nodiscard]] double room(const Vec3& centre, double height, const Vec3& side) const {
    const double less = std::min(slimmer, 0.25 * settings_.radius);
    Body body = Body::capsule(settings_.radius, height);
    body.radius -= less;
    Vec3 place = centre;
    if (mode_ == Mode::walk) {
      // The legs are lifted over steps. A body hardly taller than wide is lifted as a whole.
      const double low = std::min(settings_.step, height - 2.0 * settings_.radius);
      body.half_height -= 0.5 * low;
      place.z += 0.5 * low;
      const double rest = settings_.step - low;
      if (rest > 0.0) {
        const Impact up = space_.sweep(body, place, {0.0, 0.0, rest});
        place.z += up.hit ? up.time * rest : rest;
      }
    }
    const double far = reach() + less;
    const Impact hit = space_.sweep(body, place, far * side);
    // Ground that rises gently to the side is no wall.
    if (mode_ == Mode::walk && hit.hit && hit.normal.z > slope_cosine_) return reach();
    return hit.hit ? std::max(0.0, hit.time * far - less) : reach();
  }

  [[nodiscard]] std::optional<double> height_at(const Vec3& from, double direction, double height) const {
    const double far = height_reach * height;
    const Impact hit = space_.ray(from, {0.0, 0.0, direction * far});
    if (!hit.hit) return std::nullopt;
    return from.z + direction * far * hit.time;
  }

  [[nodiscard]] Station station(const WayPoint& a, const WayPoint& b, double t) const {
    Station s;
    s.centre = a.position + t * (b.position - a.position);
    s.height = b.height;  // constant along a piece, see Segment
    s.along = a.along + t * (b.along - a.along);
    if (arrive_) arrive_(s.centre, std::max(reach() + settings_.radius, height_reach * s.height) + s.height);
    const Vec3 way(b.position.x - a.position.x, b.position.y - a.position.y, 0.0);
    const double length = glm::length(way);
    // Steeper than about 84 degrees, left and right are undefined.
    if (length > 0.1 * std::abs(b.position.z - a.position.z)) s.heading = way / length;
    if (s.heading != Vec3(0.0) && mode_ != Mode::ghost) measure_at(s, 0.0);
    s.floor = height_at(s.centre, -1.0, s.height);
    s.ceiling = height_at(s.centre, 1.0, s.height);
    return s;
  }

  /// Measures a station at an angle from straight across the way.
  void measure_at(Station& s, double angle) const {
    const Vec3 left(-s.heading.y, s.heading.x, 0.0);
    s.across = std::cos(angle) * left + std::sin(angle) * s.heading;
    s.left = room(s.centre, s.height, s.across);
    s.right = room(s.centre, s.height, -s.across);
  }

  /// Clear width if walls bound it on both sides, else infinite.
  [[nodiscard]] double width(const Station& s) const {
    const bool bounded = s.across != Vec3(0.0) && s.left < reach() && s.right < reach();
    return bounded ? s.left + s.right + 2.0 * settings_.radius : std::numeric_limits<double>::infinity();
  }

  /// Whether the body can move on and back by its radius. Otherwise it is in a corner, which is no narrow passage.
  [[nodiscard]] bool is_passage(const Station& s) const {
    return room(s.centre, s.height, s.heading) >= settings_.radius &&
           room(s.centre, s.height, -s.heading) >= settings_.radius;
  }

 private:
  const Space& space_;
  const Arrive& arrive_;
  const WalkerSettings& settings_;
  Mode mode_;
  double slope_cosine_;
};

Narrowest narrowest_at(const Station& s, double width, double radius) {
  return {s.centre,
          s.height,
          s.along,
          width,
          s.centre + (s.left + radius) * s.across,
          s.centre - (s.right + radius) * s.across};
}

}  // namespace

RoomSurvey survey(const Space& space, const Way& way, const WalkerSettings& settings, Mode mode, const Arrive& arrive) {
  const Surveyor surveyor(space, settings, mode, arrive);
  RoomSurvey result;
  result.reach = surveyor.reach();
  const auto& points = way.points;
  const bool is_true = way.tolerance < slimmer;
  const double between = std::max(0.1 * most_stations, most_stations - static_cast<double>(points.size()));
  const double spacing = std::max(0.5 * settings.radius, way.length / between);
  result.stations.reserve(points.size() + static_cast<std::size_t>(is_true ? way.length / spacing : 0.0));
  double least = std::numeric_limits<double>::infinity();
  std::size_t piece = 0;  // piece of the narrowest station: from points[piece] to the next
  double least_t = 0.0, dt = 0.0;
  // Measures at the fraction t of the piece from points[i] to points[j].
  const auto add = [&](std::size_t i, std::size_t j, double t, double step) {
    result.stations.push_back(surveyor.station(points[i], points[j], t));
    const double width = surveyor.width(result.stations.back());
    if (width < least && surveyor.is_passage(result.stations.back())) {
      least = width;
      piece = i;
      least_t = t;
      dt = step;
    }
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool leads_on = i + 1 < points.size() && !points[i + 1].jump;
    if (leads_on) {
      const double length = glm::distance(points[i].position, points[i + 1].position);
      const double parts = is_true ? std::ceil(std::max(length / spacing, 1.0)) : 1.0;
      for (double k = 0.0; k < parts; ++k) {
        add(i, i + 1, k / parts, is_true ? 1.0 / parts : 0.0);
        result.stations.back().jump = k == 0.0 && points[i].jump;
      }
    } else if (i > 0 && !points[i].jump) {
      add(i - 1, i, 1.0, 0.0);
    } else {
      add(i, i, 0.0, 0.0);
      result.stations.back().jump = points[i].jump;
    }
  }
  if (!std::isfinite(least)) return result;

  const WayPoint &a = points[piece], &b = points[piece + 1];
  Station best = surveyor.station(a, b, least_t);
  for (int k = -refinement; k <= refinement; ++k) {
    const double t = std::clamp(least_t + dt * k / refinement, 0.0, 1.0);
    const Station s = surveyor.station(a, b, t);
    if (surveyor.width(s) < surveyor.width(best) && surveyor.is_passage(s)) best = s;
  }
  // If the way crosses a passage obliquely, the least width is oblique too.
  Station turned = best;
  for (int degrees = -45; degrees <= 45; degrees += 3) {
    surveyor.measure_at(turned, glm::radians(static_cast<double>(degrees)));
    if (surveyor.width(turned) < surveyor.width(best)) best = turned;
  }
  result.narrowest = narrowest_at(best, surveyor.width(best), settings.radius);
  return result;
}

}  // namespace roam::draw
