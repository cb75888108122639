#pragma once
/// \file
/// A reader as a child process, with pipes for its frames and its messages.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "files/descriptor.h"
#include "process/child.h"

namespace roam::reader {

using process::Ending;

/// Owns one reader. The destructor kills and collects it, and closes the pipes.
class ReaderProcess {
 public:
  /// Starts `program` with `arguments` (without the program's own name) in the folder "/", so all paths must be
  /// absolute. Its environment has only PATH, folders of libraries and temporary files, and options of sanitizers. If
  /// `takes_requests`, its standard input receives the bytes of request(); otherwise that is empty. Throws roam::Error
  /// if it cannot run.
  ReaderProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                bool takes_requests = false);
  ~ReaderProcess();
  ReaderProcess(const ReaderProcess&) = delete;
  ReaderProcess& operator=(const ReaderProcess&) = delete;

  /// Sends a u32 length and the bytes. Throws roam::Error if the reader does not accept them.
  void request(std::string_view bytes);
  /// Whether the reader has closed its stream, and all of it has been read.
  [[nodiscard]] bool has_ended() const;

  enum class Arrival { bytes, nothing, end };
  /// Waits at most `milliseconds` for bytes of the stream and stores up to buffer.size() of them in `buffer`.
  Arrival receive(std::span<std::byte> buffer, int milliseconds, std::size_t& received);

  /// Waits at most `milliseconds` for the child to end by itself, then kills it. Collects it.
  Ending finish(int milliseconds);

  /// The process number; -1 once the child has been collected.
  [[nodiscard]] int id() const { return child_->id(); }
  /// The last part of the child's standard output and error.
  [[nodiscard]] const std::string& complaints() const { return complaints_; }

 private:
  void drain_complaints();

  files::Descriptor requests_, stream_, complaint_pipe_;
  std::optional<process::Child> child_;
  std::string complaints_;
};

}  // namespace roam::reader
