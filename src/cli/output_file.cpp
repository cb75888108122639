#include "cli/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "cli/exit_status.h"
#include "cli/standard_streams.h"
#include "text/web_address.h"

namespace roam::app {

std::optional<Obstacle> obstacle(const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (fs::is_directory(file, none) || !file.has_filename()) return Obstacle{"that is a folder", "name a file in it"};
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, none))
    return Obstacle{"there is no folder " + folder.string(), "make it first, or name a file elsewhere"};
  const bool there = fs::exists(file, none);
  if (there && !fs::is_regular_file(file, none)) return Obstacle{"that is a pipe or a device", "name a file"};
  if (::access(there ? file.c_str() : folder.c_str(), W_OK) == 0) return std::nullopt;
  return Obstacle{fmt::format("{} cannot be written: {}", there ? "it" : "its folder", std::strerror(errno)),
                  "name a file elsewhere"};
}

void demand_no_address(const std::string& option, const std::filesystem::path& output) {
  if (scheme_size(output.native()) == 0) return;
  throw UsageError(
      Error(option + " " + output.string(), "a web server cannot be written to; name a place on the disk"));
}

std::vector<NamedFile> named_scenes(std::span<const std::filesystem::path> scenes) {
  std::vector<NamedFile> named;
  for (const auto& scene : scenes) named.push_back({"the scene", scene});
  return named;
}

void demand_no_overwriting(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs) {
  namespace fs = std::filesystem;
  const auto same = [](const fs::path& a, const fs::path& b) {
    std::error_code none;
    if (a.empty() || b.empty() || is_standard(a) || is_standard(b)) return false;
    const fs::path whole = fs::weakly_canonical(fs::absolute(a, none), none);
    return fs::equivalent(a, b, none) || (!whole.empty() && whole == fs::weakly_canonical(fs::absolute(b, none), none));
  };
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto demand_other = [&](const fs::path& file, const std::string& what) {
      if (!same(file, outputs[i].file)) return;
      throw UsageError(fmt::format("{} {}", outputs[i].name, outputs[i].file.string()),
                       fmt::format("this would overwrite {}; name another file", what));
    };
    for (const NamedFile& input : inputs) demand_other(input.file, input.name);
    for (const NamedFile& other : outputs.first(i)) demand_other(other.file, "the file of " + other.name);
  }
}

void check_output(std::span<const std::filesystem::path> scenes, const std::string& option,
                  const std::filesystem::path& file) {
  if (is_standard(file)) throw UsageError(option + " -", "standard output takes paths and traces only; name a file");
  demand_no_address(option, file);
  const NamedFile output{option, file};
  demand_no_overwriting(named_scenes(scenes), {&output, 1});
  if (const std::optional<Obstacle> found = obstacle(file)) {
    throw UsageError(option + " " + file.string(), found->what + "; " + found->advice);
  }
}

}  // namespace roam::app
