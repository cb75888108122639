#include "import/reader/tileset/tile_json.h"

#include <cmath>
#include <utility>

#include "import/reader/named_file.h"
#include "import/reader/tileset/gzip.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

/// Each tile is an object in a list.
constexpr int json_depth = 2 * static_cast<int>(tile_depth_limit) + 64;

std::string uri_of(const Json& content) {
  const std::string uri = text(member(content, "uri"));
  return uri.empty() ? text(member(content, "url")) : uri;
}

}  // namespace

Json tileset_json(const std::filesystem::path& file, SceneFiles& files, MeshSink& sink) {
  std::optional<std::string> bytes = whole_file(files, file);
  if (!bytes) throw Error(file.string(), "this tileset is absent or cannot be read.");
  sink.count_file();
  sink.report_more_progress(bytes->size());
  Json json = parse_json(without_gzip(std::move(*bytes), file.string()), file.string(), json_depth);
  if (text(member(json, "type")) == "CityJSON") {
    throw Error(file.string(), "CityJSON is not read yet; convert it to glTF, OBJ or PLY.");
  }
  if (!member(json, "root").is_object()) {
    throw Error(file.string(), "this JSON is no tileset of 3D Tiles: it has no tile as its 'root'.");
  }
  return json;
}

UpAxis gltf_up_of(const Json& tileset) {
  const std::string up = text(member(tileset, "asset", "gltfUpAxis"));
  const bool is_z = up == "Z" || up == "z", is_x = up == "X" || up == "x";
  return is_z ? UpAxis::z : is_x ? UpAxis::x : UpAxis::y;
}

glm::dmat4 transform_of(const Json& tile, const std::string& place) {
  const Json& transform = member(tile, "transform");
  if (transform.is_null()) return glm::dmat4(1.0);
  const auto m = numbers(transform, 16);
  if (!m) throw Error(place, "the transform of a tile is not 16 numbers; the tileset is damaged.");
  glm::dmat4 matrix;
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = (*m)[static_cast<std::size_t>(i)];
  return matrix;
}

std::vector<std::string> uris_of(const Json& tile) {
  std::vector<std::string> uris;
  const auto add = [&](const Json& content) {
    if (std::string uri = uri_of(content); !uri.empty()) uris.push_back(std::move(uri));
  };
  add(member(tile, "content"));
  for (const Json& content : member(tile, "contents")) add(content);
  const Json& several = member(tile, "extensions", "3DTILES_multiple_contents");
  for (const char* name : {"content", "contents"}) {
    for (const Json& content : member(several, name)) add(content);
  }
  return uris;
}

std::optional<Refine> refine_of(const Json& tile) {
  const std::string refine = text(member(tile, "refine"));
  if (refine.empty()) return std::nullopt;
  return refine == "ADD" || refine == "add" ? Refine::add : Refine::replace;
}

bool is_finite(const glm::dmat4& matrix) {
  for (int column = 0; column < 4; ++column) {
    for (int k = 0; k < 4; ++k) {
      if (!std::isfinite(matrix[column][k])) return false;
    }
  }
  return true;
}

}  // namespace roam::reader
