#include "training/places/samples.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>

#include "math/boxes.h"
#include "math/random.h"

namespace roam::training {

namespace {

/// The number of samples by area and by triangle, about.
constexpr double samples_by_area = 20'000.0;
constexpr std::uint64_t samples_by_triangle = 10'000;
/// m. Floors are not sampled more densely: a cell of this size holds no room.
constexpr double smallest_cell = 0.5;
/// m above the floor: the start of a flying body.
constexpr double lift = 0.5;

/// A point with its position in a random order.
struct Sample {
  std::uint64_t turn = 0;
  Vec3 place{0.0};
};
/// Each kind of sample uses half of the numbers: samples by triangle come before those by area and by volume.
constexpr std::uint64_t first_half(std::uint64_t turn) { return turn >> 1; }
constexpr std::uint64_t second_half(std::uint64_t turn) { return turn | (std::uint64_t(1) << 63); }

double area(const Triangle& t) { return 0.5 * glm::length(glm::cross(t[1] - t[0], t[2] - t[0])); }

bool before(const Vec3& a, const Vec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

/// The corners in an order that is independent of the file's.
Triangle ordered(Triangle t) {
  std::sort(t.begin(), t.end(), before);
  return t;
}

/// Twice the area of the projection on the plan, positive if counter-clockwise.
double plan_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The least and the greatest y of a triangle between two values of x, on the plan. Its corners are ordered by x.
std::array<double, 2> range_between(const Triangle& t, double low, double high) {
  constexpr double none = std::numeric_limits<double>::infinity();
  std::array<double, 2> range{none, -none};
  for (const auto& [from, to] : {std::array{0, 1}, std::array{1, 2}, std::array{0, 2}}) {
    const Vec3 &a = t[from], &b = t[to];
    if (!(b.x > a.x) || b.x < low || a.x > high) continue;  // the ends of an upright side are on the two others
    for (const double x : {std::max(a.x, low), std::min(b.x, high)}) {
      const double y = a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
      range = {std::min(range[0], y), std::max(range[1], y)};
    }
  }
  return range;
}

/// Puts a sample on `t`, whose corners are ordered, above each point of the lattice of `cell` (m, from `origin`) below
/// it.
void sample_by_area(const Triangle& t, const Vec3& origin, double cell, std::uint64_t seed, std::vector<Sample>& out) {
  const double whole = plan_area(t[0], t[1], t[2]);
  if (whole == 0.0) return;
  const Box box = box_around(t);
  const auto first = [&](int k) { return std::ceil((box.lower[k] - origin[k]) / cell); };
  const auto last = [&](int k) { return std::floor((box.upper[k] - origin[k]) / cell); };
  for (double i = first(0); i <= last(0); ++i) {
    const double x = origin.x + cell * i;
    // A cell more on all sides: the test of each point decides, not the rounding of this range.
    const auto [low, high] = range_between(t, x - cell, x + cell);
    const double from = std::max(first(1), std::floor((low - origin.y) / cell) - 1.0);
    const double to = std::min(last(1), std::ceil((high - origin.y) / cell) + 1.0);
    for (double j = from; j <= to; ++j) {
      const Vec3 p(x, origin.y + cell * j, 0.0);
      const double u = plan_area(p, t[1], t[2]) / whole, v = plan_area(t[0], p, t[2]) / whole, w = 1.0 - u - v;
      if (u < 0.0 || v < 0.0 || w < 0.0) continue;
      const std::uint64_t turn = mix(mix(seed ^ std::bit_cast<std::uint64_t>(i)) ^ std::bit_cast<std::uint64_t>(j));
      out.push_back({second_half(turn), {p.x, p.y, u * t[0].z + v * t[1].z + w * t[2].z}});
    }
  }
}

std::vector<Sample> sample_floors(const Survey& survey, std::uint64_t seed) {
  const auto ids = survey.floor_triangles();
  double total = 0.0;
  for (const TriangleId id : ids) total += area(survey.triangle(id));
  const double cell = std::max(smallest_cell, std::sqrt(total / samples_by_area));
  Vec3 origin = survey.floor().bounds().lower;
  origin.x += cell * unit(mix(seed));
  origin.y += cell * unit(mix(seed + 1));
  const std::uint64_t one_in = 1 + ids.size() / samples_by_triangle;
  std::vector<Sample> samples;
  for (const TriangleId id : ids) {
    const Triangle t = ordered(survey.triangle(id));
    sample_by_area(t, origin, cell, seed, samples);
    const Vec3 middle = (t[0] + t[1] + t[2]) / 3.0;
    if (const std::uint64_t turn = hashed(middle, seed); turn % one_in == 0)
      samples.push_back({first_half(mix(turn)), middle});
  }
  return samples;
}

/// One point in each cell of the scene's box.
void sample_air(const Survey& survey, std::uint64_t seed, std::vector<Sample>& out) {
  const Box box = survey.world().bounds();
  if (box.empty()) return;
  const Vec3 size = box.size();
  const double largest = std::max({size.x, size.y, size.z});
  // The cells are cubes; a scene without height, or width, has one layer of them.
  const double flat = std::max(largest / samples_by_area, 1e-9);
  const double volume = std::max(size.x, flat) * std::max(size.y, flat) * std::max(size.z, flat);
  const double cell = std::max(std::cbrt(volume / samples_by_area), largest / samples_by_area);
  std::array<std::uint64_t, 3> count{};
  for (int k = 0; k < 3; ++k) count[k] = static_cast<std::uint64_t>(size[k] / cell) + 1;
  for (std::uint64_t i = 0; i < count[0]; ++i) {
    for (std::uint64_t j = 0; j < count[1]; ++j) {
      for (std::uint64_t k = 0; k < count[2]; ++k) {
        const std::uint64_t turn = mix(mix(mix(seed ^ i) ^ j) ^ k);
        const Vec3 part(static_cast<double>(i) + unit(mix(turn)), static_cast<double>(j) + unit(mix(turn + 1)),
                        static_cast<double>(k) + unit(mix(turn + 2)));
        out.push_back({second_half(turn), box.lower + cell * part});
      }
    }
  }
}

}  // namespace

std::vector<Vec3> sample_places(const Survey& survey, Mode mode, std::uint64_t seed) {
  std::vector<Sample> samples = sample_floors(survey, seed);
  if (mode != Mode::walk) {
    for (Sample& s : samples) s.place.z += lift;
    sample_air(survey, seed, samples);
  }
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) {
    return a.turn != b.turn ? a.turn < b.turn : before(a.place, b.place);
  });
  std::vector<Vec3> places;
  places.reserve(samples.size());
  for (const Sample& s : samples) {
    if (places.empty() || places.back() != s.place) places.push_back(s.place);
  }
  return places;
}

}  // namespace roam::training
