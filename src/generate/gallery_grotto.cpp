#include <algorithm>
#include <array>
#include <cmath>

#include "generate/gallery_parts.h"
#include "generate/noise.h"

namespace roam::generate {
namespace {

// Lengths in metres.
constexpr double wall_thickness = 0.5;

/// A room whose walls are aligned with the door, and the hole of its furnishing in the floor.
struct Grotto {
  std::shared_ptr<const Block> room;
  Hole door;      // in the front
  Hole standing;  // in the floor: the plinth or the sump
};

Grotto make_grotto(const Tube& tube, const Opening& door, double cell, std::uint64_t seed) {
  const double narrow = 0.5, wide = uniform(1.9, 2.6, seed, 1), depth = uniform(2.0, 3.0, seed, 2),
               height = uniform(2.2, 2.7, seed, 3);
  const bool ahead_is_wide = unit(hash(seed, 4)) < 0.5;
  const Hole opening = tube.hole(door);
  const double back_margin = 0.3, plinth_depth = 0.5, plinth_length = 1.3;

  auto room = std::make_shared<Block>();
  const double before = ahead_is_wide ? narrow : wide, behind = ahead_is_wide ? wide : narrow;
  // The plinth keeps clear of the door's lines, which must equal those of the gallery's wall.
  const double plinth0 = ahead_is_wide ? before + gallery_door_width + back_margin : back_margin;
  const double plinth1 = plinth0 + plinth_length;
  std::vector<double> left = {0.0}, right = {before + gallery_door_width};
  (ahead_is_wide ? right : left).insert((ahead_is_wide ? right : left).end(), {plinth0, plinth1});
  left.push_back(before);
  right.push_back(before + gallery_door_width + behind);
  room->a = subdivide(left, cell);
  const Hole in_front{static_cast<int>(room->a.size()) - 1,
                      static_cast<int>(room->a.size()) - 1 + opening.row1 - opening.row0, 0,
                      opening.col1 - opening.col0};
  for (int row = opening.row0 + 1; row < opening.row1; ++row) {
    room->a.push_back(before + (tube.stations[static_cast<std::size_t>(row)] - door.from));
  }
  const std::vector<double> rest = subdivide(right, cell);
  room->a.insert(room->a.end(), rest.begin(), rest.end());

  for (int col = opening.col0; col < opening.col1; ++col) {
    room->b.push_back(tube.section.columns[static_cast<std::size_t>(col)].z);
  }
  const std::array<double, 2> above{gallery_door_height, height};
  const std::vector<double> upper = subdivide(above, cell);
  room->b.insert(room->b.end(), upper.begin(), upper.end());

  const std::array<double, 4> depths{0.0, depth - back_margin - plinth_depth, depth - back_margin, depth};
  room->c = subdivide(depths, cell);

  const double wall = tube.section.columns[static_cast<std::size_t>(opening.col0)].y;
  room->corner = tube.point(door.from, wall + wall_thickness, 0.0) - tube.axis.ahead(door.from) * before;
  room->ahead = tube.axis.ahead(door.from);
  room->aside = tube.axis.left(door.from);
  room->roughness = 0.01;
  room->seed = mix(seed ^ 0x10);
  const Hole standing{index_of(room->a, plinth0), index_of(room->a, plinth1), index_of(room->c, depths[1]),
                      index_of(room->c, depths[2])};
  return {room, in_front, standing};
}

Part door_part(const std::shared_ptr<const Tube>& tube, const Opening& door, const Grotto& grotto, double cell) {
  Part part;
  const Grid wall = tube_grid(tube, 0, static_cast<int>(tube->stations.size()) - 1);
  const Grid front = block_side(grotto.room, Side::front, true);
  const int layers = std::max(1, static_cast<int>(wall_thickness / cell));
  add_passage(part, wall, tube->hole(door), front, grotto.door, layers);
  return part;
}

constexpr double plinth_height = 0.6, sump_depth = 0.9;

Part room_part(const Grotto& grotto, Furnishing furnishing, double cell) {
  Part part;
  for (const Side side : {Side::front, Side::back, Side::floor, Side::roof, Side::near_end, Side::far_end}) {
    Grid grid = block_side(grotto.room, side, true);
    if (side == Side::front) grid.holes = {grotto.door};
    if (side == Side::floor) grid.holes = {grotto.standing};
    part.grids.push_back(std::move(grid));
  }
  const double rise = furnishing == Furnishing::sump ? -sump_depth : plinth_height;
  const int layers = std::max(1, static_cast<int>(std::fabs(rise) / cell));
  add_pocket(part, block_side(grotto.room, Side::floor, true), grotto.standing, {0.0, 0.0, rise}, layers);
  return part;
}

/// A cabinet and a plumb line's tube on the plinth, on feet that are not modelled.
Part instrument_part(const Grotto& grotto, double cell, std::uint64_t seed) {
  Part part;
  const double feet = 0.02, margin = 0.06;
  const Block& room = *grotto.room;
  const double a0 = room.a[static_cast<std::size_t>(grotto.standing.row0)];
  const double c0 = room.c[static_cast<std::size_t>(grotto.standing.col0)];
  auto cabinet = std::make_shared<Block>();
  cabinet->corner =
      room.corner + room.ahead * (a0 + margin) + room.aside * (c0 + margin) + Vec3{0.0, 0.0, plinth_height + feet};
  cabinet->ahead = room.ahead;
  cabinet->aside = room.aside;
  const std::array<double, 2> along{0.0, uniform(0.4, 0.7, seed, 6)}, up{0.0, uniform(0.3, 0.9, seed, 7)},
      deep{0.0, 0.38};
  cabinet->a = subdivide(along, cell);
  cabinet->b = subdivide(up, cell);
  cabinet->c = subdivide(deep, cell);
  add_body(part, cabinet);
  const double radius = 0.08;
  add_cylinder(part,
               room.corner + room.ahead * (a0 + 1.05) + room.aside * (c0 + 0.25) + Vec3{0.0, 0.0, plinth_height + feet},
               radius, uniform(0.6, 1.2, seed, 8), cell);
  return part;
}

Part named(Part part, std::string name) {
  part.name = std::move(name);
  return part;
}

}  // namespace

void add_grotto(std::vector<std::function<Part()>>& parts, const std::shared_ptr<const Tube>& tube, const Opening& door,
                const std::string& name, Furnishing furnishing, double cell, std::uint64_t seed) {
  const Grotto grotto = make_grotto(*tube, door, cell, seed);
  parts.push_back([=] { return named(door_part(tube, door, grotto, cell), name + "/door"); });
  parts.push_back([=] { return named(room_part(grotto, furnishing, cell), name + "/room"); });
  if (furnishing == Furnishing::instruments) {
    parts.push_back([=] { return named(instrument_part(grotto, cell, seed), name + "/instrument"); });
  }
}

}  // namespace roam::generate
