#pragma once
/// \file
/// Decompression of KHR_draco_mesh_compression.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "import/reader/gltf/elements.h"

namespace draco {
class Mesh;
}  // namespace draco

namespace roam::reader {

class DracoMesh {
 public:
  /// Decodes a buffer view.
  explicit DracoMesh(std::span<const std::byte> bytes);
  ~DracoMesh();
  DracoMesh(const DracoMesh&) = delete;
  DracoMesh& operator=(const DracoMesh&) = delete;

  /// Whether the bytes are a mesh of triangles.
  [[nodiscard]] bool is_whole() const { return mesh_ != nullptr; }
  /// The values of the attribute with this unique id, one for each vertex; unset if there is none. `normalized`: the
  /// glTF file says that integers mean 0 to 1, or -1 to 1. Requires is_whole().
  [[nodiscard]] std::optional<Elements> attribute(std::uint64_t id, bool normalized) const;
  /// Three vertices for each triangle. Requires is_whole().
  [[nodiscard]] Elements indices() const;

 private:
  std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace roam::reader
