#pragma once
/// \file
/// A primitive of a glTF mesh, plain or compressed by KHR_draco_mesh_compression.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "import/reader/gltf/elements.h"
#include "import/reader/gltf/gltf_file.h"
#include "import/reader/json.h"

namespace roam::reader {

struct Primitive {
  Elements positions;
  std::optional<Elements> normals, colours;
  std::optional<Elements> coordinates;  ///< texture coordinates of the set that was requested
  std::optional<Elements> indices;
  std::uint64_t mode = triangles;
  std::string damaged_looks{};  ///< the name of an attribute that is left out because it is damaged

  static constexpr std::uint64_t triangles = 4, triangle_strip = 5, triangle_fan = 6;

  /// Calls `take` with the vertices of each triangle, in the order of the file. Vertices may be out of range.
  void each_triangle(const std::function<void(const std::array<std::uint32_t, 3>&)>& take) const;
};

/// Whether the primitive has triangles, not points or lines.
[[nodiscard]] bool has_triangles(const Json& primitive);

/// Reads a primitive with triangles; unset if it has no positions. Without `looks`, reads only what a body collides
/// with. `set`: of texture coordinates. Throws roam::Error if it is damaged. A damaged attribute that only looks have
/// is left out, so that bodies collide with the triangles that are shown.
[[nodiscard]] std::optional<Primitive> read_primitive(GltfFile& file, const Json& primitive, bool looks,
                                                      std::uint64_t set);

}  // namespace roam::reader
