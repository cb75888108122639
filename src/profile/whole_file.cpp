#include "profile/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>

#include "files/unfinished.h"
#include "roam/error.h"

namespace roam::training {
namespace {

[[noreturn]] void fail_to_write(const std::filesystem::path& file, int error) {
  throw Error(fmt::format("cannot write {}: {}; is its folder yours, and the disk not full?", file.string(),
                          std::strerror(error)));
}

[[noreturn]] void fail_to_read(const std::filesystem::path& file, int error) {
  throw Error(
      fmt::format("cannot read {}: {}; check its name, and that you may read it", file.string(), std::strerror(error)));
}

void demand_name(const std::filesystem::path& file) {
  if (file.empty()) throw Error("the path of the file is empty; name the file");
}

/// A regular file, open for reading. The folder of a scene may come from a stranger: a pipe in it would keep the reader
/// waiting for ever, and a link could lead to a secret that a message then quotes.
class Opened {
 public:
  explicit Opened(const std::filesystem::path& file)
      : descriptor_(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOFOLLOW | O_NOCTTY | O_CLOEXEC)) {
    if (descriptor_ < 0) {
      if (errno != ELOOP) fail_to_read(file, errno);
      throw Error(fmt::format("cannot read {}: it is a link; put the file itself there", file.string()));
    }
    struct stat status {};
    const int error = ::fstat(descriptor_, &status) != 0 ? errno : S_ISDIR(status.st_mode) ? EISDIR : 0;
    if (error == 0 && S_ISREG(status.st_mode)) return;
    ::close(descriptor_);
    if (error != 0) fail_to_read(file, error);
    throw Error(fmt::format("cannot read {}: it is a pipe or a device; put a file there", file.string()));
  }
  ~Opened() { ::close(descriptor_); }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

/// A file in the making, which is removed again unless it gets its name.
class Unfinished {
 public:
  explicit Unfinished(const std::filesystem::path& file) : file_(file) {
    static std::atomic<std::uint64_t> number{0};
    temporary_ = fmt::format("{}.{}.{}.unfinished", file.string(), ::getpid(), number++);
    listed_.begin(temporary_);
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) {
      const int error = errno;
      temporary_.clear();
      fail_to_write(file, error);
    }
  }
  ~Unfinished() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
  }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

  void write(std::string_view text) {
    while (!text.empty()) {
      const ssize_t written = ::write(descriptor_, text.data(), text.size());
      if (written < 0 && errno != EINTR) give_up();
      if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
    }
  }
  void finish() {
    if (::fsync(descriptor_) != 0) give_up();
    if (::rename(temporary_.c_str(), file_.c_str()) != 0) give_up();
    temporary_.clear();
    // The name too is to survive a power cut, where the file system knows how.
    const std::filesystem::path folder = file_.has_parent_path() ? file_.parent_path() : std::filesystem::path(".");
    const int opened = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (opened < 0) return;
    ::fsync(opened);
    ::close(opened);
  }

 private:
  [[noreturn]] void give_up() const { fail_to_write(file_, errno); }

  std::filesystem::path file_;
  std::string temporary_;
  files::Unfinished listed_;
  int descriptor_ = -1;
};

}  // namespace

std::string read_whole(const std::filesystem::path& file, std::uint64_t limit) {
  demand_name(file);
  const Opened opened(file);
  std::string text;
  std::array<char, 65536> piece;
  for (;;) {
    const ssize_t got = ::read(opened.descriptor(), piece.data(), piece.size());
    if (got == 0) return text;
    if (got < 0 && errno != EINTR) fail_to_read(file, errno);
    if (got > 0) text.append(piece.data(), static_cast<std::size_t>(got));
    if (text.size() > limit) fail_to_read(file, EFBIG);
  }
}

void write_whole(const std::filesystem::path& file, std::string_view text) {
  demand_name(file);
  Unfinished unfinished(file);
  unfinished.write(text);
  unfinished.finish();
}

}  // namespace roam::training
