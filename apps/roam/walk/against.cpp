#include "walk/against.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/tell.h"
#include "walk/certificate.h"

namespace roam::app {

void prepare_against(SceneOptions& walked, SceneOptions& against) {
  against.up = walked.up;
  against.unit = walked.unit;
  against.ignore = walked.ignore;
  if (walked.name_a_store()) {
    walked.up.clear();
    walked.unit.clear();
    walked.ignore.clear();
  }
  against.check_files_there("--against takes its scene; say --verify to check against the store itself");
}

verification::Verification verify_against(const SceneOptions& against, const OpenScene& walked,
                                          const verification::PieceLog& pieces,
                                          const std::function<bool(std::uint64_t, std::uint64_t)>& progress,
                                          checking::SceneSum& sum) {
  // Half of the memory for pieces: in 64 MiB, more than an hour's walk.
  const auto together = static_cast<std::size_t>(walked.memory() / (2 * sizeof(verification::Piece)));
  const std::uint64_t readings = std::max<std::uint64_t>(1, (pieces.size() + together - 1) / together);
  verification::Verification all;
  std::uint64_t bytes = 0, reading_number = 0;  // in finished readings
  const auto check = [&](std::span<const verification::Piece> some) {
    verification::Verifier verifier(some);
    ImportOptions reading = against.import_options();
    std::uint64_t total = 0;
    reading.progress = [&](const ImportProgress& p) {
      total = p.bytes_total;
      return progress(bytes + p.bytes_read, p.bytes_total * std::max(readings, reading_number + 1));
    };
    TriangleId first = 0;
    stream_scene(against.scenes, reading, [&](const Mesh& piece, bool) {
      verifier.check({&piece, 1}, first);
      if (reading_number == 0) add(sum, piece);
      first += piece.triangles.size();
    });
    if (first != walked.triangles() && reading_number == 0) {
      tell(fmt::format("note: triangles of {}: {}; of the store: {}. Is it another scene, or a later one?",
                       against.names(), first, walked.triangles()));
    }
    bytes += total;
    ++reading_number;
    all.add(verifier.result());
  };
  pieces.each(together, check);
  if (pieces.size() == 0) check({});
  return all;
}

}  // namespace roam::app
