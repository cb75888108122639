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
  if (::access(there ? file.c_str() : folder.c_str(), W_OK) == 0) return std::nullopt;
  return Obstacle{fmt::format("{} cannot be written: {}", there ? "it" : "its folder", std::strerror(errno)),
                  "name a file elsewhere"};
}

void demand_no_address(const std::string& option, const std::filesystem::path& output) {
  if (scheme_size(output.native()) == 0) return;
  throw UsageError(
      Error(option + " " + output.string(), "a web server cannot be written to; name a place on the disk"));
}

void check_output(std::span<const std::filesystem::path> scenes, const std::string& option,
                  const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  if (file.empty()) throw UsageError(option, "a file needs a name");
  if (is_standard(file)) throw UsageError(option + " -", "standard output takes paths and traces only; name a file");
  demand_no_address(option, file);
  const std::string where = option + " " + file.string();
  std::error_code none;
  for (const fs::path& scene : scenes) {
    if (fs::equivalent(scene, file, none)) throw UsageError(where, "this would overwrite the scene; name another file");
  }
  if (const std::optional<Obstacle> found = obstacle(file)) throw UsageError(where, found->what + "; " + found->advice);
}

}  // namespace roam::app
