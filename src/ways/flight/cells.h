#pragma once
/// \file
/// The air of a scene in cubes: large in the open, small near surfaces and where a search needs detail.

#include <cstdint>
#include <functional>
#include <vector>

#include "ways/lattice/lattice.h"

namespace roam::ways {

using CellId = std::uint32_t;
inline constexpr CellId no_cell = ~CellId(0);

/// An octree over the scene's box and the air around it. Splitting a cube queries the clearance at the middles of its
/// eight parts and stores it. Not safe to use from several threads.
class FlyCells {
 public:
  /// For ways between two places; `survey` must outlive it. Sides are `spacing` times powers of two.
  FlyCells(const Survey& survey, const Measure& measure, double spacing, const Vec3& from, const Vec3& to);

  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  /// The leaf cube that contains a place; no_cell outside the searched air.
  [[nodiscard]] CellId at(const Vec3& place) const;
  [[nodiscard]] Vec3 centre(CellId id) const;
  [[nodiscard]] double side(CellId id) const { return unit_ * size_of(id); }
  [[nodiscard]] double half_diagonal(CellId id) const;
  [[nodiscard]] bool is_split(CellId id) const { return cells_[id].parts != no_cell; }
  /// Too small to be split.
  [[nodiscard]] bool is_smallest(CellId id) const { return cells_[id].depth == deepest; }

  /// m, certified: the clearance at the middle of a cube.
  [[nodiscard]] double free(CellId id) const { return cells_[id].free; }
  /// m, certified: no place of the cube has a larger clearance.
  [[nodiscard]] double most(CellId id) const { return cells_[id].most; }
  /// All of a cube has at least this clearance.
  [[nodiscard]] bool is_open(CellId id, double radius) const { return free(id) - half_diagonal(id) >= radius; }

  void split(CellId id);
  /// Lowers `most` of a cube that has surfaces on two sides.
  void tighten(CellId id);

  /// Calls `found` with each cube that shares a part of a face with the given one. Splits those for which `is_fine` is
  /// false first.
  void beside(CellId id, const std::function<bool(CellId)>& is_fine, const std::function<void(CellId)>& found);
  /// The middle of the face part that two neighbouring cubes share.
  [[nodiscard]] Vec3 portal(CellId a, CellId b) const;

 private:
  struct Cell {
    std::int32_t x = 0, y = 0, z = 0;  ///< the lower corner, in units
    CellId parts = no_cell;            ///< the first of eight, by x, then y, then z
    float free = 0.0F, most = 0.0F;
    std::uint8_t depth = 0;
    bool tight = false;
  };

  /// The part of a split cube that contains a place (in units).
  [[nodiscard]] CellId part_at(CellId id, std::int32_t x, std::int32_t y, std::int32_t z) const;
  [[nodiscard]] std::int32_t size_of(CellId id) const { return std::int32_t{1} << (deepest - cells_[id].depth); }
  [[nodiscard]] Cell measured(std::int32_t x, std::int32_t y, std::int32_t z, int depth) const;
  [[nodiscard]] double farthest(const Cell& cell, const Vec3& from) const;
  [[nodiscard]] Vec3 middle(const Cell& cell) const;
  void on_face(CellId id, int axis, bool upper, const Cell& of, const std::function<bool(CellId)>& is_fine,
               const std::function<void(CellId)>& found);

  static constexpr int deepest = 28;  ///< halvings of the whole box at most

  const Survey& survey_;
  const Measure measure_;
  double unit_ = 1.0;  ///< m
  Vec3 lower_{0.0};
  Box within_;
  std::vector<Cell> cells_;
};

}  // namespace roam::ways
