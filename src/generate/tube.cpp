#include "generate/tube.h"

#include <algorithm>
#include <cmath>

#include "generate/circle.h"
#include "generate/noise.h"

namespace roam::generate {
namespace {

// Roughness fades at openings, bulkheads and sharp corners: none within `plain`, all of it beyond `plain + ramp`.
constexpr double plain = 0.05, ramp = 0.4;  // m

double fade(double distance) { return smooth((distance - plain) / ramp); }

/// Rock under shotcrete: bumps of three sizes (m), with their weights.
double roughness(std::uint64_t seed, double s, double v) {
  return 0.6 * value_noise(seed, s / 1.1, v / 1.1) + 0.28 * value_noise(seed + 1, s / 0.37, v / 0.37) +
         0.12 * value_noise(seed + 2, s / 0.13, v / 0.13);
}

int steps(double length, double cell) {
  const double n = std::ceil(length / cell);
  return n > 1.0 ? static_cast<int>(n) : 1;
}

void divide_span(std::vector<double>& lines, double a, double b, std::int64_t n) {
  for (std::int64_t k = 0; k < n; ++k) {
    lines.push_back(a + (b - a) * (static_cast<double>(k) / static_cast<double>(n)));
  }
}

}  // namespace

std::vector<double> subdivide(std::span<const double> marks, double cell) {
  std::vector<double> lines;
  for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
    divide_span(lines, marks[i], marks[i + 1], steps(marks[i + 1] - marks[i], cell));
  }
  lines.push_back(marks.back());
  return lines;
}

std::vector<double> distribute(std::span<const double> marks, std::int64_t extra) {
  std::vector<double> lines;
  lines.reserve(marks.size() + static_cast<std::size_t>(extra));
  const double per_metre = static_cast<double>(extra) / (marks.back() - marks.front());
  std::int64_t given = 0;
  for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
    const std::int64_t due = floor_int((marks[i + 1] - marks.front()) * per_metre + 0.5);
    divide_span(lines, marks[i], marks[i + 1], 1 + due - given);
    given = due;
  }
  lines.push_back(marks.back());
  return lines;
}

int index_of(std::span<const double> lines, double mark) {
  return static_cast<int>(std::lower_bound(lines.begin(), lines.end(), mark) - lines.begin());
}

Section::Section(std::span<const Corner> corners, double cell) {
  constexpr double pi = 3.141592653589793;
  constexpr int least_arch_steps = 4;
  std::vector<double> corner_v;
  double v = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner &a = corners[i], &b = corners[(i + 1) % corners.size()];
    corner.push_back(static_cast<int>(columns.size()));
    corner_v.push_back(v);
    const double dy = b.y - a.y, dz = b.z - a.z;
    const double chord = std::sqrt(dy * dy + dz * dz);
    const double length = a.arch ? 0.5 * pi * chord : chord;
    const int n = a.arch ? std::max(least_arch_steps, steps(length, cell)) : steps(length, cell);
    for (int k = 0; k < n; ++k) {
      const double t = static_cast<double>(k) / n;
      Column c{a.y + dy * t, a.z + dz * t, -dz / chord, dy / chord, a.roughness, v + length * t};
      if (a.arch) {
        const CirclePoint p = circle(0.5 * t);
        if (k > 0) {
          c.y = 0.5 * chord * p.cosine;
          c.z = a.z + 0.5 * chord * p.sine;
        }
        c.ny = -p.cosine;
        c.nz = -p.sine;
      }
      columns.push_back(c);
    }
    v += length;
  }
  for (Column& c : columns) {
    double nearest = v;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (!corners[i].sharp) continue;
      const double d = std::fabs(c.v - corner_v[i]);
      nearest = std::min({nearest, d, v - d});
    }
    c.roughness *= smooth(nearest / ramp);
  }
}

