#pragma once
/// \file
/// A child process whose frames and complaints are read through pipes.

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

/// Owns one reader. Destruction kills it, collects it and closes the pipes.
class ReaderProcess {
 public:
  /// Starts `program` with `arguments` (without the program's own name) in the folder "/", so that paths among them
  /// must be absolute, and with an environment that holds nothing but folders of libraries and temporary files.
  /// `takes_requests`: what `request` sends is its standard input, else that is empty. Throws roam::Error when it
  /// cannot run.
  ReaderProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                bool takes_requests = false);
  ~ReaderProcess();
  ReaderProcess(const ReaderProcess&) = delete;
  ReaderProcess& operator=(const ReaderProcess&) = delete;

  /// Sends a u32 length and so many bytes. Throws roam::Error when nobody takes them.
  void request(std::string_view bytes);
  /// Whether it has closed its stream, with nothing left in it.
  [[nodiscard]] bool has_ended() const;

  enum class Arrival { bytes, nothing, end };
  /// Waits at most `milliseconds` for bytes of the stream and puts up to buffer.size() of them into `buffer`.
  Arrival receive(std::span<std::byte> buffer, int milliseconds, std::size_t& received);

  /// Waits at most `milliseconds` for the child to end by itself, kills it if it does not, and collects it.
  Ending finish(int milliseconds);

  /// The child's number; -1 once it has been collected.
  [[nodiscard]] int id() const { return child_->id(); }
  /// The end of what the child wrote to its standard output and error.
  [[nodiscard]] const std::string& complaints() const { return complaints_; }

 private:
  void drain_complaints();

  files::Descriptor requests_, stream_, complaint_pipe_;
  std::optional<process::Child> child_;
  std::string complaints_;
};

}  // namespace roam::reader
