#pragma once
/// \file
/// The trace of a walk: a row or more for each step.

#include <cstdint>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>

#include "files/whole_file.h"
#include "roam/walker.h"

namespace roam::app {

/// Writes `--trace`: a row for the start and one or more for each step. A step whose way has corners has a row for each
/// of them; contacts and events stand in its last row, several events joined by `+`. `clearance` is certified all along
/// the straight piece that ends in its row; 0 where nothing is certified. `radius` and `height` are those of the body
/// on that piece. Until close() the file is as it was. `-` is standard output, and
/// rows go there at once, block by block.
class TraceFile {
 public:
  /// Throws roam::Error when it cannot be written.
  explicit TraceFile(const std::filesystem::path& file);

  /// `step_start` is the time in seconds when the step began. Throws BrokenPipe when nobody reads standard output.
  void add(std::uint64_t step, double step_start, const StepReport& report);
  /// Throws roam::Error when not all could be written.
  void close();

 private:
  void write_rows();

  std::optional<files::WholeFile> out_;  ///< none: standard output
  std::string rows_;
  std::exception_ptr failure_;  ///< the first; what comes after it is not written
};

}  // namespace roam::app
