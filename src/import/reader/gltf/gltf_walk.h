#pragma once
/// \file
/// The nodes of a glTF file, from its scene to its triangles.

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "import/reader/gltf/gltf_file.h"
#include "import/reader/gltf/gltf_looks.h"
#include "import/reader/gltf/primitive.h"
#include "import/reader/mesh_sink.h"

namespace roam::reader {

class GltfWalk {
 public:
  /// `stem`: the name of objects without one. All must outlive this object. Looks are read if the sink has parts.
  GltfWalk(GltfFile& file, std::string stem, MeshSink& sink);

  /// Adds the triangles of the file's scene, transformed in doubles: first by its nodes, then by `inner`, by the
  /// translation of CESIUM_RTC, and by `outer`. May be called again for further instances. Throws roam::Error for a
  /// damaged file; then the parts until the damage are sent.
  void walk(const glm::dmat4& outer, const glm::dmat4& inner);
  /// Images are decoded here. Must be called before the file is destroyed.
  void finish() { sink_.send_parts(); }

 private:
  void walk_scene(const glm::dmat4& outer, const glm::dmat4& inner);
  void walk_node(std::uint64_t node, const glm::dmat4& parent);
  void add_mesh(const Json& node, const glm::dmat4& to_sink);
  void add(const Json& described, const Primitive& primitive, const glm::dmat4& to_sink);
  const Primitive* primitive(std::uint64_t mesh, std::uint64_t index, const Json& described);
  [[nodiscard]] std::vector<glm::dmat4> instances(const Json& node);
  void say_what_is_unknown();

  GltfFile& file_;
  std::string stem_;
  MeshSink& sink_;
  std::optional<GltfLooks> looks_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::optional<Primitive>> primitives_;
  std::vector<std::string> names_;
  std::vector<bool> visited_;
  std::vector<std::uint32_t> index_;  ///< of each vertex of the primitive, in the sink's object
};

}  // namespace roam::reader
