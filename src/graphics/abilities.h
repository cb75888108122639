#pragma once
/// \file
/// Abilities of a context's OpenGL.

#include <osg/GraphicsContext>

#include "graphics/context.h"

namespace roam::graphics {

/// Makes the realized `window` current, queries its OpenGL, and releases it. Throws roam::Error if that OpenGL cannot
/// be used, or is older than roam needs.
[[nodiscard]] Abilities ask_abilities(osg::GraphicsContext& window);

}  // namespace roam::graphics
