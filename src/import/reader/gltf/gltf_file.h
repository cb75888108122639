#pragma once
/// \file
/// A glTF 2.0 file: its JSON, its buffers, and its buffer views, decompressed.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "import/reader/json.h"
#include "import/reader/scene_files.h"

namespace roam::reader {

/// Whether these are the first bytes of a binary glTF file (.glb) of version 1.
[[nodiscard]] bool is_gltf_1(std::string_view bytes);

class GltfFile {
 public:
  /// `bytes`: those of a .glb or .gltf file, or of one inside of another file. They must outlive this object. `file`:
  /// for messages; its folder has the files that the JSON names. Throws roam::Error, as all members do, if the file is
  /// damaged.
  GltfFile(std::string_view bytes, std::filesystem::path file, SceneFiles& files);

  [[nodiscard]] const Json& json() const { return json_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Where files that the JSON names are looked up.
  [[nodiscard]] SceneFiles& files() { return files_; }

  /// The element `index` of a list of the file, e.g. "meshes". Throws if there is none.
  [[nodiscard]] const Json& item(const char* list, const Json& index) const;
  /// The bytes of a buffer view, which EXT_meshopt_compression may have compressed. Valid as long as this object.
  [[nodiscard]] std::span<const std::byte> view(std::uint64_t index);

  /// An error of this file.
  [[nodiscard]] Error damaged(const std::string& what) const;

 private:
  std::span<const std::byte> buffer(const Json& index);
  std::span<const std::byte> stretch(const Json& of);
  std::span<const std::byte> decompressed(const Json& compressed, std::uint64_t index);

  std::filesystem::path path_;
  SceneFiles& files_;
  Json json_;
  std::string_view chunk_;  ///< the buffer inside of a .glb
  bool has_chunk_ = false;
  std::map<std::uint64_t, std::string> buffers_;
  std::map<std::uint64_t, std::vector<std::byte>> decompressed_;
};

}  // namespace roam::reader
