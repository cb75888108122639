#pragma once
/// \file
/// Random scene graphs that list their triangles themselves, without OpenSceneGraph's help.

#include <algorithm>
#include <cmath>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/MatrixTransform>
#include <osg/PositionAttitudeTransform>
#include <osg/Switch>
#include <vector>

#include "clutter.h"
#include "oracle.h"

namespace osg_graphs {

using clutter::Random;
using roam::Triangle;
using roam::Vec3;

inline osg::Vec3d to_osg(const Vec3& v) { return {v.x, v.y, v.z}; }
inline Vec3 to_roam(const osg::Vec3d& v) { return {v.x(), v.y(), v.z()}; }

/// A row vector times a matrix, in the highest precision of all.
inline Vec3 placed(const osg::Vec3d& v, const osg::Matrixd& m) {
  Vec3 p;
  for (int k = 0; k < 3; ++k) {
    p[k] = static_cast<double>(static_cast<long double>(v.x()) * m(0, k) + static_cast<long double>(v.y()) * m(1, k) +
                               static_cast<long double>(v.z()) * m(2, k) + m(3, k));
  }
  return p;
}

struct Graph {
  osg::ref_ptr<osg::Group> root = new osg::Group;
  std::vector<Triangle> triangles;  ///< in the frame of the scene
};

/// Parameters of a graph: geometries of a few primitives each, within `half` of `centre`.
struct Recipe {
  Vec3 centre{0.0};
  double half = 5.0;
  int geometries = 8;
  bool kd_tree_friendly = false;  ///< floats, enough primitives, none with equal corners
};

class Maker {
 public:
  Maker(Random& random, const Recipe& recipe) : random_(random), recipe_(recipe) {}

  Graph make() {
    for (int i = 0; i < recipe_.geometries; ++i) {
      osg::ref_ptr<osg::Group> parent = graph_.root;
      osg::Matrixd to_scene;
      const int depth = static_cast<int>(random_.engine() % 4);
      for (int d = 0; d < depth; ++d) parent = nested(*parent, to_scene);
      add_geometry(*parent, to_scene);
    }
    return std::move(graph_);
  }

 private:
  double sign() { return random_.engine() % 2 == 0 ? 1.0 : -1.0; }

