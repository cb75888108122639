// Materials and images of glTF.

#include <string>
#include <vector>

#include "shown_scene.h"

namespace roam::test {
namespace {

std::string base64(const std::string& bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
  }
  return text;
}

/// A triangle with texture coordinates and that material.
std::string gltf(const std::string& material, const std::string& image_uri) {
  std::string buffer;
  for (const float c : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 1.f, 1.f, 1.f, 0.f, 0.f})
    buffer += bytes_of(c);
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"name":"Door","mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
    "materials":[)" +
         material + R"(],"textures":[{"source":0}],"images":[{"uri":")" + image_uri + R"("}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
    {"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}],
    "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24}],
    "buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,)" +
         base64(buffer) + "\"}]}";
}

TEST(ImportDisplayLooks, ReadsMaterialsOfGltf) {
  const TemporaryFolder folder;
  folder.write("wood.bmp", bmp(two_texels));
  const std::string inside = "data:image/bmp;base64," + base64(bmp(two_texels));
  for (const std::string& uri : {std::string("wood.bmp"), inside}) {
    const Shown shown = show({folder.write(
        "a.gltf", gltf(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"baseColorFactor":[1,0.2158605,0,1]},
                           "alphaMode":"MASK","alphaCutoff":0.25})",
                       uri))});
    const ShownTriangle& t = shown.triangles.at(0);
    ASSERT_NE(t.image, nullptr) << uri.substr(0, 20);
    EXPECT_EQ(row_of(*t.image), two_texels);
    // The file's zero is at the image's upper edge, ours at the lower; its factors are linear, ours as on the screen.
    EXPECT_EQ(t.coordinates[0], glm::vec2(0, 0));
    EXPECT_EQ(t.coordinates[2], glm::vec2(0, 1));
    EXPECT_EQ(t.colours[0], (Colour{255, 128, 0, 255}));
    EXPECT_EQ(t.look.cover, DisplayCover::cut);
    EXPECT_EQ(t.look.cutoff, 0.25f);
    EXPECT_EQ(shown.report.textures, 1u);
  }
  const Shown glass = show({folder.write(
      "b.gltf", gltf(R"({"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]},"alphaMode":"BLEND"})", "wood.bmp"))});
  EXPECT_EQ(glass.triangles.at(0).colours[0][3], 128);
  EXPECT_EQ(glass.triangles[0].look.cover, DisplayCover::blended);
  EXPECT_EQ(glass.report.textures, 0u);
  const Shown air = show({folder.write(
      "c.gltf", gltf(R"({"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0]},"alphaMode":"BLEND"})", "wood.bmp"))});
  EXPECT_EQ(air.triangles.at(0).colours[0][3], 255);
}

/// The look of the triangle, and the images of its part.
struct GltfLook {
  DisplayLook look;
  std::vector<DisplayTexture> images;
};
GltfLook look_of(const TemporaryFolder& folder, const std::string& material, const std::string& image = "wood.bmp") {
  const Shown shown = show({folder.write("a.gltf", gltf(material, image))});
  return {shown.triangles.at(0).look, shown.parts.at(0)->textures};
}

TEST(ImportDisplayLooks, ReadsRoughnessAndMetalnessOfGltf) {
  const TemporaryFolder folder;
  folder.write("wood.bmp", bmp({{10, 20, 30}, {40, 50, 60}}));
  const auto gloss = [&](const std::string& members) {
    return look_of(folder, R"({"pbrMetallicRoughness":{)" + members + "}}");
  };
  EXPECT_EQ(look_of(folder, "{}").look.roughness, 1.0f);
  EXPECT_EQ(gloss("").look.roughness, 1.0f) << "glTF's default: the roughest metal, which looks dull";
  const DisplayLook brass = gloss(R"("metallicFactor":0.75,"roughnessFactor":0.25)").look;
  EXPECT_EQ(brass.metalness, 0.75f);
  EXPECT_EQ(brass.roughness, 0.25f);
  EXPECT_EQ(gloss(R"("roughnessFactor":0.26)").look.roughness, 0.25f) << "to 1/16, so that few looks differ";
  const DisplayLook odd = gloss(R"("metallicFactor":-7,"roughnessFactor":-1e300)").look;
  EXPECT_EQ(odd.metalness, 0.0f);
  EXPECT_EQ(odd.roughness, 0.0f);
  EXPECT_EQ(gloss(R"("roughnessFactor":1e30)").look.roughness, 1.0f);

  const GltfLook patchy = gloss(R"("roughnessFactor":0.5,"metallicRoughnessTexture":{"index":0})");
  EXPECT_EQ(patchy.look.texture, DisplayLook::no_texture);
  ASSERT_EQ(patchy.look.gloss_texture, 0u);
  EXPECT_EQ(patchy.images.at(0).texels, DisplayTexels::grey_alpha);
  EXPECT_EQ(patchy.images[0].bytes, (std::vector<std::uint8_t>{20, 30, 50, 60})) << "green and blue";
  EXPECT_EQ(patchy.look.roughness, 0.5f);
  // The same image with two meanings is two.
  const GltfLook both =
      gloss(R"("baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":0},"roughnessFactor":0.5)");
  EXPECT_EQ(both.images.size(), 2u);
  EXPECT_NE(both.look.texture, both.look.gloss_texture);
}

