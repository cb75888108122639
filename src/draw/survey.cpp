#include "draw/survey.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "measure/room.h"

namespace roam::draw {
namespace {

constexpr double most_stations = 10'000.0;

class Surveyor {
 public:
  Surveyor(const Space& space, const WalkerSettings& settings, Mode mode, const Arrive& arrive)
      : space_(space), arrive_(arrive), settings_(settings), mode_(mode), room_(space, settings, mode) {}

  [[nodiscard]] double reach() const { return room_.reach(); }

  [[nodiscard]] Station station(const WayPoint& a, const WayPoint& b, double t) const {
    Station s;
    s.centre = a.position + t * (b.position - a.position);
    s.height = b.height;  // constant along a piece, see Segment
    s.along = a.along + t * (b.along - a.along);
    if (arrive_) arrive_(s.centre, std::max(reach() + settings_.radius, measure::height_reach * s.height) + s.height);
    const Vec3 way(b.position.x - a.position.x, b.position.y - a.position.y, 0.0);
    const double length = glm::length(way);
    // Steeper than about 84 degrees, left and right are undefined.
    if (length > 0.1 * std::abs(b.position.z - a.position.z)) s.heading = way / length;
    if (s.heading != Vec3(0.0) && mode_ != Mode::ghost) {
      const Body body = Body::capsule(settings_.radius, s.height);
      s.across = Vec3(-s.heading.y, s.heading.x, 0.0);
      s.left = room_.beside(body, s.centre, s.across).distance;
      s.right = room_.beside(body, s.centre, -s.across).distance;
    }
    s.floor = height_at(s.centre, -1.0, s.height);
    s.ceiling = height_at(s.centre, 1.0, s.height);
    return s;
  }

 private:
  [[nodiscard]] std::optional<double> height_at(const Vec3& from, double direction, double height) const {
    const double far = measure::height_reach * height;
    const Impact hit = space_.ray(from, {0.0, 0.0, direction * far});
    if (!hit.hit) return std::nullopt;
    return from.z + direction * far * hit.time;
  }

  const Space& space_;
  const Arrive& arrive_;
  const WalkerSettings& settings_;
  Mode mode_;
  measure::Room room_;
};

}  // namespace

RoomSurvey survey(const Space& space, const Way& way, const WalkerSettings& settings, Mode mode, const Arrive& arrive) {
  const Surveyor surveyor(space, settings, mode, arrive);
  RoomSurvey result;
  result.reach = surveyor.reach();
  const auto& points = way.points;
  const bool is_true = way.tolerance < measure::slimmer;
  const double between = std::max(0.1 * most_stations, most_stations - static_cast<double>(points.size()));
  const double spacing = std::max(0.5 * settings.radius, way.length / between);
  result.stations.reserve(points.size() + static_cast<std::size_t>(is_true ? way.length / spacing : 0.0));
  // Measures at the fraction t of the piece from points[i] to points[j].
  const auto add = [&](std::size_t i, std::size_t j, double t) {
    result.stations.push_back(surveyor.station(points[i], points[j], t));
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool leads_on = i + 1 < points.size() && !points[i + 1].jump;
    if (leads_on) {
      const double length = glm::distance(points[i].position, points[i + 1].position);
      const double parts = is_true ? std::ceil(std::max(length / spacing, 1.0)) : 1.0;
      for (double k = 0.0; k < parts; ++k) {
        add(i, i + 1, k / parts);
        result.stations.back().jump = k == 0.0 && points[i].jump;
      }
    } else if (i > 0 && !points[i].jump) {
      add(i - 1, i, 1.0);
    } else {
      add(i, i, 0.0);
      result.stations.back().jump = points[i].jump;
    }
  }
  return result;
}

}  // namespace roam::draw
