#include "import/reader/display/part_graph.h"

#include <cmath>
#include <limits>
#include <osg/AlphaFunc>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osgDB/Options>
#include <osgDB/Registry>
#include <sstream>
#include <utility>
#include <vector>

#include "roam/error.h"

namespace roam::reader {
namespace {

/// Chunks hang under transforms on a grid of so many metres. Neighbours under one transform have the same floats at a
/// common edge, so that no background shines through; within a cell floats keep 8 micrometres.
constexpr double cell_size = 256.0;

/// The arrays of one geometry, filled corner by corner.
class GeometryBuilder {
 public:
  GeometryBuilder(const Surface& surface, const Vec3& zero, bool normals, bool textured)
      : surface_(surface), zero_(zero), normals_(normals), textured_(textured) {}

  osg::ref_ptr<osg::Geometry> build(std::span<const std::uint32_t> triangles, std::vector<std::uint32_t>& index_of) {
    osg::ref_ptr<osg::DrawElementsUShort> elements = new osg::DrawElementsUShort(GL_TRIANGLES);
    elements->reserve(3 * triangles.size());
    std::vector<std::uint32_t> used;
    for (const std::uint32_t t : triangles) {
      for (const std::uint32_t corner : surface_.triangles[t]) {
        if (index_of[corner] == none) {
          index_of[corner] = static_cast<std::uint32_t>(used.size());
          used.push_back(corner);
        }
        elements->push_back(static_cast<GLushort>(index_of[corner]));
      }
    }
    for (const std::uint32_t vertex : used) index_of[vertex] = none;

    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    osg::ref_ptr<osg::Vec4ubArray> colours = new osg::Vec4ubArray(osg::Array::BIND_PER_VERTEX);
    colours->setNormalize(true);
    for (const std::uint32_t i : used) {
      const Vec3 v = surface_.vertices[i] - zero_;
      vertices->push_back({static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)});
      const Colour& c = surface_.looks[i].colour;
      colours->push_back({c[0], c[1], c[2], c[3]});
    }
    geometry->setVertexArray(vertices);
    geometry->setColorArray(colours);
    if (normals_) geometry->setNormalArray(unit_normals(used));
    if (textured_) {
      osg::ref_ptr<osg::Vec2Array> coordinates = new osg::Vec2Array(osg::Array::BIND_PER_VERTEX);
      for (const std::uint32_t i : used) {
        const glm::vec2 uv = surface_.looks[i].texture;
        coordinates->push_back({uv.x, uv.y});
      }
      geometry->setTexCoordArray(0, coordinates);
    }
    geometry->addPrimitiveSet(elements);
    return geometry;
  }

  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

 private:
  [[nodiscard]] osg::ref_ptr<osg::Vec3Array> unit_normals(const std::vector<std::uint32_t>& used) const {
    osg::ref_ptr<osg::Vec3Array> normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
    for (const std::uint32_t i : used) {
      const glm::vec3 n = surface_.looks[i].normal;
      osg::Vec3 unit(n.x, n.y, n.z);
      unit.normalize();
      normals->push_back(unit);
    }
    return normals;
  }

  const Surface& surface_;
  const Vec3& zero_;
  bool normals_;
  bool textured_;
};

}  // namespace

PartGraph::PartGraph(Textures& textures, const Vec3& origin) : textures_(textures), origin_(origin) {}

void PartGraph::add(const Surface& surface, const Look& look, bool normals) {
  const osg::ref_ptr<osg::StateSet> state = state_of(look);
  const bool textured = state != nullptr && state->getTextureAttribute(0, osg::StateAttribute::TEXTURE) != nullptr;
  bytes_ += surface.bytes();
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> index_of(surface.vertices.size(), GeometryBuilder::none);
  for (const std::span<const std::uint32_t> chunk : cut_into_chunks(surface, order)) {
    Box box;
    for (const std::uint32_t t : chunk) {
      for (const std::uint32_t corner : surface.triangles[t]) box.include(surface.vertices[corner]);
    }
    bounds_.include(box);
    Vec3 cell;
    osg::Group& group = cell_around(box.center() - origin_, cell);
    const Vec3 zero = origin_ + cell;
    const osg::ref_ptr<osg::Geometry> geometry =
        GeometryBuilder(surface, zero, normals, textured).build(chunk, index_of);
    geometry->setStateSet(state);
    group.addChild(geometry);
  }
}

osg::Group& PartGraph::cell_around(const Vec3& place, Vec3& cell) {
  for (int k = 0; k < 3; ++k) cell[k] = 0.0 + cell_size * std::round(place[k] / cell_size);
  osg::Group*& group = cells_[{cell.x, cell.y, cell.z}];
  if (group == nullptr) {
    group = new osg::MatrixTransform(osg::Matrixd::translate(cell.x, cell.y, cell.z));
    root_->addChild(group);
  }
  return *group;
}

osg::ref_ptr<osg::StateSet> PartGraph::state_of(const Look& look) {
  const auto [at, is_new] = states_.try_emplace(look);
  if (!is_new) return at->second;
  osg::Texture2D* texture = nullptr;
  if (look.texture != no_texture) {
    const auto [loaded, first] = loaded_.try_emplace(look.texture);
    if (first) loaded->second = textures_.load(look.texture);
    if (first && loaded->second != nullptr) bytes_ += loaded->second->getImage()->getTotalSizeInBytes();
    texture = loaded->second;
  }
  const bool mask = look.transparency == Transparency::mask && texture != nullptr;
  const bool blend =
      look.transparency == Transparency::blend || (look.transparency == Transparency::by_texture &&
                                                   texture != nullptr && texture->getImage()->isImageTranslucent());
  if (texture == nullptr && !blend) return nullptr;
  osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
  if (texture != nullptr) state->setTextureAttributeAndModes(0, texture);
  if (mask) state->setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GEQUAL, look.cutoff));
  if (blend) {
    state->setMode(GL_BLEND, osg::StateAttribute::ON);
    state->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
  }
  at->second = state;
  return state;
}

std::string PartGraph::osgb() const {
  osgDB::ReaderWriter* writer = osgDB::Registry::instance()->getReaderWriterForExtension("osgb");
  if (writer == nullptr) {
    throw Error("OpenSceneGraph's plugin for its own format is not there; install OpenSceneGraph anew.");
  }
  const osg::ref_ptr<osgDB::Options> options = new osgDB::Options("WriteImageHint=IncludeData");
  std::ostringstream bytes(std::ios::binary);
  if (!writer->writeNode(*root_, bytes, options.get()).success() || !bytes) {
    throw Error("OpenSceneGraph could not write a part of the scene for showing; install OpenSceneGraph anew.");
  }
  return std::move(bytes).str();
}

}  // namespace roam::reader
