#pragma once
/// \file
/// The content of one tile: b3dm, i3dm, cmpt, or glTF.

#include <filesystem>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "import/reader/mesh_sink.h"
#include "import/reader/scene_files.h"
#include "roam/error.h"
#include "roam/scene_frame.h"

namespace roam::reader {

/// Where a tile lies.
struct TilePlace {
  glm::dmat4 to_scene{1.0};    ///< from the tile's frame, z up
  UpAxis gltf_up = UpAxis::y;  ///< of glTF inside the tile
};

/// The kind of a tile's content, by its first bytes.
enum class ContentKind { mesh, points, json, unknown };
[[nodiscard]] ContentKind kind_of(std::string_view first_bytes);
/// Bytes that kind_of and stated_bytes look at.
inline constexpr std::size_t content_start_bytes = 12;
/// The length that the content states in its first bytes; 0 if it states none.
[[nodiscard]] std::uint64_t stated_bytes(std::string_view first_bytes);

/// Adds the triangles of the content of `file`, which may be compressed by gzip. Points are left out, with a note.
/// Throws roam::Error if it is damaged; triangles before the damage are added.
void add_tile_content(std::string bytes, const std::filesystem::path& file, const TilePlace& place, SceneFiles& files,
                      MeshSink& sink);

/// The same with the bytes of the file, which it counts. Returns its error, which is also noted, if it is absent or
/// damaged.
[[nodiscard]] std::optional<Error> read_tile_content(const std::filesystem::path& file, const TilePlace& place,
                                                     SceneFiles& files, MeshSink& sink);

}  // namespace roam::reader
