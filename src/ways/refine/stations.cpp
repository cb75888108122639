#include "ways/refine/stations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "ways/lattice/walk_place.h"

namespace roam::ways {
namespace {

/// Metres: precision of the widest place beside a station, and of the narrowest between two.
constexpr double fine = 1e-5;
constexpr std::size_t flying_directions = 16;

struct Sideways {
  std::array<Vec3, flying_directions> direction;
  std::size_t count = 0;
};

/// The directions to search: left and right on foot, all around when flying.
Sideways sideways(const Measure& measure, const Vec3& ahead) {
  const Vec3 up(0.0, 0.0, 1.0);
  Vec3 side = glm::cross(up, ahead);
  const double length = glm::length(side);
  side = length > 0.0 ? side / length : Vec3(1.0, 0.0, 0.0);
  Sideways s;
  if (measure.mode == Mode::walk) {
    s.direction[0] = side;
    s.direction[1] = -side;
    s.count = 2;
    return s;
  }
  const Vec3 other = glm::normalize(glm::cross(ahead, side));
  for (; s.count < flying_directions; ++s.count) {
    const double angle = 2.0 * glm::pi<double>() * static_cast<double>(s.count) / flying_directions;
    s.direction[s.count] = std::cos(angle) * side + std::sin(angle) * other;
  }
  return s;
}

/// The station at a place, if it is wider than `least`.
std::optional<Station> wider(const Survey& survey, const Measure& measure, const Vec3& place, double least) {
  Vec3 foot = place;
  if (measure.mode == Mode::walk) {
    const auto found = foot_at(survey, measure, place);
    if (!found) return std::nullopt;
    foot = *found;
    const auto stand = stand_at(survey, measure, foot, largest_radius(measure), least);
    if (stand) return Station{foot, stand->radius, false};
    return std::nullopt;
  }
  const double free = clearance_at(survey, measure, foot);
  if (free < least) return std::nullopt;
  return Station{foot, free, false};
}

Vec3 ahead_at(const Stations& way, std::size_t i) {
  const std::size_t a = i > 0 ? i - 1 : 0, b = std::min(i + 1, way.size() - 1);
  const Vec3 d = way[b].place - way[a].place;
  const double length = glm::length(d);
  return length > 0.0 ? d / length : Vec3(1.0, 0.0, 0.0);
}

/// The same way with places `apart` from each other, on the straight lines between the given ones.
Stations resampled(const Stations& way, double apart) {
  Stations out{way.front()};
  double left = apart;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Vec3 a = way[i - 1].place, d = way[i].place - a;
    const double length = glm::length(d);
    double at = left;
    for (; at < length; at += apart) out.push_back({a + d * (at / length), 0.0, false});
    left = at - length;
  }
  // The last place stays; one nearer to it than half a step is dropped.
  if (out.size() > 1 && glm::length(out.back().place - way.back().place) < 0.5 * apart) out.pop_back();
  out.push_back(way.back());
  return out;
}

/// Moves each place towards the middle between its neighbours, twice over.
void smooth(Stations& way) {
  for (int turn = 0; turn < 2; ++turn) {
    Vec3 before = way.front().place;
    for (std::size_t i = 1; i + 1 < way.size(); ++i) {
      const Vec3 here = way[i].place;
      const double z = here.z;  // heights jump at kerbs, and the search for the floor starts at its own height
      way[i].place = 0.25 * before + 0.5 * here + 0.25 * way[i + 1].place;
      way[i].place.z = std::max(z, way[i].place.z);
      before = here;
    }
  }
}

/// Moves all stations to their widest within `reach`; drops those where no body fits.
Stations widened(const Survey& survey, const Measure& measure, const Stations& way, double reach) {
  Stations out{way.front()};
  for (std::size_t i = 1; i + 1 < way.size(); ++i) {
    const Station start = station_at(survey, measure, way[i].place);
    const Station best = widest_beside(survey, measure, start, ahead_at(way, i), reach);
    if (best.free > 0.0) out.push_back(best);
  }
  out.push_back(way.back());
  return out;
}

/// The narrowest place of the ridge between the neighbours of station `i`, by golden section (Kiefer 1953).
Station narrowest_near(const Survey& survey, const Measure& measure, const Stations& way, std::size_t i) {
  const Vec3 a = way[i - 1].place, b = way[i].place, c = way[i + 1].place;
  const Vec3 ahead = ahead_at(way, i);
  const auto ridge = [&](double t) {
    const Vec3 on = t < 0.0 ? b + (a - b) * -t : b + (c - b) * t;
    return widest_beside(survey, measure, station_at(survey, measure, on), ahead, station_spacing);
  };
  constexpr double golden = 0.6180339887498949;
  double low = -1.0, high = 1.0;
  double t1 = high - golden * (high - low), t2 = low + golden * (high - low);
  Station s1 = ridge(t1), s2 = ridge(t2), least = way[i];
  while ((high - low) * station_spacing > 10.0 * fine) {
    for (const Station& s : {s1, s2})
      if (s.free > 0.0 && s.free < least.free) least = s;
    if (s1.free < s2.free) {
      high = t2;
      t2 = t1;
      s2 = s1;
      t1 = high - golden * (high - low);
      s1 = ridge(t1);
    } else {
      low = t1;
      t1 = t2;
      s1 = s2;
      t2 = low + golden * (high - low);
      s2 = ridge(t2);
    }
  }
  return least;
}

}  // namespace

Station station_at(const Survey& survey, const Measure& measure, const Vec3& place) {
  return wider(survey, measure, place, measure.narrowest).value_or(Station{place, 0.0, false});
}

Station widest_beside(const Survey& survey, const Measure& measure, const Station& station, const Vec3& ahead,
                      double reach) {
  const Sideways sides = sideways(measure, ahead);
  const double enough = largest_radius(measure);
  Station best = station;
  for (double step = 0.5 * reach; step > 0.5 * fine; step *= 0.5) {
    for (bool moved = true; moved;) {
      moved = false;
      for (std::size_t k = 0; k < sides.count && best.free < enough; ++k) {
        const Vec3 to = best.place + sides.direction[k] * step;
        const Vec3 off = to - station.place;
        if (measure.mode == Mode::walk ? std::hypot(off.x, off.y) > reach : glm::length(off) > reach) continue;
        const auto next = wider(survey, measure, to, std::max(measure.narrowest, best.free + 0.1 * fine));
        if (!next) continue;
        best = *next;
        moved = true;
      }
    }
  }
  return best;
}

Stations polish(const Survey& survey, const Measure& measure, const Stations& way, double spacing) {
  if (way.size() < 3) return way;
  Stations ridge = resampled(way, std::max(0.5 * spacing, station_spacing));
  smooth(ridge);
  ridge = widened(survey, measure, ridge, spacing);
  ridge = resampled(ridge, station_spacing);
  smooth(ridge);
  ridge = widened(survey, measure, ridge, std::min(spacing, 2.0 * station_spacing));
  std::size_t least = 0;
  for (std::size_t i = 1; i + 1 < ridge.size(); ++i) {
    ridge[i].polished = true;
    if (least == 0 || ridge[i].free < ridge[least].free) least = i;
  }
  if (least > 0) {
    ridge[least] = narrowest_near(survey, measure, ridge, least);
    ridge[least].polished = true;
  }
  return ridge;
}

}  // namespace roam::ways
