#pragma once
/// \file
/// Input and output of `roam probe`: sizes, table, JSON. Its report is in words/probe.h.

#include <span>
#include <string>
#include <vector>

#include "cli/report.h"
#include "roam/probe.h"
#include "words/probe.h"

namespace roam::app {

/// "0.3, 0.4x1.9": radii, or radius x height, in metres, separated by commas or blanks. A radius alone has its
/// default_height. `where` begins messages. Throws UsageError for other text, for a tab between two
/// sizes or a comma elsewhere, and for a sphere with a height.
[[nodiscard]] std::vector<ProbedSize> parse_sizes(const std::string& text, const std::string& where,
                                                  bool spheres = false);

/// The members of one size; `with_way` adds the way and its members.
[[nodiscard]] Json json_report(const ProbeAnswer& answer, bool with_way);
/// Adds the slope of the way, the objects at the opening, and the narrow parts of the way.
void add_details(Json& json, const words::ProbeDetails& details);
/// The table, one line a size.
[[nodiscard]] std::string table(const ProbeQuestion& question, std::span<const ProbeAnswer> answers);

}  // namespace roam::app
