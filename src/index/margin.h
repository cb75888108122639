#pragma once
/// \file
/// The margins of the single-precision filter: every constant that its proof uses, in one place.
/// docs/algorithm.md, "Many triangles", counts the roundings.

namespace roam::index {

/// Unit roundoff of IEEE float, round to nearest.
inline constexpr float float_unit = 0x1p-24F;

/// Square metres, squared: a smaller |edge x edge|^2 is that of a speck narrower than 0.1 mm, which counts as its
/// edges. Times the square of an edge it is still far above underflow.
inline constexpr float smallest_face = 1e-16F;

/// Roundings charged to each metre of a node's frame (its extent, the motion, the radius, the half height) when its
/// child boxes are tested. 28 are counted.
inline constexpr float node_roundings = 40.0F;

/// Roundings charged to each metre of a triangle's farthest coordinate or of the way made, when a leaf bounds its
/// distance. 31.4 are counted, of a capsule where its own plane bounds it.
inline constexpr float leaf_roundings = 32.0F;

/// The same, of the farthest that a coordinate of a tile can be, when a triangle is left out that a ray passes. 35 are
/// counted.
inline constexpr float ray_roundings = 64.0F;

/// The same for the speed of approach, of a leaf or of a node, per metre of the whole motion. 9 are counted.
inline constexpr float speed_roundings = 16.0F;

/// Relative roundings of the radius in a product with a length. 5 are counted.
inline constexpr float radius_roundings = 8.0F;

/// Relative roundings of a quotient of two lengths, such as a time of entry. 4 are counted.
inline constexpr float time_roundings = 8.0F;

/// Of a grid step: the fraction of a step between the start of a query and its nearest grid point is stored to this.
inline constexpr float fraction_rounding = 0x1p-25F;

/// Metres. Shorter edges count as points, shorter directions as none; squares of squares are far above underflow.
inline constexpr float shortest_way = 1e-8F;

/// A triangle counts as its edges in single precision when it is narrower than this fraction of its farthest
/// coordinate: 2^10 roundings, below which the direction of its face is noise.
inline constexpr float narrow_limit = 0x1p10F * float_unit;

/// Metres. The foot on a face that is tilted by roundings lies off the closest point by a part of the distance: larger
/// bodies leave their hits to double precision.
inline constexpr double wide_body = 4.0;

/// Metres. Thinner spheres are asked about as rays are.
inline constexpr double thin_body = 1e-5;

/// Metres. A body this close to touching, its error bound apart, has arrived: a rule of economy, not of truth.
inline constexpr float arrival_tolerance = 2e-5F;

/// Metres. In exact arithmetic a hit in a tile without low bits is at most so far from the radius; what remains to
/// the 2 mm that World promises pays for rounding the limit itself.
inline constexpr float hit_limit_distance = 1.99e-3F;

/// Metres. Longer motions are swept in pieces, so that the frame of a piece stays small.
inline constexpr double longest_piece = 64.0;

/// From so many on, the children of a node that a body may meet on a motion of up to short_motion are bounded by a
/// second plane. Rays do without.
inline constexpr int many_children = 4;

/// Of a node over tiles, so many children that a body may meet on such a motion are visited in any order: to ask which
/// comes first takes as long as to look at them. See few_tiles.
inline constexpr int few_tile_count = 3;

/// Metres. The box around a longer motion is too wide to tell much of what the motion meets.
inline constexpr float short_motion = 4.0F;

/// Steps. Differences of coordinates, of up to 2^16 in a tile, and starts within this fit 32 bits.
inline constexpr double farthest_steps = 0x1p31 - 0x1p17;

/// Rounds of advance in single precision; what has not arrived by then is decided in double precision.
inline constexpr int round_count = 4;

/// Alternating projections between triangle and axis for a capsule, at most.
inline constexpr int projection_count = 3;

/// Rounds in which the place of a body's way that is nearest to a triangle is looked for in single precision.
inline constexpr int near_rounds = 3;

/// Metres. A bound that is so little below a distance that was found is not made any better.
inline constexpr float settled_gap = 1e-4F;

/// 1 / 0 stands for this many per metre: larger than any length over any motion that can matter, and finite, so that
/// 0 / 0 does not arise.
inline constexpr float huge_inverse = 1e18F;

}  // namespace roam::index
