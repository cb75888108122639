#pragma once
/// \file
/// What `roam probe` reads and says: sizes, a table, JSON. Its report is in words/probe.h.

#include <span>
#include <string>
#include <vector>

#include "cli/report.h"
#include "roam/probe.h"
#include "words/probe.h"

namespace roam::app {

/// "0.3, 0.4x1.9": radii, or radius x height, in metres, separated by commas or blanks. `where` begins messages.
/// Throws UsageError for what is none.
[[nodiscard]] std::vector<ProbedSize> parse_sizes(const std::string& text, const std::string& where);

/// The members of one size; `way` and what belongs to it only where they are asked for.
[[nodiscard]] Json json_report(const ProbeAnswer& answer, bool with_way);
/// Adds the slope of the way, the objects at the opening and the places narrower than wanted.
void add_details(Json& json, const words::ProbeDetails& details);
/// One line a size.
[[nodiscard]] std::string table(const ProbeQuestion& question, std::span<const ProbeAnswer> answers);

}  // namespace roam::app
