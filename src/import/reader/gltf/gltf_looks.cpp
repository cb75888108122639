#include "import/reader/gltf/gltf_looks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "files/escaped.h"
#include "import/reader/display/normal_matrix.h"
#include "import/reader/named_file.h"

namespace roam::reader {
namespace {

constexpr std::uint64_t no_material = std::numeric_limits<std::uint64_t>::max();

/// The sRGB transfer function (IEC 61966-2-1). glTF's colours are linear; images and screens are not.
double to_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

Colour shown(double red, double green, double blue, double opacity) {
  return {colour_byte(to_srgb(red)), colour_byte(to_srgb(green)), colour_byte(to_srgb(blue)), colour_byte(opacity)};
}

/// A share of 0 to 1, to 1/16: materials that look alike are drawn together.
float rounded(double value) {
  constexpr double steps = 16.0;
  return static_cast<float>(std::round(steps * std::clamp(value > 0.0 ? value : 0.0, 0.0, 1.0)) / steps);
}
float share_of(const Json& factor, double otherwise) { return rounded(number(factor, otherwise)); }

using Linear = glm::dvec3;  ///< red, green, blue

double brightness(const Linear& c) { return std::sqrt(0.299 * c.r * c.r + 0.587 * c.g * c.g + 0.114 * c.b * c.b); }

/// Reflectance of surfaces that are not metal.
constexpr double dielectric = 0.04;

/// The metalness with which a surface looks as one of this diffuse and specular colour: the root of a quadratic
/// equation in appendix B of KHR_materials_pbrSpecularGlossiness.
double metalness_of(const Linear& diffuse, const Linear& specular) {
  const double mirrored = brightness(specular);
  if (mirrored < dielectric) return 0.0;
  const double rest = 1.0 - std::max({specular.r, specular.g, specular.b});
  const double b = brightness(diffuse) * rest / (1.0 - dielectric) + mirrored - 2.0 * dielectric;
  const double root = std::sqrt(std::max(0.0, b * b - 4.0 * dielectric * (dielectric - mirrored)));
  return std::clamp((root - b) / (2.0 * dielectric), 0.0, 1.0);
}

/// Its base colour.
Linear base_of(const Linear& diffuse, const Linear& specular, double metalness) {
  constexpr double least = 1e-6;
  const double rest = 1.0 - std::max({specular.r, specular.g, specular.b});
  const Linear as_matt = diffuse * (rest / ((1.0 - dielectric) * std::max(1.0 - metalness, least)));
  const Linear as_metal = (specular - dielectric * (1.0 - metalness)) / std::max(metalness, least);
  const double share = metalness * metalness;
  return glm::clamp(as_matt * (1.0 - share) + as_metal * share, 0.0, 1.0);
}

DisplayWrap wrap_of(const Json& mode) {
  constexpr std::uint64_t clamp_to_edge = 33071, mirrored_repeat = 33648;
  const std::uint64_t value = whole_number(mode).value_or(0);
  if (value == clamp_to_edge) return DisplayWrap::clamp;
  return value == mirrored_repeat ? DisplayWrap::mirror : DisplayWrap::repeat;
}

/// An extension for an image whose first bytes do not state its format.
std::string extension_of_type(const std::string& type) {
  const std::size_t slash = type.find('/');
  std::string extension;
  if (slash != std::string::npos) extension.append(1, '.').append(type, slash + 1);
  return extension;
}

/// Images that are read after the file of the same name was read before must not be taken for those.
std::string unique_key(const std::string& path) {
  static std::uint64_t number = 0;
  return fmt::format("{} {}", ++number, path);
}

}  // namespace

GltfLooks::GltfLooks(GltfFile& file, MeshSink& sink)
    : file_(file), sink_(sink), key_(unique_key(file.path().string())) {}

std::uint64_t GltfLooks::coordinate_set(const Json& primitive) { return material_of(primitive).placement.set; }

const GltfLooks::Material& GltfLooks::material_of(const Json& primitive) {
  const std::uint64_t index = whole_number(member(primitive, "material")).value_or(no_material);
  const auto [at, is_new] = materials_.try_emplace(index);
  if (is_new) at->second = read(element(member(file_.json(), "materials"), index));
  return at->second;
}

GltfLooks::Material GltfLooks::read(const Json& from) {
  Material material;
  const Json& glossy = member(from, "extensions", "KHR_materials_pbrSpecularGlossiness");
  const bool metallic = member(from, "pbrMetallicRoughness").is_object() || !glossy.is_object();
  const Json& model = metallic ? member(from, "pbrMetallicRoughness") : glossy;
  material.look.texture = image(member(model, metallic ? "baseColorTexture" : "diffuseTexture"), material);
  if (const auto c = numbers(member(model, metallic ? "baseColorFactor" : "diffuseFactor"), 4)) {
    material.colour = shown((*c)[0], (*c)[1], (*c)[2], (*c)[3]);
  }
  // An invisible surface would still stop a body, so show it.
  if (material.colour[3] == 0) material.colour[3] = 255;
  const std::string mode = text(member(from, "alphaMode"));
  if (mode == "BLEND") material.look.transparency = Transparency::blend;
  if (mode == "MASK") {
    material.look.transparency = Transparency::mask;
    material.look.cutoff = static_cast<float>(number(member(from, "alphaCutoff"), 0.5));
  }
  metallic ? read_gloss(model, material) : read_glossiness(model, material);
  read_emission(from, material);
  return material;
}

void GltfLooks::read_gloss(const Json& model, Material& to) {
  const Json& reference = member(model, "metallicRoughnessTexture");
  const TextureId texture = image(reference, to);
  // The image alone says where a surface is metal.
  if (reference.is_object() && texture == no_texture) return;
  const float roughness = share_of(member(model, "roughnessFactor"), 1.0);
  if (roughness >= 1.0f && texture == no_texture) return;  // dull, whether metal or not
  to.look.gloss_texture = texture;
  to.look.roughness = roughness;
  to.look.metalness = share_of(member(model, "metallicFactor"), 1.0);
}

/// Metals are black in the diffuse colour, so it is converted. Where an image has the colours, it is taken as it is.
void GltfLooks::read_glossiness(const Json& model, Material& to) {
  if (member(model, "specularGlossinessTexture").is_object()) return;
  to.look.roughness = rounded(1.0 - number(member(model, "glossinessFactor"), 1.0));
  if (member(model, "diffuseTexture").is_object()) return;
  const auto factor = [&](const char* name, std::size_t count) {
    const auto c = numbers(member(model, name), count);
    return c ? glm::clamp(Linear((*c)[0], (*c)[1], (*c)[2]), 0.0, 1.0) : Linear(1.0);
  };
  const Linear diffuse = factor("diffuseFactor", 4), specular = factor("specularFactor", 3);
  const double metalness = metalness_of(diffuse, specular);
  const Linear base = base_of(diffuse, specular, metalness);
  const Colour colour = shown(base.r, base.g, base.b, 0.0);
  std::copy_n(colour.begin(), 3, to.colour.begin());
  to.look.metalness = rounded(metalness);
}

void GltfLooks::read_emission(const Json& material, Material& to) {
  const auto factor = numbers(member(material, "emissiveFactor"), 3);
  if (!factor) return;
  const Json& brighter = member(material, "extensions", "KHR_materials_emissive_strength");
  const double strength = number(member(brighter, "emissiveStrength"), 1.0);
  const Colour emission = shown((*factor)[0] * strength, (*factor)[1] * strength, (*factor)[2] * strength, 0.0);
  if (emission == Colour{}) return;
  const Json& reference = member(material, "emissiveTexture");
  to.look.emission_texture = image(reference, to);
  if (!reference.is_object() || to.look.emission_texture != no_texture) to.look.emission = emission;
}

TextureId GltfLooks::image(const Json& reference, Material& material) {
  if (!reference.is_object()) return no_texture;
  Placement lies;
  lies.set = whole_number(member(reference, "texCoord")).value_or(0);
  if (const Json& moved = member(reference, "extensions", "KHR_texture_transform"); moved.is_object()) {
    if (const auto o = numbers(member(moved, "offset"), 2)) lies.offset = {(*o)[0], (*o)[1]};
    if (const auto s = numbers(member(moved, "scale"), 2)) lies.scale = {(*s)[0], (*s)[1]};
    lies.rotation = number(member(moved, "rotation"), 0.0);
    lies.set = whole_number(member(moved, "texCoord")).value_or(lies.set);
  }
  const bool is_first = material.look.image() == no_texture;
  if (!is_first && !(lies == material.placement)) return no_texture;
  const TextureId found = texture(member(reference, "index"));
  if (found != no_texture) material.placement = lies;
  return found;
}

TextureId GltfLooks::texture(const Json& index) {
  const Json& json = file_.json();
  const Json& texture = element(member(json, "textures"), whole_number(index).value_or(no_material));
  Json source = member(texture, "source");
  // Images that only newer programs decode count as missing.
  for (const char* extension : {"EXT_texture_webp", "KHR_texture_basisu", "EXT_texture_avif"}) {
    if (source.is_null()) source = member(member(texture, "extensions", extension), "source");
  }
  const auto number = whole_number(source);
  const Json& image = element(member(json, "images"), number.value_or(no_material));
  if (!number || !image.is_object()) return no_texture;
  const auto sampler = whole_number(member(texture, "sampler"));
  const Json& wraps = element(member(json, "samplers"), sampler.value_or(no_material));
  const Wrapping wrapping{wrap_of(member(wraps, "wrapS")), wrap_of(member(wraps, "wrapT"))};

  const std::string uri = text(member(image, "uri"));
  const std::string key =
      fmt::format("{} image {}{}", key_, *number, extension_of_type(text(member(image, "mimeType"))));
  Textures& textures = sink_.parts()->textures();
  if (uri.starts_with("data:")) {
    return textures.add_encoded(
        key, [uri] { return data_of(uri).value_or(""); }, wrapping);
  }
  if (!uri.empty()) return textures.add_file(file_.path().parent_path(), files::unescaped(uri), wrapping);
  const auto view = whole_number(member(image, "bufferView"));
  if (!view) return no_texture;
  const auto bytes = [&file = file_, view = *view] {
    const std::span<const std::byte> inside = file.view(view);
    return std::string(reinterpret_cast<const char*>(inside.data()), inside.size());
  };
  return textures.add_encoded(key, bytes, wrapping);
}

void GltfLooks::begin(const Json& primitive, const Primitive& read, const glm::dmat3& linear) {
  primitive_ = &read;
  material_ = &material_of(primitive);
  normal_matrix_ = normal_matrix(linear);
  Look look = material_->look;
  if (!read.coordinates && look.image() != no_texture) {
    look.texture = no_texture;
    if (std::exchange(look.gloss_texture, no_texture) != no_texture) look.roughness = 1.0f;
    if (std::exchange(look.emission_texture, no_texture) != no_texture) look.emission = {};
  }
  sink_.set_look(look);
}

VertexLook GltfLooks::of(std::uint64_t vertex) const {
  VertexLook look;
  look.colour = material_->colour;
  if (primitive_->normals) look.normal = transformed_normal(normal_matrix_, primitive_->normals->vector(vertex));
  if (const auto& colours = primitive_->colours) {
    const double opacity = colours->components() > 3 ? colours->at(vertex, 3) : 1.0;
    look.colour = look.colour * shown(colours->at(vertex, 0), colours->at(vertex, 1), colours->at(vertex, 2), opacity);
  }
  if (const auto& coordinates = primitive_->coordinates) {
    const Placement& m = material_->placement;
    const double u = coordinates->at(vertex, 0) * m.scale.x, v = coordinates->at(vertex, 1) * m.scale.y;
    const double cosine = std::cos(m.rotation), sine = std::sin(m.rotation);
    // glTF's zero is at the upper edge of the image.
    look.texture = {static_cast<float>(cosine * u + sine * v + m.offset.x),
                    static_cast<float>(1.0 - (cosine * v - sine * u + m.offset.y))};
  }
  return look;
}

}  // namespace roam::reader
