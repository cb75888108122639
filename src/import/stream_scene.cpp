#include <filesystem>
#include <optional>
#include <system_error>
#include <vector>

#include "import/parts.h"
#include "import/piece_receiver.h"
#include "import/processor_budget.h"
#include "import/read_all.h"
#include "import/report_notes.h"
#include "import/scene_scope.h"
#include "math/floating_point.h"

namespace roam {
namespace {

ImportReport stream(std::span<const reader::Source> sources, const ImportOptions& options, const PieceSink& sink,
                    const LookUpSink& look_ups = {}, reader::SceneBudget* scene = nullptr) {
  ImportReport report;
  reader::read_all(sources, options, report, [&](reader::Reading& reading, std::vector<bool>& matched) {
    const std::uint64_t triangles_before = report.triangles;
    reading.wanted = reader::Reading::Wanted::pieces;
    reading.scene = scene;
    reader::PieceReceiver receiver(report, options.ignore.size(), sink);
    receiver.pass_look_ups(look_ups);
    reader::read_one(reading, receiver, matched);
    return report.triangles > triangles_before;
  });
  return report;
}

/// The report of a tile without a file. No reader is started: a folder may have a million empty folders.
ImportReport report_missing(const reader::Source& tile, const ImportOptions& options) {
  reader::check({&tile, 1}, options);
  if (options.progress && !options.progress({.path = tile.path})) throw Cancelled();
  const reader::SceneScope scope = reader::scope_of(tile.path, options);
  const std::optional<std::filesystem::path> data = scope.resolve(scope.scene / "Data");
  std::error_code none;
  const bool has_data = data && std::filesystem::is_directory(*data, none);
  std::filesystem::path folder = tile.path.has_filename() ? tile.path : tile.path.parent_path();
  if (has_data) folder /= "Data";
  ImportReport report;
  report.georeference = tile.frame;
  report.missing_pages = 1;
  report.missing_page_files.push_back((folder / tile.tile / (tile.tile + ".osgb")).string());
  reader::add_count_notes(report, options, std::vector<bool>(options.ignore.size(), true));
  return report;
}

}  // namespace

ImportReport stream_scene(std::span<const std::filesystem::path> paths, const ImportOptions& options,
                          const PieceSink& sink) {
  const DefaultFloatingPoint guard;
  return stream(reader::sources(paths), options, sink);
}

ImportReport stream_part(const ScenePart& part, const ImportOptions& options, const PieceSink& sink,
                         const LookUpSink& look_ups, reader::SceneBudget* scene) {
  const DefaultFloatingPoint guard;
  reader::SceneBudget alone;
  reader::Source source{part.path, part.tile, part.frame, part.bytes, {}};
  if (part.entries.size() == 1) source.entry = part.entries.front();
  if (!part.tile.empty() && part.files.empty()) return report_missing(source, options);
  if (scene == nullptr) scene = &alone;
  for (const ArchiveEntry& entry : part.entries) scene->add_entry(part.path, entry.begin);
  return stream(std::span(&source, 1), options, sink, look_ups, scene);
}

}  // namespace roam
