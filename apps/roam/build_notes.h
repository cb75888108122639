#pragma once
/// \file
/// The notes of a build, as sentences of the program.

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "roam/store_build.h"

namespace roam::app {

/// What was read now is noted by the program itself. Notes of parts that were read before are a store's, which may come
/// from a stranger: they are quoted.
inline std::vector<std::string> told_notes(const StoreBuildReport& report, const std::filesystem::path& store) {
  std::vector<std::string> told = report.notes;
  if (report.parts_read == report.parts) return told;
  for (std::string& note : told) note = fmt::format("of the build of {}: \"{}\"", store.string(), note);
  return told;
}

}  // namespace roam::app
