#include "generate/building.h"

#include <algorithm>
#include <cmath>

#include "generate/block.h"
#include "generate/noise.h"
#include "generate/tube.h"

namespace roam::generate {
namespace {

// Lengths in metres; heights above the pavement.
constexpr double margin = 0.8;  // from a corner of the building to its first bay
constexpr double parapet_width = 0.3, parapet_height = 0.9;
constexpr double foundation = 0.5, sill = 0.05;  // the ground floor is a little higher than the pavement
constexpr double door_width = 0.9, door_top = 2.1, passage_top = 2.6;
constexpr double ground_window = 0.9, window_sill = 0.9, recess = 0.15;
constexpr double wall = 0.3, partition = 0.2, room_height = 2.8;
constexpr double first_room = 4.0, second_room = 3.5;

struct Span {
  double from, to;
};

Span window_of(const BuildingDesign& d, int bay, double bay_width) {
  const double middle = margin + (bay + 0.5) * bay_width;
  return {middle - 0.5 * d.window_width, middle + 0.5 * d.window_width};
}

Span door_of(const BuildingDesign& d) {
  const double middle = margin + 0.5 * d.bay;
  return {middle - 0.5 * door_width, middle + 0.5 * door_width};
}

Span window_rows(const BuildingDesign& d, int storey) {
  if (storey == 0) return {ground_window, door_top};
  const double from = storey * d.storey + window_sill;
  return {from, from + d.window_height};
}

/// Marks along a facade: its ends, those of the parapet, and the edges of its windows.
std::vector<double> marks(const BuildingDesign& d, int bays, double bay_width, double length) {
  std::vector<double> m{0.0, parapet_width};
  for (int k = 0; d.windows && k < bays; ++k) {
    const Span w = window_of(d, k, bay_width);
    m.insert(m.end(), {w.from, w.to});
  }
  m.insert(m.end(), {length - parapet_width, length});
  return m;
}

void add_marks(std::vector<double>& m, const Span& s) {
  m.insert(m.end(), {s.from, s.to});
  std::sort(m.begin(), m.end());
  m.erase(std::unique(m.begin(), m.end()), m.end());
}

std::shared_ptr<const Block> body(const BuildingDesign& d, const Site& site, double cell) {
  auto block = std::make_shared<Block>();
  block->corner = site.corner;
  block->ahead = site.ahead;
  block->aside = site.aside;
  std::vector<double> a = marks(d, d.bays, d.bay, d.width());
  add_marks(a, door_of(d));
  if (d.passage) add_marks(a, window_of(d, d.bays - 1, d.bay));
  block->a = subdivide(a, cell);
  std::vector<double> b{-foundation, sill, ground_window, door_top, passage_top};
  for (int k = 1; d.windows && k < d.storeys; ++k) {
    const Span w = window_rows(d, k);
    b.insert(b.end(), {w.from, w.to});
  }
  b.push_back(d.height());
  block->b = subdivide(b, cell);
  block->c = subdivide(marks(d, d.side_bays, d.side_bay, d.depth()), cell);
  return block;
}

/// A hole of a facade. Fronts and backs have rows along the street; ends have rows along the height.
Hole hole(const Block& block, Side side, const Span& along, const Span& up) {
  const bool front_or_back = side == Side::front || side == Side::back;
  const std::vector<double>& lines = front_or_back ? block.a : block.c;
  const int l0 = index_of(lines, along.from), l1 = index_of(lines, along.to);
  const int u0 = index_of(block.b, up.from), u1 = index_of(block.b, up.to);
  return front_or_back ? Hole{l0, l1, u0, u1} : Hole{u0, u1, l0, l1};
}

int layers(double depth, double cell) { return std::max(1, static_cast<int>(std::ceil(depth / cell))); }

struct Pocket {
  Hole hole;
  double depth;  // m into the building; negative for an overhang
};

/// The windows of one side.
std::vector<Pocket> windows(const BuildingDesign& d, const Block& block, Side side) {
  std::vector<Pocket> pockets;
  if (!d.windows) return pockets;
  const bool front = side == Side::front, front_or_back = front || side == Side::back;
  const int bays = front_or_back ? d.bays : d.side_bays;
  for (int storey = 0; storey < d.storeys; ++storey) {
    for (int bay = 0; bay < bays; ++bay) {
      const bool is_door = front && bay == 0 && storey == 0;
      const bool is_passage = d.passage && front_or_back && bay == d.bays - 1 && storey == 0;
      if (is_door || is_passage) continue;
      const bool overhangs = front && storey > 0 && bay == d.overhanging_bay;
      const Span along = window_of(d, bay, front_or_back ? d.bay : d.side_bay);
      pockets.push_back({hole(block, side, along, window_rows(d, storey)), overhangs ? -overhang : recess});
    }
  }
  return pockets;
}

Hole door_hole(const BuildingDesign& d, const Block& block) {
  return hole(block, Side::front, door_of(d), {sill, door_top});
}

}  // namespace

double BuildingDesign::width() const { return 2.0 * margin + bays * bay; }
double BuildingDesign::depth() const { return 2.0 * margin + side_bays * side_bay; }
double BuildingDesign::height() const { return storeys * storey + parapet_height; }

BuildingDesign design(std::uint64_t seed, int number, bool with_windows) {
  const auto pick = [&](double low, double high, int what) { return uniform(low, high, seed, number, what); };
  BuildingDesign d;
  d.bays = 3 + static_cast<int>(pick(0.0, 2.0, 1));
  d.side_bays = 3 + static_cast<int>(pick(0.0, 2.0, 2));
  const double tall = pick(0.0, 1.0, 3);
  d.storeys = 2 + static_cast<int>(8.0 * tall * tall);
  d.bay = pick(3.6, 4.3, 4);
  d.side_bay = pick(3.4, 4.2, 5);
  d.storey = pick(3.0, 3.8, 6);
  d.window_width = pick(1.2, 2.2, 7);
  d.window_height = pick(1.2, 1.8, 8);
  d.overhanging_bay = pick(0.0, 1.0, 9) < 0.5 ? 1 + static_cast<int>(pick(0.0, d.bays - 1.0, 10)) : -1;
  d.passage = pick(0.0, 1.0, 11) < 0.3;
  d.windows = with_windows;
  return d;
}

Part facades(const BuildingDesign& d, const Site& site, double cell) {
  Part part;
  const auto block = body(d, site, cell);
  const Span passage = window_of(d, d.bays - 1, d.bay);
  std::array<Grid, 2> ends;
  std::array<Hole, 2> passage_holes{};
  for (const Side side : {Side::front, Side::back, Side::near_end, Side::far_end}) {
    Grid grid = block_side(block, side, false);
    const Vec3 inwards = side == Side::front      ? site.aside
                         : side == Side::back     ? -site.aside
                         : side == Side::near_end ? site.ahead
                                                  : -site.ahead;
    const std::vector<Pocket> pockets = windows(d, *block, side);
    for (const Pocket& p : pockets) add_pocket(part, grid, p.hole, inwards * p.depth, layers(std::fabs(p.depth), cell));
    for (const Pocket& p : pockets) grid.holes.push_back(p.hole);
    if (side == Side::front) grid.holes.push_back(door_hole(d, *block));
    if (d.passage && (side == Side::front || side == Side::back)) {
      const std::size_t k = side == Side::front ? 0 : 1;
      passage_holes[k] = hole(*block, side, passage, {sill, passage_top});
      ends[k] = grid;
      grid.holes.push_back(passage_holes[k]);
    }
    part.grids.push_back(std::move(grid));
  }
  if (d.passage) add_passage(part, ends[0], passage_holes[0], ends[1], passage_holes[1], layers(d.depth(), cell));
  Grid roof = block_side(block, Side::roof, false);
  const Hole terrace{index_of(block->a, parapet_width), index_of(block->a, d.width() - parapet_width),
                     index_of(block->c, parapet_width), index_of(block->c, d.depth() - parapet_width)};
  add_pocket(part, roof, terrace, {0.0, 0.0, -parapet_height}, layers(parapet_height, cell));
  roof.holes = {terrace};
  part.grids.push_back(std::move(roof));
  part.grids.push_back(block_side(block, Side::floor, false));
  return part;
}

Part interior(const BuildingDesign& d, const Site& site, double cell) {
  Part part;
  const auto outside = body(d, site, cell);
  const Hole door = door_hole(d, *outside);
  auto first = std::make_shared<Block>();
  first->corner = site.corner;
  first->ahead = site.ahead;
  first->aside = site.aside;
  // The rooms share the lines of the door, so that its passage and the inner door fit them.
  const Span opening = door_of(d);
  const std::array<double, 2> left{wall + 0.1, opening.from}, right{opening.to, margin + 2.0 * d.bay},
      above{door_top, room_height}, deep{wall, wall + first_room};
  first->a = subdivide(left, cell);
  const int row0 = static_cast<int>(first->a.size()) - 1;
  for (int i = door.row0 + 1; i < door.row1; ++i) first->a.push_back(outside->a[static_cast<std::size_t>(i)]);
  const std::vector<double> rest = subdivide(right, cell);
  first->a.insert(first->a.end(), rest.begin(), rest.end());
  for (int j = door.col0; j < door.col1; ++j) first->b.push_back(outside->b[static_cast<std::size_t>(j)]);
  const std::vector<double> upper = subdivide(above, cell);
  first->b.insert(first->b.end(), upper.begin(), upper.end());
  first->c = subdivide(deep, cell);
  auto second = std::make_shared<Block>(*first);
  const std::array<double, 2> deeper{wall + first_room + partition, wall + first_room + partition + second_room};
  second->c = subdivide(deeper, cell);

  const Hole in_room{row0, row0 + door.row1 - door.row0, 0, door.col1 - door.col0};
  add_passage(part, block_side(outside, Side::front, false), door, block_side(first, Side::front, true), in_room,
              layers(wall, cell));
  add_passage(part, block_side(first, Side::back, true), in_room, block_side(second, Side::front, true), in_room,
              layers(partition, cell));
  for (const auto& room : {first, second}) {
    for (const Side side : {Side::front, Side::back, Side::floor, Side::roof, Side::near_end, Side::far_end}) {
      Grid grid = block_side(room, side, true);
      const bool has_door = side == Side::front || (side == Side::back && room == first);
      if (has_door) grid.holes = {in_room};
      part.grids.push_back(std::move(grid));
    }
  }
  return part;
}

}  // namespace roam::generate
