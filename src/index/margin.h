#pragma once
/// \file
/// Margins of the single-precision filter: all constants of its proof. docs/algorithm.md, "Many triangles", counts the
/// roundings.

namespace roam::index {

/// Unit roundoff of IEEE float, round to nearest.
inline constexpr float float_unit = 0x1p-24F;

/// m^4. A triangle with a smaller |edge x edge|^2 is a speck narrower than 0.1 mm and counts as its edges. Times the
/// square of an edge the value is still far above underflow.
inline constexpr float smallest_face = 1e-16F;

/// Roundings charged to each metre of a node's frame (its extent, the motion, the radius, the half height) in tests of
/// its child boxes. 28 are counted.
inline constexpr float node_roundings = 40.0F;

/// Roundings charged to each metre of a triangle's farthest coordinate, or of the motion made, when a leaf bounds its
/// distance. 31.4 are counted: for a capsule, with the triangle's own plane.
inline constexpr float leaf_roundings = 32.0F;

/// Roundings charged to each metre of the farthest coordinate of a tile, when a ray drops a triangle. 26 are counted.
inline constexpr float ray_roundings = 64.0F;

/// Roundings charged to each metre of the whole motion, for the speed of approach to a leaf or a node. 9 are counted.
inline constexpr float speed_roundings = 16.0F;

/// Relative roundings of the radius in a product with a length. 5 are counted.
inline constexpr float radius_roundings = 8.0F;

/// Relative roundings of a quotient of two lengths, such as a time of entry. 4 are counted.
inline constexpr float time_roundings = 8.0F;

/// Relative roundings by which an arrival must be earlier before it drops a triangle that would arrive later. 13 are
/// counted: in the product that says so, and in the time to which the triangle would have advanced.
inline constexpr float later_roundings = 32.0F;

/// In grid steps: precision of the stored fraction between the start of a query and its nearest grid point.
inline constexpr float fraction_rounding = 0x1p-25F;

/// Metres. Shorter edges count as points, and shorter directions as zero; their fourth powers are far above underflow.
inline constexpr float shortest_way = 1e-8F;

/// A triangle counts as its edges in single precision when it is narrower than this fraction of its farthest
/// coordinate: 2^10 roundings, below which the direction of its face is noise.
inline constexpr float narrow_limit = 0x1p10F * float_unit;

/// Metres. Larger bodies leave their hits to double precision. The foot on a face tilted by roundings misses the
/// closest point by a part of the distance.
inline constexpr double wide_body = 4.0;

/// Metres. Thinner spheres are swept as rays.
inline constexpr double thin_body = 1e-5;

/// Metres. A body this close to touching, apart from its error bound, has arrived. Only speed depends on it.
inline constexpr float arrival_tolerance = 2e-5F;

/// Metres. In exact arithmetic a hit is at most this far from the radius. The rest up to the 2 mm that World promises
/// covers the rounding of the limit itself.
inline constexpr float hit_limit_distance = 1.99e-3F;
/// The same for vertices with low bits that are known at least twice as well: of the 1e-5 m of a lossless world.
inline constexpr float fine_hit_distance = 9e-6F;

/// Metres. Longer motions are swept in pieces, so that the frame of a piece stays small.
inline constexpr double longest_piece = 64.0;

/// Up to this many children of a node over tiles, met by a motion of up to short_motion, are visited in any order:
/// sorting would take as long as the visits. See few_tiles.
inline constexpr int few_tile_count = 3;

/// Metres. The box around a longer motion is too wide to exclude much.
inline constexpr float short_motion = 4.0F;

/// Steps. Starts within this, less coordinates of up to 2^16 in a tile, fit into 32 bits.
inline constexpr double farthest_steps = 0x1p31 - 0x1p17;

/// Rounds of advance in single precision; bodies that have not arrived by then are decided in double precision.
inline constexpr int round_count = 4;

/// Greatest number of alternating projections between triangle and axis for a capsule.
inline constexpr int projection_count = 3;

/// Rounds of the single-precision search for the point of the motion nearest to a triangle.
inline constexpr int near_rounds = 3;

/// Metres. A bound this close below a distance that was found is not improved.
inline constexpr float settled_gap = 1e-4F;

/// Per metre. Stands for 1 / 0: larger than any length over any motion that matters, and finite, so that 0 / 0 does not
/// arise.
inline constexpr float huge_inverse = 1e18F;

}  // namespace roam::index
