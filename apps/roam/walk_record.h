#pragma once
/// \file
/// What is kept of a walk while it goes on: its trace, and its pieces for --verify.

#include <cstdint>
#include <exception>
#include <filesystem>
#include <string>

#include "files/whole_file.h"
#include "piece_log.h"
#include "roam/walker.h"

namespace roam::app {

/// Writes `--trace`: a row for the start and one or more for each step. A step whose way has corners has a row for each
/// of them; contacts and events stand in its last row, several events joined by `+`. `clearance` is certified all along
/// the straight piece that ends in its row; 0 where nothing is certified. `radius` and `height` are those of the body
/// on that piece. Until close() the file is as it was.
class TraceFile {
 public:
  /// Throws roam::Error when it cannot be written.
  explicit TraceFile(const std::filesystem::path& file);

  /// `step_start` is the time in seconds when the step began.
  void add(std::uint64_t step, double step_start, const StepReport& report);
  /// Throws roam::Error when not all could be written.
  void close();

 private:
  void write_rows();

  files::WholeFile out_;
  std::string rows_;
  std::exception_ptr failure_;  ///< the first; what comes after it is not written
};

/// The pieces of one step, for verify(): each straight piece of its way, with the size that the body had on it, and its
/// place at the end, unless it is held there because it does not fit. Of the start, step 0, only the place where the
/// body was put: the way out of a wall into which a path begins is no step.
void append_pieces(PieceLog& pieces, std::uint64_t step, const StepReport& report);

}  // namespace roam::app
