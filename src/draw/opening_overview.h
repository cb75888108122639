#pragma once
/// \file
/// Where a way leads, or breaks off, in one plan: the first panel of `roam probe --picture`.

#include <span>
#include <string>
#include <vector>

#include "draw/labels.h"
#include "draw/sheet.h"
#include "roam/mesh.h"
#include "roam/walker.h"

namespace roam::draw {

/// All places are of the feet; flying, of the centre.
struct Overview {
  Mode mode = Mode::walk;
  double radius = 0.0;  ///< of the body, metres
  double height = 0.0;
  double step = 0.3;  ///< on foot: what is lower than this above the feet is walked over
  Vec3 start{0.0}, target{0.0};
  std::vector<Vec3> way;  ///< empty: there is none
  /// Where there is no way: what is reached from both ends, on a lattice of `spacing` metres.
  std::vector<Vec3> from_start, from_target;
  double spacing = 0.2;
  /// A place to look at, with a few words.
  struct Mark {
    Vec3 place{0.0};
    std::string text;
    bool good = false;
  };
  std::vector<Mark> marks;
};

/// Where the scene's y points, which in maps is north, and its x.
void draw_compass(const Turn& turn, const Point& centre, Sheet& sheet, Labels& labels);

/// Draws the plan with its caption below `y` (pixels), as wide as the sheet's contents, and its legend. Returns where
/// it ends. Throws roam::Cancelled after Ctrl-C.
[[nodiscard]] double draw_overview(const Overview& overview, std::span<const Mesh> meshes, double y, Sheet& sheet,
                                   Labels& labels);

}  // namespace roam::draw
