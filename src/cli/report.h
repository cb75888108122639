#pragma once
/// \file
/// Pieces of the JSON reports that several verbs share.

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

/// What a pager held and did.
[[nodiscard]] Json to_json(const PagerStats& paging);

/// The form of the JSON objects that the program prints. It grows when a member goes or changes its meaning; further
/// members do not count.
inline constexpr int json_schema = 1;

/// Writes the report to standard output, after the members "roam", the version, and "schema". Throws BrokenPipe when
/// nobody reads it, roam::Error when it cannot be written, e.g. to a disk that is full.
void print(const Json& report);
/// The same in one line, for a sequence of objects.
void print_line(const Json& object);
/// The same of lines for people, made printable.
void print(const std::string& text);
/// Whether a JSON report was printed: a program prints one at most.
[[nodiscard]] bool has_printed_json();

}  // namespace roam::app
