#include "store/build/scene_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <span>

#include "files/holes.h"
#include "roam/error.h"
#include "store/files.h"

namespace roam::store {
namespace {

namespace fs = std::filesystem;

}  // namespace

Descriptor open_without_links(const fs::path& real, int flags) {
  Descriptor at(again([&] { return ::open("/", not_to_read | O_DIRECTORY | O_CLOEXEC); }));
  for (const fs::path& name : real.parent_path().relative_path()) {
    if (!at.is_open()) break;
    constexpr int folder = not_to_read | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;
    at = Descriptor(again([&] { return ::openat(at.number(), name.c_str(), folder); }));
  }
  if (!at.is_open()) return at;
  return Descriptor(again([&] {
    return ::openat(at.number(), real.filename().c_str(), flags | O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
  }));
}

struct stat state_of(const Descriptor& file, const fs::path& name) {
  struct stat status {};
  if (!file.is_open() || ::fstat(file.number(), &status) != 0) {
    throw Error::at(name.string(), fmt::format("cannot read {}: {}", name.string(), std::strerror(errno)));
  }
  if (!S_ISREG(status.st_mode))
    throw Error::at(name.string(), fmt::format("cannot read {}: it is no ordinary file", name.string()));
  return status;
}

void fail_changed(const std::string& name) {
  throw Error::at(name, fmt::format("{} was changed while the scene was read; build again when it is finished", name));
}

FileHash::FileHash(const fs::path& real, const std::function<void()>& tick)
    : file_(real), tick_(tick), descriptor_(open_without_links(real, O_RDONLY)), status_(state_of(descriptor_, real)) {
  if (!files::is_mostly_holes(descriptor_.number())) return;
  throw Error::at(
      file_.string(),
      fmt::format("{} has {} bytes, but only {} of them are on the disk: the rest is a hole, which no scene has. "
                  "Remove it; if it is meant, copy it without holes (cp --sparse=never)",
                  file_.string(), status_.st_size, 512 * static_cast<std::uint64_t>(status_.st_blocks)));
}

std::string FileHash::digits(const ArchiveEntry& entry) {
  if (entry != ArchiveEntry()) {
    add_data(static_cast<off_t>(entry.begin), static_cast<off_t>(entry.begin + entry.packed));
    return hash_.digits();
  }
  off_t at = 0;
  // Also reads beyond the former size: a file that has grown is being changed.
  for (const off_t size = status_.st_size; at < size;) {
    const files::DataRange data = files::next_data(descriptor_.number(), at, size);
    add_hole(static_cast<std::uint64_t>(data.begin - at));
    add_data(data.begin, data.end);
    at = data.end;
  }
  add_data(at, std::numeric_limits<off_t>::max());
  return hash_.digits();
}

void FileHash::fail() const {
  throw Error::at(file_.string(), fmt::format("cannot read {}: {}", file_.string(), std::strerror(errno)));
}

void FileHash::add_hole(std::uint64_t bytes) {
  if (bytes == 0) return;
  std::fill_n(piece_.begin(), std::min<std::uint64_t>(piece_.size(), bytes), std::byte{0});
  for (std::uint64_t done = 0; done < bytes;) {
    const std::uint64_t some = std::min<std::uint64_t>(piece_.size(), bytes - done);
    hash_.add(std::span(piece_).first(static_cast<std::size_t>(some)));
    done += some;
    tick_();
  }
}

void FileHash::add_data(off_t from, off_t end) {
  while (from < end) {
    const auto most = static_cast<std::size_t>(std::min<off_t>(static_cast<off_t>(piece_.size()), end - from));
    const ssize_t got = again([&] { return ::pread(descriptor_.number(), piece_.data(), most, from); });
    if (got < 0) fail();
    if (got == 0) return;
    hash_.add(std::span(piece_).first(static_cast<std::size_t>(got)));
    from += got;
    tick_();
  }
}

}  // namespace roam::store
