#pragma once
/// \file
/// Help as a page of the manual, in the macros of man(7).

#include <string>

#include "cli/help_page.h"

namespace roam::app {

/// The page of section 1 for `page`, a verb of `program` or the program itself. `date` is "2026-11-26"; `version` is
/// shown below the text.
[[nodiscard]] std::string man_page(const HelpPage& page, const HelpPage& program, const std::string& version,
                                   const std::string& date);

/// "roam-make-city" for "roam make city".
[[nodiscard]] std::string man_page_name(const HelpPage& page);

}  // namespace roam::app
