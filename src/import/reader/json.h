#pragma once
/// \file
/// JSON of files that strangers wrote: parsed within a depth, and read without trust in its shape.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "roam/math.h"

namespace roam::reader {

using Json = nlohmann::json;

/// Parses a text. Bytes that are no UTF-8 are replaced. Throws roam::Error at `place` for a text that is no JSON, that
/// has a number beyond doubles, or whose brackets are nested deeper than `most_depth`.
[[nodiscard]] Json parse_json(std::string_view text, const std::string& place, int most_depth);

/// The member of an object; null if there is none, or if `value` is no object.
[[nodiscard]] const Json& member(const Json& value, const char* key);
/// The element of a list; null if there is none, or if `value` is no list.
[[nodiscard]] const Json& element(const Json& value, std::uint64_t index);
/// A member of a member: `extensions` and the like.
[[nodiscard]] const Json& member(const Json& value, const char* key, const char* inner);

/// A whole number >= 0; unset for any other value.
[[nodiscard]] std::optional<std::uint64_t> whole_number(const Json& value);
/// A finite number, or `fallback`.
[[nodiscard]] double number(const Json& value, double fallback);
/// A text, or an empty one.
[[nodiscard]] std::string text(const Json& value);
/// A list of exactly three finite numbers.
[[nodiscard]] std::optional<Vec3> three_numbers(const Json& value);
/// A list of at least `count` finite numbers, by index; unset if it is shorter.
[[nodiscard]] std::optional<std::vector<double>> numbers(const Json& value, std::size_t count);

}  // namespace roam::reader
