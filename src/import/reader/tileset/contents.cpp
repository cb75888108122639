#include "import/reader/tileset/contents.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <span>
#include <string_view>

#include "files/descriptor.h"
#include "import/reader/file_names.h"
#include "import/reader/machine_failure.h"
#include "import/reader/named_file.h"
#include "import/reader/tileset/gzip.h"
#include "import/reader/tileset/tile_content.h"

namespace roam::reader {

namespace fs = std::filesystem;

fs::path TileContents::place(const fs::path& folder, const std::string& uri) {
  if (uri.find_first_of("\\%?#:") != std::string::npos) {
    return named_file(folder, uri, [&](const fs::path& path) { return !find(path).empty(); });
  }
  return uri.empty() ? fs::path() : (folder / uri).lexically_normal();
}

fs::path TileContents::find(const fs::path& path) {
  if (path.empty() || !path.has_filename()) return {};
  const fs::path folder = path.parent_path();
  auto known = folders_.find(folder);
  if (known == folders_.end()) known = folders_.emplace(folder, files_.resolve(folder)).first;
  if (!known->second) {
    files_.leave_out(path);
    return {};
  }
  const fs::path real = *known->second / path.filename();
  struct stat status {};
  if (::lstat(real.c_str(), &status) != 0) {
    fail_unless_missing(errno, path);
    return {};
  }
  if (S_ISREG(status.st_mode)) return real;
  if (!S_ISLNK(status.st_mode)) return {};
  if (!files_.resolve(path)) files_.leave_out(path);
  return files_.find(path);
}

TileContents::State TileContents::state_of(const fs::path& path) {
  const fs::path file = find(path);
  if (file.empty()) return State::missing;
  const files::Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (!descriptor.is_open() || ::fstat(descriptor.number(), &status) != 0) {
    fail_unless_missing(errno, path);
    return State::missing;
  }
  std::array<char, content_start_bytes> start{};
  const std::size_t read = files::read_fully(descriptor.number(), 0, std::as_writable_bytes(std::span(start)));
  if (read < start.size()) fail_unless_missing(errno, path);
  const std::string_view bytes(start.data(), read);
  const std::string extension = extension_of(path);
  if (is_gzip(bytes)) return extension == "json" ? State::tileset : State::mesh;
  const ContentKind kind = kind_of(bytes);
  const bool states_length = kind == ContentKind::mesh || kind == ContentKind::points;
  const bool cut =
      states_length && (read < content_start_bytes || stated_bytes(bytes) > static_cast<std::uint64_t>(status.st_size));
  if (kind == ContentKind::unknown || cut) return State::missing;
  if (kind == ContentKind::points) return State::points;
  return kind == ContentKind::json && extension != "gltf" ? State::tileset : State::mesh;
}

}  // namespace roam::reader
