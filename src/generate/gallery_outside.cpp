#include <algorithm>
#include <cmath>

#include "generate/gallery_parts.h"
#include "generate/noise.h"

namespace roam::generate {
namespace {

// The dam, in metres: offsets to the left of the gallery's axis (downstream), heights above the datum. These dimensions
// are our own; the paper only says that the gallery lies in a dam. The lower gallery and its split lie inside, 15 m
// above the base.
constexpr double upstream = -14.0, crest_edge = 8.0, crest = 190.0, shoulder = 176.0, base = 66.0, batter = 0.75;
// Height of the ground along the axis. It buries the ends of the dam and stays below every gallery.
constexpr double valley = 62.0, below_gallery = 172.0, above_crest = 192.0;
constexpr double valley_from = 500.0, valley_to = 1950.0;          // stations
constexpr double bank_from = 4.0, bank_to = 40.0, dam_end = 38.0;  // beyond the gallery's ends
constexpr double bank_slope = 0.45, bank_top = 280.0;
constexpr double surroundings = 600.0, relief = 45.0;

double ground_cell(const GalleryDetail& detail, const Box& area) {
  const Vec3 size = area.size();
  return std::sqrt(2.0 * size.x * size.y / detail.ground_triangles);
}

Box plan() {
  Box box;
  for (const Path& p : gallery_paths) {
    box.include(p.from);
    box.include(p.to);
  }
  box.lower -= Vec3{surroundings, surroundings, 0.0};
  box.upper += Vec3{surroundings, surroundings, 0.0};
  return box;
}

/// Coarse ground consists of chords of the true one. Banks move outwards by the greatest reach of a chord, so that no
/// triangle of the ground enters a gallery, however few there are.
double bank_margin(const GalleryDetail& detail) { return 1.5 * ground_cell(detail, plan()); }

double bank_height(double length, double station, double margin) {
  const auto line = [](double s, double s0, double z0, double s1, double z1) {
    return z0 + (z1 - z0) * ((s - s0) / (s1 - s0));
  };
  const double left0 = -bank_to - margin, left1 = -bank_from - margin;
  const double right0 = length + bank_from + margin, right1 = length + bank_to + margin;
  if (station < left0) return std::min(bank_top, above_crest + bank_slope * (left0 - station));
  if (station < left1) return line(station, left0, above_crest, left1, below_gallery);
  if (station < valley_from) return line(station, left1, below_gallery, valley_from, valley);
  if (station < valley_to) return valley;
  if (station < right0) return line(station, valley_to, valley, right0, below_gallery);
  if (station < right1) return line(station, right0, below_gallery, right1, above_crest);
  return std::min(bank_top, above_crest + bank_slope * (station - right1));
}

double hills(std::uint64_t seed, double x, double y) {
  double sum = 0.0, wavelength = 640.0, share = 0.5;
  constexpr int octaves = 7;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += share * octave_noise(seed, octave, x / wavelength, y / wavelength);
    wavelength *= 0.5;
    share *= 0.5;
  }
  return relief * sum;
}

}  // namespace

Part dam(const GalleryOptions& options, const GalleryDetail& detail) {
  constexpr double blend = 150.0;
  const auto axis = std::make_shared<const Axis>(upper_axis(blend));
  const double toe = crest_edge + batter * (shoulder - base);
  const std::array<Vec3, 5> corners{{{0.0, upstream, base},
                                     {0.0, upstream, crest},
                                     {0.0, crest_edge, crest},
                                     {0.0, crest_edge, shoulder},
                                     {0.0, toe, base}}};
  const double beyond = dam_end + bank_margin(detail);
  double outline = 0.0;
  std::array<double, 5> lengths{};
  for (std::size_t k = 0; k < 5; ++k) {
    const Vec3 d = corners[(k + 1) % 5] - corners[k];
    lengths[k] = std::sqrt(d.y * d.y + d.z * d.z);
    outline += lengths[k];
  }
  const double cell = std::sqrt(2.0 * outline * (axis->length() + 2.0 * beyond) / detail.dam_triangles);
  std::vector<Vec3> section;
  for (std::size_t k = 0; k < 5; ++k) {
    const int n = std::max(1, static_cast<int>(std::ceil(lengths[k] / cell)));
    for (int i = 0; i < n; ++i) {
      section.push_back(corners[k] + (corners[(k + 1) % 5] - corners[k]) * (static_cast<double>(i) / n));
    }
  }
  const std::array<double, 3> marks{-beyond, axis->corner(), axis->length() + beyond};
  const double rows = detail.dam_triangles / (2.0 * static_cast<double>(section.size()));
  const std::vector<double> stations = distribute(marks, std::max(1, static_cast<int>(rows)));

  const auto row_points = [axis, section, stations, origin = options.origin](int row, std::span<Vec3> out) {
    const Axis::Frame f = axis->frame(stations[static_cast<std::size_t>(row)]);
    for (std::size_t k = 0; k < out.size(); ++k) {
      out[k] = Vec3(f.origin.x + f.left.x * section[k].y, f.origin.y + f.left.y * section[k].y, section[k].z) + origin;
    }
  };
  Part part{"dam", {}, {}};
  const int last_row = static_cast<int>(stations.size()) - 1;
  part.grids.push_back(
      {.rows = last_row, .cols = static_cast<int>(section.size()), .points = row_points, .closed = true});
  for (const bool last : {false, true}) {
    const int row = last ? last_row : 0;
    const Axis::Frame f = axis->frame(stations[static_cast<std::size_t>(row)]);
    Fan end{.center = f.origin + Vec3{0.0, 0.0, 0.5 * (shoulder + base)} + options.origin,
            .corners = static_cast<int>(section.size()),
            .flipped = last};
    end.points = [row_points, row](std::span<Vec3> out) { row_points(row, out); };
    part.fans.push_back(std::move(end));
  }
  return part;
}

Part ground(const GalleryOptions& options, const GalleryDetail& detail) {
  const Box area = plan();
  const Vec3 size = area.size();
  const double cell = ground_cell(detail, area);
  const int rows = std::max(1, static_cast<int>(size.x / cell + 0.5));
  const int cols = std::max(1, static_cast<int>(detail.ground_triangles / (2.0 * rows) + 0.5));
  const auto axis = std::make_shared<const Axis>(upper_axis(1.0));
  Grid grid{.rows = rows, .cols = cols};
  grid.points = [axis, area, size, rows, cols, margin = bank_margin(detail), seed = mix(options.seed ^ 0x20),
                 origin = options.origin](int row, std::span<Vec3> out) {
    // The hills end before the dam.
    constexpr double plain_from = 120.0, plain_over = 300.0;
    const double x = area.lower.x + size.x * (static_cast<double>(row) / rows);
    for (int col = 0; col <= cols; ++col) {
      const double y = area.lower.y + size.y * (static_cast<double>(col) / cols);
      const Axis::Place p = axis->place(x, y);
      const double share = smooth((std::fabs(p.offset) - plain_from - margin) / plain_over);
      double z = bank_height(axis->length(), p.station, margin);
      if (share > 0.0) z += share * hills(seed, x, y);
      out[static_cast<std::size_t>(col)] = Vec3(x, y, z) + origin;
    }
  };
  return {"terrain", {std::move(grid)}, {}};
}

Box gallery_bounds() {
  Box box = plan();
  box.lower.z = std::min(valley, base) - relief;
  box.upper.z = bank_top + relief;
  return box;
}

}  // namespace roam::generate
