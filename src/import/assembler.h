#pragma once
/// \file
/// Assembly of a reader's meshes into a scene.

#include <string>
#include <vector>

#include "import/mesh_receiver.h"

namespace roam::reader {

/// Takes the frames of one reader and appends their meshes to a scene.
class Assembler : public MeshReceiver {
 public:
  /// `mesh_bytes`: most bytes of vertices and triangles that this reader may still send.
  Assembler(ImportedScene& scene, std::size_t ignore_patterns, std::uint64_t mesh_bytes)
      : MeshReceiver(scene.report, ignore_patterns, mesh_bytes), scene_(scene) {}

 private:
  void begin(std::string name, bool continues) override;
  std::span<Vec3> more_vertices(std::size_t count) override { return vertex_pieces_.emplace_back(count); }
  std::span<Corners> more_triangles(std::size_t count) override { return triangle_pieces_.emplace_back(count); }
  void finish() override;

  ImportedScene& scene_;
  // The current mesh, in the pieces that arrived. They are joined once their number is known, so nothing grows by
  // copying.
  std::string name_;
  std::vector<std::vector<Vec3>> vertex_pieces_;
  std::vector<std::vector<Corners>> triangle_pieces_;
};

}  // namespace roam::reader
