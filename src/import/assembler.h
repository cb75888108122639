#pragma once
/// \file
/// Checks and assembly of a reader's meshes into a scene.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "import/stream_receiver.h"

namespace roam::reader {

/// Takes the frames of one reader and appends their meshes to a scene.
class Assembler : public StreamReceiver {
 public:
  /// `mesh_bytes`: most bytes of vertices and triangles that this reader may still send.
  Assembler(ImportedScene& scene, std::size_t ignore_patterns, std::uint64_t mesh_bytes);

  [[nodiscard]] std::uint64_t triangles() const override { return triangles_; }

 private:
  void take_content(FrameKind kind, std::span<const std::byte> payload) override;
  void finish_content(const Totals& totals) override;
  void take_vertices(std::span<const std::byte> payload);
  void take_triangles(std::span<const std::byte> payload);
  void finish_mesh();

  ImportedScene& scene_;
  std::uint64_t vertices_ = 0, triangles_ = 0;

  // The current mesh, in the pieces that arrived. They are joined once their number is known, so nothing grows by
  // copying.
  bool in_mesh_ = false;
  std::string name_;
  std::uint64_t mesh_vertices_ = 0;
  std::vector<std::vector<Vec3>> vertex_pieces_;
  std::vector<std::vector<std::array<std::uint32_t, 3>>> triangle_pieces_;
};

}  // namespace roam::reader
