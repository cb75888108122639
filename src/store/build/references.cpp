#include "store/build/references.h"

#include <fmt/format.h>

#include <algorithm>

#include "files/escaped.h"
#include "text/printable.h"

namespace roam::store {
namespace {

namespace fs = std::filesystem;

/// Bytes for each name besides its text.
constexpr std::uint64_t name_cost = 16;
/// The same for a file in LookUps.
constexpr std::uint64_t look_up_cost = 256;

std::string escaped(const std::string& path) {
  return files::escaped(path, [](char32_t code) { return !is_control(code) && code != U'%'; });
}

/// The path below a folder; empty if it lies elsewhere.
fs::path below(const fs::path& file, const fs::path& folder) {
  fs::path inside = file.lexically_relative(folder);
  return inside.empty() || *inside.begin() == ".." || *inside.begin() == "." ? fs::path() : inside;
}

bool is_allowed(const fs::path& file, const reader::SceneScope& scope) {
  // The first folder is that of the scene.
  return std::any_of(scope.folders.begin() + (scope.folders.empty() ? 0 : 1), scope.folders.end(),
                     [&](const fs::path& folder) { return !below(file, folder).empty(); });
}

}  // namespace

std::optional<std::string> reference_name(const fs::path& file, const reader::SceneScope& scope) {
  const fs::path inside = below(file, scope.scene.parent_path());
  if (!inside.empty()) return escaped(inside.string());
  if (is_allowed(file, scope)) return escaped(file.string());
  return std::nullopt;
}

std::optional<fs::path> reference_file(const std::string& name, const reader::SceneScope& scope) {
  const std::string text = files::unescaped(name);
  if (text.find('\0') != std::string::npos) return std::nullopt;
  fs::path file(text);
  if (file.is_relative()) file = scope.scene.parent_path() / file;
  // Any other spelling, with ".." for example, is none that a builder writes.
  if (reference_name(file.lexically_normal(), scope) != name || !file.has_filename()) return std::nullopt;
  return file;
}

std::uint64_t references_cost(const std::vector<std::string>& names) {
  std::uint64_t bytes = 0;
  for (const std::string& name : names) bytes += name_cost + name.size();
  return bytes;
}

LookUps::LookUps(const ScenePart& part, const reader::SceneScope& scope, std::uint64_t most_bytes)
    : part_(part.name), scope_(scope), is_archive_(!part.entries.empty()), bytes_left_(most_bytes) {
  for (const fs::path& file : part.files) {
    listed_.insert(fs::absolute(file).lexically_normal().string());
    listed_.insert(scope.find(file).string());  // without links, as some readers name it again
  }
}

void LookUps::add(const FileLookUp& file) {
  if (file.file.empty()) are_all_ = false;
  if (file.file.empty() || listed_.contains(file.file.string())) return;
  FileLookUp found = file;
  // Whether an archive has another entry, and which, only its own bytes say.
  if (!below(file.file, scope_.scene).empty() && is_archive_) found.file = scope_.scene;
  const std::optional<std::string> name = reference_name(found.file, scope_);
  if (!name) {
    if (found.found) are_all_ = false;
    return;
  }
  if (!files_.try_emplace(*name, found).second) return;
  const std::uint64_t bytes = look_up_cost + 2 * name->size();
  if (bytes > bytes_left_) {
    throw Error(part_, "it refers to more files than there is memory for; give --memory more");
  }
  bytes_left_ -= bytes;
}

}  // namespace roam::store
