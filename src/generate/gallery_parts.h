#pragma once
/// \file
/// Parts of the dam gallery. docs/proofs.md, "The made gallery", has the plan.

#include <memory>
#include <string>
#include <vector>

#include "generate/block.h"
#include "generate/tube.h"
#include "roam/generate.h"

namespace roam::generate {

/// Fineness and furnishing of the gallery. Few triangles leave no room for every grotto and joint.
struct GalleryDetail {
  double cell;             ///< m, of walls and rooms
  double grotto_spacing;   ///< m
  double joint_spacing;    ///< m
  double drain_spacing;    ///< m
  std::int64_t more_rows;  ///< rows of the upper gallery beyond those at marks
  double dam_triangles;
  double ground_triangles;
};

/// A tube and the parts along it, in the order of their stations.
struct GalleryTube {
  std::shared_ptr<const Tube> tube;
  std::vector<std::function<Part()>> parts;
};

[[nodiscard]] GalleryTube upper_gallery(const GalleryOptions& options, const GalleryDetail& detail);
[[nodiscard]] GalleryTube lower_gallery(const GalleryOptions& options, const GalleryDetail& detail);

/// The furnishing of a grotto: instruments on a plinth, or a sump in its floor.
enum class Furnishing { instruments, sump };

/// A room behind a door in the left wall of a straight stretch of `tube`: `NAME/door`, `NAME/room` and, with
/// instruments, `NAME/instrument`.
void add_grotto(std::vector<std::function<Part()>>& parts, const std::shared_ptr<const Tube>& tube, const Opening& door,
                const std::string& name, Furnishing furnishing, double cell, std::uint64_t seed);

/// The axis of path 1 and path 2, extended by some metres at both ends.
[[nodiscard]] Axis upper_axis(double blend);

[[nodiscard]] Part dam(const GalleryOptions& options, const GalleryDetail& detail);
[[nodiscard]] Part ground(const GalleryOptions& options, const GalleryDetail& detail);
/// The bounds of everything, before the origin is added.
[[nodiscard]] Box gallery_bounds();

}  // namespace roam::generate
