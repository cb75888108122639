#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "files/escaped.h"
#include "import/find_reader.h"
#include "import/parts.h"
#include "import/read_all.h"
#include "math/floating_point.h"

namespace roam {
namespace {

namespace fs = std::filesystem;

/// A tile of a folder, or a file of a tileset's part.
struct Tile {
  fs::path file;
  bool present = false;
  std::string part{};  ///< empty: the tile of a folder
  ArchiveEntry entry{};
};

/// Receives the list of a scene's parts.
class PartList : public reader::StreamReceiver {
 public:
  /// `memory`: most bytes that the parts of the list may take.
  PartList(ImportReport& report, std::size_t ignore_patterns, std::uint64_t memory)
      : StreamReceiver(report, ignore_patterns, memory) {}

  [[nodiscard]] std::uint64_t triangles() const override { return 0; }
  [[nodiscard]] const std::vector<Tile>& tiles() const { return tiles_; }

 private:
  /// Bytes of a part besides its texts, and copies of these: in the list, as paths and names, and in a build.
  static constexpr std::uint64_t part_bytes = 1024, copies = 8;

  void take_content(reader::FrameKind kind, std::span<const std::byte> payload) override {
    if (kind != reader::FrameKind::tile) throw StreamDamaged{"a frame of unknown kind"};
    count_bytes(part_bytes + copies * payload.size());
    reader::PayloadReader fields(payload);
    fs::path file = fields.take_text();
    const bool present = fields.take<std::uint8_t>() != 0;
    std::string part = fields.take_text();
    const auto entry = fields.take<ArchiveEntry>();
    if (!fields.complete()) throw StreamDamaged{"a frame of broken length"};
    if (!tiles_.empty() && tiles_.front().part.empty() != part.empty()) throw StreamDamaged{"parts of two kinds"};
    tiles_.push_back({std::move(file), present, std::move(part), entry});
  }
  void finish_content(const reader::Totals&) override {}

