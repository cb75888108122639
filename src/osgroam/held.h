#pragma once
/// \file
/// Why a manipulator's body does not move.

#include <string>

#include "osgRoam/Manipulator.h"

namespace osgRoam {

/// For display and console: the reason, and the keys that help; empty: it can move. "held: the body does not fit here;
/// N passes through walls".
[[nodiscard]] std::string why_held(const Manipulator& roamer);

}  // namespace osgRoam
