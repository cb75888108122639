#pragma once
/// \file
/// Looks of surfaces from assimp's materials and vertices.

#include <assimp/scene.h>

#include <filesystem>
#include <glm/mat3x3.hpp>
#include <map>
#include <string>

#include "import/reader/display/look.h"
#include "import/reader/mesh_sink.h"

namespace roam::reader {

class AssimpLooks {
 public:
  /// `extension`: of the scene's file, lower case without the dot. `sink` must have parts. All must outlive this
  /// object.
  AssimpLooks(const aiScene& scene, const std::filesystem::path& file, std::string extension, MeshSink& sink);

  /// Sets the mesh's material for the triangles that follow. `linear`: the linear part of the mesh's transform.
  void begin_mesh(const aiMesh& mesh, const glm::dmat3& linear);
  /// The look of a vertex of the current mesh.
  [[nodiscard]] VertexLook of(unsigned vertex) const;

 private:
  struct Material {
    Look look;
    Colour colour = white;
    unsigned coordinates = 0;  ///< the number of the mesh's set of texture coordinates
  };

  Material material_of(const aiMaterial& material);
  TextureId texture_of(const aiMaterial& material, unsigned& coordinates);
  TextureId embedded(const aiTexture& texture, const std::string& name, Wrapping wrapping);
  void take_gltf_transparency(const aiMaterial& material, Look& look) const;
  static void take_gltf_gloss(const aiMaterial& material, Look& look);
  [[nodiscard]] Colour shown(const aiColor4D& colour) const;

  const aiScene& scene_;
  std::filesystem::path folder_;
  std::string extension_;
  bool gltf_;
  MeshSink& sink_;
  std::map<unsigned, Material> materials_;

  // The current mesh.
  const aiMesh* mesh_ = nullptr;
  const Material* material_ = nullptr;
  glm::dmat3 normal_matrix_{1.0};
};

}  // namespace roam::reader
