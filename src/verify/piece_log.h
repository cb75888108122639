#pragma once
/// \file
/// The pieces of a way of any length, in little memory.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "files/unnamed_file.h"
#include "roam/step_report.h"
#include "verify/verification.h"

namespace roam::verification {

/// A list that only grows. A few thousand pieces are in memory. The others are in an unnamed file in the folder for
/// temporary files (TMPDIR, else /tmp), 80 bytes each.
class PieceLog {
 public:
  /// The number of pieces in memory.
  static constexpr std::size_t held = 4096;

  /// `piece` belongs to the step of the last piece, or to a later one. Throws roam::Error if the file cannot be
  /// written.
  void add(const Piece& piece);
  [[nodiscard]] std::uint64_t size() const { return in_file_ + last_.size(); }

  using Take = std::function<void(std::span<const Piece>)>;
  /// Calls `take` with up to `most` (>= 1) pieces at a time, in order. The pieces of a step stay together, unless there
  /// are more than `most`. Throws roam::Error if the file cannot be read.
  void each(std::size_t most, const Take& take) const;

 private:
  void read(std::uint64_t first, std::span<Piece> out) const;

  std::optional<files::UnnamedFile> file_;
  std::uint64_t in_file_ = 0;  ///< pieces
  std::vector<Piece> last_;    ///< the pieces after those in the file
};

/// Checks every piece against every triangle of `meshes`; see verify().
[[nodiscard]] Verification verify(std::span<const Mesh> meshes, const PieceLog& pieces,
                                  const std::function<bool(std::uint64_t)>& progress = {});

/// The pieces of one step, for verify(): each straight piece of its way with the body's size there, and its end place.
/// The end place is left out if the body is held there because it does not fit. For the start, step 0, only the place
/// where the body was put: the way out of a wall in which a path begins is no step.
void append_pieces(PieceLog& pieces, std::uint64_t step, const StepReport& report);

}  // namespace roam::verification
