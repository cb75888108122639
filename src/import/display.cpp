#include "import/display.h"

#include <optional>
#include <utility>

#include "import/part_receiver.h"
#include "import/read_all.h"
#include "import/report_notes.h"

namespace roam {

DisplayReport read_display(std::span<const std::filesystem::path> paths, const ImportOptions& options,
                           const std::function<bool(DisplayPart&&)>& take) {
  DisplayReport report;
  std::optional<Vec3> origin;
  std::uint64_t bytes_left = options.memory_limit;
  std::uint32_t source = 0;
  const std::function<bool(DisplayPart &&)> give = [&](DisplayPart&& part) {
    part.source = source;
    return take(std::move(part));
  };
  reader::read_all(reader::sources(paths), options, report.import,
                   [&](reader::Reading& reading, std::vector<bool>& matched) {
                     const std::uint64_t parts_before = report.parts;
                     reading.wanted = reader::Reading::Wanted::display;
                     reading.origin = origin;
                     reader::PartReceiver receiver(report, origin, options.ignore.size(), bytes_left, give);
                     reader::read_one(reading, receiver, matched);
                     bytes_left -= receiver.bytes_taken();
                     ++source;
                     // Which patterns match in pages is not known.
                     if (report.paged) matched.assign(matched.size(), true);
                     return report.parts > parts_before;
                   });
  if (auto note = reader::note_of_missing_images(report.missing_textures, report.missing_texture_files)) {
    report.notes.push_back(std::move(*note));
  }
  return report;
}

}  // namespace roam
