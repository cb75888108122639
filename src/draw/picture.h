#pragma once
/// \file
/// `roam walk --picture`: plan and section of the way that was walked, as an SVG or a PNG. docs/pictures.md shows one.
///
/// A picture is made in steps, each a file of its own and each, but for the last, from values to values:
///   way       the places of all steps -> few corners, and how far along they lie
///   survey    -> the room beside the body, floor, ceiling (queries the space)
///   marks     -> the places to point at
///   levels    -> the heights at which the plan is cut
///   frames    -> which part of the scene is shown at which scale
///   cut       -> what planes cut out of the scene; lines: loose segments -> few long lines
///   compose   -> a sheet: lines, discs and texts in pixels (panel, legend, labels)
///   draw      -> a file, with Cairo

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "draw/draw.h"
#include "draw/lines.h"
#include "draw/sheet.h"
#include "draw/survey.h"
#include "draw/way.h"
#include "roam/mesh.h"
#include "roam/space.h"
#include "words/walk.h"

namespace roam::draw {

/// What must be measured while the space is there.
struct Measured {
  Way way;
  Survey survey;
};

[[nodiscard]] Measured measure(const Space& space, const words::EndedWalk& report, const Record& record,
                               const Arrive& arrive = {});

/// Hands out all triangles that meet a box, little by little.
using Triangles = std::function<void(const Box&, const std::function<void(std::span<const Mesh>)>& take)>;

/// What a picture is made from.
struct Walked {
  std::string title;  ///< the scene and the path, for people
  const words::EndedWalk& report;
  const Record& record;
  const Measured& measured;
  Box bounds;  ///< of the scene
  Triangles triangles;
  /// Most segments of each kind in one panel. A sheet takes up to some 2,000 bytes for each of them.
  std::size_t most_segments = usual_segments;
  std::uint64_t triangle_count = 0;  ///< of the scene; 0: not known
};

/// The whole sheet. Throws roam::Cancelled after Ctrl-C.
[[nodiscard]] Sheet make_sheet(const Walked& walked);

}  // namespace roam::draw
