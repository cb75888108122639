#pragma once
/// \file
/// Which properties of a PLY file's vertices say how they look.

#include <vector>

#include "import/reader/display/look.h"
#include "import/reader/mesh_sink.h"
#include "import/reader/ply_header.h"

namespace roam::reader {

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

}  // namespace roam::reader
