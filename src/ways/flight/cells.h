#pragma once
/// \file
/// The air of a scene in cubes: large in the open, split where something is near and where it is looked at closely.

#include <cstdint>
#include <functional>
#include <vector>

#include "ways/lattice/lattice.h"

namespace roam::ways {

using CellId = std::uint32_t;
inline constexpr CellId no_cell = ~CellId(0);

/// An octree over the scene's box and what flies around it. A cube is split by asking how far its eight parts' middles
/// are from everything; what has been asked is kept. Not safe to use from several threads.
class FlyCells {
 public:
  /// Of ways from one place to another; `survey` must outlive it. Sides are `spacing` times powers of two.
  FlyCells(const Survey& survey, const Measure& measure, double spacing, const Vec3& from, const Vec3& to);

  [[nodiscard]] std::size_t size() const { return cells_.size(); }
  /// The cube that a place lies in, of those that are not split; no_cell where nobody flies.
  [[nodiscard]] CellId at(const Vec3& place) const;
  [[nodiscard]] Vec3 centre(CellId id) const;
  [[nodiscard]] double side(CellId id) const { return unit_ * size_of(id); }
  [[nodiscard]] double half_diagonal(CellId id) const;
  [[nodiscard]] bool is_split(CellId id) const { return cells_[id].parts != no_cell; }
  /// Too small to be split.
  [[nodiscard]] bool is_smallest(CellId id) const { return cells_[id].depth == deepest; }

  /// m, certified: how far the middle of a cube is from everything.
  [[nodiscard]] double free(CellId id) const { return cells_[id].free; }
  /// m, certified: no place of the cube is farther from everything.
  [[nodiscard]] double most(CellId id) const { return cells_[id].most; }
  /// All of a cube is at least that far from everything.
  [[nodiscard]] bool is_open(CellId id, double radius) const { return free(id) - half_diagonal(id) >= radius; }

  void split(CellId id);
  /// Makes `most` of a cube less where something is near on two sides.
  void tighten(CellId id);

  /// Calls `found` with each cube beside a cube that shares a part of a face with it and that `is_fine` does not want
  /// split: those that it does are split first.
  void beside(CellId id, const std::function<bool(CellId)>& is_fine, const std::function<void(CellId)>& found);
  /// The middle of what two cubes side by side share.
  [[nodiscard]] Vec3 portal(CellId a, CellId b) const;

 private:
  struct Cell {
    std::int32_t x = 0, y = 0, z = 0;  ///< the lower corner, in units
    CellId parts = no_cell;            ///< the first of eight, by x, then y, then z
    float free = 0.0F, most = 0.0F;
    std::uint8_t depth = 0;
    bool tight = false;
  };

  /// Of a cube that is split, the part that a place (in units) lies in.
  [[nodiscard]] CellId part_at(CellId id, std::int32_t x, std::int32_t y, std::int32_t z) const;
  [[nodiscard]] std::int32_t size_of(CellId id) const { return std::int32_t{1} << (deepest - cells_[id].depth); }
  [[nodiscard]] Cell measured(std::int32_t x, std::int32_t y, std::int32_t z, int depth) const;
  [[nodiscard]] double farthest(const Cell& cell, const Vec3& from) const;
  [[nodiscard]] Vec3 middle(const Cell& cell) const;
  void on_face(CellId id, int axis, bool upper, const Cell& of, const std::function<bool(CellId)>& is_fine,
               const std::function<void(CellId)>& found);

  static constexpr int deepest = 28;  ///< times that the whole may be halved

  const Survey& survey_;
  const Measure measure_;
  double unit_ = 1.0;  ///< m
  Vec3 lower_{0.0};
  Box within_;
  std::vector<Cell> cells_;
};

}  // namespace roam::ways
