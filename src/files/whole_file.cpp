#include "files/whole_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <memory>
#include <system_error>
#include <utility>

#include "files/file_error.h"

namespace roam::files {
namespace {

namespace fs = std::filesystem;

/// Leaves room for the process and the number in a name of 255 bytes, the most that file systems take.
constexpr std::size_t longest_stem = 200;

constexpr int list_flags = O_RDONLY | O_DIRECTORY | O_CLOEXEC;

void demand_name(const fs::path& file) {
  if (file.empty()) throw Error("the path of the file is empty; name the file");
}

/// "a-2.png" for "a.png" and 2.
std::string numbered(const fs::path& name, int number) {
  return fmt::format("{}-{}{}", name.stem().string(), number, name.extension().string());
}

/// Nobody chose the name or the folder of a numbered file: the message has its whole path.
[[noreturn]] void fail_to_write_numbered(int folder, const fs::path& path, const std::string& name, int error) {
  int number = 1;
  struct stat status {};
  while (::fstatat(folder, numbered(name, number).c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0) ++number;
  std::error_code none;
  fail("write", (fs::absolute(path, none) / numbered(name, number)).lexically_normal(), error);
}

}  // namespace

// The folder of a scene may come from a stranger: a pipe in it would keep the reader waiting for ever, and a link could
// lead to a secret that a message then quotes.
Descriptor open_regular(int folder, const std::string& name, const fs::path& file) {
  Descriptor opened(
      again([&] { return ::openat(folder, name.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_NOCTTY | O_CLOEXEC); }));
  if (!opened.is_open()) {
    if (errno != ELOOP) fail("read", file, errno);
    throw Error::at(file.string(),
                    fmt::format("cannot read {}: it is a link; put the file itself there", file.string()));
  }
  struct stat status {};
  if (::fstat(opened.number(), &status) != 0) fail("read", file, errno);
  if (S_ISDIR(status.st_mode)) fail("read", file, EISDIR);
  if (S_ISREG(status.st_mode)) return opened;
  throw Error::at(file.string(),
                  fmt::format("cannot read {}: it is a pipe or a device; put a file there", file.string()));
}

std::string read_to_end(const Descriptor& opened, const fs::path& file, std::uint64_t limit) {
  std::string text;
  std::array<char, 65536> piece;
  for (;;) {
    const ssize_t got = again([&] { return ::read(opened.number(), piece.data(), piece.size()); });
    if (got == 0) return text;
    if (got < 0) fail("read", file, errno);
    text.append(piece.data(), static_cast<std::size_t>(got));
    if (text.size() > limit) fail("read", file, EFBIG);
  }
}

namespace {

/// The place of a file of this naming, in an open folder.
Place place_for(const fs::path& file, Naming naming) {
  demand_name(file);
  Place place = naming == Naming::exact ? place_behind_links(file) : place_of(file);
  if (!place.folder.is_open()) fail("write", file, place.error);
  return place;
}

}  // namespace

WholeFile::WholeFile(const fs::path& file, Naming naming, FileKind kind)
    : WholeFile(place_for(file, naming), naming, std::move(kind), usual_rights) {
  if (naming_ != Naming::numbered) demand_replaceable();
  remove_abandoned();
}

WholeFile::WholeFile(Descriptor folder, fs::path folder_path, std::string name, unsigned rights, Naming naming)
    : WholeFile(Place{std::move(folder_path), std::move(name), std::move(folder)}, naming, {}, rights) {}

WholeFile::WholeFile(Place place, Naming naming, FileKind kind, unsigned rights)
    : place_(std::move(place)), kind_(std::move(kind)), rights_(rights), naming_(naming) {
  static std::atomic<std::uint64_t> number{0};
  if (place_.name.empty()) fail_to_write(EISDIR);
  while (!begin(number++)) {
  }
}

void WholeFile::demand_replaceable() const {
  // Renaming would replace a device, and fail on a folder after all the work.
  struct stat status {};
  if (::fstatat(folder(), place_.name.c_str(), &status, 0) != 0) {
    if (errno != ENOENT) fail_to_write(errno);
    return;
  }
  if (S_ISDIR(status.st_mode)) fail_to_write(EISDIR);
  const std::string file = place_.path().string();
  if (!S_ISREG(status.st_mode)) {
    throw FileError(Error::at(file, fmt::format("cannot write {}: it is a pipe or a device; name a file", file)),
                    ESPIPE);
  }
  if (place_.may_get(kind_)) return;
  throw FileError(Error::at(file, fmt::format("cannot write {}: this would overwrite a file that is no {}; name "
                                              "another file, or move that one away",
                                              file, kind_.noun)),
                  EEXIST);
}

bool WholeFile::begin(std::uint64_t number) {
  temporary_ = fmt::format("{}.{}.{}{}", place_.name.substr(0, longest_stem), ::getpid(), number, temporary_suffix);
  const int file = again([&] {
    return ::openat(folder(), temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, rights_);
  });
  if (file < 0) {
    const int error = errno;
    temporary_.clear();
    // Left by a process that had the same number, in a container perhaps.
    if (error == EEXIST) return false;
    fail_to_write(error);
  }
  file_ = Descriptor(file);
  // Where files have no locks, remove_abandoned() gets none either.
  const bool taken = ::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  struct stat status {};
  if (taken || (::fstat(file, &status) == 0 && status.st_nlink == 0)) {  // one that removes abandoned files was faster
    temporary_.clear();
    return false;
  }
  try {
    listed_.begin(folder(), temporary_);
  } catch (...) {
    // Called by a constructor, so the destructor will not remove it.
    ::unlinkat(folder(), temporary_.c_str(), 0);
    throw;
  }
  return true;
}

void WholeFile::remove_abandoned() const {
  Descriptor list(::openat(folder(), ".", list_flags));
  const std::unique_ptr<DIR, int (*)(DIR*)> entries(::fdopendir(list.number()), &::closedir);
  if (!entries) return;
  static_cast<void>(list.release());
  const std::string_view stem = std::string_view(place_.name).substr(0, longest_stem);
  while (const dirent* const entry = ::readdir(entries.get())) {
    const char* const name = entry->d_name;
    if (!is_temporary(name, [&](std::string_view of) { return of == stem; })) continue;
    const Descriptor left(::openat(folder(), name, O_RDWR | O_NONBLOCK | O_NOFOLLOW | O_NOCTTY | O_CLOEXEC));
    struct stat opened {};
    struct stat named {};
    if (!left.is_open() || ::flock(left.number(), LOCK_EX | LOCK_NB) != 0) continue;
    if (::fstat(left.number(), &opened) != 0 || !S_ISREG(opened.st_mode)) continue;
    // Committed meanwhile, and another one has the name now.
    if (::fstatat(folder(), name, &named, AT_SYMLINK_NOFOLLOW) != 0 || named.st_ino != opened.st_ino) continue;
    ::unlinkat(folder(), name, 0);
  }
}

WholeFile::~WholeFile() {
  if (!temporary_.empty()) ::unlinkat(folder(), temporary_.c_str(), 0);
}

void WholeFile::fail_to_write(int error) const {
  if (naming_ == Naming::numbered) fail_to_write_numbered(folder(), place_.folder_path, place_.name, error);
  fail("write", place_.path(), error);
}

void WholeFile::write(std::span<const std::byte> bytes) {
  if (write_fully(file_.number(), bytes) < bytes.size()) fail_to_write(errno);
}

void WholeFile::write_at(std::uint64_t offset, std::span<const std::byte> bytes) {
  if (write_fully(file_.number(), offset, bytes) < bytes.size()) fail_to_write(errno);
}

void WholeFile::finish_writing() {
  if (again([&] { return ::fsync(file_.number()); }) != 0) fail_to_write(errno);
  // Some network file systems tell of a full disk only when a file is closed. This one stays open, for its lock.
  const int copy = ::fcntl(file_.number(), F_DUPFD_CLOEXEC, 0);
  if (copy < 0 || (::close(copy) != 0 && errno != EINTR)) fail_to_write(errno);
}

bool WholeFile::take(const std::string& name) {
#ifdef RENAME_NOREPLACE
  if (::renameat2(folder(), temporary_.c_str(), folder(), name.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno == EEXIST) return false;
    // Some file systems cannot.
#endif
  if (::linkat(folder(), temporary_.c_str(), folder(), name.c_str(), 0) == 0) {
    ::unlinkat(folder(), temporary_.c_str(), 0);
    return true;
  }
  // Some file systems know no second name of a file.
  struct stat status {};
  if (errno == EEXIST || ::fstatat(folder(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0) return false;
  if (::renameat(folder(), temporary_.c_str(), folder(), name.c_str()) != 0) fail_to_write(errno);
  return true;
}

// Nothing allocates once the file has its name. Only the fsync of its folder may fail then.
fs::path WholeFile::commit() {
  fs::path file = place_.path();
  if (naming_ == Naming::unclaimed) {
    finish_writing();
    if (!take(place_.name)) ::unlinkat(folder(), temporary_.c_str(), 0);
    settle();
    return file;
  }
  finish_writing();
  if (naming_ != Naming::numbered) {
    demand_replaceable();
    rename_to(place_.name);
    return file;
  }
  for (int number = 1;; ++number) {
    const std::string name = numbered(place_.name, number);
    file = place_.folder_path / name;
    if (take(name)) break;
  }
  settle();
  return file;
}

void WholeFile::commit_as(const std::string& name) {
  finish_writing();
  rename_to(name);
}

void WholeFile::rename_to(const std::string& name) {
  if (::renameat(folder(), temporary_.c_str(), folder(), name.c_str()) != 0) fail_to_write(errno);
  settle();
}

void WholeFile::settle() {
  temporary_.clear();
  listed_.end();
  file_.close();
  sync_folder(folder(), place_.folder_path);
}

bool is_temporary(std::string_view name, const std::function<bool(std::string_view)>& is_final) {
  if (!name.ends_with(temporary_suffix)) return false;
  name.remove_suffix(temporary_suffix.size());
  for (int i = 0; i < 2; ++i) {  // the process, and the number of the file
    const std::size_t end = name.find_last_not_of("0123456789");
    if (end == std::string_view::npos || end + 1 == name.size() || name[end] != '.') return false;
    name = name.substr(0, end);
  }
  return is_final(name);
}

fs::path write_whole(const fs::path& file, std::string_view text, Naming naming, FileKind kind) {
  WholeFile out(file, naming, std::move(kind));
  out.write(std::as_bytes(std::span(text)));
  return out.commit();
}

std::string read_whole(const fs::path& file, std::uint64_t limit) {
  demand_name(file);
  return read_to_end(open_regular(AT_FDCWD, file.string(), file), file, limit);
}

Descriptor open_named(const fs::path& file) {
  demand_name(file);
  Descriptor opened(again([&] { return ::open(file.c_str(), O_RDONLY | O_NOCTTY | O_CLOEXEC); }));
  if (!opened.is_open()) fail("read", file, errno);
  return opened;
}

std::string read_named(const fs::path& file, std::uint64_t limit) { return read_to_end(open_named(file), file, limit); }

void sync_folder(int folder, const fs::path& path) {
  if (again([&] { return ::fsync(folder); }) == 0) return;
  // Some network file systems know no fsync of folders, and one opened without the right to list it has none (EBADF).
  if (errno != EINVAL && errno != EBADF) fail("sync", path, errno);
}

}  // namespace roam::files
