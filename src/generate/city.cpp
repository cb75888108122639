#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "generate/block.h"
#include "generate/building.h"
#include "generate/noise.h"
#include "generate/scene.h"
#include "generate/tube.h"
#include "math/floating_point.h"

namespace roam::generate {
namespace {

// Lengths in metres. A tile is a block, with half of each street around it.
constexpr double tile = 64.0, half_street = 8.0, kerb = 0.15, pavement = 3.0;
constexpr double bridge_height = 5.5, bridge_thickness = 0.4, bridge_width = 3.0, bridge_landing = 2.0;
constexpr double bridge_parapet = 1.1, parapet_edge = 0.1, parapet_width = 0.15, pier_size = 0.5, pier_depth = 0.5;
constexpr int most_blocks = 40;  // along a side
constexpr int designs = 64, lots = 4;
constexpr double bridge_share = 0.3, cell_limit_low = 0.01, cell_limit_high = 30.0;

/// The values that determine all parts of a city.
struct City {
  std::uint64_t seed = 0;
  Vec3 origin{0.0};
  int blocks = 1;  // along a side
  bool windows = true;
  double cell = 1.0;
  int street_rows = 0, street_cols = 0;  // grid lines of a tile beyond those that it needs

  [[nodiscard]] int design_of(int row, int col, int lot) const {
    return static_cast<int>(hash(seed, row * most_blocks + col, lot) % designs);
  }
  [[nodiscard]] bool bridged(int row, int col) const {
    return row + 1 < blocks && unit(hash(seed, row * most_blocks + col, lots)) < bridge_share;
  }
  [[nodiscard]] Vec3 corner(int row, int col) const { return {row * tile, col * tile, 0.0}; }
};

Part street(const City& city, int row, int col) {
  const std::array<double, 4> marks{0.0, half_street, tile - half_street, tile};
  const std::vector<double> xs = distribute(marks, city.street_rows), ys = distribute(marks, city.street_cols);
  Grid grid{.rows = static_cast<int>(xs.size()) - 1, .cols = static_cast<int>(ys.size()) - 1};
  grid.points = [xs, ys, corner = city.corner(row, col), origin = city.origin](int r, std::span<Vec3> out) {
    for (std::size_t k = 0; k < out.size(); ++k) {
      out[k] = Vec3(corner.x + xs[static_cast<std::size_t>(r)], corner.y + ys[k], 0.0) + origin;
    }
  };
  const Hole block{index_of(xs, marks[1]), index_of(xs, marks[2]), index_of(ys, marks[1]), index_of(ys, marks[2])};
  Part part{fmt::format("street/{:03}_{:03}", row, col), {}, {}};
  add_pocket(part, grid, block, {0.0, 0.0, kerb}, 1);
  grid.holes = {block};
  part.grids.push_back(std::move(grid));
  return part;
}

/// Two buildings face the street below the block, two the street above it.
Site site_of(const City& city, int row, int col, int lot) {
  const double near = half_street + pavement, far = tile - half_street - pavement;
  const double middle = 0.5 * tile + 0.5;
  const bool upper = lot >= 2, second = lot % 2 == 1;
  Site site;
  site.corner = city.corner(row, col) + city.origin + Vec3{0.0, 0.0, kerb};
  if (upper) {
    site.ahead = {-1.0, 0.0, 0.0};
    site.aside = {0.0, -1.0, 0.0};
    site.corner += Vec3{second ? tile - middle : far, far, 0.0};
  } else {
    site.corner += Vec3{second ? middle : near, near, 0.0};
  }
  return site;
}

/// A foot bridge over the street between a block and the next: a deck on four piers with a parapet at each side.
Part bridge(const City& city, int row, int col) {
  auto deck = std::make_shared<Block>();
  const double start = tile - half_street - bridge_landing, length = 2.0 * (half_street + bridge_landing);
  deck->corner = city.corner(row, col) + city.origin + Vec3{start, 0.5 * (tile - bridge_width), bridge_height};
  const double pier = 0.5 * (bridge_landing - pier_size);
  const std::array<double, 8> a{
      0.0,           parapet_edge,          pier,  pier + pier_size, length - pier - pier_size,
      length - pier, length - parapet_edge, length};
  const std::array<double, 2> b{0.0, bridge_thickness};
  const double inner = parapet_edge + parapet_width, pier_edge = inner + pier_size;
  const std::array<double, 8> c{0.0,
                                parapet_edge,
                                inner,
                                pier_edge,
                                bridge_width - pier_edge,
                                bridge_width - inner,
                                bridge_width - parapet_edge,
                                bridge_width};
  deck->a = subdivide(a, city.cell);
  deck->b = subdivide(b, city.cell);
  deck->c = subdivide(c, city.cell);
  const auto hole = [&](double a0, double a1, double c0, double c1) {
    return Hole{index_of(deck->a, a0), index_of(deck->a, a1), index_of(deck->c, c0), index_of(deck->c, c1)};
  };
  const auto layers = [&](double depth) { return std::max(1, static_cast<int>(std::ceil(depth / city.cell))); };

  Part part{fmt::format("bridge_{:03}_{:03}", row, col), {}, {}};
  Grid top = block_side(deck, Side::roof, false), bottom = block_side(deck, Side::floor, false);
  const std::array<Hole, 2> parapets{hole(a[1], a[6], c[1], c[2]), hole(a[1], a[6], c[5], c[6])};
  for (const Hole& h : parapets) add_pocket(part, top, h, {0.0, 0.0, bridge_parapet}, layers(bridge_parapet));
  const double pier_length = bridge_height + pier_depth;  // into the pavement
  const std::array<Hole, 4> piers{hole(a[2], a[3], c[2], c[3]), hole(a[2], a[3], c[4], c[5]),
                                  hole(a[4], a[5], c[2], c[3]), hole(a[4], a[5], c[4], c[5])};
  for (const Hole& h : piers) add_pocket(part, bottom, h, {0.0, 0.0, -pier_length}, layers(pier_length));
  top.holes.assign(parapets.begin(), parapets.end());
  bottom.holes.assign(piers.begin(), piers.end());
  part.grids.push_back(std::move(top));
  part.grids.push_back(std::move(bottom));
  for (const Side side : {Side::front, Side::back, Side::near_end, Side::far_end}) {
    part.grids.push_back(block_side(deck, side, false));
  }
  return part;
}

Part building(const City& city, int row, int col, int lot, bool inside) {
  const BuildingDesign d = design(city.seed, city.design_of(row, col, lot), city.windows);
  const Site site = site_of(city, row, col, lot);
  Part part = inside ? interior(d, site, city.cell) : facades(d, site, city.cell);
  part.name = fmt::format("block_{:03}_{:03}/building_{}{}", row, col, lot, inside ? "/interior" : "");
  return part;
}

double triangles(const Part& part) {
  std::uint64_t n = 0;
  for (const auto& slices : slice(part)) n += count(part, slices).triangles;
  return static_cast<double>(n);
}

/// Triangles of each kind of thing at a given cell. Buildings of one design have equal numbers.
struct Built {
  std::array<double, designs> building{};
  double bridge = 0.0;
};

Built count_built(const City& city) {
  Built built;
  for (int k = 0; k < designs; ++k) {
    const BuildingDesign d = design(city.seed, k, city.windows);
    built.building[static_cast<std::size_t>(k)] =
        triangles(facades(d, {}, city.cell)) + triangles(interior(d, {}, city.cell));
  }
  built.bridge = triangles(bridge(city, 0, 0));
  return built;
}

/// Triangles of everything except streets.
double built_triangles(const City& city, const Built& built) {
  double sum = 0.0;
  for (int row = 0; row < city.blocks; ++row) {
    for (int col = 0; col < city.blocks; ++col) {
      for (int lot = 0; lot < lots; ++lot) {
        sum += built.building[static_cast<std::size_t>(city.design_of(row, col, lot))];
      }
      if (city.bridged(row, col)) sum += built.bridge;
    }
  }
  return sum;
}

double built_triangles(const City& city) { return built_triangles(city, count_built(city)); }

constexpr double built_share = 0.9;   // of the triangles at most; streets take the rest
constexpr double coarse_share = 0.7;  // of the triangles at most for the coarsest city, so that it can be refined

/// Chooses the largest city that leaves triangles to refine it.
bool fit_blocks(City& city, double asked) {
  city.cell = cell_limit_high;
  const Built built = count_built(city);
  for (city.blocks = most_blocks; city.blocks > 0; --city.blocks) {
    if (built_triangles(city, built) <= coarse_share * asked) return true;
  }
  return false;
}

City fit(const CityOptions& options) {
  const double asked = static_cast<double>(options.triangles);
  City city{.seed = mix(options.seed ^ 0x40), .origin = options.origin};
  constexpr int least_blocks_with_windows = 3;
  if (!fit_blocks(city, asked) || city.blocks < least_blocks_with_windows) {
    city.windows = false;
    fit_blocks(city, asked);
  }
  double fine = cell_limit_low, coarse = cell_limit_high;
  constexpr int halvings = 20;
  for (int i = 0; i < halvings; ++i) {
    city.cell = std::sqrt(fine * coarse);
    (built_triangles(city) > built_share * asked ? fine : coarse) = city.cell;
  }
  city.cell = coarse;

  // A tile's street has 2 rows cols triangles and those of the kerb. Rows and columns grow alike until they reach the
  // number; then columns are removed until they do not exceed it.
  const double per_tile = (asked - built_triangles(city)) / (static_cast<double>(city.blocks) * city.blocks);
  const auto made = [&] { return triangles(street(city, 0, 0)); };
  while (city.street_rows < (1 << 14) && made() < per_tile) {
    const int step = std::max(1, static_cast<int>((std::sqrt(per_tile) - std::sqrt(made())) / 4.0));
    city.street_rows += step;
    city.street_cols += step;
  }
  while (city.street_cols > 0 && made() > per_tile) --city.street_cols;
  return city;
}

}  // namespace

Scene city(const CityOptions& options) {
  const DefaultFloatingPoint guard;
  check_options("city", options.triangles, options.origin);
  const City city = fit(options);
  // Each block has its street, four buildings with their interiors, and a bridge or nothing.
  constexpr std::uint64_t parts_per_block = 2 + 2 * lots;
  const auto blocks = static_cast<std::uint64_t>(city.blocks);
  Scene::Plan plan;
  plan.parts = blocks * blocks * parts_per_block;
  plan.part = [city, blocks](std::uint64_t number) -> Part {
    const auto block = number / parts_per_block;
    const int row = static_cast<int>(block / blocks), col = static_cast<int>(block % blocks);
    const int what = static_cast<int>(number % parts_per_block);
    if (what == 0) return street(city, row, col);
    if (what <= 2 * lots) return building(city, row, col, (what - 1) / 2, what % 2 == 0);
    if (city.bridged(row, col)) return bridge(city, row, col);
    return {};
  };
  const double side = city.blocks * tile;
  plan.bounds = {options.origin + Vec3{0.0, 0.0, -1.0},
                 options.origin + Vec3{side, side, kerb + greatest_building_height}};
  return make_scene(std::move(plan));
}

}  // namespace roam::generate
