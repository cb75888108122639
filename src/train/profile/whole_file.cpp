#include "train/profile/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>

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
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) fail_to_read(file, EISDIR);
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  if (!in) fail_to_read(file, errno);
  std::string text(limit + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) fail_to_read(file, errno);
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > limit) fail_to_read(file, EFBIG);
  return text;
}

void write_whole(const std::filesystem::path& file, std::string_view text) {
  demand_name(file);
  Unfinished unfinished(file);
  unfinished.write(text);
  unfinished.finish();
}

}  // namespace roam::training
