#pragma once
/// \file
/// The files that a part of a scene refers to, beyond those that scene_parts() lists.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "import/parts.h"
#include "import/scene_scope.h"

namespace roam::store {

/// The name of a file in a manifest: relative to the folder that holds the scene, or absolute in an allowed folder.
/// Bytes that are no UTF-8, control characters and % become %XX. None for a file elsewhere.
[[nodiscard]] std::optional<std::string> reference_name(const std::filesystem::path& file,
                                                        const reader::SceneScope& scope);
/// The reverse, absolute, for a name that a stranger may have written. None for a name that reference_name does not
/// give. Whether the file lies in the scope is SceneScope's to say.
[[nodiscard]] std::optional<std::filesystem::path> reference_file(const std::string& name,
                                                                  const reader::SceneScope& scope);

/// Most bytes of all names in a manifest, as references_cost counts them.
inline constexpr std::uint64_t most_reference_bytes = 4u << 20;
[[nodiscard]] std::uint64_t references_cost(const std::vector<std::string>& names);

/// A part of a scene and the files that it refers to.
struct SourcePart : ScenePart {
  SourcePart() = default;
  explicit SourcePart(ScenePart part) : ScenePart(std::move(part)) {}

  std::map<std::string, std::filesystem::path> references;  ///< by reference_name; such a file may be absent
};

/// The files that a reader looks up while it reads a part, without those that scene_parts() lists. In place of an entry
/// of an archive it is the archive.
class LookUps {
 public:
  /// `most_bytes` of memory for them.
  LookUps(const ScenePart& part, const reader::SceneScope& scope, std::uint64_t most_bytes);

  /// Throws roam::Error if they take too much memory.
  void add(const FileLookUp& file);

  /// By reference_name.
  [[nodiscard]] const std::map<std::string, FileLookUp>& files() const { return files_; }
  /// Whether files() are all that were looked up.
  [[nodiscard]] bool are_all() const { return are_all_; }

 private:
  std::string part_;
  const reader::SceneScope& scope_;
  bool is_archive_;
  std::uint64_t bytes_left_;
  std::set<std::string> listed_;
  std::map<std::string, FileLookUp> files_;
  bool are_all_ = true;
};

}  // namespace roam::store
