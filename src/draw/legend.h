#pragma once
/// \file
/// The legend at the foot of a sheet: the colours and signs that the sheet shows, with their meanings.

#include "draw/compose.h"
#include "draw/labels.h"

namespace roam::draw {

/// Draws it below `top`. Returns its lower end, in pixels.
double draw_legend(const Contents& contents, Sheet& sheet, Labels& labels, double top);

}  // namespace roam::draw
