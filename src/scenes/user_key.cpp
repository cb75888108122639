#include "scenes/user_key.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <span>
#include <thread>
#include <utility>

#include "cli/user_folder.h"
#include "files/descriptor.h"
#include "files/file_error.h"
#include "files/whole_file.h"
#include "roam/error.h"
#include "store/folder.h"

namespace roam::app {
namespace {

namespace fs = std::filesystem;
using files::Descriptor;

constexpr mode_t others_reading = 077, others_writing = 022;
constexpr unsigned own_folder = 0700, own_file = 0600;  // rights
constexpr int most_looks = 20;                          // at a key with several names, in 1 s
/// 64 digits and a line feed.
constexpr std::size_t key_bytes = 65;

struct stat status_of(const Descriptor& opened, const fs::path& path) {
  struct stat status {};
  if (::fstat(opened.number(), &status) != 0) files::fail("read", path, errno);
  return status;
}

/// Throws if it does not belong to the user, or if others have these rights.
void demand_own(const struct stat& status, const fs::path& path, mode_t rights) {
  if (status.st_uid != ::geteuid())
    throw Error::at(path.string(), fmt::format("{} belongs to another user", path.string()));
  if ((status.st_mode & rights) == 0) return;
  const bool reading = rights == others_reading;
  throw Error::at(path.string(),
                  fmt::format("others may {} {}; take that right from them: chmod go-{} {}",
                              reading ? "read" : "write to", path.string(), reading ? "rwx" : "w", path.string()));
}

/// Opens the folder that holds the folder of the key; with `makes`, makes it if there is none. Not open if it does not
/// exist. Throws if others may give another folder the name of the key's.
Descriptor open_above(const fs::path& path, bool makes) {
  const auto open = [&] { return Descriptor(::open(path.c_str(), store::not_to_read | O_DIRECTORY | O_CLOEXEC)); };
  Descriptor above = open();
  if (!above.is_open() && errno == ENOENT && makes) {
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    if (::mkdir(path.c_str(), own_folder) != 0 && errno != EEXIST) files::fail("make the folder", path, errno);
    above = open();
  }
  if (!above.is_open()) {
    if (errno == ENOENT && !makes) return above;
    files::fail("read", path, errno);
  }
  const mode_t mode = status_of(above, path).st_mode;
  if ((mode & others_writing) == 0 || (mode & S_ISVTX) != 0) return above;
  throw Error::at(
      path.string(),
      fmt::format("others may rename folders in {0}; take that right from them: chmod go-w {0}, or, where they "
                  "may write, chmod +t {0}",
                  path.string()));
}

/// Opens the folder of the key. All checks are of the folder that is open, because its path may lead to another one
/// later. Not open if it does not exist and is not to be made.
Descriptor open_folder(const fs::path& path, bool makes) {
  const Descriptor above = open_above(path.parent_path(), makes);
  if (!above.is_open()) return Descriptor();
  const std::string name = path.filename().string();
  const auto open = [&] {
    return Descriptor(::openat(above.number(), name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  };
  Descriptor folder = open();
  if (!folder.is_open() && errno == ENOENT) {
    if (!makes) return folder;
    if (::mkdirat(above.number(), name.c_str(), own_folder) != 0 && errno != EEXIST) {
      files::fail("make the folder", path, errno);
    }
    folder = open();
  }
  if (!folder.is_open()) {
    // A link is no folder to the system, either.
    if (errno != ENOTDIR && errno != ELOOP) files::fail("read", path, errno);
    std::error_code error;
    const bool link = fs::is_symlink(fs::symlink_status(path, error));
    throw Error::at(path.string(),
                    fmt::format("{} is {}; put the folder itself there", path.string(), link ? "a link" : "no folder"));
  }
  demand_own(status_of(folder, path), path, others_writing);
  return folder;
}

StoreKey parse(const std::string& text, const fs::path& file) {
  StoreKey key;
  bool good = text.size() == key_bytes && text.back() == '\n';
  for (std::size_t i = 0; good && i < key.bytes.size(); ++i) {
    std::uint8_t byte = 0;
    const char* const end = text.data() + 2 * i + 2;
    const auto [at, error] = std::from_chars(end - 2, end, byte, 16);
    good = error == std::errc() && at == end;
    key.bytes[i] = std::byte{byte};
  }
  if (good) return key;
  throw Error::at(
      file.string(),
      fmt::format("{} is damaged; put a copy of it back, or remove it: then stores that were built with it are "
                  "no longer known as yours",
                  file.string()));
}

bool is_there(const Descriptor& folder, const fs::path& file) {
  struct stat status {};
  return ::fstatat(folder.number(), file.filename().c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 || errno != ENOENT;
}

StoreKey read(const Descriptor& folder, const fs::path& file) {
  const auto open = [&] { return files::open_regular(folder.number(), file.filename().string(), file); };
  Descriptor key = open();
  struct stat status = status_of(key, file);
  // On some file systems the process that makes it gives it its name before it takes the temporary one away.
  for (int i = 0; i < most_looks && status.st_nlink > 1; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    key = open();
    status = status_of(key, file);
  }
  demand_own(status, file, others_reading);
  if (status.st_nlink > 1) {
    throw Error::at(file.string(),
                    fmt::format("{} has other names, too (hard links); put a copy in its place", file.string()));
  }
  return parse(files::read_to_end(key, file, 4096), file);
}

void make(const Descriptor& folder, const fs::path& file) {
  std::string text;
  for (const std::byte byte : key_of_this_run().bytes) text += fmt::format("{:02x}", static_cast<unsigned>(byte));
  text += '\n';
  Descriptor own(::fcntl(folder.number(), F_DUPFD_CLOEXEC, 0));
  if (!own.is_open()) files::fail("write", file, errno);
  // Tasks on several machines may begin at once, where a folder's lock is not known to the others.
  files::WholeFile out(std::move(own), file.parent_path(), file.filename().string(), own_file,
                       files::Naming::unclaimed);
  out.write(std::as_bytes(std::span(text)));
  out.commit();
}

/// Whether a machine without a place for a key has this error, and not one whose disk is full or fails.
bool is_lasting(int error) {
  return error == EACCES || error == EPERM || error == EROFS || error == ENOENT || error == ENOTDIR;
}

UserKey found(bool makes) {
  const fs::path file = key_file();
  if (file.empty()) return {{}, Error("there is no folder for it: set HOME or XDG_DATA_HOME")};
  try {
    const Descriptor folder = open_folder(file.parent_path(), makes);
    if (!folder.is_open() || !is_there(folder, file)) {
      if (!makes) return {{}, Error("you have none yet, and the first `roam build` makes it")};
      make(folder, file);
    }
    return {read(folder, file)};
  } catch (const files::FileError& error) {
    if (makes && !is_lasting(error.number)) throw;
    return {{}, error};
  } catch (const Error& error) {
    return {{}, error};
  }
}

}  // namespace

fs::path key_file() {
  const fs::path folder = user_folder("XDG_DATA_HOME", ".local/share");
  return folder.empty() ? folder : folder / "store.key";
}

UserKey user_key() { return found(false); }
UserKey made_user_key() { return found(true); }

StoreKey key_of_this_run() {
  StoreKey key;
  if (::getrandom(key.bytes.data(), key.bytes.size(), 0) != static_cast<ssize_t>(key.bytes.size())) {
    throw Error("the operating system gives no random numbers");
  }
  return key;
}

}  // namespace roam::app
