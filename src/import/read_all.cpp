#include "import/read_all.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <system_error>

#include "import/find_reader.h"
#include "import/report_notes.h"
#include "text/web_address.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// Entries of a folder between two calls of the progress function.
constexpr std::uint64_t entries_in_between = 1000;

/// The size of a file, or of all files in a folder. Inaccessible files count as 0. Calls `look_up` from time to time
/// with the bytes so far, because a folder may be a whole disk.
std::uint64_t bytes_in(const fs::path& path, const std::function<void(std::uint64_t)>& look_up) {
  std::error_code none;
  if (!fs::is_directory(path, none)) {
    const auto size = fs::file_size(path, none);
    return none ? 0 : size;
  }
  std::uint64_t bytes = 0, entries = 0;
  fs::recursive_directory_iterator entry(path, fs::directory_options::skip_permission_denied, none);
  while (!none && entry != fs::recursive_directory_iterator()) {
    if (++entries % entries_in_between == 0) look_up(bytes);
    std::error_code unseen;
    if (fs::is_regular_file(entry->symlink_status(unseen))) {
      const auto size = entry->file_size(unseen);
      bytes += unseen ? 0 : size;
    }
    entry.increment(none);
  }
  return bytes;
}

/// Numbers of triangles left out so far, by reason.
struct LeftOut {
  std::uint64_t bad = 0;
  std::uint64_t ignored = 0;
};

Error no_triangle(const fs::path& path, const ImportReport& report, const LeftOut& before) {
  const std::uint64_t bad = report.bad_triangles - before.bad;
  const std::uint64_t ignored = report.ignored_triangles - before.ignored;
  if (bad > 0) {
    return Error(path.string(),
                 fmt::format("none of its {} triangles is usable: they have vertices that are not finite, lie beyond "
                             "1e9 m, or are not there. The file is damaged, or in another unit.",
                             bad));
  }
  if (ignored > 0) {
    return Error(path.string(),
                 fmt::format("all of its {} triangles are in objects that are to be ignored; ignore fewer.", ignored));
  }
  std::string remedy = "check that it is the right file";
  if (!report.outside_files.empty()) {
    remedy = fmt::format("it refers to {}, which lies outside of its folder; --allow lets a folder in",
                         listed(report.outside_files));
  }
  return Error(path.string(), fmt::format("this gives no triangle, so there is nothing to walk on; {}.", remedy));
}

}  // namespace

std::vector<Source> sources(std::span<const fs::path> paths) {
  std::vector<Source> all;
  for (const fs::path& path : paths) all.push_back({path});
  return all;
}

void check(std::span<const Source> sources, const ImportOptions& options) {
  if (sources.empty()) throw Error("no scene was named; name one or more files or folders to import.");
  if (options.memory_limit < ImportOptions::least_memory) {
    throw Error(
        fmt::format("an import memory limit of {} bytes is too small; allow at least 64 MiB.", options.memory_limit));
  }
  if (!(options.silence_limit > 0.0) || !std::isfinite(options.silence_limit)) {
    throw Error(fmt::format("an import time limit of {} s makes no sense; give a number of seconds above 0.",
                            options.silence_limit));
  }
  for (const Source& source : sources) {
    const fs::path& path = source.path;
    if (path.empty()) throw Error("the path of a scene is empty; name its file or folder.");
    if (!options.through_link) static_cast<void>(scope_of(path, options));
    std::error_code why;
    const fs::file_status status = fs::status(path, why);
    if (!fs::exists(status)) {
      const std::string reason = why && status.type() == fs::file_type::none ? " (" + why.message() + ")" : "";
      throw Error(path.string(),
                  fmt::format("there is no such file or folder{}. {}", reason, help_for_missing(path.native())));
    }
    if (!fs::is_directory(status) && !fs::is_regular_file(status)) {
      throw Error(path.string(), "this is neither a file nor a folder; a scene is read from one of these.");
    }
  }
}

void read_all(std::span<const Source> sources, const ImportOptions& options, ImportReport& report,
              const std::function<bool(Reading& reading, std::vector<bool>& matched)>& read) {
  check(sources, options);
  const fs::path program = find_reader(options.reader);

  ImportProgress progress;
  std::vector<std::uint64_t> sizes;
  const auto tell = [&](const ImportProgress& so_far) {
    if (options.progress && !options.progress(so_far)) throw Cancelled();
  };
  for (const Source& source : sources) {
    progress.path = source.path;
    const auto counted = [&](std::uint64_t bytes) {
      ImportProgress so_far = progress;
      so_far.bytes_total += bytes;
      tell(so_far);
    };
    sizes.push_back(source.bytes ? *source.bytes : bytes_in(source.path, counted));
    progress.bytes_total += sizes.back();
  }

  std::vector<bool> matched(options.ignore.size(), false);
  std::uint64_t bytes_before = 0;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const std::uint64_t triangles_before = report.triangles;
    const LeftOut before{report.bad_triangles, report.ignored_triangles};
    const auto say = [&](std::uint64_t bytes, std::uint64_t triangles) {
      progress.path = sources[i].path;
      progress.bytes_read = bytes_before + std::min(bytes, sizes[i]);
      progress.triangles = triangles_before + triangles;
      tell(progress);
    };
    say(0, 0);
    Reading reading;
    reading.program = program;
    reading.path = sources[i].path;
    reading.scope = scope_of(reading.path, options);
    reading.tile = sources[i].tile;
    reading.entry = sources[i].entry;
    reading.path_bytes = sizes[i];
    reading.options = &options;
    reading.report_progress = say;
    if (!report.georeference) report.georeference = sources[i].frame;
    reading.frame = report.georeference;
    const bool whole = sources[i].tile.empty();
    if (!read(reading, matched) && whole) throw no_triangle(sources[i].path, report, before);
    if (!whole) matched.assign(matched.size(), true);
    say(sizes[i], report.triangles - triangles_before);
    bytes_before += sizes[i];
  }
  add_count_notes(report, options, matched);
}

}  // namespace roam::reader
