#pragma once
/// \file
/// glTF files and 3D Tiles, made byte by byte.

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "roam/math.h"

namespace roam::test {

using Json = nlohmann::json;

/// The bytes of numbers.
template <class T>
std::string packed(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// A glTF file in the making: its JSON, and one buffer.
struct MadeGltf {
  Json json{{"asset", {{"version", "2.0"}}}, {"scene", 0},
            {"scenes", {{{"nodes", {0}}}}},  {"nodes", {{{"mesh", 0}}}},
            {"meshes", Json::array()},       {"accessors", Json::array()},
            {"bufferViews", Json::array()}};
  std::string buffer;

  /// Adds a buffer view. Returns its number.
  std::size_t add_view(const std::string& bytes) {
    buffer.resize((buffer.size() + 3) / 4 * 4);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
    buffer += bytes;
    return json["bufferViews"].size() - 1;
  }
  std::size_t add_accessor(const std::string& bytes, int component_type, const char* type, std::size_t count) {
    const std::size_t view = add_view(bytes);
    json["accessors"].push_back(
        {{"bufferView", view}, {"componentType", component_type}, {"type", type}, {"count", count}});
    return json["accessors"].size() - 1;
  }
  /// Adds a mesh of one primitive.
  void add_mesh(const Json& primitive) { json["meshes"].push_back({{"primitives", {primitive}}}); }

  /// The file as .glb.
  [[nodiscard]] std::string glb() const {
    Json whole = json;
    if (!whole.contains("buffers")) whole["buffers"] = {{{"byteLength", buffer.size()}}};
    const auto chunk = [](const char* kind, std::string bytes, char padding) {
      bytes.resize((bytes.size() + 3) / 4 * 4, padding);
      return packed(std::vector{static_cast<std::uint32_t>(bytes.size())}) + std::string(kind, 4) + bytes;
    };
    const std::string chunks = chunk("JSON", whole.dump(), ' ') + chunk("BIN\0", buffer, '\0');
    return "glTF" + packed(std::vector{std::uint32_t{2}, static_cast<std::uint32_t>(12 + chunks.size())}) + chunks;
  }
};

inline constexpr int type_u16 = 5123, type_u32 = 5125, type_f32 = 5126;

/// A grid of n x n quads in the plane y = `height`, with a little relief: 2 n^2 triangles.
struct MadeGrid {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;
  explicit MadeGrid(std::uint32_t n, float height = 0.0f, float side = 1.0f) {
    for (std::uint32_t j = 0; j <= n; ++j) {
      for (std::uint32_t i = 0; i <= n; ++i) {
        const float relief = 0.25f * static_cast<float>((i * 7 + j * 3) % 5) / static_cast<float>(n);
        positions.insert(positions.end(), {side * static_cast<float>(i) / static_cast<float>(n), height + relief,
                                           side * static_cast<float>(j) / static_cast<float>(n)});
      }
    }
    for (std::uint32_t j = 0; j < n; ++j) {
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
        indices.insert(indices.end(), {a, c, b, b, c, d});
      }
    }
  }
  [[nodiscard]] std::size_t vertices() const { return positions.size() / 3; }
  [[nodiscard]] MadeGltf gltf() const {
    MadeGltf made;
    const auto points = made.add_accessor(packed(positions), type_f32, "VEC3", vertices());
    const auto corners = made.add_accessor(packed(indices), type_u32, "SCALAR", indices.size());
    made.add_mesh({{"attributes", {{"POSITION", points}}}, {"indices", corners}});
    return made;
  }
};

/// A b3dm or i3dm tile. `features`: JSON and binary of its feature table.
inline std::string made_tile(const std::string& magic, const std::string& content, const std::string& features = "",
                             const std::string& binary = "") {
  const auto size = [](const std::string& text) { return static_cast<std::uint32_t>(text.size()); };
  const bool instanced = magic == "i3dm";
  const std::uint32_t header = instanced ? 32 : 28;
  std::vector<std::uint32_t> numbers{
      1, header + size(features) + size(binary) + size(content), size(features), size(binary), 0, 0};
  if (instanced) numbers.push_back(1);
  return magic + packed(numbers) + features + binary + content;
}

/// A composite tile.
inline std::string made_composite(const std::vector<std::string>& tiles) {
  std::string all;
  for (const std::string& tile : tiles) all += tile;
  return "cmpt" +
         packed(std::vector<std::uint32_t>{1, static_cast<std::uint32_t>(16 + all.size()),
                                           static_cast<std::uint32_t>(tiles.size())}) +
         all;
}

/// A tile of a tileset.
inline Json made_node(const std::string& uri, const Json& children = Json::array(), const char* refine = "REPLACE") {
  Json tile{{"boundingVolume", {{"sphere", {0, 0, 0, 10}}}}, {"geometricError", 1}, {"refine", refine}};
  if (!uri.empty()) tile["content"] = {{"uri", uri}};
  if (!children.empty()) tile["children"] = children;
  return tile;
}

inline std::string made_tileset(const Json& root, const Json& asset = {{"version", "1.1"}}) {
  return Json{{"asset", asset}, {"geometricError", 10}, {"root", root}}.dump();
}

}  // namespace roam::test
