#pragma once
/// \file
/// The legend at the foot of a sheet: what its colours and signs stand for, only those that it shows.

#include "draw/compose.h"
#include "draw/labels.h"

namespace roam::draw {

/// Draws it below `top` and returns where it ends, in pixels.
double draw_legend(const Contents& contents, Sheet& sheet, Labels& labels, double top);

}  // namespace roam::draw
