#pragma once
/// \file
/// The properties of a PLY file that describe its look.

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "import/reader/display/look.h"
#include "import/reader/mesh_sink.h"
#include "import/reader/ply_header.h"

namespace roam::reader {

/// The properties of vertices.
class PlyLooks {
 public:
  /// If `sink` has parts, sets the look of the triangles that follow. Otherwise wants no property.
  PlyLooks(const PlyElement& vertex, const PlyHeader& header, const std::filesystem::path& file, MeshSink& sink);

  [[nodiscard]] bool wants(std::size_t property) const { return roles_[property] != none; }
  /// Stores the value of a wanted property in the look.
  void take(std::size_t property, double value, VertexLook& look) const;

 private:
  /// Numbers of a look, in the order of their places.
  enum Role { normal_x, normal_y, normal_z, red, green, blue, across, up, none };

  std::vector<Role> roles_;
  std::vector<double> one_;  ///< for each property, the value that means 1
};

/// The properties of faces. Programs that cut a surface into pieces of an image give each corner of a face its own
/// texture coordinates.
class PlyWedges {
 public:
  /// Wants vertices if `sink` has parts and some faces have such coordinates.
  PlyWedges(const PlyHeader& header, const std::filesystem::path& file, MeshSink& sink);

  [[nodiscard]] bool wanted() const { return !looks_.empty(); }
  [[nodiscard]] bool is_coordinates(const PlyProperty& property) const;
  [[nodiscard]] bool is_image(const PlyProperty& property) const;

  void add_vertex(const Vec3& place, const VertexLook& look) { vertices_.push_back({place, look}); }
  [[nodiscard]] std::uint64_t vertex_count() const { return vertices_.size(); }
  /// Adds a face. `corners` are vertex indices; `coordinates` has two numbers for each corner in image number `image`,
  /// or is empty.
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
