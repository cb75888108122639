#include "import/reader/scene_files.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// Links that lead to links: more is a circle. Linux stops at as many.
constexpr int link_limit = 40;
/// References that are remembered, so that each is reported once.
constexpr std::size_t remembered = 4'000'000;

bool is_below(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

SceneFiles::SceneFiles(std::vector<fs::path> folders, std::vector<fs::path> files, FrameWriter& frames)
    : folders_(std::move(folders)), files_(std::move(files)), frames_(frames) {}

bool SceneFiles::holds(const fs::path& path) const {
  return std::find(files_.begin(), files_.end(), path) != files_.end() ||
         std::any_of(folders_.begin(), folders_.end(), [&](const fs::path& folder) { return is_below(path, folder); });
}

std::optional<fs::path> SceneFiles::resolve(const fs::path& path) const {
  fs::path whole = path.lexically_normal();
  for (int links = 0; links <= link_limit; ++links) {
    if (!whole.is_absolute() || !holds(whole)) return std::nullopt;
    // Folders of the scene have no links in them: the first link lies inside.
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

fs::path SceneFiles::find(const fs::path& path) const {
  const std::optional<fs::path> file = resolve(path);
  std::error_code none;
  return file && fs::is_regular_file(fs::symlink_status(*file, none)) ? *file : fs::path();
}

fs::path SceneFiles::open(const fs::path& path) {
  fs::path file = find(path);
  if (!file.empty() && opened_.size() < remembered && opened_.insert(fs::hash_value(file)).second) {
    frames_.send(FrameKind::opened, PayloadWriter().add_text(file.string()));
  }
  return file;
}

void SceneFiles::leave_out(const fs::path& path) {
  const fs::path place = path.lexically_normal();
  const std::string name = place.string();
  if (left_out_.empty()) first_left_out_ = name;
  if (left_out_.size() >= remembered || !left_out_.insert(fs::hash_value(place)).second) return;
  frames_.send(FrameKind::outside, PayloadWriter().add_text(name));
}

}  // namespace roam::reader
