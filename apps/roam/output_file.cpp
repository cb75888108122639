#include "output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "exit_status.h"

namespace roam::app {

void check_output(std::span<const std::filesystem::path> scenes, const std::string& option,
                  const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  if (file.empty()) throw UsageError(option + ": a file needs a name");
  std::error_code none;
  for (const fs::path& scene : scenes) {
    if (fs::equivalent(scene, file, none))
      throw UsageError(fmt::format("{} {} would overwrite the scene", option, file.string()));
  }
  if (fs::is_directory(file, none) || !file.has_filename())
    throw UsageError(fmt::format("{} {}: that is a folder; name a file in it", option, file.string()));
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, none))
    throw UsageError(fmt::format("{} {}: there is no folder {}; make it first, or name a file elsewhere", option,
                                 file.string(), folder.string()));
  const bool there = fs::exists(file, none);
  if (::access(there ? file.c_str() : folder.c_str(), W_OK) != 0) {
    throw UsageError(fmt::format("{} {}: {} cannot be written: {}; name a file elsewhere", option, file.string(),
                                 there ? "it" : "its folder", std::strerror(errno)));
  }
}

}  // namespace roam::app
