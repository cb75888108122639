#pragma once
/// \file
/// A file of any size as a moving window of bytes, and as lines.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "files/descriptor.h"

namespace roam::reader {

/// Reads a file from its beginning to its end through one buffer.
class FileBytes {
 public:
  /// Calls `progress` with the bytes read so far whenever the buffer is filled. Throws roam::Error if the file cannot
  /// be opened.
  FileBytes(const std::filesystem::path& path, std::function<void(std::uint64_t)> progress);

  /// The bytes from offset() on: at least `wanted`, fewer only at the end of the file. Valid until the next call of
  /// window. Throws roam::Error if `wanted` exceeds window_limit.
  std::string_view window(std::size_t wanted) {
    return end_ - begin_ >= wanted ? std::string_view(buffer_.data() + begin_, end_ - begin_) : refill(wanted);
  }
  /// Moves the window on by `count` bytes.
  void skip(std::size_t count) { begin_ += count; }

  /// The position of the window in the file.
  [[nodiscard]] std::uint64_t offset() const { return read_ - (end_ - begin_); }
  /// The size of the file when it was opened.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] const std::string& path() const { return path_; }

  /// Upper bound, in bytes, of a line, token or record in a valid file.
  static constexpr std::size_t window_limit = 256u << 20;

 private:
  std::string_view refill(std::size_t wanted);

  std::string path_;
  std::function<void(std::uint64_t)> progress_;
  files::Descriptor file_;
  std::uint64_t size_ = 0, read_ = 0;
  bool at_end_ = false;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;
};

/// The lines of a text file. They end with LF or CR LF; or with CR alone, if the first line does.
class Lines {
 public:
  explicit Lines(FileBytes& bytes);

  /// Sets `line` to the next line without its end, valid until the next call. False at the end of the file.
  bool next(std::string_view& line);
  /// The number of the last line from next(), counted from 1.
  [[nodiscard]] std::uint64_t number() const { return number_; }

 private:
  FileBytes& bytes_;
  char end_of_line_ = '\n';
  std::uint64_t number_ = 0;
};

/// For a note about a file: "2 faces with fewer than three corners were skipped".
[[nodiscard]] inline std::string skipped_faces_text(std::uint64_t count) {
  const bool one = count == 1;
  return std::to_string(count) + (one ? " face" : " faces") + " with fewer than three corners " +
         (one ? "was" : "were") + " skipped";
}

}  // namespace roam::reader
