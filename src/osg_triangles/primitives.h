#pragma once
/// \file
/// The triangles of a geometry's primitives, by the indices of their corners. OpenSceneGraph's own functors trust the
/// indices of the file, and do not say which vertices are shared.

#include <cstddef>
#include <cstdint>
#include <osg/Array>
#include <osg/Geometry>
#include <osg/PrimitiveSet>
#include <type_traits>

namespace roam::osg_triangles {

/// A vertex array of any kind.
class Vertices {
 public:
  Vertices() = default;
  template <class Vertex>
  Vertices(std::size_t count, const Vertex* vertices)
      : count_(vertices == nullptr ? 0 : count),
        array_(vertices),
        is_float_(std::is_same_v<typename Vertex::value_type, float>),
        at_([](const void* array, std::size_t i) { return point(static_cast<const Vertex*>(array)[i]); }) {}

  [[nodiscard]] std::size_t size() const { return count_; }
  /// True if the array is of floats: a file could have more digits.
  [[nodiscard]] bool is_float() const { return is_float_; }
  /// The vertex; `i` < size().
  [[nodiscard]] osg::Vec3d operator[](std::size_t i) const { return at_(array_, i); }

 private:
  template <class Vertex>
  static osg::Vec3d point(const Vertex& v) {
    const osg::Vec2d first(v.x(), v.y());
    if constexpr (Vertex::num_components == 2) {
      return {first, 0.0};
    } else if constexpr (Vertex::num_components == 3) {
      return {first, static_cast<double>(v.z())};
    } else {
      // OpenGL divides by w; most files have 1 there.
      return osg::Vec3d(first, v.z()) / static_cast<double>(v.w());
    }
  }

  std::size_t count_ = 0;
  const void* array_ = nullptr;
  bool is_float_ = false;
  osg::Vec3d (*at_)(const void*, std::size_t) = nullptr;
};

/// The corners of one triangle. Unchecked: an index may be out of range.
struct Corners {
  std::uint64_t a, b, c;
  unsigned primitive;  ///< the number of the primitive in the geometry; points, lines, triangles and quads all count
  unsigned half;       ///< which half of a quad: 0 or 1
  bool indexed;        ///< false: triangles do not share vertices
};

/// Passes all triangles of a geometry to `Receiver`, by run(). A receiver has
///     void begin(const auto* vertices, std::size_t count);   // before the triangles
///     void triangle(const Corners& corners);
template <class Receiver>
class Primitives : public osg::PrimitiveIndexFunctor {
 public:
  explicit Primitives(Receiver& receiver) : receiver_(receiver) {}

  void run(const osg::Geometry& geometry) {
    const osg::Array* vertices = geometry.getVertexArray();
    if (vertices == nullptr && geometry.getNumVertexAttribArrays() > 0) vertices = geometry.getVertexAttribArray(0);
    if (vertices == nullptr || !begin_integers(*vertices)) return geometry.accept(*this);
    for (const auto& primitives : geometry.getPrimitiveSetList()) primitives->accept(*this);
  }

  // Geometry::accept() calls these. It refuses integers.
  void setVertexArray(unsigned int count, const osg::Vec2* v) override { receiver_.begin(v, count); }
  void setVertexArray(unsigned int count, const osg::Vec3* v) override { receiver_.begin(v, count); }
  void setVertexArray(unsigned int count, const osg::Vec4* v) override { receiver_.begin(v, count); }
  void setVertexArray(unsigned int count, const osg::Vec2d* v) override { receiver_.begin(v, count); }
  void setVertexArray(unsigned int count, const osg::Vec3d* v) override { receiver_.begin(v, count); }
  void setVertexArray(unsigned int count, const osg::Vec4d* v) override { receiver_.begin(v, count); }

