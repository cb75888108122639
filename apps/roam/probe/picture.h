#pragma once
/// \file
/// The drawing of `roam probe --picture`.

#include <string>

#include "draw/sheet.h"
#include "roam/probe.h"

namespace roam::app {

/// A plan of the way, complete or up to its end; and the deciding opening with the body, in plan and section. Throws
/// roam::Cancelled after Ctrl-C.
[[nodiscard]] draw::Sheet sheet_of(const std::string& title, const Survey& survey, const ProbeQuestion& question,
                                   const ProbeAnswer& answer);

}  // namespace roam::app
