#include "view/display_node.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <memory>
#include <osg/Array>
#include <osg/Image>
#include <osg/MatrixTransform>
#include <osg/StateSet>
#include <osg/Texture2D>
#include <utility>
#include <vector>

#include "graphics/shading.h"
#include "view/shown_objects.h"

namespace roam::app {
namespace {

/// An array with the bits of a list of plain vectors.
template <class Array, class Vector>
osg::ref_ptr<Array> array_of(const std::vector<Vector>& list) {
  static_assert(sizeof(typename Array::ElementDataType) == sizeof(Vector));
  osg::ref_ptr<Array> array = new Array(osg::Array::BIND_PER_VERTEX, static_cast<unsigned>(list.size()));
  if (!list.empty()) {
    std::memcpy(const_cast<void*>(array->getDataPointer()), list.data(), list.size() * sizeof(Vector));
  }
  return array;
}

GLenum format_of(DisplayTexels texels) {
  constexpr GLenum formats[] = {GL_LUMINANCE,
                                GL_LUMINANCE_ALPHA,
                                GL_RGB,
                                GL_RGBA,
                                GL_COMPRESSED_RGB_S3TC_DXT1_EXT,
                                GL_COMPRESSED_RGBA_S3TC_DXT1_EXT,
                                GL_COMPRESSED_RGBA_S3TC_DXT3_EXT,
                                GL_COMPRESSED_RGBA_S3TC_DXT5_EXT};
  return formats[static_cast<std::size_t>(texels)];
}

osg::Texture::WrapMode wrap_of(DisplayWrap wrap) {
  if (wrap == DisplayWrap::repeat) return osg::Texture::REPEAT;
  return wrap == DisplayWrap::mirror ? osg::Texture::MIRROR : osg::Texture::CLAMP_TO_EDGE;
}

osg::ref_ptr<osg::Texture2D> texture_of(const DisplayTexture& from, const TextureQuality& quality) {
  auto* bytes = new unsigned char[from.bytes.size()];
  std::copy(from.bytes.begin(), from.bytes.end(), bytes);
  const GLenum format = format_of(from.texels);
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->setImage(static_cast<int>(from.width), static_cast<int>(from.height), 1, static_cast<GLint>(format), format,
                  GL_UNSIGNED_BYTE, bytes, osg::Image::USE_NEW_DELETE, 1);
  if (from.levels > 1) {
    osg::Image::MipmapDataType offsets;
    for (std::uint32_t level = 1; level < from.levels; ++level) {
      offsets.push_back(static_cast<unsigned>(DisplayTexture::bytes_of(from.texels, from.width, from.height, level)));
    }
    image->setMipmapLevels(offsets);
  }
  // Cards can compute smaller levels of texels, but not always of compressed blocks.
  const bool smaller = from.levels > 1 || from.texels < DisplayTexels::dxt1;
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
  texture->setWrap(osg::Texture::WRAP_S, wrap_of(from.across));
  texture->setWrap(osg::Texture::WRAP_T, wrap_of(from.up));
  texture->setFilter(osg::Texture::MIN_FILTER, smaller ? osg::Texture::LINEAR_MIPMAP_LINEAR : osg::Texture::LINEAR);
  texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::LINEAR);
  texture->setMaxAnisotropy(quality.anisotropy);
  texture->setResizeNonPowerOfTwoHint(false);
  return texture;
}

/// Null if the look is plain. `textures`: those of its part.
osg::ref_ptr<osg::StateSet> state_of(const DisplayLook& look,
                                     const std::vector<osg::ref_ptr<osg::Texture2D>>& textures) {
  const bool dull = look.roughness >= 1.0f && look.gloss_texture == DisplayLook::no_texture;
  const bool emits = look.emission != std::array<std::uint8_t, 3>{};
  if (!look.has_image() && look.cover == DisplayCover::opaque && dull && !emits) return nullptr;
  osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
  const auto set_image = [&](unsigned unit, std::uint32_t texture) {
    if (texture == DisplayLook::no_texture) return false;
    state->setTextureAttribute(unit, textures[texture]);
    return true;
  };
  graphics::Surface surface{.textured = set_image(graphics::picture_unit, look.texture),
                            .blended = look.cover == DisplayCover::blended};
  if (look.cover == DisplayCover::cut) surface.cutoff = look.cutoff;
  if (!dull) {
    surface.gloss = {look.roughness, look.metalness, set_image(graphics::gloss_unit, look.gloss_texture)};
  }
  if (emits) {
    const auto& [red, green, blue] = look.emission;
    surface.emission = {{red / 255.0f, green / 255.0f, blue / 255.0f},
                        set_image(graphics::emission_unit, look.emission_texture)};
  }
  graphics::apply(surface, *state);
  return state;
}

osg::ref_ptr<PageLod> pages_of(const DisplayPages& from, const std::vector<osg::ref_ptr<osg::Group>>& groups,
                               const NamePage& name_page, const std::shared_ptr<PageRules>& rules) {
  osg::ref_ptr<PageLod> lod = new PageLod(from, rules);
  for (unsigned i = 0; i < from.levels.size(); ++i) {
    const DisplayLevel& level = from.levels[i];
    if (level.group != 0) {
      lod->addChild(groups[level.group]);
    } else {
      lod->setFileName(i, name_page(level.page));
    }
    lod->add_range(level.from, level.to);
  }
  return lod;
}

}  // namespace

