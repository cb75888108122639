#pragma once
/// \file
/// The sheet of `roam probe --picture`.

#include <string>

#include "draw/sheet.h"
#include "roam/probe.h"

namespace roam::app {

/// Where the way leads, or where it breaks off, in one plan; and what decides, in a plan and a section, with the body
/// in it. Throws roam::Cancelled after Ctrl-C.
[[nodiscard]] draw::Sheet sheet_of(const std::string& title, const Survey& survey, const ProbeQuestion& question,
                                   const ProbeAnswer& answer);

}  // namespace roam::app
