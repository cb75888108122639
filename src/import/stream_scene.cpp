#include <vector>

#include "import/piece_receiver.h"
#include "import/read_all.h"
#include "math/floating_point.h"
#include "roam/import.h"

namespace roam {
namespace {

ImportReport stream(std::span<const reader::Source> sources, const ImportOptions& options, const PieceSink& sink,
                    const LookUpSink& look_ups = {}) {
  ImportReport report;
  reader::read_all(sources, options, report, [&](reader::Reading& reading, std::vector<bool>& matched) {
    const std::uint64_t triangles_before = report.triangles;
    reading.wanted = reader::Reading::Wanted::pieces;
    reader::PieceReceiver receiver(report, options.ignore.size(), sink);
    receiver.pass_look_ups(look_ups);
    reader::read_one(reading, receiver, matched);
    return report.triangles > triangles_before;
  });
  return report;
}

}  // namespace

ImportReport stream_scene(std::span<const std::filesystem::path> paths, const ImportOptions& options,
                          const PieceSink& sink) {
  const DefaultFloatingPoint guard;
  return stream(reader::sources(paths), options, sink);
}

ImportReport stream_part(const ScenePart& part, const ImportOptions& options, const PieceSink& sink,
                         const LookUpSink& look_ups) {
  const DefaultFloatingPoint guard;
  const reader::Source source{part.path, part.tile, part.frame, part.bytes};
  return stream(std::span(&source, 1), options, sink, look_ups);
}

}  // namespace roam
