#pragma once
/// \file
/// The nested global grids that tiles quantize their vertices on.

#include <array>
#include <cstdint>

#include "index/block.h"
#include "roam/math.h"

namespace roam::index {

/// Number of steps that a 16-bit coordinate can count. One less than 65536, so that rounding up always fits.
inline constexpr std::int64_t grid_steps = 65535;
/// The low bits of a fine tile divide its step into this many.
inline constexpr std::int64_t fine_steps = 65536;

/// Metres. Tiles of ordinary triangles are at most grid_steps of this step wide (64 m). So a vertex moves by at most
/// sqrt(3)/2 steps: 0.85 mm.
inline constexpr double ordinary_step = 1.0 / 1024.0;
/// No grid is finer than 2^-19 m. Then the start of any query that can reach a tile fits into 31 bits of steps: 3 *
/// World::reach_limit (radius, half height, reach) + the longest piece of a motion < 4095 m.
inline constexpr int finest_exponent = -19;

/// A power-of-two grid: coordinate v lies at origin + step * v, and origin is a multiple of step.
struct Grid {
  Vec3 origin{0.0};
  double step = 1.0;

  /// The finest grid on which the box is at most grid_steps wide.
  static Grid fitting(const Box& box);

  /// The grid of a tree over tiles, 2^29 steps across. So differences of coordinates fit 31 bits even for queries that
  /// start outside but within reach.
  static Grid over(const Box& box);
  /// The smallest box of whole steps around a box.
  [[nodiscard]] StepBox steps(const Box& box) const;

  /// The nearest fine coordinate, in units of step / fine_steps.
  [[nodiscard]] std::array<std::int64_t, 3> fine(const Vec3& p) const;
  /// The whole coordinate nearest to a fine one; the remainder lies in [-32768, 32767].
  [[nodiscard]] static std::int64_t whole(std::int64_t fine) { return (fine + fine_steps / 2) >> 16; }
};

}  // namespace roam::index
