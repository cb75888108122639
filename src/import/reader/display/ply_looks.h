#pragma once
/// \file
/// Which properties of a PLY file say how it looks.

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "import/reader/display/look.h"
#include "import/reader/mesh_sink.h"
#include "import/reader/ply_header.h"

namespace roam::reader {

/// Those of vertices.
class PlyLooks {
 public:
  /// Where `sink` has parts, sets the look of the triangles that follow; else wants nothing.
  PlyLooks(const PlyElement& vertex, const PlyHeader& header, const std::filesystem::path& file, MeshSink& sink);

  [[nodiscard]] bool wants(std::size_t property) const { return roles_[property] != Role::none; }
  /// Puts a value of a wanted property into the look.
  void take(std::size_t property, double value, VertexLook& look) const;

 private:
  enum class Role { none, normal_x, normal_y, normal_z, red, green, blue, across, up };

  std::vector<Role> roles_;
  std::vector<double> one_;  ///< the value of each property that stands for 1
};

/// Those of faces: each corner of a face has its own place in an image, which programs that cut a surface into pieces
/// of image write.
class PlyWedges {
 public:
  /// Where `sink` has parts and some face such places, wants vertices; else nothing.
  PlyWedges(const PlyHeader& header, const std::filesystem::path& file, MeshSink& sink);

  [[nodiscard]] bool wanted() const { return !looks_.empty(); }
  [[nodiscard]] bool is_coordinates(const PlyProperty& property) const;
  [[nodiscard]] bool is_image(const PlyProperty& property) const;

  void add_vertex(const Vec3& place, const VertexLook& look) { vertices_.push_back({place, look}); }
  [[nodiscard]] std::uint64_t vertex_count() const { return vertices_.size(); }
  /// Adds a face whose corners are vertices, with two numbers each for the place in image number `image`, or none.
  void add_face(std::span<const std::uint32_t> corners, std::span<const double> coordinates, std::int64_t image);

 private:
  struct Vertex {
    Vec3 place;
    VertexLook look;
  };

  MeshSink& sink_;
  std::vector<Look> looks_;  ///< of each image
  std::vector<Vertex> vertices_;
};

}  // namespace roam::reader
