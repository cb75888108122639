#include "import/reader/display/assimp_looks.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "import/reader/display/normal_matrix.h"

namespace roam::reader {
namespace {

/// The sRGB transfer function (IEC 61966-2-1). glTF's colours are linear; images and screens are not.
double to_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

/// A value of a material, limited to 0..1; `otherwise` if there is none, or it is no number.
float share_of(const aiMaterial& material, const char* key, unsigned type, unsigned index, float otherwise) {
  float value = otherwise;
  material.Get(key, type, index, value);
  return std::isnan(value) ? otherwise : std::clamp(value, 0.0f, 1.0f);
}

DisplayWrap wrap_of(aiTextureMapMode mode) {
  switch (mode) {
    case aiTextureMapMode_Clamp:
    case aiTextureMapMode_Decal:
      return DisplayWrap::clamp;
    case aiTextureMapMode_Mirror:
      return DisplayWrap::mirror;
    default:
      return DisplayWrap::repeat;
  }
}

/// An uncompressed embedded image as a TGA file, whose texels have the same order.
std::string as_tga(const aiTexture& texture) {
  std::string bytes(18, '\0');
  bytes[2] = 2;  // true colour
  const auto put = [&](std::size_t at, unsigned value) {
    bytes[at] = static_cast<char>(value & 0xff);
    bytes[at + 1] = static_cast<char>(value >> 8 & 0xff);
  };
  put(12, texture.mWidth);
  put(14, texture.mHeight);
  bytes[16] = 32;
  bytes[17] = 0x28;  // eight bits of opacity, top row first
  const auto* texels = reinterpret_cast<const char*>(texture.pcData);
  return bytes.append(texels, sizeof(aiTexel) * texture.mWidth * texture.mHeight);
}

}  // namespace

AssimpLooks::AssimpLooks(const aiScene& scene, const std::filesystem::path& file, std::string extension, MeshSink& sink)
    : scene_(scene),
      folder_(file.parent_path()),
      extension_(std::move(extension)),
      gltf_(extension_ == "glb" || extension_ == "gltf"),
      sink_(sink) {}

void AssimpLooks::begin_mesh(const aiMesh& mesh, const glm::dmat3& linear) {
  mesh_ = &mesh;
  normal_matrix_ = normal_matrix(linear);
  const auto [at, is_new] = materials_.try_emplace(mesh.mMaterialIndex);
  if (is_new && mesh.mMaterialIndex < scene_.mNumMaterials) {
    at->second = material_of(*scene_.mMaterials[mesh.mMaterialIndex]);
  }
  material_ = &at->second;
  Look look = material_->look;
  if (!mesh.HasTextureCoords(material_->coordinates)) look.texture = no_texture;
  sink_.set_look(look);
}

VertexLook AssimpLooks::of(unsigned i) const {
  VertexLook look;
  look.colour = material_->colour;
  if (mesh_->HasNormals()) {
    const aiVector3D& n = mesh_->mNormals[i];
    look.normal = transformed_normal(normal_matrix_, {n.x, n.y, n.z});
  }
  if (mesh_->HasVertexColors(0)) look.colour = look.colour * shown(mesh_->mColors[0][i]);
  if (mesh_->HasTextureCoords(material_->coordinates)) {
    const aiVector3D& c = mesh_->mTextureCoords[material_->coordinates][i];
    look.texture = {c.x, c.y};
  }
  return look;
}

Colour AssimpLooks::shown(const aiColor4D& c) const {
  const auto byte = [&](double value) { return colour_byte(gltf_ ? to_srgb(value) : value); };
  return {byte(c.r), byte(c.g), byte(c.b), colour_byte(c.a)};
}

AssimpLooks::Material AssimpLooks::material_of(const aiMaterial& from) {
  Material material;
  material.look.texture = texture_of(from, material.coordinates);
  aiColor4D colour(1.0f, 1.0f, 1.0f, 1.0f);
  if (!gltf_ || from.Get(AI_MATKEY_BASE_COLOR, colour) != aiReturn_SUCCESS) {
    from.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
  }
  material.colour = shown(colour);
  // An invisible surface would still stop a body, so show it.
  if (material.colour[3] == 0) material.colour[3] = 255;
  if (gltf_) {
    take_gltf_transparency(from, material.look);
    material.look.roughness = share_of(from, AI_MATKEY_ROUGHNESS_FACTOR, 1.0f);
    material.look.metalness = share_of(from, AI_MATKEY_METALLIC_FACTOR, 0.0f);
    return material;
  }
  float opacity = 1.0f;
  from.Get(AI_MATKEY_OPACITY, opacity);
  // In these formats an image replaces the colour.
  if (material.look.texture != no_texture) material.colour = white;
  material.colour[3] = opacity > 0.0f ? colour_byte(opacity) : 255;
  material.look.transparency = material.colour[3] < 255 ? Transparency::blend : Transparency::by_texture;
  return material;
}

void AssimpLooks::take_gltf_transparency(const aiMaterial& material, Look& look) const {
  aiString mode;
  material.Get(AI_MATKEY_GLTF_ALPHAMODE, mode);
  if (std::strcmp(mode.C_Str(), "BLEND") == 0) look.transparency = Transparency::blend;
  if (std::strcmp(mode.C_Str(), "MASK") == 0) {
    look.transparency = Transparency::mask;
    look.cutoff = share_of(material, AI_MATKEY_GLTF_ALPHACUTOFF, look.cutoff);
  }
}

TextureId AssimpLooks::texture_of(const aiMaterial& material, unsigned& coordinates) {
  for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
    aiString name;
    aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    unsigned set = 0;
    if (material.GetTexture(type, 0, &name, nullptr, &set, nullptr, nullptr, modes) != aiReturn_SUCCESS) continue;
    if (name.length == 0) continue;
    coordinates = set < AI_MAX_NUMBER_OF_TEXTURECOORDS ? set : 0;
    const Wrapping wrapping{wrap_of(modes[0]), wrap_of(modes[1])};
    if (const aiTexture* inside = scene_.GetEmbeddedTexture(name.C_Str())) {
      return embedded(*inside, name.C_Str(), wrapping);
    }
    return sink_.parts()->textures().add_file(folder_, name.C_Str(), wrapping);
  }
  return no_texture;
}

TextureId AssimpLooks::embedded(const aiTexture& texture, const std::string& name, Wrapping wrapping) {
  const bool encoded = texture.mHeight == 0;
  const auto read = [&texture, encoded] {
    if (texture.pcData == nullptr) return std::string();
    return encoded ? std::string(reinterpret_cast<const char*>(texture.pcData), texture.mWidth) : as_tga(texture);
  };
  // The extension names the format of bytes that have no signature.
  const std::string key = name + (encoded ? "" : ".tga");
  return sink_.parts()->textures().add_encoded(key, read, wrapping);
}

}  // namespace roam::reader