osg::ref_ptr<osg::Geometry> make_geometry(const DisplayGeometry& from) {
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setUseDisplayList(false);
  geometry->setUseVertexBufferObjects(true);
  geometry->setVertexArray(array_of<osg::Vec3Array>(from.positions));
  const osg::ref_ptr<osg::Vec4ubArray> colours = array_of<osg::Vec4ubArray>(from.colours);
  colours->setNormalize(true);
  geometry->setColorArray(colours);
  if (from.normals.empty()) {
    // A zero normal stands for no normal.
    geometry->setNormalArray(new osg::Vec3Array(1), osg::Array::BIND_OVERALL);
  } else {
    geometry->setNormalArray(array_of<osg::Vec3Array>(from.normals));
  }
  if (!from.coordinates.empty()) geometry->setTexCoordArray(0, array_of<osg::Vec2Array>(from.coordinates));
  const osg::ref_ptr<osg::DrawElementsUShort> triangles =
      new osg::DrawElementsUShort(GL_TRIANGLES, static_cast<unsigned>(from.indices.size()), from.indices.data());
  geometry->addPrimitiveSet(triangles);
  return geometry;
}

osg::ref_ptr<osg::Group> make_node(const DisplayPart& part, const TextureQuality& quality, const NamePage& name_page,
                                   SceneObjects& objects, const std::shared_ptr<PageRules>& rules) {
  const std::vector<SceneObjects::Number> numbers = objects.add(part.objects);
  const std::shared_ptr<const SceneObjects::Flags> flags = objects.flags();
  std::vector<osg::ref_ptr<osg::Texture2D>> textures;
  for (const DisplayTexture& texture : part.textures) textures.push_back(texture_of(texture, quality));
  std::vector<osg::ref_ptr<osg::StateSet>> states;
  for (const DisplayLook& look : part.looks) {
    states.push_back(state_of(look, textures));
  }
  std::vector<osg::ref_ptr<osg::Group>> groups(part.groups);
  for (auto& group : groups) group = new osg::Group;

  std::map<std::pair<std::uint32_t, std::array<double, 3>>, osg::MatrixTransform*> cells;
  for (const DisplayGeometry& from : part.geometries) {
    const Vec3& c = from.cell;
    osg::MatrixTransform*& cell = cells[{from.group, {c.x, c.y, c.z}}];
    if (cell == nullptr) {
      cell = new osg::MatrixTransform(osg::Matrixd::translate(c.x, c.y, c.z));
      groups[from.group]->addChild(cell);
    }
    const osg::ref_ptr<osg::Geometry> geometry = make_geometry(from);
    geometry->setStateSet(states[from.look]);
    std::vector<DisplayRun> runs = from.runs;
    for (DisplayRun& run : runs) run.object = numbers[run.object];
    keep_objects(*geometry, std::move(runs), *flags);
    cell->addChild(geometry);
  }
  for (const DisplayPages& pages : part.pages) {
    groups[pages.group]->addChild(pages_of(pages, groups, name_page, rules));
  }
  return groups[0];
}

}  // namespace roam::app
