#include "import/reader/osg_geometry.h"

#include <cstdint>
#include <limits>
#include <vector>

#include "osg_triangles/primitives.h"

namespace roam::reader {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// Adds triangles to the sink.
class TriangleCollector {
 public:
  TriangleCollector(const osg::Matrixd& to_world, const OsgLooks* looks, MeshSink& sink)
      : to_world_(to_world), looks_(looks), sink_(sink) {}

  /// Sets the number of the primitive set whose triangles follow.
  void begin_set(unsigned number) { set_ = number; }

  // Interface of osg_triangles::Primitives.
  template <class Vertex>
  void begin(const Vertex* vertices, std::size_t count) {
    vertices_ = osg_triangles::Vertices(count, vertices);
    index_in_object_.assign(vertices_.size(), none);
  }
  void triangle(const osg_triangles::Corners& t) {
    const std::uint32_t a = corner(t.a, t.indexed);
    const std::uint32_t b = corner(t.b, t.indexed);
    sink_.add_triangle(a, b, corner(t.c, t.indexed));
  }

 private:
  std::uint32_t corner(std::uint64_t i, bool indexed) {
    if (i >= vertices_.size()) return none;
    std::uint32_t& index = index_in_object_[i];
    if (index == none) {
      const osg::Vec3d in_file = vertices_[i];
      if (vertices_.is_float()) {
        for (int k = 0; k < 3; ++k) sink_.note_rounded(in_file[k]);
      }
      const osg::Vec3d w = in_file * to_world_;
      const Vec3 v{w.x(), w.y(), w.z()};
      const VertexLook look = looks_ == nullptr ? VertexLook{} : looks_->of(i, set_);
      // Arrays without indices repeat the vertices that triangles share.
      index = indexed ? sink_.add_vertex(v, look) : sink_.add_shared_vertex(v, look);
    }
    return index;
  }

  const osg::Matrixd& to_world_;
  const OsgLooks* looks_;
  MeshSink& sink_;
  unsigned set_ = 0;
  osg_triangles::Vertices vertices_;
  std::vector<std::uint32_t> index_in_object_;
};

}  // namespace

void add_geometry(const osg::Geometry& geometry, const osg::Matrixd& to_world, const OsgLooks* looks, MeshSink& sink) {
  TriangleCollector collector(to_world, looks, sink);
  osg_triangles::Primitives<TriangleCollector> primitives(collector);
  if (looks == nullptr || !looks->by_set()) return primitives.run(geometry);
  // The functor does not receive the number of the primitive set, so each set is visited alone. A vertex with different
  // looks in two sets becomes two vertices.
  for (unsigned i = 0; i < geometry.getNumPrimitiveSets(); ++i) {
    const osg::ref_ptr<osg::Geometry> one = new osg::Geometry(geometry, osg::CopyOp::SHALLOW_COPY);
    one->setPrimitiveSetList({const_cast<osg::PrimitiveSet*>(geometry.getPrimitiveSet(i))});
    collector.begin_set(i);
    primitives.run(*one);
  }
}

}  // namespace roam::reader
