#pragma once
/// \file
/// An image's texels as they are sent.

#include <osg/Image>

#include "import/display_part.h"

namespace roam::reader {

/// Whether there is anything in it to be shown.
[[nodiscard]] bool has_texels(const osg::Image& image);

/// Its texels as they are where their kind is one of DisplayTexels, else turned into bytes of red, green, blue and
/// opacity. `image` must have texels.
[[nodiscard]] DisplayTexture texels_of(const osg::Image& image);

}  // namespace roam::reader
