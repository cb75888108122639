#include "draw/stations.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "measure/room.h"

namespace roam::draw {
namespace {

constexpr double most_stations = 10'000.0;

}  // namespace

RoomSurvey survey(const Space& space, const Way& way, const WalkerSettings& settings, Mode mode, const Arrive& arrive) {
  const measure::Room room(space, settings, mode);
  RoomSurvey result;
  result.reach = room.reach();
  const auto height_at = [&](const Station& s, double direction) -> std::optional<double> {
    const double far = direction * measure::height_reach * s.height;
    const FirstImpact hit = space.first_impact({0.0, 0.0}, s.centre, {0.0, 0.0, far});
    return hit.hit ? std::optional(s.centre.z + far * hit.time) : std::nullopt;
  };
  /// Measures at the fraction `t` of the piece from `a` to `b`.
  const auto add = [&](const WayPoint& a, const WayPoint& b, double t) {
    Station& s = result.stations.emplace_back();
    s.centre = a.position + t * (b.position - a.position);
    s.height = b.height;  // constant along a piece, see Segment
    s.along = a.along + t * (b.along - a.along);
    s.jump = t == 0.0 && a.jump;
    if (arrive) arrive(s.centre, std::max(room.reach() + settings.radius, measure::height_reach * s.height) + s.height);
    const Vec3 run(b.position.x - a.position.x, b.position.y - a.position.y, 0.0);
    const double length = glm::length(run);
    // Steeper than about 84 degrees, left and right are undefined.
    if (length > 0.1 * std::abs(b.position.z - a.position.z)) s.heading = run / length;
    if (s.heading != Vec3(0.0) && mode != Mode::ghost) {
      const Body body = Body::capsule(settings.radius, s.height);
      s.across = Vec3(-s.heading.y, s.heading.x, 0.0);
      s.left = room.beside(body, s.centre, s.across).distance;
      s.right = room.beside(body, s.centre, -s.across).distance;
    }
    s.floor = height_at(s, -1.0);
    s.ceiling = height_at(s, 1.0);
  };
  const auto& points = way.points;
  const bool is_true = way.tolerance < measure::slimmer;
  const double between = std::max(0.1 * most_stations, most_stations - static_cast<double>(points.size()));
  const double spacing = std::max(0.5 * settings.radius, way.length / between);
  result.stations.reserve(points.size() + static_cast<std::size_t>(is_true ? way.length / spacing : 0.0));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i + 1 < points.size() && !points[i + 1].jump) {
      const double length = glm::distance(points[i].position, points[i + 1].position);
      const double parts = is_true ? std::ceil(std::max(length / spacing, 1.0)) : 1.0;
      for (double k = 0.0; k < parts; ++k) add(points[i], points[i + 1], k / parts);
    } else if (i > 0 && !points[i].jump) {
      add(points[i - 1], points[i], 1.0);
    } else {
      add(points[i], points[i], 0.0);
    }
  }
  return result;
}

}  // namespace roam::draw
