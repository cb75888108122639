#pragma once
/// \file
/// Notes about the counts of a report.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "roam/import.h"

namespace roam::reader {

/// Inserts notes about the report's counts, and about patterns that matched nothing, before report.notes.
void add_count_notes(ImportReport& report, const ImportOptions& options, const std::vector<bool>& matched);

/// The sentence about a reader that this system could not confine, if it was one. add_count_notes inserts it, too.
[[nodiscard]] std::optional<std::string> note_of_confinement(const ImportReport& report);

/// The first few names, separated by commas, with a hint if there are others.
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

/// The sentence about images that are absent or unreadable, if there are any. `files`: names of some of them.
[[nodiscard]] std::optional<std::string> note_of_missing_images(std::uint64_t count,
                                                                const std::vector<std::string>& files);

}  // namespace roam::reader
