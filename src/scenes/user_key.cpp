#include "scenes/user_key.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>

#include <algorithm>
#include <charconv>
#include <span>

#include "cli/user_folder.h"
#include "files/descriptor.h"
#include "files/file_error.h"
#include "files/whole_file.h"
#include "roam/error.h"

namespace roam::app {
namespace {

namespace fs = std::filesystem;
using files::Descriptor;

constexpr mode_t others_reading = 077, others_writing = 022;
constexpr unsigned own_folder = 0700, own_file = 0600;  // rights
/// 64 digits and a line feed.
constexpr std::size_t key_bytes = 65;

/// Throws if it does not belong to the user, or if others have these rights.
void demand_own(const fs::path& path, mode_t rights) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) files::fail("read", path, errno);
  if (status.st_uid != ::geteuid()) throw Error(fmt::format("{} belongs to another user", path.string()));
  if ((status.st_mode & rights) == 0) return;
  const bool reading = rights == others_reading;
  throw Error(fmt::format("others may {} {}; take that right from them: chmod go-{} {}", reading ? "read" : "write to",
                          path.string(), reading ? "rwx" : "w", path.string()));
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
  throw Error(
      fmt::format("{} is damaged; put a copy of it back, or remove it: then stores that were built with it are "
                  "no longer known as yours",
                  file.string()));
}

StoreKey read(const fs::path& file) {
  demand_own(file.parent_path(), others_writing);
  const std::string text = files::read_whole(file, 4096);
  demand_own(file, others_reading);
  return parse(text, file);
}

void make(const fs::path& file) {
  std::string text;
  for (const std::byte byte : key_of_this_run().bytes) text += fmt::format("{:02x}", static_cast<unsigned>(byte));
  files::WholeFile out(file, own_file);
  text += '\n';
  out.write(std::as_bytes(std::span(text)));
  out.commit();
}

UserKey found(bool makes) {
  const fs::path file = key_file();
  if (file.empty()) return {{}, "there is no folder for it: set HOME or XDG_DATA_HOME"};
  try {
    std::error_code error;
    const fs::path folder = file.parent_path();
    if (!fs::exists(fs::symlink_status(file, error))) {
      if (!makes) return {{}, "you have none yet, and the first `roam build` makes it"};
      if (!fs::exists(folder, error)) {
        fs::create_directories(folder.parent_path(), error);
        if (::mkdir(folder.c_str(), own_folder) != 0 && errno != EEXIST) files::fail("make the folder", folder, errno);
      }
      demand_own(folder, others_writing);
      // If two processes begin at once, one makes the key for both. Some file systems have no locks.
      const Descriptor lock(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
      (void)files::again([&] { return ::flock(lock.number(), LOCK_EX); });
      if (!fs::exists(fs::symlink_status(file, error))) make(file);
    }
    return {read(file), ""};
  } catch (const Error& error) {
    return {{}, error.what()};
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
