#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "generate/noise.h"
#include "generate/scene.h"
#include "math/floating_point.h"
#include "roam/error.h"

namespace roam::generate {
namespace {

constexpr double least_size = 10.0, most_size = 100'000.0;  // m
constexpr int tile_cells = 128;                             // along a side
constexpr double height_per_wavelength = 0.16;              // amplitude of each octave divided by its wavelength
constexpr int most_octaves = 16;

/// Height at a point: octaves of noise, the broad ones folded into ridges, cut by scarps where a mask allows them.
class Relief {
 public:
  Relief(std::uint64_t seed, double size, double cell) : seed_(seed), broadest_(0.5 * size) {
    // The mesh cannot represent waves shorter than two cells.
    for (double w = broadest_; w >= 2.0 * cell && octaves_ < most_octaves; w *= 0.5) ++octaves_;
  }

  [[nodiscard]] double height(double x, double y) const {
    double sum = 0.0, wavelength = broadest_;
    for (int k = 0; k < octaves_; ++k) {
      const double n = octave_noise(seed_, k, x / wavelength, y / wavelength);
      constexpr int ridged_octaves = 3;
      const double ridge = 1.0 - std::fabs(n);
      sum += height_per_wavelength * wavelength * (k < ridged_octaves ? ridge * ridge - 0.6 : 0.5 * n);
      wavelength *= 0.5;
    }
    const double mask_wavelength = 0.5 * broadest_;
    const double mask = smooth(2.0 * gradient_noise(seed_ - 1, x / mask_wavelength, y / mask_wavelength) + 0.5);
    return sum + mask * (scarps(sum) - sum);
  }

 private:
  /// Benches between cliffs. A cliff rises three quarters of a step within a twelfth of a step of the original slope.
  [[nodiscard]] double scarps(double height) const {
    constexpr double steepness = 12.0, rise_on_bench = 0.25;
    const double step = 0.25 * height_per_wavelength * broadest_;
    const double level = height / step, whole = static_cast<double>(floor_int(level)), part = level - whole;
    const double cliff = smooth((part - 0.5) * steepness + 0.5);
    return step * (whole + rise_on_bench * part + (1.0 - rise_on_bench) * cliff);
  }

  std::uint64_t seed_;
  double broadest_;
  int octaves_ = 0;
};

/// An upper bound of the sum of all octaves, as a multiple of the broadest wavelength: 0.16 (1 + 1/2 + 1/4 + ...), plus
/// one step by which a scarp may move a point.
constexpr double highest_per_wavelength = 2.25 * height_per_wavelength;

}  // namespace

Scene terrain(const TerrainOptions& options) {
  const DefaultFloatingPoint guard;
  check_options("terrain", options.triangles, options.origin);
  if (!(options.size >= least_size && options.size <= most_size)) {
    throw Error(
        fmt::format("A terrain of {} m cannot be made: ask for {} to {} m.", options.size, least_size, most_size));
  }
  const int cells = static_cast<int>(std::sqrt(0.5 * static_cast<double>(options.triangles)) + 0.5);
  const int tiles = (cells + tile_cells - 1) / tile_cells;
  const Relief relief(mix(options.seed ^ 0x30), options.size, options.size / cells);

  Scene::Plan plan;
  plan.parts = static_cast<std::uint64_t>(tiles) * static_cast<std::uint64_t>(tiles);
  plan.part = [=, size = options.size, origin = options.origin](std::uint64_t number) {
    const int tile_row = static_cast<int>(number) / tiles, tile_col = static_cast<int>(number) % tiles;
    const int row0 = tile_row * tile_cells, col0 = tile_col * tile_cells;
    Grid grid{.rows = std::min(tile_cells, cells - row0), .cols = std::min(tile_cells, cells - col0)};
    grid.points = [=](int row, std::span<Vec3> out) {
      const double x = size * (static_cast<double>(row0 + row) / cells);
      for (std::size_t k = 0; k < out.size(); ++k) {
        const double y = size * (static_cast<double>(col0 + static_cast<int>(k)) / cells);
        out[k] = Vec3(x, y, relief.height(x, y)) + origin;
      }
    };
    return Part{fmt::format("terrain/{:03}_{:03}", tile_row, tile_col), {std::move(grid)}, {}};
  };
  const double highest = highest_per_wavelength * 0.5 * options.size;
  plan.bounds = {options.origin + Vec3{0.0, 0.0, -highest}, options.origin + Vec3{options.size, options.size, highest}};
  return make_scene(std::move(plan));
}

}  // namespace roam::generate
