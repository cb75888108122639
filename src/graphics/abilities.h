#pragma once
/// \file
/// Asks a context's OpenGL what it can do.

#include <osg/GraphicsContext>

#include "graphics/context.h"

namespace roam::graphics {

/// Makes the realized `window` current, asks, and releases it. Throws roam::Error when its OpenGL cannot be used, or is
/// older than what roam draws with.
[[nodiscard]] Abilities ask_abilities(osg::GraphicsContext& window);

}  // namespace roam::graphics