  std::vector<Tile> tiles_;
};

/// Regular files below a folder, sorted. Links that lead out of the scene are not followed.
std::vector<fs::path> files_in(const fs::path& folder, const reader::SceneScope& scope) {
  std::vector<fs::path> files;
  std::error_code none;
  fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied, none);
  while (!none && entry != fs::recursive_directory_iterator()) {
    if (entry.depth() > reader::deepest_nesting) {
      throw Error(folder.string(),
                  fmt::format("more than {} folders lie in each other there, as in no scene; remove them",
                              reader::deepest_nesting));
    }
    if (!scope.find(entry->path()).empty()) files.push_back(entry->path());
    entry.increment(none);
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Gives every part a unique name.
class Names {
 public:
  std::string unique(const std::string& file_name) {
    // File names may have any bytes, but names of parts are text.
    const std::string wished = files::escaped(file_name, [](char32_t) { return true; });
    // Many names may escape to the same text, so the search goes on from the last number.
    int& last = last_[wished];
    std::string name = ++last == 1 ? wished : fmt::format("{} ({})", wished, last);
    while (!taken_.insert(name).second) name = fmt::format("{} ({})", wished, ++last);
    return name;
  }

 private:
  std::set<std::string> taken_;
  std::map<std::string, int> last_;  ///< number given to a name
};

void count_bytes(ScenePart& part) {
  for (const fs::path& file : part.files) {
    std::error_code unseen;
    const auto bytes = fs::file_size(file, unseen);
    part.bytes += unseen ? 0 : bytes;
  }
}

/// Adds one part for each tile. Missing tiles are parts too, so that reading them reports it.
void add_tiles(const fs::path& path, const std::vector<Tile>& tiles, const std::optional<Georeference>& frame,
               const reader::SceneScope& scope, const ImportOptions& options, Names& names,
               std::vector<ScenePart>& parts) {
  // The folder as read_tiles finds it.
  fs::path folder = scope.scene;
  if (folder.filename() == "Data") folder = folder.parent_path();
  const fs::path metadata = folder / "metadata.xml";
  // By real path. Many links to one large folder would make a list that no memory holds.
  std::map<fs::path, std::string> folders;
  for (const Tile& tile : tiles) {
    if (options.progress && !options.progress({})) throw Cancelled();
    ScenePart part;
    part.path = path;
    part.tile = tile.file.stem().string();
    part.name = names.unique(folder.filename().string() + "/" + part.tile);
    part.frame = frame;
    const auto real = tile.present ? scope.resolve(tile.file.parent_path()) : std::nullopt;
    if (real && scope.resolve(tile.file)) {
      const auto [same, is_new] = folders.emplace(*real, part.tile);
      if (!is_new) {
        throw Error(tile.file.parent_path().string(),
                    fmt::format("it leads to the same folder as {}; remove one of them", same->second));
      }
      part.files = files_in(tile.file.parent_path(), scope);
      // This file has the position of the tile.
      if (!scope.find(metadata).empty() &&
          std::find(part.files.begin(), part.files.end(), metadata) == part.files.end()) {
        part.files.push_back(metadata);
      }
    }
    count_bytes(part);
    parts.push_back(std::move(part));
  }
}

/// Checks what a reader says of the entries of an archive. Together they are no longer than the archive, so that
/// reading all of them costs no more.
void check_entries(const fs::path& path, const std::vector<Tile>& tiles) {
  const std::uint64_t size = fs::file_size(path);
  std::set<std::pair<std::uint64_t, std::uint64_t>> all;
  for (const Tile& tile : tiles) all.emplace(tile.entry.begin, tile.entry.packed);
  std::uint64_t end = 0;
  for (const auto& [begin, bytes] : all) {
    if (begin < end || begin > size || bytes > size - begin) {
      throw Error(path.string(),
                  "the entries of this archive overlap, or reach beyond its end. Copy or export it again.");
    }
    end = begin + bytes;
  }
}

/// Adds the parts of a tileset: each content, before them what concerns the tileset as a whole.
void add_contents(const fs::path& path, const std::vector<Tile>& tiles, const std::optional<Georeference>& frame,
                  const reader::SceneScope& scope, const ImportOptions& options, Names& names,
                  std::vector<ScenePart>& parts) {
  std::error_code none;
  const bool archive = tiles.front().entry != ArchiveEntry();
  if (archive) check_entries(path, tiles);
  const fs::path folder = archive || fs::is_directory(path, none) ? scope.scene : scope.scene.parent_path();
  // A tileset may name a file at many places. It is looked up once; unset: absent.
  std::map<fs::path, std::optional<std::uint64_t>> bytes_of;
  const auto bytes_at = [&](const fs::path& file) {
    const auto [known, is_new] = bytes_of.try_emplace(file);
    if (is_new && !scope.find(file).empty()) {
      std::error_code unseen;
      const auto bytes = fs::file_size(file, unseen);
      known->second = unseen ? 0 : bytes;
    }
    return known->second;
  };
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (options.progress && !options.progress({})) throw Cancelled();
    const Tile& tile = tiles[i];
    if (i == 0 || tile.part != tiles[i - 1].part) {
      ScenePart& part = parts.emplace_back();
      part.path = path;
      part.frame = frame;
      const fs::path inside = tile.file.lexically_relative(folder);
      // The name of an archive is that of its folder, so that both give the same store.
      const fs::path name = archive ? folder.stem() : folder.filename();
      part.name = names.unique((name / (inside.empty() ? tile.file.filename() : inside)).string());
      part.tile = tile.part;
    }
    if (archive) {
      parts.back().files.push_back(tile.file);
      parts.back().entries.push_back(tile.entry);
      parts.back().bytes += tile.entry.packed;
      continue;
    }
    // The files may have gone meanwhile; then reading the part says so.
    const std::optional<std::uint64_t> bytes = bytes_at(tile.file);
    if (!bytes) continue;
    parts.back().files.push_back(tile.file);
    parts.back().bytes += *bytes;
  }
}

}  // namespace

std::vector<ScenePart> scene_parts(std::span<const fs::path> paths, const ImportOptions& options) {
  const DefaultFloatingPoint guard;
  const std::vector<reader::Source> sources = reader::sources(paths);
  reader::check(sources, options);
  const fs::path program = reader::find_reader(options.reader);

  std::vector<ScenePart> parts;
  Names names;
  ImportReport report;
  for (const fs::path& path : paths) {
    reader::Reading reading;
    reading.program = program;
    reading.path = path;
    reading.scope = reader::scope_of(path, options);
    reading.options = &options;
    reading.wanted = reader::Reading::Wanted::list;
    reading.frame = report.georeference;
    reading.report_progress = [&options](std::uint64_t, std::uint64_t) {
      if (options.progress && !options.progress({})) throw Cancelled();
    };
    const std::optional<Georeference> frame = report.georeference;
    PartList list(report, options.ignore.size(), options.memory_limit);
    std::vector<bool> matched(options.ignore.size());
    reader::read_one(reading, list, matched);
    std::error_code none;
    if (!list.tiles().empty() || fs::is_directory(path, none)) {
      const bool tileset = !list.tiles().empty() && !list.tiles().front().part.empty();
      (tileset ? add_contents : add_tiles)(path, list.tiles(), frame, reading.scope, options, names, parts);
      continue;
    }
    ScenePart part;
    part.name = names.unique(reading.scope.scene.filename().string());
    part.path = path;
    part.files.push_back(reading.scope.scene);
    count_bytes(part);
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace roam
