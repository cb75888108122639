#pragma once
/// \file
/// The trace of a walk: a row or more for each step.

#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>

#include "cli/output_file.h"
#include "files/whole_file.h"
#include "roam/walker.h"

namespace roam::app {

/// Traces, and empty files.
[[nodiscard]] FileKind traces();

/// Writes `--trace`: a row for the start and one or more for each step. A step has a row for each corner of its way.
/// Contacts and events stand in its last row, several events joined by `+`. `clearance` is certified along the straight
/// piece that ends in its row; 0 if nothing is certified. `radius` and `height` are the body's on that piece. Until
/// close() an earlier file stays unchanged. `-` is standard output, where rows are written block by block.
class TraceFile {
 public:
  /// Throws roam::Error if it cannot be written.
  explicit TraceFile(const std::filesystem::path& file);

  /// `step_start`: the time at the start of the step, in s. Throws BrokenPipe if the reader has closed standard output.
  void add(std::uint64_t step, double step_start, const StepReport& report);
  /// Throws roam::Error if a row could not be written.
  void close();

 private:
  void write_rows();

  std::optional<files::WholeFile> out_;  ///< none: standard output
  std::string rows_;
  std::exception_ptr failure_;  ///< the first failure; later rows are not written
};

}  // namespace roam::app
