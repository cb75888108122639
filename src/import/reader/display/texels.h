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

/// Roughness (grey) and metalness (opacity) from an image's green and blue. Requires has_texels(image), and that the
/// image is not compressed.
[[nodiscard]] DisplayTexture gloss_of(const osg::Image& image);

}  // namespace roam::reader
