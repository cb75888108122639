#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "import/reader/file_names.h"
#include "import/reader/formats.h"
#include "import/reader/tileset/outline.h"
#include "import/reader/tileset/tile_content.h"
#include "import/reader/tileset/tile_pages.h"
#include "import/report_notes.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// The part that has what concerns the tileset as a whole: which files are missing, and notes. Its name continues with
/// a fingerprint of these, so that it is read again if they change.
constexpr std::string_view outline_part = "outline";

/// Adds a content of a tileset, where others may be whole.
std::optional<Error> add_if_whole(const TileContent& content, SceneFiles& files, MeshSink& sink) {
  std::optional<Error> error = read_tile_content(content.file, content.place, files, sink);
  if (error) sink.report_missing_page(content.file.string());
  return error;
}

void report(const Outline& outline, MeshSink& sink, const std::string& name) {
  for (const std::string& note : outline.notes) sink.report_note(note);
  if (outline.georeference) sink.report_georeference(*outline.georeference);
  if (outline.stand_ins > 0) {
    sink.report_note(
        fmt::format("{}: {} of its coarser tiles stand in for finer ones that are missing.", name, outline.stand_ins));
  }
  if (outline.points > 0) {
    sink.report_note(
        fmt::format("{}: {} of its tiles are points or lines, which have no surface; they are left out: {}.", name,
                    outline.points, listed(outline.point_files)));
  }
}

/// FNV-1a: the same on every machine.
class Hash {
 public:
  void add(std::string_view text) {
    for (const char c : text) value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ull;
};

void list(const Outline& outline, const fs::path& folder, const SceneFiles& files, MeshSink& sink) {
  Hash hash;
  for (const TileContent& content : outline.contents) hash.add(token_of(content, folder) + "\n");
  hash.add(fmt::format("{} {} {}", outline.missing, outline.stand_ins, outline.points));
  for (const std::string& note : outline.notes) hash.add(note);
  const std::string name = fmt::format("{} {:016x}", outline_part, hash.value());
  for (const fs::path& file : outline.files) sink.report_part(file.string(), name, files.located_entry(file));
  for (const TileContent& content : outline.contents) {
    sink.report_part(content.file.string(), token_of(content, folder), files.located_entry(content.file));
  }
}

}  // namespace

void read_tileset(const fs::path& path, SceneFiles& files, MeshSink& sink, const ReadingSettings& settings) {
  const std::string extension = extension_of(path);
  if (extension != "json") {
    if (settings.only_list) return;
    if (const auto error = read_tile_content(path, {}, files, sink)) throw *error;
    return;
  }
  const fs::path folder = path.parent_path();
  const bool only_outline = settings.tile.starts_with(outline_part);
  if (!settings.tile.empty() && !only_outline) {
    const auto content = content_of(settings.tile, folder);
    if (!content) throw Error(path.string(), "the tileset does not have the requested part; install roam anew.");
    add_if_whole(*content, files, sink);
    return;
  }
  const bool whole_scene = settings.tile.empty() && !settings.only_list;
  if (sink.parts() != nullptr && whole_scene && hand_on_pages(path, files, sink, settings)) return;
  const Outline outline = outline_of(path, files, sink, settings);
  report(outline, sink, path.string());
  if (settings.only_list) return list(outline, folder, files, sink);
  if (only_outline) return;
  if (outline.contents.empty() && outline.missing > 0) {
    throw Error(path.string(),
                fmt::format("none of the {} files that it refers to is there and whole; the first is {}.",
                            outline.missing, outline.first_missing));
  }
  std::optional<Error> first;
  bool any = outline.contents.empty();
  for (const TileContent& content : outline.contents) {
    std::optional<Error> error = add_if_whole(content, files, sink);
    any = any || !error;
    if (!first) first = std::move(error);
  }
  if (!any) throw *first;
}

}  // namespace roam::reader
