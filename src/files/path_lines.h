#pragma once
/// \file
/// Paths with the comments in their files.

#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "roam/path_file.h"

namespace roam {

/// Gets a line that is a comment, and its number from 1.
using OnComment = std::function<void(std::string_view line, int number)>;
/// read_path() that tells comments. Holds one line at a time.
[[nodiscard]] std::vector<Waypoint> read_path(std::istream& in, const std::string& name, const OnComment& on_comment);

}  // namespace roam
