#pragma once
/// \file
/// Parts of the JSON reports that several verbs share.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "roam/math.h"
#include "roam/pager.h"

namespace roam::app {

/// One JSON object whose members keep the order in which they are set. Sources that build one include
/// <nlohmann/json.hpp>.
using Json = nlohmann::ordered_json;

/// [x, y, z]
[[nodiscard]] Json to_json(const Vec3& v);

/// {"min": [x, y, z], "max": [x, y, z]}
[[nodiscard]] Json to_json(const Box& box);

/// The state and statistics of a pager.
[[nodiscard]] Json to_json(const PagerStats& paging);

/// The version of the program's JSON objects. It grows when a member is removed or changes its meaning; new members do
/// not count.
inline constexpr int json_schema = 1;

/// Writes the report to standard output, after the members "roam", the version, and "schema". Throws BrokenPipe if the
/// reader has closed it, and roam::Error if it cannot be written, e.g. to a full disk.
void print(const Json& report);
/// The same in one line, for a sequence of objects.
void print_line(const Json& object);
/// The same for lines of text, made printable.
void print(const std::string& text);
/// Whether a JSON report was printed: a program prints at most one.
[[nodiscard]] bool has_printed_json();

}  // namespace roam::app
