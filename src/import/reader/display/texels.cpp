#include "import/reader/display/texels.h"

#include <algorithm>
#include <optional>
#include <osg/Texture>

#include "import/reader/display/look.h"

namespace roam::reader {
namespace {

/// The kind of an image whose texels can be sent unchanged.
std::optional<DisplayTexels> kind_of(const osg::Image& image) {
  switch (image.getPixelFormat()) {
    case GL_COMPRESSED_RGB_S3TC_DXT1_EXT:
      return DisplayTexels::dxt1;
    case GL_COMPRESSED_RGBA_S3TC_DXT1_EXT:
      return DisplayTexels::dxt1_alpha;
    case GL_COMPRESSED_RGBA_S3TC_DXT3_EXT:
      return DisplayTexels::dxt3;
    case GL_COMPRESSED_RGBA_S3TC_DXT5_EXT:
      return DisplayTexels::dxt5;
    default:
      break;
  }
  if (image.getDataType() != GL_UNSIGNED_BYTE) return std::nullopt;
  switch (image.getPixelFormat()) {
    case GL_LUMINANCE:
      return DisplayTexels::grey;
    case GL_LUMINANCE_ALPHA:
      return DisplayTexels::grey_alpha;
    case GL_RGB:
      return DisplayTexels::rgb;
    case GL_RGBA:
      return DisplayTexels::rgba;
    default:
      return std::nullopt;
  }
}

std::uint32_t width_of(const osg::Image& image) {
  return std::min(static_cast<std::uint32_t>(image.s()), DisplayTexture::side_limit);
}
std::uint32_t height_of(const osg::Image& image) {
  return std::min(static_cast<std::uint32_t>(image.t()), DisplayTexture::side_limit);
}

void copy_blocks(const osg::Image& image, DisplayTexture& texture) {
  // The display cannot use an incomplete set of levels.
  if (image.getNumMipmapLevels() == DisplayTexture::all_levels(texture.width, texture.height)) {
    texture.levels = image.getNumMipmapLevels();
  }
  for (unsigned level = 0; level < texture.levels; ++level) {
    const auto bytes = DisplayTexture::bytes_of(texture.texels, std::max(texture.width >> level, 1u),
                                                std::max(texture.height >> level, 1u));
    const unsigned char* first = image.getMipmapData(level);
    texture.bytes.insert(texture.bytes.end(), first, first + bytes);
  }
}

}  // namespace

bool has_texels(const osg::Image& image) {
  if (image.data() == nullptr || image.s() <= 0 || image.t() <= 0 || image.r() != 1) return false;
  const auto kind = kind_of(image);
  if (!kind) return !image.isCompressed();
  if (*kind < DisplayTexels::dxt1) return true;
  // Compressed blocks cannot be reduced.
  return std::max(image.s(), image.t()) <= static_cast<int>(DisplayTexture::side_limit);
}

DisplayTexture texels_of(const osg::Image& image) {
  const auto kind = kind_of(image);
  DisplayTexture texture;
  texture.width = width_of(image);
  texture.height = height_of(image);
  texture.texels = kind.value_or(DisplayTexels::rgba);
  if (texture.texels >= DisplayTexels::dxt1) {
    copy_blocks(image, texture);
    return texture;
  }
  const std::uint64_t row_bytes = DisplayTexture::bytes_of(texture.texels, texture.width, 1);
  texture.bytes.reserve(row_bytes * texture.height);
  for (unsigned t = 0; t < texture.height; ++t) {
    if (kind) {
      const unsigned char* row = image.data(0, t);
      texture.bytes.insert(texture.bytes.end(), row, row + row_bytes);
      continue;
    }
    for (unsigned s = 0; s < texture.width; ++s) {
      const osg::Vec4 colour = image.getColor(s, t);
      for (unsigned k = 0; k < 4; ++k) texture.bytes.push_back(colour_byte(colour[k]));
    }
  }
  return texture;
}

DisplayTexture gloss_of(const osg::Image& image) {
  const auto kind = kind_of(image);
  const std::size_t step = kind == DisplayTexels::rgb ? 3 : kind == DisplayTexels::rgba ? 4 : 0;
  DisplayTexture texture;
  texture.width = width_of(image);
  texture.height = height_of(image);
  texture.texels = DisplayTexels::grey_alpha;
  texture.bytes.reserve(std::size_t{2} * texture.width * texture.height);
  for (unsigned t = 0; t < texture.height; ++t) {
    for (unsigned s = 0; s < texture.width; ++s) {
      if (step > 0) {
        const unsigned char* texel = image.data(0, t) + step * s;
        texture.bytes.insert(texture.bytes.end(), texel + 1, texel + 3);
      } else {
        const osg::Vec4 colour = image.getColor(s, t);
        for (const unsigned k : {1u, 2u}) texture.bytes.push_back(colour_byte(colour[k]));
      }
    }
  }
  return texture;
}

}  // namespace roam::reader
