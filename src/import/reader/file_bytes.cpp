#include "import/reader/file_bytes.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "roam/error.h"
#include "text/byte_order_mark.h"

namespace roam::reader {
namespace {

constexpr std::size_t buffer_bytes = 4u << 20;

}  // namespace

FileBytes::FileBytes(const std::filesystem::path& path, std::function<void(std::uint64_t)> progress)
    : path_(path.string()), progress_(std::move(progress)), file_(open(path_.c_str(), O_RDONLY | O_CLOEXEC)) {
  struct stat status {};
  if (!file_.is_open() || fstat(file_.number(), &status) != 0) {
    const std::string reason = std::strerror(errno);
    throw Error(path_, fmt::format("this file cannot be opened: {}.", reason));
  }
  size_ = static_cast<std::uint64_t>(status.st_size);
  buffer_.resize(buffer_bytes);
}

std::string_view FileBytes::refill(std::size_t wanted) {
  if (wanted > window_limit) {
    throw Error(path_, fmt::format("from byte {} on it has no end of a line or list for {} MiB; the file is damaged.",
                                   offset(), window_limit >> 20));
  }
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (wanted > buffer_.size()) buffer_.resize(std::max(wanted, std::min(2 * buffer_.size(), window_limit)));
  // Stop at `wanted` bytes even if the buffer has room: a short read is no reason to wait for more.
  while (!at_end_ && end_ < wanted) {
    const ssize_t n = files::again([&] { return read(file_.number(), buffer_.data() + end_, buffer_.size() - end_); });
    if (n < 0) throw Error(path_, fmt::format("reading failed at byte {}: {}.", read_, std::strerror(errno)));
    at_end_ = n == 0;
    end_ += static_cast<std::size_t>(n);
    read_ += static_cast<std::uint64_t>(n);
  }
  progress_(read_);
  return {buffer_.data(), end_};
}

Lines::Lines(FileBytes& bytes) : bytes_(bytes) {
  constexpr std::size_t looked_at = 4096;
  const std::string_view start = bytes_.window(looked_at);
  const auto end = start.find_first_of("\r\n");
  if (end != std::string_view::npos && start[end] == '\r' && !start.substr(end).starts_with("\r\n"))
    end_of_line_ = '\r';
  if (is_utf16(start)) throw Error(bytes_.path(), "this is UTF-16 text; save it as UTF-8.");
  if (start.starts_with(byte_order_mark)) bytes_.skip(byte_order_mark.size());
}

bool Lines::next(std::string_view& line) {
  std::size_t searched = 0;
  std::string_view window = bytes_.window(1);
  if (window.empty()) return false;
  std::size_t length = 0;
  while (true) {
    const void* end = std::memchr(window.data() + searched, end_of_line_, window.size() - searched);
    if (end != nullptr) {
      length = static_cast<std::size_t>(static_cast<const char*>(end) - window.data());
      bytes_.skip(length + 1);
      break;
    }
    searched = window.size();
    window = bytes_.window(searched + 1);
    if (window.size() == searched) {
      length = searched;
      bytes_.skip(length);
      break;
    }
  }
  ++number_;
  line = window.substr(0, length);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return true;
}

}  // namespace roam::reader
