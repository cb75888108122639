#pragma once
/// \file
/// Conversion of an image's texels for sending.

#include <osg/Image>

#include "import/display_part.h"

namespace roam::reader {

/// Whether the image can be shown.
[[nodiscard]] bool has_texels(const osg::Image& image);

/// The image's texels: unchanged if their kind is one of DisplayTexels, else converted to bytes of red, green, blue and
/// opacity. Requires has_texels(image).
[[nodiscard]] DisplayTexture texels_of(const osg::Image& image);

}  // namespace roam::reader
