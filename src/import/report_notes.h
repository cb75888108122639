#pragma once
/// \file
/// The counts of a report as sentences.

#include <string>
#include <vector>

#include "roam/import.h"

namespace roam::reader {

/// Puts before report.notes what the counts of the report and the patterns that matched nothing mean for the user.
void add_count_notes(ImportReport& report, const ImportOptions& options, const std::vector<bool>& matched);

/// The first few names, separated by commas, and whether there are others.
[[nodiscard]] std::string listed(const std::vector<std::string>& names);

}  // namespace roam::reader
