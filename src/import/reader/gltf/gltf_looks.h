#pragma once
/// \file
/// Looks of surfaces from glTF's materials and vertices.

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <map>
#include <string>

#include "import/reader/display/look.h"
#include "import/reader/gltf/gltf_file.h"
#include "import/reader/gltf/primitive.h"
#include "import/reader/mesh_sink.h"

namespace roam::reader {

class GltfLooks {
 public:
  /// `sink` must have parts. Both must outlive this object. Images are decoded when the sink sends its parts, and
  /// `file` must exist until then.
  GltfLooks(GltfFile& file, MeshSink& sink);

  /// The set of texture coordinates that the primitive's material uses.
  [[nodiscard]] std::uint64_t coordinate_set(const Json& primitive);
  /// Sets the look of the triangles that follow. `linear`: the linear part of their transform.
  void begin(const Json& primitive, const Primitive& read, const glm::dmat3& linear);
  /// The look of a vertex of that primitive.
  [[nodiscard]] VertexLook of(std::uint64_t vertex) const;

 private:
  /// How an image lies on the surface: KHR_texture_transform.
  struct Placement {
    std::uint64_t set = 0;  ///< of texture coordinates
    glm::dvec2 offset{0.0}, scale{1.0};
    double rotation = 0.0;
    bool operator==(const Placement&) const = default;
  };
  struct Material {
    Look look;
    Colour colour = white;
    Placement placement;  ///< of all its images
  };

  const Material& material_of(const Json& primitive);
  [[nodiscard]] Material read(const Json& material);
  /// The image of a material; none if it lies otherwise than the images before.
  [[nodiscard]] TextureId image(const Json& reference, Material& material);
  void read_gloss(const Json& model, Material& to);
  void read_glossiness(const Json& model, Material& to);
  void read_emission(const Json& material, Material& to);
  [[nodiscard]] TextureId texture(const Json& index);

  GltfFile& file_;
  MeshSink& sink_;
  std::string key_;  ///< unique in this process
  std::map<std::uint64_t, Material> materials_;

  // The current primitive.
  const Primitive* primitive_ = nullptr;
  const Material* material_ = nullptr;
  glm::dmat3 normal_matrix_{1.0};
};

}  // namespace roam::reader