TEST(ImportDisplayLooks, ConvertsSpecularAndGlossinessOfGltf) {
  const TemporaryFolder folder;
  folder.write("wood.bmp", bmp({{10, 20, 30}}));
  const auto show_glossy = [&](const std::string& members) {
    const std::string material = R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{)" + members + "}}}";
    return show({folder.write("a.gltf", gltf(material, "wood.bmp"))}).triangles.at(0);
  };
  const auto gold =
      show_glossy(R"("diffuseFactor":[0,0,0,1],"specularFactor":[1,0.766,0.336],"glossinessFactor":0.75)");
  EXPECT_EQ(gold.look.metalness, 1.0f);
  EXPECT_EQ(gold.look.roughness, 0.25f);
  EXPECT_EQ(gold.colours[0], (Colour{255, 227, 157, 255})) << "the specular colour, on a screen";
  const auto plaster =
      show_glossy(R"("diffuseFactor":[0.5,0.25,0.125,1],"specularFactor":[0.04,0.04,0.04],"glossinessFactor":0)");
  EXPECT_EQ(plaster.look.metalness, 0.0f);
  EXPECT_EQ(plaster.look.roughness, 1.0f);
  EXPECT_EQ(plaster.colours[0], (Colour{188, 137, 99, 255})) << "the diffuse colour";
  const auto picture = show_glossy(R"("diffuseTexture":{"index":0},"glossinessFactor":0.5)");
  EXPECT_EQ(picture.look.texture, 0u);
  EXPECT_EQ(picture.look.roughness, 0.5f);
  EXPECT_EQ(picture.look.metalness, 0.0f);
  EXPECT_EQ(picture.colours[0], (Colour{255, 255, 255, 255}));
  const auto odd =
      show_glossy(R"("specularFactor":[-9,1e300,1],"diffuseFactor":[1e300,0,0,-1],"glossinessFactor":1e9)");
  EXPECT_EQ(odd.look.roughness, 0.0f);
}

TEST(ImportDisplayLooks, WithoutItsImageASurfaceOfGltfIsDull) {
  const TemporaryFolder folder;
  folder.write("wood.bmp", bmp({{10, 20, 30}}));
  const std::string mirror = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"roughnessFactor":0,)"
                             R"("metallicRoughnessTexture":{"index":0)";
  EXPECT_EQ(look_of(folder, mirror + "}}}").look.roughness, 0.0f);
  EXPECT_EQ(look_of(folder, mirror + "}}}", "gone.bmp").look.roughness, 1.0f);
  EXPECT_EQ(look_of(folder, mirror + R"(,"texCoord":1}}})").look.roughness, 1.0f) << "it lies otherwise";
  const DisplayLook moved =
      look_of(folder, mirror + R"(,"extensions":{"KHR_texture_transform":{"scale":[2,2]}}}}})").look;
  EXPECT_EQ(moved.roughness, 1.0f);
  EXPECT_EQ(moved.texture, 0u);
}

TEST(ImportDisplayLooks, ReadsEmissionOfGltf) {
  const TemporaryFolder folder;
  folder.write("wood.bmp", bmp({{10, 20, 30}}));
  using Emission = std::array<std::uint8_t, 3>;
  const DisplayLook lamp = look_of(folder, R"({"emissiveFactor":[1,0.2158605,0]})").look;
  EXPECT_EQ(lamp.emission, (Emission{255, 128, 0}));
  EXPECT_EQ(lamp.emission_texture, DisplayLook::no_texture);
  EXPECT_EQ(look_of(folder, R"({"emissiveFactor":[0.1,0,0],"extensions":{"KHR_materials_emissive_strength":
                                {"emissiveStrength":2.158605}}})")
                .look.emission,
            (Emission{128, 0, 0}));
  const DisplayLook screen = look_of(folder, R"({"emissiveFactor":[1,1,1],"emissiveTexture":{"index":0}})").look;
  EXPECT_EQ(screen.emission_texture, 0u);
  EXPECT_EQ(screen.emission, (Emission{255, 255, 255}));
  EXPECT_EQ(look_of(folder, R"({"emissiveTexture":{"index":0}})").images.size(), 0u) << "times 0";
  EXPECT_EQ(look_of(folder, R"({"emissiveFactor":[1,1,1],"emissiveTexture":{"index":0}})", "gone.bmp").look.emission,
            Emission{});
}

}  // namespace
}  // namespace roam::test
