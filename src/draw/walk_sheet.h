#pragma once
/// \file
/// The sheet of `roam walk --picture`: title, plan, details, section and legend. docs/pictures.md shows one.
///
/// Each step is a file of its own. Only `survey` queries a space, and only the last three draw:
///   way          the places of all steps -> few corners, with their distances along the way
///   survey       -> the room beside the body, floor, ceiling
///   marks        -> the places to mark
///   levels       -> the heights at which the plan is cut
///   frames       -> the part of the scene to show, and its scale
///   cut          -> cuts of planes with the scene; lines: loose segments -> few long lines
///   walk_panels  -> shapes in metres, painted by a Panel on a Page
///   walk_sheet   -> a Sheet: lines, discs and texts in pixels
///   picture_file -> a file

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "draw/lines.h"
#include "draw/sheet.h"
#include "draw/stations.h"
#include "draw/way.h"
#include "roam/mesh.h"
#include "roam/space.h"
#include "words/walk.h"

namespace roam::draw {

/// Measurements that need the space.
struct Measured {
  Way way;
  RoomSurvey survey;
};

[[nodiscard]] Measured measure(const Space& space, const words::EndedWalk& report, const Record& record,
                               const Arrive& arrive = {});

/// Passes all triangles that meet a box to `take`, in parts.
using Triangles = std::function<void(const Box&, const std::function<void(std::span<const Mesh>)>& take)>;

/// The input of a sheet.
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

/// The whole sheet. Throws roam::Cancelled after Ctrl-C, unless that ended the walk.
[[nodiscard]] Sheet make_sheet(const Walked& walked);

}  // namespace roam::draw
