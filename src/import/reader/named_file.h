#pragma once
/// \file
/// Files that a glTF file or a tileset names by a URI, and whole files as bytes.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "import/reader/scene_files.h"

namespace roam::reader {

/// Whether a URI has a scheme (http:, data: and so on), so that it names no file of the scene.
[[nodiscard]] bool has_scheme(std::string_view uri);

/// The path that a URI names, relative to `folder`: as it is written if `is_there` finds that file, else without its
/// query and with %20 and the like replaced. The file need not exist. Empty for a URI with a scheme.
[[nodiscard]] std::filesystem::path named_file(const std::filesystem::path& folder, const std::string& uri,
                                               const std::function<bool(const std::filesystem::path&)>& is_there);

/// The bytes of a data URI; unset if it is none, or malformed.
[[nodiscard]] std::optional<std::string> data_of(std::string_view uri);

/// The whole file that a URI names. Unset if there is none, or if it cannot be read.
[[nodiscard]] std::optional<std::string> named_bytes(SceneFiles& files, const std::filesystem::path& folder,
                                                     const std::string& uri);

/// The whole file. Looks it up and reports it as opened; a path out of the scene is left out. Unset if there is no such
/// file, or if its rights forbid to read it, or if it is a damaged entry of an archive. Throws std::bad_alloc for a
/// file that does not fit into memory, MachineFailure if the disk cannot be read.
[[nodiscard]] std::optional<std::string> whole_file(SceneFiles& files, const std::filesystem::path& path);

}  // namespace roam::reader
