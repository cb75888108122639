#include "generate/block.h"

#include <algorithm>
#include <cmath>

#include "generate/circle.h"
#include "generate/noise.h"

namespace roam::generate {

Vec3 Block::point(int i, int j, int k) const {
  double x = a[static_cast<std::size_t>(i)], z = b[static_cast<std::size_t>(j)], y = c[static_cast<std::size_t>(k)];
  if (roughness > 0.0 && j > 0 && k > 0) {
    constexpr double bump = 0.6, ramp = 0.4;  // m: size of the bumps; distance from floor and front over which they
                                              // grow
    const double share = roughness * smooth((z - b.front()) / ramp) * smooth((y - c.front()) / ramp);
    const double p = (x + 0.7 * y) / bump, q = (z + 0.4 * y) / bump;
    x += share * value_noise(seed, p, q);
    y += share * value_noise(seed + 1, p, q);
    z += share * value_noise(seed + 2, p, q);
  }
  return {corner.x + ahead.x * x + aside.x * y, corner.y + ahead.y * x + aside.y * y, corner.z + z};
}

Grid block_side(const std::shared_ptr<const Block>& block, Side side, bool from_inside) {
  const int na = static_cast<int>(block->a.size()) - 1, nb = static_cast<int>(block->b.size()) - 1,
            nc = static_cast<int>(block->c.size()) - 1;
  Grid grid;
  bool inward = false;  // whether the grid without a flip faces inward
  const auto set = [&](int rows, int cols, bool wound_inward, auto index) {
    grid.rows = rows;
    grid.cols = cols;
    inward = wound_inward;
    grid.points = [block, index](int row, std::span<Vec3> out) {
      for (std::size_t col = 0; col < out.size(); ++col) {
        const auto [i, j, k] = index(row, static_cast<int>(col));
        out[col] = block->point(i, j, k);
      }
    };
  };
  using Index = std::array<int, 3>;
  switch (side) {
    case Side::front:
      set(na, nb, false, [](int r, int c) { return Index{r, c, 0}; });
      break;
    case Side::back:
      set(na, nb, true, [nc](int r, int c) { return Index{r, c, nc}; });
      break;
    case Side::floor:
      set(na, nc, true, [](int r, int c) { return Index{r, 0, c}; });
      break;
    case Side::roof:
      set(na, nc, false, [nb](int r, int c) { return Index{r, nb, c}; });
      break;
    case Side::near_end:
      set(nb, nc, false, [](int r, int c) { return Index{0, r, c}; });
      break;
    case Side::far_end:
      set(nb, nc, true, [na](int r, int c) { return Index{na, r, c}; });
      break;
  }
  grid.flipped = inward != from_inside;
  return grid;
}

void add_body(Part& part, const std::shared_ptr<const Block>& block) {
  for (const Side side : {Side::front, Side::back, Side::floor, Side::roof, Side::near_end, Side::far_end}) {
    part.grids.push_back(block_side(block, side, false));
  }
}

void add_cylinder(Part& part, const Vec3& foot, double radius, double height, double cell) {
  constexpr double full_turn = 6.283185307179586;
  constexpr int least_corners = 8;
  const int corners = std::max(least_corners, static_cast<int>(std::ceil(full_turn * radius / cell)));
  const int layers = std::max(1, static_cast<int>(std::ceil(height / cell)));
  const auto ring = [foot, radius, corners](double z, std::span<Vec3> out) {
    for (std::size_t k = 0; k < out.size(); ++k) {
      const CirclePoint p = circle(static_cast<double>(k) / corners);
      out[k] = {foot.x + radius * p.cosine, foot.y + radius * p.sine, foot.z + z};
    }
  };
  const auto level = [height, layers](int row) { return height * (static_cast<double>(row) / layers); };
  Grid mantle{.rows = layers, .cols = corners, .closed = true, .flipped = true};
  mantle.points = [ring, level](int row, std::span<Vec3> out) { ring(level(row), out); };
  part.grids.push_back(std::move(mantle));
  Fan bottom{.center = foot, .corners = corners, .flipped = true};
  bottom.points = [ring](std::span<Vec3> out) { ring(0.0, out); };
  Fan top{.center = foot + Vec3{0.0, 0.0, level(layers)}, .corners = corners};
  top.points = [ring, z = level(layers)](std::span<Vec3> out) { ring(z, out); };
  part.fans.push_back(std::move(bottom));
  part.fans.push_back(std::move(top));
}

}  // namespace roam::generate
