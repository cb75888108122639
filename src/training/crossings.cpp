#include "training/crossings.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "ways/trials/on_way.h"

namespace roam::training {

namespace {

/// m. A foot this near to floor stands on it. The lattice's feet are exact, but ways between them cut across bumps.
constexpr double on_floor = 0.04;
/// m along the way between two samples of the floor.
constexpr double look_every = 0.03;
/// m. How far above and below a rim to search for floor on its two sides.
constexpr double rim_level = 0.3;

}  // namespace

bool stands_on_floor(const Survey& survey, const Vec3& foot) {
  return survey.floor().clearance({on_floor, 0.0}, foot, 0.0).found;
}

Crossings::Crossings(const Survey& survey, std::span<const cracks::FoundCrack> cracks, double smallest)
    : survey_(&survey), reach_(2.0 * smallest + on_floor + look_every) {
  for (std::size_t i = 0; i < cracks.size(); ++i) {
    for (const Vec3& rim : cracks[i].rim) places_.push_back({rim, i});
  }
  std::sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) {
    if (a.rim.x != b.rim.x) return a.rim.x < b.rim.x;
    return a.crack < b.crack;
  });
}

std::vector<Crossing> Crossings::on(std::span<const Vec3> way) const {
  std::vector<Crossing> found;
  if (places_.empty()) return found;
  const auto add_near = [&](const Vec3& foot, double gone) {
    auto at = std::lower_bound(places_.begin(), places_.end(), foot.x - reach_,
                               [](const Place& place, double x) { return place.rim.x < x; });
    for (; at != places_.end() && at->rim.x <= foot.x + reach_; ++at) {
      if (glm::distance(at->rim, foot) <= reach_) found.push_back({at->crack, gone});
    }
  };
  ways::for_each_station(way, look_every, [&](const Vec3& foot, const Vec3&, double gone) {
    if (!stands_on_floor(*survey_, foot)) add_near(foot, gone);
  });
  std::sort(found.begin(), found.end(),
            [](const Crossing& a, const Crossing& b) { return a.crack != b.crack ? a.crack < b.crack : a.at < b.at; });
  const auto same = [](const Crossing& a, const Crossing& b) { return a.crack == b.crack; };
  found.erase(std::unique(found.begin(), found.end(), same), found.end());
  return found;
}

std::vector<Vec3> stretch(std::span<const Vec3> way, double at, double reach) {
  std::vector<Vec3> part;
  double gone = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const double length = glm::distance(way[i - 1], way[i]);
    const double begin = std::max(0.0, at - reach - gone), end = std::min(length, at + reach - gone);
    if (length > 0.0 && begin < end) {
      if (part.empty()) part.push_back(way[i - 1] + (begin / length) * (way[i] - way[i - 1]));
      part.push_back(way[i - 1] + (end / length) * (way[i] - way[i - 1]));
    }
    gone += length;
  }
  if (part.size() < 2) part.assign({way.front(), way.back()});
  return part;
}

std::vector<Vec3> way_over(const Survey& survey, const Crack& crack, double run_up) {
  const double half = crack.radius + run_up;
  std::vector<Vec3> way;
  for (const double side : {-1.0, 1.0}) {
    const Vec3 end = crack.point + side * half * crack.direction + Vec3(0.0, 0.0, rim_level);
    const FirstImpact floor = survey.floor().first_impact({0.0, 0.0}, end, Vec3(0.0, 0.0, -2.0 * rim_level));
    if (!floor.hit) return {};
    way.push_back(end - Vec3(0.0, 0.0, 2.0 * rim_level * floor.time));
  }
  return way;
}

}  // namespace roam::training
