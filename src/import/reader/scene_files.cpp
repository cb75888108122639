#include "import/reader/scene_files.h"

#include <sys/stat.h>

#include <system_error>
#include <utility>

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

SceneFiles::SceneFiles(SceneScope scope, FrameWriter& frames) : scope_(std::move(scope)), frames_(frames) {}

fs::path SceneFiles::look_up(const fs::path& path) {
  const fs::path place = path.lexically_normal();
  if (!place.is_absolute()) return {};
  fs::path file = scope_.find(place);
  if (looked_up_.size() == remembered) return file;
  if (!looked_up_.insert(fs::hash_value(place)).second) return file;
  if (looked_up_.size() == remembered) report_unseen();
  frames_.send(FrameKind::looked_up, PayloadWriter().add_text(place.string()).add(state_of(file)));
  return file;
}

void SceneFiles::report_unseen() { frames_.send(FrameKind::looked_up, PayloadWriter().add_text("").add(LookedUp{})); }

fs::path SceneFiles::open(const fs::path& path) {
  fs::path file = look_up(path);
  if (!file.empty() && opened_.size() < remembered && opened_.insert(fs::hash_value(file)).second) {
    frames_.send(FrameKind::opened, PayloadWriter().add_text(file.string()));
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
