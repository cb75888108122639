#include "import/reader/tileset/contents.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdint>
#include <span>
#include <utility>

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
  if (files_.is_in_archive(path)) return files_.find(path);
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

std::optional<TileContents::Start> TileContents::start_of(const fs::path& file) {
  if (const auto entry = files_.entry(file)) {
    std::optional<std::string> bytes = files_.read_entry(file, content_start_bytes);
    return bytes ? std::optional(Start{std::move(*bytes), entry->bytes}) : std::nullopt;
  }
  const files::Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (!descriptor.is_open() || ::fstat(descriptor.number(), &status) != 0) {
    fail_unless_missing(errno, file);
    return std::nullopt;
  }
  std::string bytes(content_start_bytes, '\0');
  const std::size_t read = files::read_fully(descriptor.number(), 0, std::as_writable_bytes(std::span(bytes)));
  if (read < bytes.size()) fail_unless_missing(errno, file);
  bytes.resize(read);
  return Start{std::move(bytes), static_cast<std::uint64_t>(status.st_size)};
}

TileContents::State TileContents::state_of(const fs::path& path) {
  const fs::path file = find(path);
  if (file.empty()) return State::missing;
  const std::optional<Start> start = start_of(file);
  if (!start) return State::missing;
  const std::string& bytes = start->bytes;
  const std::string extension = extension_of(path);
  if (is_gzip(bytes)) return extension == "json" ? State::tileset : State::mesh;
  const ContentKind kind = kind_of(bytes);
  const bool states_length = kind == ContentKind::mesh || kind == ContentKind::points;
  const bool cut = states_length && (bytes.size() < content_start_bytes || stated_bytes(bytes) > start->size);
  if (kind == ContentKind::unknown || cut) return State::missing;
  if (kind == ContentKind::points) return State::points;
  return kind == ContentKind::json && extension != "gltf" ? State::tileset : State::mesh;
}

}  // namespace roam::reader