double Tube::floor_at(double station) const {
  if (station <= floor.front().first) return floor.front().second;
  for (std::size_t i = 0; i + 1 < floor.size(); ++i) {
    const auto [s0, z0] = floor[i];
    const auto [s1, z1] = floor[i + 1];
    if (station < s1) return z0 + (z1 - z0) * ((station - s0) / (s1 - s0));
  }
  return floor.back().second;
}

Vec3 Tube::point(double station, double y, double z) const {
  const Axis::Frame f = axis.frame(station);
  return {f.origin.x + f.left.x * y + origin.x, f.origin.y + f.left.y * y + origin.y, floor_at(station) + z + origin.z};
}

Hole Tube::hole(const Opening& o) const {
  return {index_of(stations, o.from), index_of(stations, o.to), section.corner[static_cast<std::size_t>(o.corner0)],
          section.corner[static_cast<std::size_t>(o.corner1)]};
}

void Tube::row_points(int row, std::span<Vec3> points) const {
  const double s = stations[static_cast<std::size_t>(row)];
  const Axis::Frame f = axis.frame(s);
  const Vec3 base{f.origin.x + origin.x, f.origin.y + origin.y, floor_at(s) + origin.z};
  const double ends = fade(std::min(s - stations.front(), stations.back() - s));

  struct Near {
    double ds, v0, v1;
  };
  std::vector<Near> near;
  for (const Opening& o : openings) {
    const double ds = std::max({o.from - s, s - o.to, 0.0});
    if (ds < plain + ramp) {
      const auto v = [&](int k) {
        return section.columns[static_cast<std::size_t>(section.corner[static_cast<std::size_t>(k)])].v;
      };
      near.push_back({ds, v(o.corner0), v(o.corner1)});
    }
  }
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Section::Column& c = section.columns[k];
    double y = c.y, z = c.z;
    if (c.roughness > 0.0 && ends > 0.0) {
      double share = ends;
      for (const Near& o : near) share = std::min(share, fade(std::max({o.ds, o.v0 - c.v, c.v - o.v1})));
      if (share > 0.0) {
        const double d = c.roughness * share * roughness(seed, s, c.v);
        y += c.ny * d;
        z += c.nz * d;
      }
    }
    points[k] = {base.x + f.left.x * y, base.y + f.left.y * y, base.z + z};
  }
}

Grid tube_grid(const std::shared_ptr<const Tube>& tube, int row0, int row1) {
  Grid grid{.rows = row1 - row0, .cols = static_cast<int>(tube->section.columns.size()), .closed = true};
  grid.points = [tube, row0](int row, std::span<Vec3> out) { tube->row_points(row0 + row, out); };
  for (const Opening& o : tube->openings) {
    Hole h = tube->hole(o);
    if (h.row0 < row0 || h.row1 > row1) continue;
    h.row0 -= row0;
    h.row1 -= row0;
    grid.holes.push_back(h);
  }
  return grid;
}

Fan bulkhead(const std::shared_ptr<const Tube>& tube, bool last, std::vector<int> columns, double y, double z) {
  const double station = last ? tube->stations.back() : tube->stations.front();
  const int row = last ? static_cast<int>(tube->stations.size()) - 1 : 0;
  Fan fan{.center = tube->point(station, y, z), .corners = static_cast<int>(columns.size()), .flipped = last};
  fan.points = [tube, row, columns = std::move(columns)](std::span<Vec3> out) {
    std::vector<Vec3> all(tube->section.columns.size());
    tube->row_points(row, all);
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = all[static_cast<std::size_t>(columns[k])];
  };
  return fan;
}

std::vector<int> columns_between(const Section& section, int corner0, int corner1) {
  const int n = static_cast<int>(section.columns.size());
  const int last = section.corner[static_cast<std::size_t>(corner1)];
  std::vector<int> columns;
  for (int c = section.corner[static_cast<std::size_t>(corner0)]; c != last; c = (c + 1) % n) columns.push_back(c);
  columns.push_back(last);
  return columns;
}

}  // namespace roam::generate
