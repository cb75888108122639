#include "files/place.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <span>
#include <system_error>
#include <utility>

#include "files/file_error.h"
#include "text/byte_order_mark.h"

namespace roam::files {
namespace {

namespace fs = std::filesystem;

#ifdef O_PATH
constexpr int pass_flags = O_PATH;
#else
constexpr int pass_flags = O_RDONLY;
#endif

/// The same of a path from an open folder on.
Descriptor open_folders(int at, const fs::path& path, const fs::path& whole) {
  Descriptor folder = open_folder(at, path.is_absolute() ? "/" : ".", pass_flags, whole);
  for (const fs::path& part : path.relative_path()) {
    if (!folder.is_open()) return folder;
    if (!part.empty() && part != ".") folder = open_folder(folder.number(), part, pass_flags, whole);
  }
  return folder;
}

Place place_at(int at, const fs::path& from, const fs::path& file, const fs::path& whole) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  Place place{from / folder, file.filename().string()};
  if (!file.has_parent_path() && !from.empty()) place.folder_path = from;
  place.folder = open_folders(at, folder, whole);
  if (!place.folder.is_open()) {
    place.error = errno;
    return place;
  }
  // One that may not be listed may be written to all the same.
  Descriptor list = open_folder(place.folder.number(), ".", O_RDONLY, whole);
  if (list.is_open()) place.folder = std::move(list);
  return place;
}

}  // namespace

FileKind beginning_with(std::string start, std::string noun) {
  return {std::move(noun), [start = std::move(start)](int file) {
            std::string text(byte_order_mark.size() + start.size(), '\0');
            errno = 0;
            text.resize(read_fully(file, 0, std::as_writable_bytes(std::span(text))));
            return text.empty() ? errno == 0 : without_byte_order_mark(text).starts_with(start);
          }};
}

bool is_link(int folder, const std::string& name, const fs::path& path) {
  struct stat link {};
  struct stat around {};
  if (::fstatat(folder, name.c_str(), &link, AT_SYMLINK_NOFOLLOW) != 0 || !S_ISLNK(link.st_mode)) return false;
  const bool known = ::fstat(folder, &around) == 0;
  const bool shared = !known || ((around.st_mode & S_ISVTX) != 0 && (around.st_mode & (S_IWGRP | S_IWOTH)) != 0);
  if (!shared || link.st_uid == ::geteuid() || (known && link.st_uid == around.st_uid)) return true;
  throw FileError(Error::at(path.string(), fmt::format("cannot write {}: {} is a link that another user put there; "
                                                       "choose another place",
                                                       path.string(), name)),
                  EACCES);
}

Descriptor open_folder(int folder, const std::string& name, int flags, const fs::path& path) {
  const auto open = [&](int more) {
    return Descriptor(again([&] { return ::openat(folder, name.c_str(), flags | more | O_DIRECTORY | O_CLOEXEC); }));
  };
  // A folder may give way to a link at any time, so a link is followed only if it is known as one.
  Descriptor opened = open(O_NOFOLLOW);
  if (opened.is_open() || (errno != ENOTDIR && errno != ELOOP)) return opened;
  const int error = errno;
  if (is_link(folder, name, path)) return open(0);
  errno = error;
  return opened;
}

bool Place::may_get(const FileKind& kind) const {
  struct stat status {};
  if (!kind.has || ::fstatat(folder.number(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) return true;
  if (!S_ISREG(status.st_mode)) return true;
  const Descriptor there(again([&] {
    return ::openat(folder.number(), name.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_NOCTTY | O_CLOEXEC);
  }));
  return kind.has(there.number());
}

Descriptor open_folders(const fs::path& path) { return open_folders(AT_FDCWD, path, path); }

Place place_of(const fs::path& file) { return place_at(AT_FDCWD, {}, file, file); }

Place place_behind_links(const fs::path& file) {
  constexpr int most_links = 40;  // as Linux follows
  Place place = place_of(file);
  for (int i = 0; place.folder.is_open() && is_link(place.folder.number(), place.name, file); ++i) {
    struct stat status {};
    // Links in /proc lead to pipes by no path.
    if (::fstatat(place.folder.number(), place.name.c_str(), &status, 0) == 0 && !S_ISREG(status.st_mode)) break;
    if (i == most_links) fail("write", file, ELOOP);
    std::string target(4096, '\0');  // PATH_MAX of Linux
    const ssize_t size = ::readlinkat(place.folder.number(), place.name.c_str(), target.data(), target.size());
    if (size < 0) fail("write", file, errno);
    target.resize(static_cast<std::size_t>(size));
    place = place_at(place.folder.number(), place.folder_path, target, file);
  }
  return place;
}

}  // namespace roam::files
