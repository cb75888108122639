#pragma once
/// \file
/// The tiles of tileset.json, as the standard describes them.

#include <cstddef>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "import/reader/json.h"
#include "import/reader/mesh_sink.h"
#include "import/reader/scene_files.h"
#include "roam/scene_frame.h"

namespace roam::reader {

/// Most tiles in each other, those of external tilesets included. Real tilesets have some 30.
inline constexpr std::size_t tile_depth_limit = 1000;

/// Whether finer tiles replace a tile, or are added to it.
enum class Refine : std::uint8_t { replace, add };

/// The values of a tileset file, which may be compressed by gzip. Counts it. Throws roam::Error if it is absent,
/// damaged, or no tileset.
[[nodiscard]] Json tileset_json(const std::filesystem::path& file, SceneFiles& files, MeshSink& sink);

/// The axis that is up in the glTF inside of a tileset's tiles.
[[nodiscard]] UpAxis gltf_up_of(const Json& tileset);
/// The transform of a tile to its parent. Throws roam::Error at `place` if it is damaged.
[[nodiscard]] glm::dmat4 transform_of(const Json& tile, const std::string& place);
/// The URIs of a tile's contents.
[[nodiscard]] std::vector<std::string> uris_of(const Json& tile);
/// Unset: as its parent.
[[nodiscard]] std::optional<Refine> refine_of(const Json& tile);

[[nodiscard]] bool is_finite(const glm::dmat4& matrix);

}  // namespace roam::reader
