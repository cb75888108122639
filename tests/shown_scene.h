#pragma once
/// \file
/// What read_display sends, read back as a viewer does, and compared with what import_scene gives.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Node>
#include <osg/NodeVisitor>
#include <osg/Texture2D>
#include <osgDB/Registry>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "import/display.h"
#include "import_files.h"

namespace roam::test {

/// A triangle as it is to be seen.
struct ShownTriangle {
  Triangle corners;
  std::array<osg::Vec4ub, 3> colours;
  std::array<osg::Vec3, 3> normals;      ///< zero where there are none
  std::array<osg::Vec2, 3> coordinates;  ///< zero where there are none
  osg::ref_ptr<osg::Image> image;        ///< null where there is none
  osg::ref_ptr<osg::StateSet> state;     ///< null where there is none
};

struct Shown {
  std::vector<ShownTriangle> triangles;
  std::vector<osg::ref_ptr<osg::Geometry>> geometries;
  std::vector<DisplayPart> parts;  ///< without their bytes
  std::vector<osg::ref_ptr<osg::Node>> roots;
  DisplayReport report;
};

/// Takes a part apart, as display.h says what it holds.
class PartWalk : public osg::NodeVisitor {
 public:
  PartWalk(Shown& shown, const Vec3& origin) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), shown_(shown) {
    to_scene_.makeTranslate(origin.x, origin.y, origin.z);
  }

  void apply(osg::MatrixTransform& transform) override {
    const osg::Matrixd before = to_scene_;
    to_scene_.preMult(transform.getMatrix());
    traverse(transform);
    to_scene_ = before;
  }

  void apply(osg::Geometry& geometry) override {
    shown_.geometries.push_back(&geometry);
    const auto* vertices = dynamic_cast<const osg::Vec3Array*>(geometry.getVertexArray());
    const auto* colours = dynamic_cast<const osg::Vec4ubArray*>(geometry.getColorArray());
    const auto* normals = dynamic_cast<const osg::Vec3Array*>(geometry.getNormalArray());
    const auto* coordinates = dynamic_cast<const osg::Vec2Array*>(geometry.getTexCoordArray(0));
    ASSERT_TRUE(vertices != nullptr && colours != nullptr && geometry.getNumPrimitiveSets() == 1);
    const auto* elements = dynamic_cast<const osg::DrawElementsUShort*>(geometry.getPrimitiveSet(0));
    ASSERT_TRUE(elements != nullptr && elements->getMode() == GL_TRIANGLES);
    osg::Texture2D* texture = nullptr;
    if (osg::StateSet* state = geometry.getStateSet()) {
      texture = dynamic_cast<osg::Texture2D*>(state->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
    }
    EXPECT_EQ(texture != nullptr, coordinates != nullptr);
    for (std::size_t i = 0; i + 2 < elements->size(); i += 3) {
      ShownTriangle triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto v = (*elements)[i + k];
        const osg::Vec3d place = osg::Vec3d((*vertices)[v]) * to_scene_;
        triangle.corners[k] = {place.x(), place.y(), place.z()};
        triangle.colours[k] = (*colours)[v];
        if (normals != nullptr) triangle.normals[k] = (*normals)[v];
        if (coordinates != nullptr) triangle.coordinates[k] = (*coordinates)[v];
      }
      if (texture != nullptr) triangle.image = texture->getImage();
      triangle.state = geometry.getStateSet();
      shown_.triangles.push_back(triangle);
    }
  }

 private:
  Shown& shown_;
  osg::Matrixd to_scene_;
};

inline Shown show(const std::vector<std::filesystem::path>& paths, const ImportOptions& options = {}) {
  Shown shown;
  shown.report = read_display(paths, options, [&](DisplayPart&& part) {
    std::istringstream bytes(std::exchange(part.osgb, {}), std::ios::binary);
    osg::ref_ptr<osg::Node> root =
        osgDB::Registry::instance()->getReaderWriterForExtension("osgb")->readNode(bytes).getNode();
    EXPECT_TRUE(root != nullptr);
    if (root == nullptr) return false;
    const std::size_t before = shown.triangles.size();
    PartWalk walk(shown, part.origin);
    root->accept(walk);
    EXPECT_EQ(shown.triangles.size() - before, part.triangles);
    shown.roots.push_back(root);
    shown.parts.push_back(std::move(part));
    return true;
  });
  return shown;
}

inline std::string display_error(const std::filesystem::path& path, const ImportOptions& options = {}) {
  try {
    const std::array<std::filesystem::path, 1> paths{path};
    read_display(paths, options, [](DisplayPart&&) { return true; });
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

/// How many of the scene's triangles are not shown once each within `tolerance` metres, corner by corner.
inline std::size_t not_shown(const Scene& scene, const Shown& shown, double tolerance) {
  using Cell = std::array<std::int64_t, 3>;
  const double size = 4.0 * tolerance;
  const auto cell_of = [&](const Vec3& v) {
    return Cell{std::llround(v.x / size), std::llround(v.y / size), std::llround(v.z / size)};
  };
  const auto near = [&](const Triangle& a, const Triangle& b) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(a[k][axis] - b[k][axis]) <= tolerance)) return false;
      }
    }
    return true;
  };
  std::multimap<Cell, const Triangle*> left;
  for (const ShownTriangle& triangle : shown.triangles) left.emplace(cell_of(triangle.corners[0]), &triangle.corners);
  std::size_t missing = 0;
  for (const Triangle& triangle : triangles_of(scene)) {
    const Cell cell = cell_of(triangle[0]);
    bool found = false;
    for (std::int64_t n = 0; n < 27 && !found; ++n) {
      const auto [first, last] = left.equal_range({cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1});
      for (auto at = first; at != last && !found; ++at) {
        found = near(*at->second, triangle);
        if (found) {
          left.erase(at);
          break;
        }
      }
    }
    missing += found ? 0 : 1;
  }
  return missing + left.size();
}

/// An uncompressed image of one row, first texel left, as a BMP file.
inline std::string bmp(const std::vector<std::array<std::uint8_t, 3>>& row) {
  std::string texels;
  for (const auto& [r, g, b] : row) texels += bytes_of(b) + bytes_of(g) + bytes_of(r);
  texels.resize((texels.size() + 3) / 4 * 4);
  const auto u32 = [](std::size_t value) { return bytes_of(static_cast<std::uint32_t>(value)); };
  const auto u16 = [](unsigned value) { return bytes_of(static_cast<std::uint16_t>(value)); };
  return "BM" + u32(54 + texels.size()) + u32(0) + u32(54) + u32(40) + u32(row.size()) + u32(1) + u16(1) + u16(24) +
         u32(0) + u32(texels.size()) + u32(2835) + u32(2835) + u32(0) + u32(0) + texels;
}

}  // namespace roam::test
