#include "store/folder.h"

#include <dirent.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include "files/place.h"
#include "store/files.h"

namespace roam::store {
namespace {

namespace fs = std::filesystem;

static_assert(is_a_link == ELOOP && is_a_folder == EISDIR && is_something_else == ESPIPE);

/// A component of a name as the system calls want it.
class Component {
 public:
  explicit Component(std::string_view text) {
    const std::size_t size = std::min(text.size(), text_.size() - 1);
    std::memcpy(text_.data(), text.data(), size);
    fits_ = size == text.size() && text != "..";
  }
  [[nodiscard]] const char* get() const { return text_.data(); }
  [[nodiscard]] bool fits() const { return fits_; }

 private:
  std::array<char, 256> text_{};
  bool fits_;
};

int kind(mode_t mode) {
  if (S_ISLNK(mode)) return is_a_link;
  return S_ISDIR(mode) ? is_a_folder : is_something_else;
}

/// What is in the place of a file or folder, where open(2) said `error`.
int kind_at(int folder, const Component& name, int error, mode_t wanted) {
  struct stat status {};
  if (::fstatat(folder, name.get(), &status, AT_SYMLINK_NOFOLLOW) != 0 || (status.st_mode & S_IFMT) == wanted) {
    return error;
  }
  return kind(status.st_mode);
}

Descriptor open_component(int folder, std::string_view text, int flags, mode_t wanted) {
  const Component name(text);
  if (!name.fits()) {
    errno = ENAMETOOLONG;
    return Descriptor();
  }
  // Without O_NONBLOCK a pipe would be waited for.
  Descriptor opened(again(
      [&] { return ::openat(folder, name.get(), flags | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0666); }));
  if (!opened.is_open()) {
    errno = kind_at(folder, name, errno, wanted);
    return opened;
  }
  struct stat status {};
  int error = ::fstat(opened.number(), &status) != 0 ? errno : 0;
  if (error == 0 && (status.st_mode & S_IFMT) != wanted) error = kind(status.st_mode);
  if (error == 0) return opened;
  opened = Descriptor();
  errno = error;
  return opened;
}

/// The first part of the name that is a link, or the name.
fs::path in_the_way(const Folder& store, const std::string& name) {
  fs::path path = store.path();
  std::error_code error;
  for (const fs::path& part : fs::path(name)) {
    path /= part;
    if (fs::is_symlink(path, error)) break;
  }
  return path;
}

struct CloseFolder {
  void operator()(DIR* folder) const { ::closedir(folder); }
};

/// The names in an open folder; false, and errno set, where it cannot be read.
bool list(Descriptor folder, std::vector<std::string>& names) {
  const std::unique_ptr<DIR, CloseFolder> entries(::fdopendir(folder.number()));
  if (!entries) return false;
  (void)folder.release();  // which `entries` closes
  while (const dirent* entry = ::readdir(entries.get())) {
    const std::string_view name = entry->d_name;
    if (name != "." && name != "..") names.emplace_back(name);
  }
  return true;
}

/// Removes what is in an open folder, so many folders deep.
void empty(const Descriptor& folder, int depth) {
  Descriptor again_open(again([&] { return ::openat(folder.number(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC); }));
  std::vector<std::string> names;
  if (!again_open.is_open() || !list(std::move(again_open), names)) return;
  for (const std::string& name : names) {
    if (::unlinkat(folder.number(), name.c_str(), 0) == 0 || depth == 0) continue;
    const Descriptor inner = open_component(folder.number(), name, O_RDONLY, S_IFDIR);
    if (!inner.is_open()) continue;
    empty(inner, depth - 1);
    ::unlinkat(folder.number(), name.c_str(), AT_REMOVEDIR);
  }
}

/// Folders in a folder of a store: scratch/runs.
constexpr int deepest = 2;

bool remove(const Folder& store, const std::string& name, int flags) noexcept {
  const auto [above, own] = split(name);
  const Descriptor folder = open_folder(store, above);
  if (!folder.is_open()) return false;
  const Component last(own);
  return last.fits() && ::unlinkat(folder.number(), last.get(), flags) == 0;
}

}  // namespace

Folder Folder::held(const fs::path& path, bool through_link) {
  Folder folder(path);
  Descriptor opened = through_link ? files::open_folders(path) : Descriptor(again([&] {
    return ::open(path.c_str(), not_to_read | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  }));
  if (opened.is_open()) opened = files::open_folder(opened.number(), ".", O_RDONLY, path);
  folder.held_ = std::make_shared<const Descriptor>(std::move(opened));
  if (folder.held_->is_open()) return folder;
  const int error = errno;
  std::error_code none;
  fail("open", path, "", !through_link && fs::is_symlink(fs::symlink_status(path, none)) ? is_a_link : error);
}

Folder Folder::held_or_made(const fs::path& path, bool through_link, std::vector<MadeFolder>& made) {
  Folder folder(path);
  constexpr int flags = not_to_read | O_DIRECTORY | O_CLOEXEC;
  Descriptor at(again([&] { return ::open(path.is_absolute() ? "/" : ".", flags); }));
  std::vector<std::string> names;
  for (const fs::path& name : path.relative_path()) {
    if (!name.empty() && name != ".") names.push_back(name.string());
  }
  for (const std::string& name : names) {
    const bool is_last = &name == &names.back();
    const auto open = [&] {
      if (!is_last || through_link) return files::open_folder(at.number(), name, not_to_read, path);
      return Descriptor(again([&] { return ::openat(at.number(), name.c_str(), flags | O_NOFOLLOW); }));
    };
    Descriptor next = open();
    if (!next.is_open() && errno == ENOENT) {
      if (::mkdirat(at.number(), name.c_str(), 0777) == 0) {
        made.push_back({std::move(at), name});
        at = Descriptor(again([&] { return ::openat(made.back().above.number(), ".", O_RDONLY | O_CLOEXEC); }));
        if (!at.is_open()) fail("open", path, "", errno);
        sync_folder(at.number(), path);
        next = Descriptor(again([&] { return ::openat(at.number(), name.c_str(), flags | O_NOFOLLOW); }));
      } else if (errno == EEXIST) {  // another builder has made it, or it is a link that leads nowhere
        next = open();
      } else {
        fail("make the folder", path, "", errno);
      }
    }
    if (!next.is_open()) {
      const int error = errno;
      struct stat status {};
      const bool link = is_last && !through_link &&
                        ::fstatat(at.number(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
                        S_ISLNK(status.st_mode);
      fail("open", path, "", link ? is_a_link : error);
    }
    at = std::move(next);
  }
  folder.held_ = std::make_shared<const Descriptor>(
      again([&] { return ::openat(at.number(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC); }));
  if (!folder.held_->is_open()) fail("open", path, "", errno);
  return folder;
}

Descriptor Folder::open() const noexcept {
  constexpr int flags = O_RDONLY | O_DIRECTORY | O_CLOEXEC;
  if (held_) return Descriptor(again([&] { return ::openat(held_->number(), ".", flags); }));
  return Descriptor(again([&] { return ::open(path_.c_str(), flags); }));
}

bool Folder::is_in_place() const noexcept {
  struct stat now {
  }, then{};
  return held_ && ::stat(path_.c_str(), &now) == 0 && ::fstat(held_->number(), &then) == 0 &&
         now.st_dev == then.st_dev && now.st_ino == then.st_ino;
}

void fail(const char* what, const Folder& store, const std::string& name, int error) {
  const fs::path file = name.empty() ? store.path() : store / name;
  const auto refuse = [&](const std::string& why) {
    throw FileError(Error::at(file.string(), fmt::format("cannot {} {}: {}", what, file.string(), why)), error);
  };
  if (error == is_a_link) {
    refuse(
        fmt::format("{} is a symbolic link, and what a store consists of lies in its own folder; remove the link, "
                    "and put there what it leads to",
                    in_the_way(store, name).string()));
  }
  if (is_foreign(error)) {
    refuse(fmt::format("it is {}, which no store has there; remove it",
                       error == is_a_folder ? "a folder" : "no ordinary file"));
  }
  if (error == ENOSPC || error == EDQUOT) {
    refuse(fmt::format("{}; make room there or choose another output, and start again: what is complete is kept",
                       std::strerror(error)));
  }
  files::fail(what, file, error);
}

Descriptor open_folder(const Folder& store, std::string_view name) noexcept {
  Descriptor folder = store.open();
  while (folder.is_open() && !name.empty()) {
    const std::size_t slash = std::min(name.find('/'), name.size());
    folder = open_component(folder.number(), name.substr(0, slash), O_RDONLY, S_IFDIR);
    name.remove_prefix(std::min(slash + 1, name.size()));
  }
  return folder;
}

Descriptor open_file(const Folder& store, std::string_view name, int flags) noexcept {
  const auto [above, last] = split(name);
  const Descriptor folder = open_folder(store, above);
  return folder.is_open() ? open_component(folder.number(), last, flags, S_IFREG) : Descriptor();
}

std::pair<std::string_view, std::string_view> split(std::string_view name) noexcept {
  const std::size_t slash = std::min(name.rfind('/') + 1, name.size());  // npos + 1 is 0
  return {name.substr(0, slash > 0 ? slash - 1 : 0), name.substr(slash)};
}

unsigned type_of(const Folder& store, std::string_view name) noexcept {
  const auto [above, own] = split(name);
  const Descriptor folder = open_folder(store, above);
  const Component last(own);
  struct stat status {};
  const bool there =
      folder.is_open() && last.fits() && ::fstatat(folder.number(), last.get(), &status, AT_SYMLINK_NOFOLLOW) == 0;
  return there ? status.st_mode & S_IFMT : 0;
}

bool is_file(const Folder& store, std::string_view name) noexcept { return type_of(store, name) == S_IFREG; }

std::optional<std::uint64_t> size_of(const Folder& store, const std::string& name) {
  const auto [folder_name, last] = split(name);
  const Descriptor folder = open_folder(store, folder_name);
  struct stat status {};
  if (!folder.is_open() || ::fstatat(folder.number(), last.data(), &status, AT_SYMLINK_NOFOLLOW) != 0) {
    if (errno == ENOENT) return std::nullopt;
    fail("read", store, name, errno);
  }
  if (!S_ISREG(status.st_mode)) fail("read", store, name, kind(status.st_mode));
  return static_cast<std::uint64_t>(status.st_size);
}

std::vector<std::string> names_in(const Folder& store, const std::string& folder) {
  Descriptor opened = open_folder(store, folder);
  if (!opened.is_open()) {
    if (errno == ENOENT) return {};
    fail("read", store, folder, errno);
  }
  std::vector<std::string> names;
  if (!list(std::move(opened), names)) fail("read", store, folder, errno);
  if (folder.empty()) return names;
  for (std::string& name : names) name.insert(0, folder + "/");
  return names;
}

std::vector<std::string> files_in(const Folder& store, const std::string& folder) {
  std::vector<std::string> names = names_in(store, folder);
  std::erase_if(names, [&](const std::string& name) { return !is_file(store, name); });
  return names;
}

void make_folder_in(const Folder& store, const std::string& name) {
  Descriptor above = open_folder(store, "");
  if (!above.is_open()) fail("open", store, "", errno);
  for (const fs::path& part : fs::path(name)) {
    Descriptor next = open_component(above.number(), part.native(), O_RDONLY, S_IFDIR);
    if (!next.is_open() && errno == ENOENT) {
      if (::mkdirat(above.number(), part.c_str(), 0777) != 0 && errno != EEXIST) {
        fail("make the folder", store, name, errno);
      }
      sync_folder(above.number(), store.path());
      next = open_component(above.number(), part.native(), O_RDONLY, S_IFDIR);
    }
    if (!next.is_open()) fail("use the folder", store, name, errno);
    above = std::move(next);
  }
}

bool remove_file(const Folder& store, const std::string& name) noexcept { return remove(store, name, 0); }
bool remove_folder(const Folder& store, const std::string& name) noexcept { return remove(store, name, AT_REMOVEDIR); }

void remove_all(const Folder& store, const std::string& name) {
  if (remove_file(store, name)) return;
  const Descriptor folder = open_folder(store, name);
  if (!folder.is_open()) return;
  empty(folder, deepest);
  remove_folder(store, name);
}

}  // namespace roam::store
