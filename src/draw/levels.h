#pragma once
/// \file
/// The heights at which a plan is cut, and the places of each cut.
///
/// A floor is not flat, so a plan at body height needs more than one cut. The heights of the body's centre along the
/// way are grouped into levels. The first level is the window of half a body's height with the longest part of the way;
/// the next one has the longest part of the rest, and so on. Each level is cut at the median height of its part of the
/// way.
///
/// So a walk on one floor has one cut, exactly at the height of the body's centre, crouching or not. No cut is farther
/// than half a body's height from the centre of the body that walks there.
///
/// Each place of the plan shows the level of the nearest part of the way, seen from above. Where the way crosses itself
/// a storey higher, the upper level is shown, and the lower one beneath it, paler.

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "draw/geometry.h"
#include "draw/stations.h"

namespace roam::draw {

struct Levels {
  std::vector<double> cuts;          ///< heights in the scene, metres, ascending
  std::vector<std::uint16_t> where;  ///< for each station its level: an index into cuts
};

[[nodiscard]] Levels find_levels(std::span<const Station> stations, double body_height);

/// For people: "cut at the height of the body's centre, z = 1.20 m".
[[nodiscard]] std::string cut_text(const Levels& levels);

/// The levels shown in each cell of a grid over a rectangle of the plan.
class LevelMap {
 public:
  static constexpr std::uint16_t none = 0xffff;
  struct Cell {
    std::uint16_t upper = none;  ///< shown dark
    std::uint16_t lower = none;  ///< shown pale beneath, if any
  };

  /// One level everywhere.
  LevelMap(const Rect& area, std::uint16_t level) : area_(area), cells_{{level, none}} {}
  /// `storey`: the least difference in height, metres, of two levels shown one over the other.
  LevelMap(const Rect& area, const Levels& levels, std::span<const Station> stations, const Turn& turn, double storey);

  [[nodiscard]] const Rect& area() const { return area_; }
  [[nodiscard]] const Cell& at(const Point& p) const { return cells_[index(p)]; }

  /// Passes the pieces of a segment within the area to `take`, each with its cell.
  template <class Take>
  void pieces(Segment s, const Take& take) const;

 private:
  [[nodiscard]] std::size_t index(const Point& p) const;

  Rect area_;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<Cell> cells_;
};

template <class Take>
void LevelMap::pieces(Segment s, const Take& take) const {
  if (!clip(s, area_)) return;
  if (cells_.size() == 1) {
    take(s, cells_[0]);
    return;
  }
  const Point d = s.b - s.a;
  const std::array<double, 2> cell{area_.width() / columns_, area_.height() / rows_};
  // Steps to the next border of the grid.
  double t = 0.0;
  while (t < 1.0) {
    double next = 1.0;
    for (int k = 0; k < 2; ++k) {
      if (d[k] == 0.0) continue;
      const double at = (s.a[k] + t * d[k] - area_.lower[k]) / cell[k];
      // Skips a border at t itself, up to rounding.
      constexpr double rounding = 1e-9;
      const double line = d[k] > 0.0 ? std::floor(at + rounding) + 1.0 : std::ceil(at - rounding) - 1.0;
      next = std::min(next, (area_.lower[k] + line * cell[k] - s.a[k]) / d[k]);
    }
    if (!(next > t)) next = 1.0;
    const Segment piece{s.a + t * d, next < 1.0 ? s.a + next * d : s.b};
    take(piece, at(0.5 * (piece.a + piece.b)));
    t = next;
  }
}

}  // namespace roam::draw