  osg::Matrixd random_matrix() {
    switch (random_.engine() % 7) {
      case 0:
        return osg::Matrixd::translate(to_osg(recipe_.centre));
      case 1:
        return osg::Matrixd::translate(to_osg(random_.in_box(1000.0)));
      case 2:
        return osg::Matrixd::rotate(random_.between(0.0, 6.28), to_osg(random_.direction()));
      case 3: {
        const double s = random_.between(0.01, 4.0) * sign();
        return osg::Matrixd::scale(s, s, s);
      }
      case 4:
        return osg::Matrixd::scale(random_.between(0.1, 4.0), random_.between(0.1, 4.0) * sign(),
                                   random_.between(0.1, 4.0));
      case 5: {  // including shear
        osg::Matrixd m;
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) m(i, j) = random_.between(-1.5, 1.5);
        }
        m.postMultTranslate(to_osg(random_.in_box(10.0)));
        return m;
      }
      default:
        return osg::Matrixd::rotate(random_.between(0.0, 6.28), osg::Vec3d(0, 0, 1)) *
               osg::Matrixd::translate(to_osg(random_.in_box(5.0)));
    }
  }

  osg::ref_ptr<osg::Group> nested(osg::Group& parent, osg::Matrixd& to_scene) {
    osg::ref_ptr<osg::Group> group;
    switch (random_.engine() % 6) {
      case 0: {
        osg::ref_ptr<osg::Switch> one = new osg::Switch;
        one->addChild(new osg::Group, false);
        group = new osg::Group;
        one->addChild(group, true);
        parent.addChild(one);
        return group;
      }
      case 1: {
        osg::ref_ptr<osg::LOD> lod = new osg::LOD;
        group = new osg::Group;
        lod->addChild(group, 0.0f, 100.0f);
        lod->addChild(coarse(), 100.0f, 1e9f);
        parent.addChild(lod);
        return group;
      }
      case 2: {
        osg::ref_ptr<osg::PositionAttitudeTransform> pat = new osg::PositionAttitudeTransform;
        pat->setPosition(to_osg(random_.in_box(20.0)));
        pat->setAttitude(osg::Quat(random_.between(0.0, 3.0), to_osg(random_.direction())));
        pat->setScale(osg::Vec3d(random_.between(0.5, 2.0), random_.between(0.5, 2.0), random_.between(0.5, 2.0)));
        pat->computeLocalToWorldMatrix(to_scene, nullptr);
        parent.addChild(pat);
        return pat;
      }
      default: {
        const osg::Matrixd own = random_matrix();
        osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(own);
        to_scene.preMult(own);
        parent.addChild(transform);
        return transform;
      }
    }
  }

  /// Geometry that is invisible from nearby.
  osg::ref_ptr<osg::Node> coarse() {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (int i = 0; i < 3; ++i) vertices->push_back(osg::Vec3(to_osg(recipe_.centre + random_.in_box(recipe_.half))));
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
    return geometry;
  }

  template <class Array>
  std::vector<osg::Vec3d> fill(osg::Geometry& geometry, const std::vector<osg::Vec3d>& points) {
    using Vertex = typename Array::ElementDataType;
    osg::ref_ptr<Array> array = new Array;
    std::vector<osg::Vec3d> kept;
    for (const osg::Vec3d& p : points) {
      Vertex v;
      for (int k = 0; k < 3; ++k) v[k] = static_cast<typename Vertex::value_type>(p[k]);
      if constexpr (Vertex::num_components == 4) v[3] = 1;
      array->push_back(v);
      kept.emplace_back(v[0], v[1], v[2]);
    }
    geometry.setVertexArray(array);
    return kept;
  }

  void add_geometry(osg::Group& parent, const osg::Matrixd& to_scene) {
    osg::Matrixd back;
    back.invert_4x3(to_scene);
    const int count = recipe_.kd_tree_friendly ? 60 : 12;
    std::vector<osg::Vec3d> points;
    const Vec3 at = recipe_.centre + random_.in_box(recipe_.half);
    const double size = 0.05 * std::pow(200.0, random_.unit());
    for (int i = 0; i < count; ++i) {
      points.push_back(to_osg(at + size * random_.in_box(0.5)) * back);
      if (!recipe_.kd_tree_friendly && random_.engine() % 5 == 0 && i > 0) points.back() = points[points.size() - 2];
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setName("geometry");
    std::vector<osg::Vec3d> kept;
    switch (recipe_.kd_tree_friendly ? 0 : random_.engine() % 4) {
      case 0:
        kept = fill<osg::Vec3Array>(*geometry, points);
        break;
      case 1:
        kept = fill<osg::Vec4Array>(*geometry, points);
        break;
      case 2:
        kept = fill<osg::Vec4dArray>(*geometry, points);
        break;
      default:
        kept = fill<osg::Vec3dArray>(*geometry, points);
        break;
    }
    std::vector<Vec3> corners;
    for (const osg::Vec3d& v : kept) corners.push_back(placed(v, to_scene));
    for (int set = 0; set < 2; ++set) add_primitives(*geometry, corners);
    if (random_.engine() % 2 == 0) {
      osg::ref_ptr<osg::Geode> geode = new osg::Geode;
      geode->addDrawable(geometry);
      parent.addChild(geode);
    } else {
      parent.addChild(geometry);
    }
  }

  void add_primitives(osg::Geometry& geometry, const std::vector<Vec3>& corners) {
    const GLenum modes[] = {GL_TRIANGLES,  GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN, GL_QUADS,
                            GL_QUAD_STRIP, GL_POLYGON,        GL_LINES,        GL_POINTS};
    const GLenum mode = modes[random_.engine() % 8];
    const int n = static_cast<int>(corners.size());
    std::vector<unsigned> index;
    if (random_.engine() % 2 == 0) {
      const int first = static_cast<int>(random_.engine() % 4), count = n - first;
      for (int i = 0; i < count; ++i) index.push_back(static_cast<unsigned>(first + i));
      geometry.addPrimitiveSet(new osg::DrawArrays(mode, first, count));
    } else {
      for (int i = 0; i < n; ++i) index.push_back(static_cast<unsigned>(random_.engine() % corners.size()));
      // Whole primitives only: OpenSceneGraph's own KdTree reads beyond the end of others.
      index.resize(index.size() / 12 * 12);
      switch (random_.engine() % 3) {
        case 0:
          geometry.addPrimitiveSet(new osg::DrawElementsUInt(mode, index.begin(), index.end()));
          break;
        case 1:
          geometry.addPrimitiveSet(new osg::DrawElementsUShort(mode, index.begin(), index.end()));
          break;
        default: {
          osg::ref_ptr<osg::DrawElementsUByte> bytes = new osg::DrawElementsUByte(mode);
          for (const unsigned i : index) bytes->push_back(static_cast<GLubyte>(i));
          geometry.addPrimitiveSet(bytes);
          break;
        }
      }
    }
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
      graph_.triangles.push_back({corners[index[a]], corners[index[b]], corners[index[c]]});
    };
    for (std::size_t i = 0; i < index.size(); ++i) {
      const bool third = i % 3 == 2, fourth = i % 4 == 3, odd = i % 2 == 1;
      if (mode == GL_TRIANGLES && third) add(i - 2, i - 1, i);
      if (mode == GL_TRIANGLE_STRIP && i >= 2) add(i - 2, i - 1, i);
      if ((mode == GL_TRIANGLE_FAN || mode == GL_POLYGON) && i >= 2) add(0, i - 1, i);
      if (mode == GL_QUADS && fourth) add(i - 3, i - 2, i - 1), add(i - 3, i - 1, i);
      // A quad of a strip has its corners in the order 0, 1, 3, 2.
      if (mode == GL_QUAD_STRIP && i >= 3 && odd) add(i - 3, i - 2, i), add(i - 3, i, i - 1);
    }
  }

  Random& random_;
  Recipe recipe_;
  Graph graph_;
};

/// The least distance of a body's axis to the triangles over [0, time] of its motion.
inline double least_distance(const std::vector<Triangle>& triangles, const roam::Body& body, const Vec3& from,
                             const Vec3& motion, double time) {
  constexpr double far = 3.0;  // larger than all queries here
  double least = far;
  for (const Triangle& t : triangles) {
    bool apart = false;
    for (int k = 0; k < 3; ++k) {
      const double grown = far + (k == 2 ? body.half_height : 0.0), a = from[k], b = from[k] + motion[k];
      apart = apart || std::max({t[0][k], t[1][k], t[2][k]}) < std::min(a, b) - grown ||
              std::min({t[0][k], t[1][k], t[2][k]}) > std::max(a, b) + grown;
    }
    if (apart) continue;
    least = std::min(least, static_cast<double>(oracle::least_distance(body, from, motion, time, t)));
  }
  return least;
}

}  // namespace osg_graphs
