#include "import/reader/scene_files.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <string>
#include <utility>

#include "roam/error.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// Most references that are remembered, so that each is reported once.
constexpr std::size_t remembered = 4'000'000;

/// The state of the regular file at a path without links.
LookedUp state_of(const fs::path& real) {
  struct stat status {};
  if (real.empty() || ::lstat(real.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  return {static_cast<std::uint64_t>(status.st_size),
          std::int64_t{status.st_ctim.tv_sec} * 1'000'000'000 + status.st_ctim.tv_nsec, 1};
}

}  // namespace

SceneFiles::SceneFiles(SceneScope scope, FrameWriter& frames, std::optional<ArchiveEntry> known,
                       std::shared_ptr<Archive> opened)
    : scope_(std::move(scope)), frames_(frames), known_(known), archive_(std::move(opened)) {
  if (is_archive_name(scope_.scene)) archive_file_ = scope_.find(scope_.scene);
}

std::string SceneFiles::name_in_archive(const fs::path& path) const {
  const std::string &whole = path.native(), &scene = scope_.scene.native();
  if (archive_file_.empty() || !whole.starts_with(scene) || whole.size() < scene.size() + 2) return {};
  return whole[scene.size()] == '/' ? whole.substr(scene.size() + 1) : std::string();
}

Archive& SceneFiles::archive() const {
  if (archive_ == nullptr) archive_ = std::make_shared<Archive>(archive_file_, scope_.scene.string(), known_);
  return *archive_;
}

std::optional<ArchiveEntry> SceneFiles::entry(const fs::path& path) const {
  const std::string name = name_in_archive(path.lexically_normal());
  return name.empty() ? std::nullopt : archive().find(name);
}

ArchiveEntry SceneFiles::located_entry(const fs::path& path) const {
  const std::optional<ArchiveEntry> found = entry(path);
  return found ? archive().located(*found) : ArchiveEntry();
}

std::optional<std::string> SceneFiles::read_entry(const fs::path& path, std::uint64_t most) {
  const std::optional<ArchiveEntry> found = entry(path);
  if (!found) return std::nullopt;
  try {
    return archive().read(*found, most);
  } catch (const Error& error) {
    if (damaged_.size() < remembered && damaged_.insert(fs::hash_value(path)).second) {
      frames_.send(FrameKind::note, PayloadWriter().add_text(fmt::format("{}: {}", path.string(), error.reason())));
    }
    return std::nullopt;
  }
}

std::optional<fs::path> SceneFiles::resolve(const fs::path& path) const {
  const fs::path place = path.lexically_normal();
  if (archive_file_.empty() || place == scope_.scene) return scope_.resolve(path);
  const bool is_inside = is_in_archive(place) && place.native().size() <= longest_path;
  return is_inside ? std::optional(place) : std::nullopt;
}

fs::path SceneFiles::find(const fs::path& path) const {
  if (archive_file_.empty() || path == scope_.scene) return scope_.find(path);
  const fs::path place = path.lexically_normal();
  return entry(place) ? place : fs::path();
}

fs::path SceneFiles::look_up(const fs::path& path) {
  const fs::path place = path.lexically_normal();
  if (!place.is_absolute()) return {};
  fs::path file = find(place);
  if (looked_up_.size() == remembered) return file;
  if (!looked_up_.insert(fs::hash_value(place)).second) return file;
  if (looked_up_.size() == remembered) report_unseen();
  frames_.send(FrameKind::looked_up,
               PayloadWriter().add_text(place.string()).add(state_of(is_in_archive(place) ? archive_file_ : file)));
  return file;
}

void SceneFiles::report_unseen() { frames_.send(FrameKind::looked_up, PayloadWriter().add_text("").add(LookedUp{})); }

fs::path SceneFiles::open(const fs::path& path) {
  fs::path file = look_up(path);
  const fs::path& on_disk = is_in_archive(file) ? archive_file_ : file;
  if (!on_disk.empty() && opened_.size() < remembered && opened_.insert(fs::hash_value(on_disk)).second) {
    frames_.send(FrameKind::opened, PayloadWriter().add_text(on_disk.string()));
    // Flush at once: the next computation is allowed because of this file.
    frames_.flush();
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
