#pragma once
/// \file
/// JSON of small files, from people or from strangers, within limits.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace roam::files {

/// Bytes. More than any profile, settings or bookmarks: a region of a profile takes some 300.
inline constexpr std::uint64_t longest_json = 16 << 20;

/// The values of a text that is JSON, perhaps with comments. Throws roam::Error that says what the text "is" or "has"
/// for one that is no JSON, is nested deeper than 16 levels, or has more than 1000 members in an object or a million
/// values: a text from a stranger could take a hundred times its size, and an object of many members a time that grows
/// with their square.
[[nodiscard]] nlohmann::ordered_json parse_json(const std::string& text);

}  // namespace roam::files
