#include "import/scene_scope.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <system_error>

#include "roam/error.h"
#include "roam/import.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// Most links that are followed, as in Linux; more are a circle.
constexpr int link_limit = 40;

bool is_below(const fs::path& path, const fs::path& folder) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end == folder.end() && std::distance(rest, path.end()) <= deepest_nesting + 1;
}

/// The absolute form of a path, with no links in the folders above its last part. A folder at the end of a link is
/// followed, too, if `through_link`.
fs::path without_links_above(const fs::path& path, bool through_link) {
  fs::path whole = fs::absolute(path);
  // A slash at the end would follow a link.
  while (!through_link && (!whole.has_filename() || whole.filename() == ".")) whole = whole.parent_path();
  std::error_code none;
  const bool folder = (through_link || whole.filename() == "..") && fs::is_directory(whole, none);
  // Follow links before "..", as the system does. By text alone ".." may lead to another file.
  const fs::path real = fs::canonical(folder ? whole : whole.parent_path(), none);
  if (none) return whole.lexically_normal();
  return folder ? real : real / whole.filename();
}

}  // namespace

bool SceneScope::holds(const fs::path& path) const {
  return std::find(files.begin(), files.end(), path) != files.end() ||
         std::any_of(folders.begin(), folders.end(), [&](const fs::path& folder) { return is_below(path, folder); });
}

std::optional<fs::path> SceneScope::resolve(const fs::path& path) const {
  fs::path whole = path.lexically_normal();
  for (int links = 0; links <= link_limit; ++links) {
    if (!whole.is_absolute() || whole.native().size() > longest_path || !holds(whole)) return std::nullopt;
    // Folders of the scope have no links in their paths, so the first link lies inside.
    fs::path at;
    fs::path rest;
    bool found = false;
    for (const fs::path& name : whole) {
      if (found) {
        rest /= name;
        continue;
      }
      const fs::path next = at / name;
      std::error_code none;
      found = holds(next) && fs::is_symlink(fs::symlink_status(next, none));
      if (found) {
        const fs::path target = fs::read_symlink(next, none);
        if (none) return std::nullopt;
        at /= target;
      } else {
        at = next;
      }
    }
    if (!found) return at;
    whole = (rest.empty() ? at : at / rest).lexically_normal();
  }
  return std::nullopt;
}

fs::path SceneScope::find(const fs::path& path) const {
  const std::optional<fs::path> file = resolve(path);
  std::error_code none;
  return file && fs::is_regular_file(fs::symlink_status(*file, none)) ? *file : fs::path();
}

SceneScope scope_of(const fs::path& named, const ImportOptions& options) {
  const fs::path path = without_links_above(named, options.through_link);
  SceneScope scope;
  scope.scene = path;
  std::error_code none;
  const fs::file_status status = options.through_link ? fs::status(path, none) : fs::symlink_status(path, none);
  if (fs::is_symlink(status)) {
    throw Error(named.string(), "this is a link, which is followed only where you name it as the scene.");
  }
  if (fs::is_directory(status)) {
    scope.folders.push_back(path);
    // This file lies beside the folder of the tiles and has their position.
    if (path.filename() == "Data") {
      const fs::path metadata = path.parent_path() / "metadata.xml";
      if (fs::is_regular_file(fs::symlink_status(metadata, none))) scope.files.push_back(metadata);
    }
  } else {
    scope.folders.push_back(path.parent_path());
    // The user named the file, so its target is allowed wherever a link leads.
    const fs::path real = options.through_link ? fs::canonical(path, none) : fs::path();
    if (!real.empty()) scope.files.push_back(real);
  }
  for (const fs::path& folder : options.allow) {
    const fs::path real = fs::canonical(folder, none);
    if (none || !fs::is_directory(real, none)) {
      throw Error(folder.string(), "there is no such folder to allow. Check the spelling.");
    }
    scope.folders.push_back(real);
  }
  return scope;
}

}  // namespace roam::reader
