#include "cli/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "cli/exit_status.h"
#include "cli/interrupt.h"
#include "cli/standard_streams.h"
#include "cli/tell.h"
#include "files/read_stream.h"
#include "roam/path_file.h"
#include "text/web_address.h"

namespace roam::app {

namespace {

files::Place place_behind(const std::filesystem::path& output) {
  try {
    return files::place_behind_links(output);
  } catch (const Error& error) {
    throw UsageError(error);
  }
}

}  // namespace

std::optional<Obstacle> obstacle(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (fs::is_directory(file, none) || !file.has_filename()) return Obstacle{"that is a folder", "name a file in it"};
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, none))
    return Obstacle{"there is no folder " + folder.string(), "make it first, or name a file elsewhere"};
  const bool there = fs::exists(file, none);
  if (there && !fs::is_regular_file(file, none)) return Obstacle{"that is a pipe or a device", "name a file"};
  for (const auto& [name, place] : {std::pair{"its folder", folder}, std::pair{"it", file}}) {
    if (::access(place.c_str(), W_OK) == 0 || errno == ENOENT) continue;
    return Obstacle{fmt::format("{} cannot be written: {}", name, std::strerror(errno)), "name a file elsewhere"};
  }
  return std::nullopt;
}

void demand_no_address(const std::string& option, const std::filesystem::path& output) {
  if (scheme_size(output.native()) == 0) return;
  throw UsageError(
      Error(option + " " + output.string(), "a web server cannot be written to; name a place on the disk"));
}

FileKind paths() {
  return {"path", [](int file) {
            try {
              files::ReadStream in(file, "");
              return beginning_with("# roam: ", "").has(file) || !read_path(in, "").empty();
            } catch (const Error&) {
              return false;
            }
          }};
}

std::vector<NamedFile> named_scenes(std::span<const std::filesystem::path> scenes) {
  std::vector<NamedFile> named;
  for (const auto& scene : scenes) named.push_back({"the scene", scene});
  return named;
}

void demand_no_overwriting(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs) {
  namespace fs = std::filesystem;
  std::error_code none;
  const auto whole = [&](const fs::path& file) { return fs::weakly_canonical(fs::absolute(file, none), none); };
  const auto same = [&](const fs::path& a, const fs::path& b) {
    return fs::equivalent(a, b, none) || (!whole(a).empty() && whole(a) == whole(b));
  };
  // Every file in the folder of a scene, a store or tiles may be a part of it.
  const auto has_part = [&](const fs::path& folder, const fs::path& file) {
    if (!fs::is_directory(folder, none) || !fs::exists(file, none)) return false;
    const fs::path from = whole(folder), to = whole(file);
    return std::mismatch(from.begin(), from.end(), to.begin(), to.end()).first == from.end();
  };
  const auto is_file = [](const fs::path& file) { return !file.empty() && !is_standard(file); };
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const fs::path& output = outputs[i].file;
    if (!is_file(output)) continue;
    const auto refuse = [&](const std::string& what, const char* advice = "name another file") {
      throw UsageError(fmt::format("{} {}", outputs[i].name, output.string()),
                       fmt::format("this would overwrite {}; {}", what, advice));
    };
    const files::Place place = place_behind(output);
    for (const NamedFile& input : inputs) {
      if (!is_file(input.file)) continue;
      if (same(input.file, output)) refuse(input.name);
      if (has_part(input.file, output)) refuse("a file of " + input.name);
    }
    if (!place.may_get(outputs[i].kind))
      refuse(fmt::format("a file that is no {}", outputs[i].kind.noun), "name another file, or move that one away");
    for (const NamedFile& other : outputs.first(i)) {
      if (is_file(other.file) && same(other.file, output)) refuse("the file of " + other.name);
    }
  }
}

void check_output(const std::string& option, const std::filesystem::path& file) {
  if (is_standard(file)) throw UsageError(option + " -", "standard output takes paths and traces only; name a file");
  demand_no_address(option, file);
  if (const std::optional<Obstacle> found = obstacle(place_behind(file).path())) {
    throw UsageError(option + " " + file.string(), found->what + "; " + found->advice);
  }
}

void Unwritten::raise() const {
  if (errors_.empty()) return;
  for (std::size_t i = 1; i < errors_.size(); ++i) tell(errors_[i].what());
  // An Error after a signal counts as one that the signal caused.
  if (interrupted()) throw Stopped(errors_.front().what());
  throw Error(errors_.front());
}

std::string earlier_stays(const std::filesystem::path& file) {
  std::error_code none;
  return !is_standard(file) && std::filesystem::exists(file, none) ? "; the earlier file of that name stays as it was"
                                                                   : "";
}

}  // namespace roam::app
