#include "import/reader/osg_geometry.h"

#include <cstdint>
#include <limits>
#include <osg/PrimitiveSet>
#include <vector>

namespace roam::reader {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Collects primitives by index. OpenSceneGraph's own TriangleIndexFunctor trusts the indices of the file.
class TriangleCollector : public osg::PrimitiveIndexFunctor {
 public:
  TriangleCollector(const osg::Matrixd& to_world, const OsgLooks* looks, MeshSink& sink)
      : to_world_(to_world), looks_(looks), sink_(sink) {}

  /// Tells which of the geometry's primitive sets comes next.
  void begin_set(unsigned number) { set_ = number; }

  void setVertexArray(unsigned int count, const osg::Vec2* v) override { set(count, v); }
  void setVertexArray(unsigned int count, const osg::Vec3* v) override { set(count, v); }
  void setVertexArray(unsigned int count, const osg::Vec4* v) override { set(count, v); }
  void setVertexArray(unsigned int count, const osg::Vec2d* v) override { set(count, v); }
  void setVertexArray(unsigned int count, const osg::Vec3d* v) override { set(count, v); }
  void setVertexArray(unsigned int count, const osg::Vec4d* v) override { set(count, v); }

  void drawArrays(GLenum mode, GLint first, GLsizei count) override {
    if (first < 0 || count < 0) return;
    primitive(mode, static_cast<std::uint64_t>(count), true,
              [first](std::uint64_t i) { return static_cast<std::uint64_t>(first) + i; });
  }
  void drawElements(GLenum mode, GLsizei count, const GLubyte* indices) override { elements(mode, count, indices); }
  void drawElements(GLenum mode, GLsizei count, const GLushort* indices) override { elements(mode, count, indices); }
  void drawElements(GLenum mode, GLsizei count, const GLuint* indices) override { elements(mode, count, indices); }

 private:
  static osg::Vec3d point(const osg::Vec2& v) { return {v.x(), v.y(), 0.0}; }
  static osg::Vec3d point(const osg::Vec3& v) { return {v.x(), v.y(), v.z()}; }
  static osg::Vec3d point(const osg::Vec2d& v) { return {v.x(), v.y(), 0.0}; }
  static osg::Vec3d point(const osg::Vec3d& v) { return v; }
  static osg::Vec3d point(const osg::Vec4& v) { return point(osg::Vec4d(v)); }
  // OpenGL divides by w; most files have 1 there.
  static osg::Vec3d point(const osg::Vec4d& v) { return osg::Vec3d(v.x() / v.w(), v.y() / v.w(), v.z() / v.w()); }

  template <class Vertex>
  void set(unsigned int count, const Vertex* vertices) {
    count_ = vertices == nullptr ? 0 : count;
    vertices_ = vertices;
    is_float_ = std::is_same_v<typename Vertex::value_type, float>;
    get_ = [](const void* array, std::uint64_t i) { return point(static_cast<const Vertex*>(array)[i]); };
    index_in_object_.assign(count_, none);
  }

  template <class Index>
  void elements(GLenum mode, GLsizei count, const Index* indices) {
    if (count < 0 || indices == nullptr) return;
    primitive(mode, static_cast<std::uint64_t>(count), false,
              [indices](std::uint64_t i) { return static_cast<std::uint64_t>(indices[i]); });
  }

  std::uint32_t corner(std::uint64_t i, bool unindexed) {
    if (i >= count_) return none;
    std::uint32_t& index = index_in_object_[i];
    if (index == none) {
      const osg::Vec3d in_file = get_(vertices_, i);
      if (is_float_) {
        for (int k = 0; k < 3; ++k) sink_.note_rounded(in_file[k]);
      }
      const osg::Vec3d w = in_file * to_world_;
      const Vec3 v{w.x(), w.y(), w.z()};
      const VertexLook look = looks_ == nullptr ? VertexLook{} : looks_->of(i, set_);
      // Arrays without indices repeat the vertices that triangles share.
      index = unindexed ? sink_.add_shared_vertex(v, look) : sink_.add_vertex(v, look);
    }
    return index;
  }

  template <class IndexOf>
  void primitive(GLenum mode, std::uint64_t count, bool unindexed, IndexOf index_of) {
    const auto triangle = [&](std::uint64_t a, std::uint64_t b, std::uint64_t c) {
      const std::uint32_t ia = corner(index_of(a), unindexed);
      const std::uint32_t ib = corner(index_of(b), unindexed);
      sink_.add_triangle(ia, ib, corner(index_of(c), unindexed));
    };
    switch (mode) {
      case GL_TRIANGLES:
        for (std::uint64_t i = 2; i < count; i += 3) triangle(i - 2, i - 1, i);
        break;
      case GL_TRIANGLE_STRIP:
        for (std::uint64_t i = 2; i < count; ++i) triangle(i - 2 + i % 2, i - 1 - i % 2, i);
        break;
      case GL_TRIANGLE_FAN:
      case GL_POLYGON:
        for (std::uint64_t i = 2; i < count; ++i) triangle(0, i - 1, i);
        break;
      case GL_QUADS:
        for (std::uint64_t i = 3; i < count; i += 4) {
          triangle(i - 3, i - 2, i - 1);
          triangle(i - 3, i - 1, i);
        }
        break;
      case GL_QUAD_STRIP:
        for (std::uint64_t i = 3; i < count; i += 2) {
          triangle(i - 3, i - 2, i);
          triangle(i - 3, i, i - 1);
        }
        break;
      default:  // points and lines have no surface
        break;
    }
  }

  const osg::Matrixd& to_world_;
  const OsgLooks* looks_;
  MeshSink& sink_;
  unsigned set_ = 0;
  std::uint64_t count_ = 0;
  const void* vertices_ = nullptr;
  bool is_float_ = false;
  osg::Vec3d (*get_)(const void*, std::uint64_t) = nullptr;
  std::vector<std::uint32_t> index_in_object_;
};

}  // namespace

void add_geometry(const osg::Geometry& geometry, const osg::Matrixd& to_world, const OsgLooks* looks, MeshSink& sink) {
  TriangleCollector collector(to_world, looks, sink);
  if (looks == nullptr || !looks->by_set()) return geometry.accept(collector);
  // The functor is not told which primitive set it is given, so that each comes alone; a vertex of two sets that look
  // different is two vertices.
  for (unsigned i = 0; i < geometry.getNumPrimitiveSets(); ++i) {
    const osg::ref_ptr<osg::Geometry> one = new osg::Geometry(geometry, osg::CopyOp::SHALLOW_COPY);
    one->setPrimitiveSetList({const_cast<osg::PrimitiveSet*>(geometry.getPrimitiveSet(i))});
    collector.begin_set(i);
    one->accept(collector);
  }
}

}  // namespace roam::reader
