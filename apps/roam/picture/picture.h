#pragma once
/// \file
/// `roam walk --picture`: plan and section of the way that was walked, as an SVG or a PNG. docs/pictures.md shows one.
///
/// A picture is made in steps, each a file of its own and each, but for the last, from values to values:
///   way       the places of all steps -> few corners, and how far along they lie
///   survey    -> the room beside the body, floor, ceiling, the narrowest place (asks the space)
///   marks     -> the places to point at
///   levels    -> the heights at which the plan is cut
///   frames    -> which part of the scene is shown at which scale
///   cut       -> what planes cut out of the scene; lines: loose segments -> few long lines
///   compose   -> a sheet: lines, discs and texts in pixels (panel, legend, labels)
///   draw      -> a file, with Cairo

#include <filesystem>
#include <string>

#include "draw.h"
#include "roam/mesh.h"
#include "roam/space.h"
#include "sheet.h"
#include "walk_report.h"
#include "way.h"

namespace roam::app::picture {

/// What a picture is made from.
struct Walked {
  std::string title;  ///< the scene and the path, for people
  const WalkReport& report;
  const Record& record;
  const Space& space;
  std::span<const Mesh> meshes;  ///< that `space` was built from
};

/// The whole sheet. Throws roam::Cancelled after Ctrl-C.
[[nodiscard]] Sheet make_sheet(const Walked& walked);

}  // namespace roam::app::picture
