#include "import/reader/scene_files.h"

#include <system_error>
#include <utility>

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// Most references that are remembered, so that each is reported once.
constexpr std::size_t remembered = 4'000'000;

}  // namespace

SceneFiles::SceneFiles(SceneScope scope, FrameWriter& frames) : scope_(std::move(scope)), frames_(frames) {}

fs::path SceneFiles::open(const fs::path& path) {
  fs::path file = find(path);
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
