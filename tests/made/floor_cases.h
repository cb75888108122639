#pragma once
/// \file
/// Small scenes whose cracks are known by construction, each with a name. Rooms are 8 m by 6 m with walls around unless
/// a case says otherwise; floors are at z = 0.

#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "floor_pieces.h"

namespace floors {

struct FloorCase {
  std::string name;
  Mesh mesh;
  std::vector<double> cracks{};      ///< radii, widest first
  std::vector<double> steps_down{};  ///< likewise
  bool has_drop = false;             ///< there is an open drop as well
  double tolerance = 2e-5;
  std::function<bool(const Vec3&)> is_reached = [](const Vec3& foot) { return foot.z > -0.35; };
};

inline constexpr double long_side = 8.0, short_side = 6.0;

inline bool anywhere(const Vec3&) { return true; }

/// The walls around a room.
inline void enclose(Mesh& mesh, double low = -3.0, double high = 3.0) {
  scenes::add_wall(mesh, 0.0, 0.0, long_side, 0.0, low, high);
  scenes::add_wall(mesh, long_side, 0.0, long_side, short_side, low, high);
  scenes::add_wall(mesh, long_side, short_side, 0.0, short_side, low, high);
  scenes::add_wall(mesh, 0.0, short_side, 0.0, 0.0, low, high);
}

/// A room with holes over a bottom `depth` lower.
inline Mesh holed(const std::vector<Piece>& holes, double depth = 2.0, double cell = 0.7) {
  Mesh mesh;
  Floor floor(0.0, 0.0, long_side, short_side, cell);
  for (const Piece& hole : holes) floor.without(hole);
  floor.add_to(mesh, 0.0);
  scenes::add_floor(mesh, 0.0, 0.0, long_side, short_side, -depth);
  enclose(mesh, -depth);
  return mesh;
}

inline FloorCase straight_split(const std::string& name, double width, double depth, double turn, double cell = 0.7) {
  return {.name = name, .mesh = holed({strip(4.03, 3.01, width, turn)}, depth, cell), .cracks = {0.5 * width}};
}

// ------------------------------------------------------------------------------------------------ what is a crack

inline void add_holes(std::vector<FloorCase>& cases) {
  for (const auto& [name, width] : {std::pair{"SplitOf10Centimetres", 0.1},
                                    {"SplitOf20Centimetres", 0.2},
                                    {"SplitOf50Centimetres", 0.5},
                                    {"SplitOf80Centimetres", 0.8},
                                    {"SplitOf125Centimetres", 1.25}})
    cases.push_back(straight_split(name, width, 2.0, 0.0));
  cases.push_back(straight_split("SplitThatIs50MetresDeep", 0.6, 50.0, 0.0));
  cases.push_back(straight_split("SplitAtAnAngleToTheTriangles", 0.37, 2.0, 30.0));
  cases.push_back(straight_split("NarrowSplitAtAnAngle", 0.1, 2.0, 17.0));
  cases.push_back(straight_split("SplitInAFineMesh", 0.5, 2.0, 12.0, 0.08));
  cases.push_back({.name = "CrossingSplits",
                   .mesh = holed({strip(4.03, 3.0, 0.5, 0.0), strip(4.0, 3.01, 0.5, 90.0)}),
                   .cracks = {0.25 * std::numbers::sqrt2}});
  // Three of the four corners lie on a circle that holds no fourth: two sides of 60 degrees, 0.4 / sin 60 long.
  cases.push_back({.name = "ObliquelyCrossingSplits",
                   .mesh = holed({strip(4.03, 3.0, 0.4, 10.0), strip(4.0, 3.01, 0.4, 70.0)}),
                   .cracks = {0.4 / std::sin(std::numbers::pi / 3.0) / std::numbers::sqrt3}});
  // Ends at the room's wall, which a fallen body may just touch: r = (0.4 - r slant) cos here too.
  const double open_slant = 0.3 / short_side, open_cosine = 1.0 / std::hypot(1.0, open_slant);
  cases.push_back({.name = "TaperingSplit",
                   .mesh = holed({{{3.9, 0.0, 0.0}, {4.1, 0.0, 0.0}, {4.4, short_side, 0.0}, {3.6, short_side, 0.0}}}),
                   .cracks = {0.4 * open_cosine / (1.0 + open_slant * open_cosine)}});
  // Touches both sides and the end: r = (0.4 - r slant) cos.
  const double slant = 0.3 / 4.0, cosine = 1.0 / std::hypot(1.0, slant);
  cases.push_back({.name = "TaperingSplitWithAnEnd",
                   .mesh = holed({{{3.9, 1.0, 0.0}, {4.1, 1.0, 0.0}, {4.4, 5.0, 0.0}, {3.6, 5.0, 0.0}}}),
                   .cracks = {0.4 * cosine / (1.0 + slant * cosine)}});
  cases.push_back({.name = "RoundManhole", .mesh = holed({round(4.1, 3.0, 0.3, 32)}), .cracks = {0.3}});
  cases.push_back({.name = "Sump", .mesh = holed({rectangle(2.0, 2.0, 2.4, 2.4)}, 0.5), .cracks = {0.2}});
  cases.push_back({.name = "TwoSumps",
                   .mesh = holed({rectangle(1.0, 1.0, 1.4, 1.4), rectangle(6.0, 4.0, 6.6, 4.6)}, 0.5),
                   .cracks = {0.3, 0.2}});
  cases.push_back({.name = "HoleWithTwoLobes",
                   .mesh = holed({rectangle(3.0, 3.0, 3.33, 3.33), rectangle(3.3, 3.1, 4.0, 3.22),
                                  rectangle(3.8, 2.8, 4.45, 3.45)}),
                   .cracks = {0.325}});
  Mesh ramp;
  Floor(0.0, 0.0, long_side, short_side).without(strip(4.0, 3.0, 0.5, 0.0)).add_to(ramp, [](double x, double) {
    return x * std::tan(20.0 * std::numbers::pi / 180.0);
  });
  enclose(ramp, -3.0, 8.0);
  cases.push_back({.name = "SplitAcrossARamp", .mesh = std::move(ramp), .cracks = {0.25}});
  // The undersides rise to the rims: two floors share an edge, but neither continues the other.
  Mesh wedges;
  for (const auto& [from, to] : {std::pair{0.0, 3.7}, {long_side, 4.3}}) {
    scenes::add_floor(wedges, from, 0.0, to, short_side, 0.0);
    const double inner = to + (from < to ? -0.5 : 0.5);
    scenes::add_quad(wedges, {inner, 0.0, -0.3}, {to, 0.0, 0.0}, {to, short_side, 0.0}, {inner, short_side, -0.3});
  }
  enclose(wedges);
  cases.push_back({.name = "SplitBetweenWedges", .mesh = std::move(wedges), .cracks = {0.3}});
  // One above the other, each over a bottom that no body reaches.
  Mesh storeys = holed({strip(4.03, 3.0, 0.5, 0.0)}, 8.0);
  Floor(0.0, 0.0, long_side, short_side).without(strip(4.03, 3.0, 0.4, 0.0)).add_to(storeys, 3.0);
  enclose(storeys, -8.0, 6.0);
  cases.push_back({.name = "SplitsInTwoStoreys", .mesh = std::move(storeys), .cracks = {0.25, 0.2}});
  // A gap along a wall swallows bodies of half its width, like a gap between two floors.
  cases.push_back({.name = "GapAlongAWall", .mesh = holed({rectangle(0.0, 0.0, long_side, 0.5)}), .cracks = {0.25}});
  // A wall rises from the bottom through a hole, nearer to one side.
  Mesh parted = holed({rectangle(3.0, 0.0, 4.0, short_side)});
  scenes::add_wall(parted, 3.4, 0.0, 3.4, short_side, -2.0, 2.0);
  cases.push_back({.name = "WallInAHole", .mesh = std::move(parted), .cracks = {0.3, 0.2}});
  // A corridor 0.7 m wide: no body as wide as the split fits there, but a foot must carry those that do fit.
  Mesh narrow = holed({strip(4.0, 3.0, 1.2, 0.0)});
  for (const double y : {2.7, 3.4}) scenes::add_wall(narrow, 0.0, y, long_side, y, -2.0, 2.0);
  cases.push_back({.name = "SplitInANarrowCorridor",
                   .mesh = std::move(narrow),
                   .cracks = {0.6},
                   .is_reached = [](const Vec3& foot) { return foot.z > -0.35 && foot.y > 2.7 && foot.y < 3.4; }});
  // Rubble too steep to stand on fills the wide part of a hole to 0.1 m below the floor: it does not reach the rim.
  Mesh rubble = holed({rectangle(3.0, 0.0, 5.0, short_side)});
  for (int i = 0; i < 15; ++i) {
    const double x = 3.5 + 0.1 * i;
    scenes::add_quad(rubble, {x, 0.0, -0.2}, {x + 0.05, 0.0, -0.1}, {x + 0.05, short_side, -0.1},
                     {x, short_side, -0.2});
    scenes::add_quad(rubble, {x + 0.05, 0.0, -0.1}, {x + 0.1, 0.0, -0.2}, {x + 0.1, short_side, -0.2},
                     {x + 0.05, short_side, -0.1});
  }
  cases.push_back({.name = "SplitBesideSteepRubble", .mesh = std::move(rubble), .cracks = {0.46}, .tolerance = 0.01});
}

// ------------------------------------------------------------------------------------------------ what is none

/// Ten stairs up from x = 1 and a landing, from wall to wall. Without risers they are boards.
inline Mesh stairs(double rise, double tread, bool risers) {
  Mesh mesh;
  scenes::add_floor(mesh, 0.0, 0.0, long_side, short_side, 0.0);
  for (int i = 0; i < 10; ++i) {
    const double x = 1.0 + tread * i, z = rise * i, end = i == 9 ? long_side : x + tread;
    if (risers) {
      scenes::add_wall(mesh, x, 0.0, x, short_side, z, z + rise);
      scenes::add_floor(mesh, x, 0.0, end, short_side, z + rise);
    } else {
      scenes::add_box(mesh, {x, 0.0, z + rise - 0.03}, {end - (i == 9 ? 0.0 : 0.02), short_side, z + rise});
    }
  }
  enclose(mesh, -1.0, 6.0);
  return mesh;
}

/// A channel across the room.
inline Mesh channel(double width, double depth) {
  Mesh mesh = holed({rectangle(4.0, 0.0, 4.0 + width, short_side)}, depth);
  for (const double x : {4.0, 4.0 + width}) scenes::add_wall(mesh, x, 0.0, x, short_side, -depth, 0.0);
  return mesh;
}

inline void add_floors(std::vector<FloorCase>& cases) {
  cases.push_back({.name = "Stairs", .mesh = stairs(0.17, 0.28, true), .is_reached = anywhere});
  cases.push_back({.name = "SteepStairs", .mesh = stairs(0.29, 0.25, true), .is_reached = anywhere});
  cases.push_back({.name = "OpenRisers", .mesh = stairs(0.18, 0.27, false), .is_reached = anywhere});
  Mesh grate = holed({rectangle(3.0, 2.0, 4.0, 3.0)});
  for (double x = 3.01; x < 4.0; x += 0.05) scenes::add_box(grate, {x, 1.99, -0.03}, {x + 0.02, 3.01, 0.0});
  cases.push_back({.name = "Grate", .mesh = std::move(grate)});
  cases.push_back({.name = "Gutter", .mesh = channel(0.3, 0.2)});
  cases.push_back({.name = "DrainOf25Centimetres", .mesh = channel(0.5, 0.25)});
  cases.push_back({.name = "ChannelOfJustAStep", .mesh = channel(0.5, 0.3)});
  Mesh kerb;
  scenes::add_floor(kerb, 0.0, 0.0, 4.0, short_side, 0.0);
  scenes::add_wall(kerb, 4.0, 0.0, 4.0, short_side, 0.0, 0.29);
  scenes::add_floor(kerb, 4.0, 0.0, long_side, short_side, 0.29);
  enclose(kerb);
  cases.push_back({.name = "Kerb", .mesh = std::move(kerb), .is_reached = anywhere});
  for (const auto& [name, degrees] :
       {std::pair{"ValleyOf20Degrees", 20.0}, {"ValleyOf33Degrees", 33.0}, {"ValleyOf45Degrees", 45.0}}) {
    Mesh valley;
    const double slope = std::tan(degrees * std::numbers::pi / 180.0);
    Floor(0.0, 0.0, long_side, short_side, 1.0).add_to(valley, [&](double x, double) {
      return slope * std::max(std::abs(x - 4.0) - 2.0, -2.0);
    });
    enclose(valley, -3.0, 5.0);
    cases.push_back({.name = name, .mesh = std::move(valley), .is_reached = anywhere});
  }
  // Slabs that meet without a common corner; one lies over two others, one a little higher.
  Mesh slabs;
  scenes::add_box(slabs, {0.0, 0.0, -0.2}, {3.1, short_side, 0.0});
  scenes::add_box(slabs, {3.1, 0.0, -0.2}, {long_side, 2.7, 0.0});
  scenes::add_box(slabs, {3.1, 2.7, -0.2}, {long_side, short_side, 0.0});
  scenes::add_box(slabs, {2.0, 1.0, -0.15}, {5.0, 4.0, 0.0});
  scenes::add_box(slabs, {5.0, 4.3, -0.15}, {7.0, 5.0, 0.02});
  enclose(slabs);
  cases.push_back({.name = "SlabsThatMeetWithoutSharedCorners", .mesh = std::move(slabs)});
  // The floor continues for 3 cm behind a wall; a hole and another floor follow.
  Mesh behind;
  scenes::add_floor(behind, 0.0, 0.0, 4.03, short_side, 0.0);
  scenes::add_wall(behind, 4.0, 0.0, 4.0, short_side, 0.0, 3.0);
  scenes::add_floor(behind, 4.5, 0.0, long_side, short_side, 0.0);
  scenes::add_wall(behind, 4.53, 0.0, 4.53, short_side, 0.0, 3.0);
  enclose(behind);
  cases.push_back({.name = "HoleBehindAWall", .mesh = std::move(behind)});
  // Above the room, out of reach, two slabs half a metre apart.
  Mesh ceiling = holed({});
  scenes::add_box(ceiling, {0.0, 0.0, 2.4}, {4.0, short_side, 2.6});
  scenes::add_box(ceiling, {4.5, 0.0, 2.4}, {long_side, short_side, 2.6});
  cases.push_back({.name = "GapInACeiling", .mesh = std::move(ceiling), .is_reached = [](const Vec3& foot) {
                     return foot.z > -0.35 && foot.z < 1.0;
                   }});
}

// ------------------------------------------------------------------------------------------------ drops and steps

inline void add_drops(std::vector<FloorCase>& cases) {
  Mesh edge;
  Floor(0.0, 0.0, 4.0, short_side).add_to(edge, 1.2);
  scenes::add_wall(edge, 4.0, 0.0, 4.0, short_side, 0.0, 1.2);
  Floor(4.0, 0.0, long_side, short_side).add_to(edge, 0.0);
  enclose(edge, 0.0, 4.0);
  cases.push_back({.name = "LoadingEdge", .mesh = std::move(edge), .has_drop = true, .is_reached = anywhere});
  cases.push_back({.name = "ShaftOf2Metres", .mesh = holed({rectangle(3.0, 2.0, 5.0, 4.0)}, 20.0), .has_drop = true});
  cases.push_back({.name = "RoundShaft", .mesh = holed({round(4.0, 3.0, 1.2, 24)}, 20.0), .has_drop = true});
  Mesh cliff;
  Floor(0.0, 0.0, 4.0, short_side).add_to(cliff, 0.0);
  scenes::add_wall(cliff, 4.0, 0.0, 4.0, short_side, -30.0, 0.0);
  scenes::add_floor(cliff, 4.0, -9.0, 30.0, 15.0, -30.0);
  cases.push_back({.name = "Cliff", .mesh = std::move(cliff), .has_drop = true});
  Mesh end;
  Floor(0.0, 0.0, 4.0, short_side).add_to(end, 0.0);
  cases.push_back({.name = "FloorThatEnds", .mesh = std::move(end), .has_drop = true});
  // Posts of a porch stand beyond the rim, with feet at its height. A body of 0.5 m just fits between them, but also
  // falls off beside them.
  Mesh porch;
  Floor(0.0, 0.0, 4.0, short_side).add_to(porch, 0.0);
  for (const double y : {1.0, 4.7}) scenes::add_box(porch, {5.03, y, 0.0}, {5.28, y + 0.3, 3.0});
  cases.push_back({.name = "PostsBeyondTheEndOfAFloor",
                   .mesh = std::move(porch),
                   .has_drop = true,
                   .is_reached = [](const Vec3& foot) { return foot.x < 5.05 && foot.z < 0.35; }});
  cases.push_back({.name = "SlotThatLeadsToAPit",
                   .mesh = holed({rectangle(2.0, 2.75, 4.6, 3.25), rectangle(4.5, 1.5, 7.5, 4.5)}, 3.0),
                   .cracks = {0.25},
                   .has_drop = true});
  // The wall's lower edge is free, and floor ends on both sides: at a pit there, at a gap here that swallows bodies.
  Mesh beside;
  scenes::add_floor(beside, 0.0, 0.0, 4.0, short_side, 0.0);
  scenes::add_wall(beside, 4.4, 0.0, 4.4, short_side, 0.0, 3.0);
  scenes::add_floor(beside, 6.9, 0.0, long_side, short_side, 0.0);
  enclose(beside);
  cases.push_back(
      {.name = "GapAlongAWallWithAPitBehind", .mesh = std::move(beside), .cracks = {0.2}, .has_drop = true});
  // The same with a window 0.3 m wide, which makes the gap and the pit one void. A body leans into it: it touches both
  // jambs and the rim, (0.4 - r)^2 + 0.15^2 = r^2.
  Mesh window;
  scenes::add_floor(window, 0.0, 0.0, 4.0, short_side, 0.0);
  scenes::add_wall(window, 4.4, 0.0, 4.4, 0.2, 0.0, 3.0);
  scenes::add_wall(window, 4.4, 0.5, 4.4, short_side, 0.0, 3.0);
  scenes::add_floor(window, 6.9, 0.0, long_side, short_side, 0.0);
  enclose(window);
  cases.push_back({.name = "GapAlongAWallWithAWindowToAPit",
                   .mesh = std::move(window),
                   .cracks = {0.1825 / 0.8},
                   .has_drop = true});
  // Two low sofas on the floor of the room, 0.4 m apart.
  Mesh sofas = holed({});
  scenes::add_box(sofas, {2.0, 0.0, 0.0}, {3.8, 1.0, 0.5});
  scenes::add_box(sofas, {4.2, 0.0, 0.0}, {6.0, 1.0, 0.5});
  cases.push_back({.name = "GapBetweenSofas",
                   .mesh = std::move(sofas),
                   .steps_down = {0.2},
                   .has_drop = true,
                   .is_reached = anywhere});
  cases.push_back({.name = "HoleToAFloorBelowThatOneComesTo",
                   .mesh = holed({rectangle(3.0, 3.0, 3.8, 3.5)}, 2.6),
                   .steps_down = {0.25},
                   .is_reached = anywhere});
}

// ------------------------------------------------------------------------------------------ cracks that lead to drops

/// A floor at z = 0 with these corners, as a fan.
inline void add_fan(Mesh& mesh, const std::vector<Vec3>& corners) {
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    scenes::add_triangle(mesh, corners[0], corners[i], corners[i + 1]);
}

/// Walls from each place to the next.
inline void add_walls(Mesh& mesh, const std::vector<std::pair<double, double>>& places) {
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    scenes::add_wall(mesh, places[i].first, places[i].second, places[i + 1].first, places[i + 1].second, -3.0, 3.0);
}

/// A split between two floors, 12 m long and `from` to `to` wide, that ends in a pit 3 m long.
inline Mesh split_to_pit(double from, double to) {
  constexpr double length = 12.0;
  Mesh mesh;
  add_fan(mesh, {{0.0, 0.0, 0.0}, {4.0 - 0.5 * from, 0.0, 0.0}, {4.0 - 0.5 * to, length, 0.0}, {0.0, length, 0.0}});
  add_fan(mesh, {{4.0 + 0.5 * from, 0.0, 0.0}, {8.0, 0.0, 0.0}, {8.0, length, 0.0}, {4.0 + 0.5 * to, length, 0.0}});
  add_walls(mesh, {{0.0, 0.0}, {8.0, 0.0}, {8.0, length + 3.0}, {0.0, length + 3.0}, {0.0, 0.0}});
  return mesh;
}

/// A floor x < 3.55, and beside it a gap `length` long, 0.6 to 0.9 m wide to a wall, with an open drop beyond. `nose`
/// narrower in the last 0.2 m.
inline Mesh gap_to_drop(double length, double nose) {
  Mesh mesh;
  add_fan(mesh, {{0.0, 0.0, 0.0}, {3.55, 0.0, 0.0}, {3.55, length + 0.8, 0.0}, {0.0, length + 0.8, 0.0}});
  add_walls(mesh, {{4.15, 0.0},
                   {4.45, length},
                   {4.45, length + 0.6},
                   {4.45 - nose, length + 0.6},
                   {4.45 - nose, length + 0.8},
                   {8.0, length + 0.8}});
  add_walls(mesh, {{0.0, 0.0}, {8.0, 0.0}, {8.0, length + 4.0}, {0.0, length + 4.0}, {0.0, 0.0}});
  return mesh;
}

inline void add_cracks_to_drops(std::vector<FloorCase>& cases) {
  // As straight as it is long: no climb leaves the part that belongs to the drop, and none reaches that part.
  Mesh gap;
  add_fan(gap, {{0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {4.0, 9.3, 0.0}, {0.0, 9.3, 0.0}});
  add_walls(gap, {{4.9, 0.0}, {4.9, 9.0}, {9.0, 9.0}});
  add_walls(gap, {{0.0, 0.0}, {9.0, 0.0}, {9.0, 13.0}, {0.0, 13.0}, {0.0, 0.0}});
  cases.push_back({.name = "LongGapAlongAWallToADrop", .mesh = std::move(gap), .cracks = {0.45}, .has_drop = true});
  // Two floors. One ends at a pier; beyond it the gap is 0.9 m wide, then 0.85 m, then open.
  Mesh pier;
  add_fan(pier, {{0.0, 0.0, 0.0}, {3.55, 0.0, 0.0}, {3.55, 3.6, 0.0}, {0.0, 3.6, 0.0}});
  add_fan(pier, {{0.0, 3.6, 0.0}, {3.575, 3.6, 0.0}, {3.575, 3.8, 0.0}, {0.0, 3.8, 0.0}});
  add_fan(pier, {{4.15, 0.0, 0.0}, {8.0, 0.0, 0.0}, {8.0, 2.6, 0.0}, {4.39375, 2.6, 0.0}});
  add_walls(pier, {{8.0, 2.6}, {4.39375, 2.6}, {4.45, 3.2}, {4.45, 3.6}, {4.425, 3.6}, {4.425, 3.8}, {8.0, 3.8}});
  enclose(pier);
  cases.push_back(
      {.name = "SplitThatEndsAtAPierBesideADrop", .mesh = std::move(pier), .cracks = {0.45}, .has_drop = true});
  cases.push_back({.name = "GapAlongAWallThatWidensUpToANarrowOutlet",
                   .mesh = gap_to_drop(4.0, 0.025),
                   .cracks = {0.45},
                   .has_drop = true});
  // Places nearer than r + 1 m to the first open disc of a body of r belong to the drop. That disc's centre is 1 m from
  // the floor's corner, and r from the wall's, 0.9 m beside it. The border of the drop is found to some centimetres.
  const auto widest_before_drop = [](double length) {
    const double slope = 0.3 / length, cosine = 1.0 / std::hypot(1.0, slope), mouth = length + 0.8;
    double r = 0.45;
    for (int i = 0; i < 20; ++i) {
      const double x = 0.5 * (1.0 - r * r + 0.9 * 0.9) / 0.9;  // of the centre, from the floor's edge
      const double y = mouth + std::sqrt(1.0 - x * x) - std::sqrt((1.0 + r) * (1.0 + r) - (x - r) * (x - r));
      r = (0.6 + slope * y) * cosine / (1.0 + cosine);  // touches the floor's edge and the wall
    }
    return r;
  };
  for (const auto& [name, length] :
       {std::pair{"GapAlongAWallThatWidensTowardsADrop", 4.0}, {"ShortGapAlongAWallThatWidensTowardsADrop", 2.0}})
    cases.push_back({.name = name,
                     .mesh = gap_to_drop(length, 0.0),
                     .cracks = {widest_before_drop(length)},
                     .has_drop = true,
                     .tolerance = 0.003});
  // The floor of a corridor ends 0.8 m before a bend, beyond which it opens into a pit. The widest bodies touch both
  // outer walls and the inner corner, 2 (0.4 - r)^2 = r^2. They are farther from floor than the walls let a body be
  // wide.
  Mesh bend;
  add_fan(bend, {{0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {4.0, 0.4, 0.0}, {0.0, 0.4, 0.0}});
  add_walls(bend, {{0.0, 0.4}, {4.4, 0.4}, {4.4, 1.3}, {1.4, 1.3}, {1.4, 6.3}, {7.8, 6.3}, {7.8, 1.3}});
  add_walls(bend, {{7.8, 1.3}, {4.8, 1.3}, {4.8, 0.0}, {0.0, 0.0}, {0.0, 0.4}});
  cases.push_back({.name = "CorridorThatBendsIntoAPit",
                   .mesh = std::move(bend),
                   .cracks = {0.8 - 0.4 * std::numbers::sqrt2 / (1.0 + std::numbers::sqrt2)},
                   .tolerance = 0.01});
  // Measured up to where an open disc that touches both corners of the mouth takes over, 1 - sqrt(1 - w^2 / 4) inside.
  const auto widest = [](double from, double to) {
    const double slant = 0.5 * (to - from) / 12.0, cosine = 1.0 / std::hypot(1.0, slant);
    if (slant < 0.0) return 0.5 * from * cosine / (1.0 - slant * cosine);  // touches the wall
    return (0.5 * to - slant * (1.0 - std::sqrt(1.0 - 0.25 * to * to))) * cosine;
  };
  for (const auto& [name, from, to] : {std::tuple{"SplitToAPit2MillimetresWiderThere", 0.6, 0.602},
                                       {"SplitToAPit2MillimetresNarrowerThere", 0.602, 0.6},
                                       {"SplitToAPit30CentimetresWiderThere", 0.6, 0.9},
                                       {"SplitToAPit30CentimetresNarrowerThere", 0.9, 0.6},
                                       {"SplitToAPitAsWideAllAlong", 0.6, 0.6}})
    cases.push_back({.name = name,
                     .mesh = split_to_pit(from, to),
                     .cracks = {widest(from, to)},
                     .has_drop = true,
                     .tolerance = 5e-4});
}

inline std::vector<FloorCase> floor_cases() {
  std::vector<FloorCase> cases;
  add_holes(cases);
  add_floors(cases);
  add_drops(cases);
  add_cracks_to_drops(cases);
  return cases;
}

}  // namespace floors
