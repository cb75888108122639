#include "verify/piece_log.h"

#include <algorithm>
#include <type_traits>

namespace roam::verification {

static_assert(std::is_trivially_copyable_v<Piece>);

void PieceLog::add(const Piece& piece) {
  if (last_.size() == held) {
    if (!file_) file_.emplace("the moves of a long walk");
    file_->write_at(in_file_ * sizeof(Piece), std::as_bytes(std::span(last_)));
    in_file_ += last_.size();
    last_.clear();
  }
  last_.push_back(piece);
}

void PieceLog::read(std::uint64_t first, std::span<Piece> out) const {
  const auto stored =
      static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), in_file_ - std::min(first, in_file_)));
  if (stored > 0) file_->read_at(first * sizeof(Piece), std::as_writable_bytes(out.first(stored)));
  const auto skipped = static_cast<std::size_t>(first + stored - in_file_);
  if (stored < out.size()) std::copy_n(last_.data() + skipped, out.size() - stored, out.data() + stored);
}

void PieceLog::each(std::size_t most, const Take& take) const {
  std::vector<Piece> some;
  for (std::uint64_t next = 0; next < size();) {
    const std::size_t kept = some.size();
    some.resize(kept + static_cast<std::size_t>(std::min<std::uint64_t>(most - kept, size() - next)));
    read(next, std::span(some).subspan(kept));
    next += some.size() - kept;
    // The last step may continue in the next batch.
    std::size_t whole = some.size();
    while (next < size() && whole > 0 && some[whole - 1].step == some.back().step) --whole;
    if (whole == 0) whole = some.size();
    take(std::span<const Piece>(some).first(whole));
    some.erase(some.begin(), some.begin() + static_cast<std::ptrdiff_t>(whole));
  }
}

Verification verify(std::span<const Mesh> meshes, const PieceLog& pieces,
                    const std::function<bool(std::uint64_t)>& progress) {
  constexpr std::size_t together = 65'536;  // 5 MB
  Verification all;
  pieces.each(together, [&](std::span<const Piece> some) {
    const std::uint64_t before = all.pieces;
    all.add(verify(meshes, some, [&](std::uint64_t done) { return !progress || progress(before + done); }));
  });
  return all;
}

void append_pieces(PieceLog& pieces, std::uint64_t step, const StepReport& report) {
  Vec3 from = report.from;
  for (const Segment& corner : report.segments) {
    if (step == 0) break;
    if (corner.teleport) from = corner.position;
    pieces.add({step, from, corner.position, Body::capsule(corner.radius, corner.height), corner.axis_clearance});
    from = corner.position;
  }
  if (report.held && !(report.axis_clearance > 0.0)) return;
  pieces.add({step, report.to, report.to, Body::capsule(report.radius, report.height), report.axis_clearance});
}

}  // namespace roam::verification
