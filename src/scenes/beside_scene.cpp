#include "scenes/beside_scene.h"

#include <fmt/format.h>

#include <cmath>

#include "cli/exit_status.h"
#include "roam/error.h"
#include "store/held.h"

namespace roam::app {

std::filesystem::path store_beside(const std::filesystem::path& scene) {
  std::filesystem::path path = std::filesystem::absolute(scene).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  const bool is_here = scene.is_relative() && path.parent_path() == std::filesystem::current_path();
  path += ".roam";
  return is_here ? path.filename() : path;
}

void demand_no_link(const std::filesystem::path& store) {
  std::error_code none;
  if (!std::filesystem::is_symlink(std::filesystem::symlink_status(store, none))) return;
  throw Error::at(
      store.string(),
      fmt::format("{} is a link, and a store that lies beside its scene may be none: name the store that is meant, or "
                  "delete the link",
                  store.string()));
}

std::shared_ptr<const Store> open_store_beside(const std::filesystem::path& store, std::uint64_t memory) {
  demand_no_link(store);
  return store::open_store(store::Folder::held(store, false), memory);
}

void demand_memory_of_build(const std::optional<std::uint64_t>& memory) {
  if (!memory || *memory >= StoreBuildOptions::least_memory) return;
  throw UsageError(fmt::format("--memory {:.5g} MiB", std::ldexp(static_cast<double>(*memory), -20)),
                   fmt::format("a build needs at least {} MiB", StoreBuildOptions::least_memory >> 20));
}

std::vector<std::string> notes_as_sentences(const StoreBuildReport& report, const std::filesystem::path& store) {
  std::vector<std::string> told = report.notes;
  if (report.parts_read == report.parts) return told;
  for (std::string& note : told) note = fmt::format("of the build of {}: \"{}\"", store.string(), note);
  return told;
}

}  // namespace roam::app
