#include "osg_triangles/mesh_of.h"

#include <cmath>
#include <limits>

#include "math/finite.h"
#include "osg_triangles/primitives.h"

namespace roam::osg_triangles {
namespace {

class Collector {
 public:
  Collector(const osg::Matrixd& to_world, Mesh& mesh, std::uint64_t& left_out)
      : to_world_(to_world), mesh_(mesh), left_out_(left_out) {}

  template <class Vertex>
  void begin(const Vertex* vertices, std::size_t count) {
    vertices_ = Vertices(count, vertices);
    index_in_mesh_.assign(vertices_.size(), unseen);
  }

  void triangle(const Corners& t) {
    const std::array<std::uint32_t, 3> corners{corner(t.a), corner(t.b), corner(t.c)};
    for (const std::uint32_t c : corners) {
      if (c == bad) return ++left_out_, void();
    }
    mesh_.triangles.push_back(corners);
  }

 private:
  static constexpr std::uint32_t unseen = std::numeric_limits<std::uint32_t>::max();
  static constexpr std::uint32_t bad = unseen - 1;

  std::uint32_t corner(std::uint64_t i) {
    if (i >= index_in_mesh_.size()) return bad;
    std::uint32_t& index = index_in_mesh_[i];
    if (index == unseen) {
      const osg::Vec3d v = vertices_[i] * to_world_;
      const Vec3 vertex{v.x(), v.y(), v.z()};
      if (is_within_limit(vertex)) {
        index = static_cast<std::uint32_t>(mesh_.vertices.size());
        mesh_.vertices.push_back(vertex);
      } else {
        index = bad;
      }
    }
    return index;
  }

  const osg::Matrixd& to_world_;
  Mesh& mesh_;
  std::uint64_t& left_out_;
  Vertices vertices_;
  std::vector<std::uint32_t> index_in_mesh_;
};

}  // namespace

Mesh mesh_of(const osg::Geometry& geometry, const osg::Matrixd& to_world, std::uint64_t& left_out) {
  Mesh mesh;
  Collector collector(to_world, mesh, left_out);
  Primitives<Collector> primitives(collector);
  primitives.run(geometry);
  return mesh;
}

std::string innermost(const std::vector<std::string>& names) {
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    if (!name->empty()) return *name;
  }
  return "";
}

}  // namespace roam::osg_triangles
