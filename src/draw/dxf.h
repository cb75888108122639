#pragma once
/// \file
/// Sheets as DXF, for those who draw on: lines, circles, arcs and texts in metres, a layer for each kind.

#include <string>

#include "draw/sheet.h"

namespace roam::draw {

/// The views of a sheet as DXF (release 12, ASCII), in metres. The first view with a turn lies where it is in the
/// scene. The others stand to the right of it, one below the other, at full size, under their names; heights are not
/// exaggerated there. Legends, scale bars and colours of areas are left out. Lines are as exact as on the sheet: to 0.4
/// pixels, or as Sheet::coarsest says. A sheet without views gives its texts.
[[nodiscard]] std::string to_dxf(const Sheet& sheet);

}  // namespace roam::draw
