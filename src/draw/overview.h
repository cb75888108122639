#pragma once
/// \file
/// A way, or the place where it breaks off, in one plan: the first panel of `roam probe --picture`.

#include <span>
#include <string>
#include <vector>

#include "draw/page.h"
#include "roam/mesh.h"
#include "roam/walker.h"

namespace roam::draw {

/// All places are of the feet; flying, of the centre.
struct Overview {
  Mode mode = Mode::walk;
  double radius = 0.0;  ///< of the body, metres
  double height = 0.0;
  double step = 0.3;  ///< on foot: the body walks over obstacles lower than this above the feet
  Vec3 start{0.0}, target{0.0};
  std::vector<Vec3> way;  ///< empty: there is none
  /// Without a way: the places reached from both ends, on a lattice of `spacing` metres.
  std::vector<Vec3> from_start, from_target;
  double spacing = 0.2;
  /// A marked place, with a few words.
  struct Mark {
    Vec3 place{0.0};
    std::string text;
    bool good = false;
  };
  std::vector<Mark> marks;
};

/// Adds the plan with its heading and legend to the page. Throws roam::Cancelled after Ctrl-C.
void add_overview(Page& page, const Overview& overview, std::span<const Mesh> meshes);

}  // namespace roam::draw
