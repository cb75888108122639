#include "import/reader/json.h"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "roam/error.h"
#include "text/printable.h"

namespace roam::reader {
namespace {

const Json nothing;

/// The same text with '?' in place of each byte that is no UTF-8.
std::string as_utf8(std::string_view text) {
  std::string valid;
  valid.reserve(text.size());
  while (!text.empty()) {
    const std::size_t bytes = first_character(text).bytes;
    if (bytes == 0) {
      valid += '?';
    } else {
      valid += text.substr(0, bytes);
    }
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return valid;
}

/// The fault and its place. Quotes nothing of the file.
std::string reason_of(std::string what) {
  if (const std::size_t tag = what.find("] "); tag != std::string::npos) what.erase(0, tag + 2);
  return what.substr(0, what.find("; last read: "));
}

/// Whether brackets are nested deeper. The parser's callback sees that, too, but takes a time that grows with the
/// square of a list's length.
bool is_nested_deeper(std::string_view text, int most_depth) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') {
      in_string = !in_string;
    } else if (in_string) {
      if (c == '\\') ++i;
    } else if (c == '[' || c == '{') {
      if (++depth > most_depth) return true;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return false;
}

}  // namespace

Json parse_json(std::string_view text, const std::string& place, int most_depth) {
  if (is_nested_deeper(text, most_depth)) {
    throw Error(place, fmt::format("its JSON is nested more than {} deep; the file is damaged.", most_depth));
  }
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    // A number beyond doubles is such a fault, too. Some exporters write names in other encodings.
    try {
      return Json::parse(as_utf8(text));
    } catch (const Json::exception&) {
      throw Error(place, fmt::format("it is no JSON ({}); the file is damaged.", printable(reason_of(error.what()))));
    }
  }
}

const Json& member(const Json& value, const char* key) {
  if (!value.is_object()) return nothing;
  const auto at = value.find(key);
  return at == value.end() ? nothing : *at;
}

const Json& member(const Json& value, const char* key, const char* inner) { return member(member(value, key), inner); }

const Json& element(const Json& value, std::uint64_t index) {
  return value.is_array() && index < value.size() ? value[index] : nothing;
}

std::optional<std::uint64_t> whole_number(const Json& value) {
  if (value.is_number_unsigned()) return value.get<std::uint64_t>();
  // Some exporters write 3.0.
  if (!value.is_number_float()) return std::nullopt;
  const double number = value.get<double>();
  if (!(number >= 0.0 && number <= 9e15) || std::floor(number) != number) return std::nullopt;
  return static_cast<std::uint64_t>(number);
}

double number(const Json& value, double fallback) {
  if (!value.is_number()) return fallback;
  const double number = value.get<double>();
  return std::isfinite(number) ? number : fallback;
}

std::string text(const Json& value) { return value.is_string() ? value.get<std::string>() : std::string(); }

std::optional<Vec3> three_numbers(const Json& value) {
  const auto three = value.size() == 3 ? numbers(value, 3) : std::nullopt;
  return three ? std::optional(Vec3((*three)[0], (*three)[1], (*three)[2])) : std::nullopt;
}

std::optional<std::vector<double>> numbers(const Json& value, std::size_t count) {
  if (!value.is_array() || value.size() < count) return std::nullopt;
  std::vector<double> list;
  for (std::size_t i = 0; i < count; ++i) {
    const double one = number(value[i], std::nan(""));
    if (!std::isfinite(one)) return std::nullopt;
    list.push_back(one);
  }
  return list;
}

}  // namespace roam::reader