  void drawArrays(GLenum mode, GLint first, GLsizei count) override {
    if (first < 0 || count < 0) return;
    decompose(mode, static_cast<std::uint64_t>(count), false,
              [first](std::uint64_t i) { return static_cast<std::uint64_t>(first) + i; });
  }
  void drawElements(GLenum mode, GLsizei count, const GLubyte* indices) override { elements(mode, count, indices); }
  void drawElements(GLenum mode, GLsizei count, const GLushort* indices) override { elements(mode, count, indices); }
  void drawElements(GLenum mode, GLsizei count, const GLuint* indices) override { elements(mode, count, indices); }

 private:
  bool begin_integers(const osg::Array& array) {
    // Small geometries are many, and the casts below take longer than their triangles.
    if (array.getDataType() == GL_FLOAT || array.getDataType() == GL_DOUBLE) return false;
    return begin_any<osg::Vec2bArray, osg::Vec3bArray, osg::Vec4bArray, osg::Vec2sArray, osg::Vec3sArray,
                     osg::Vec4sArray, osg::Vec2iArray, osg::Vec3iArray, osg::Vec4iArray, osg::Vec2ubArray,
                     osg::Vec3ubArray, osg::Vec4ubArray, osg::Vec2usArray, osg::Vec3usArray, osg::Vec4usArray,
                     osg::Vec2uiArray, osg::Vec3uiArray, osg::Vec4uiArray>(array);
  }
  template <class... Arrays>
  bool begin_any(const osg::Array& array) {
    const auto begin_as = [&]<class Array>(const Array* same) {
      if (same != nullptr) receiver_.begin(same->asVector().data(), same->size());
      return same != nullptr;
    };
    return (begin_as(dynamic_cast<const Arrays*>(&array)) || ...);
  }
  template <class Index>
  void elements(GLenum mode, GLsizei count, const Index* indices) {
    if (count < 0 || indices == nullptr) return;
    decompose(mode, static_cast<std::uint64_t>(count), true,
              [indices](std::uint64_t i) { return static_cast<std::uint64_t>(indices[i]); });
  }

  template <class IndexOf>
  void decompose(GLenum mode, std::uint64_t count, bool indexed, IndexOf index_of) {
    const auto triangle = [&](std::uint64_t a, std::uint64_t b, std::uint64_t c, unsigned half = 0) {
      receiver_.triangle({index_of(a), index_of(b), index_of(c), primitive_, half, indexed});
    };
    const auto single = [&](std::uint64_t a, std::uint64_t b, std::uint64_t c) {
      triangle(a, b, c);
      ++primitive_;
    };
    switch (mode) {
      case GL_TRIANGLES:
        for (std::uint64_t i = 2; i < count; i += 3) single(i - 2, i - 1, i);
        break;
      case GL_TRIANGLE_STRIP:
        for (std::uint64_t i = 2; i < count; ++i) single(i - 2 + i % 2, i - 1 - i % 2, i);
        break;
      case GL_TRIANGLE_FAN:
      case GL_POLYGON:
        for (std::uint64_t i = 2; i < count; ++i) single(0, i - 1, i);
        break;
      case GL_QUADS:
        for (std::uint64_t i = 3; i < count; i += 4) {
          triangle(i - 3, i - 2, i - 1, 0);
          triangle(i - 3, i - 1, i, 1);
          ++primitive_;
        }
        break;
      case GL_QUAD_STRIP:
        for (std::uint64_t i = 3; i < count; i += 2) {
          triangle(i - 3, i - 2, i, 0);
          triangle(i - 3, i, i - 1, 1);
          ++primitive_;
        }
        break;
      // Points and lines have no surface, but they are counted.
      case GL_POINTS:
      case GL_LINE_LOOP:
        primitive_ += static_cast<unsigned>(count);
        break;
      case GL_LINES:
        primitive_ += static_cast<unsigned>(count / 2);
        break;
      case GL_LINE_STRIP:
        primitive_ += count == 0 ? 0 : static_cast<unsigned>(count - 1);
        break;
      default:
        break;
    }
  }

  Receiver& receiver_;
  unsigned primitive_ = 0;
};

}  // namespace roam::osg_triangles
