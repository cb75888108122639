#include "store/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace roam::store {
namespace {

/// Lists and objects in each other, at most.
constexpr int most_depth = 8;
/// Bytes. The parser keeps several copies of a token.
constexpr std::size_t most_token = 1U << 20;

/// The longest token of a JSON text; for any other text at least the longest before the first error.
std::size_t longest_token(std::string_view text) {
  std::size_t longest = 0, begin = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\') {
      ++i;
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && (c <= ' ' || c == ',' || c == ':' || c == '[' || c == ']' || c == '{' || c == '}')) {
      begin = i + 1;
    }
    longest = std::max(longest, std::min(i + 1, text.size()) - std::min(begin, i));
  }
  return longest;
}

}  // namespace

TooLarge::TooLarge(const std::string& name, std::uint64_t memory)
    : Error(
          at(name, fmt::format("{} takes more than the {:.5g} MiB of memory that it may take; where there is --memory, "
                               "give more",
                               name, std::ldexp(double(memory), -20)))) {}

Json JsonReader::read(std::string_view text, const Json::parser_callback_t& see) const {
  if (longest_token(text) > most_token) refuse("a text or a number in it is longer than any of its kind");
  using Event = Json::parse_event_t;
  const auto within_limits = [&](int depth, Event event, Json& json) {
    if ((event == Event::object_start || event == Event::array_start) && depth >= most_depth) {
      refuse("it is nested deeper than any of its kind");
    }
    return see(depth, event, json);
  };
  Json json = Json::parse(text.begin(), text.end(), within_limits, false);
  if (json.is_discarded()) refuse("it is no JSON");
  return json;
}

Json parse_json(std::string_view text, const std::string& name, std::uint64_t memory) {
  /// Bytes. Includes the member's name and the growth of lists.
  constexpr std::uint64_t most_of_a_value = 192;
  JsonReader reader(name, memory);
  return reader.read(text, [&](int, Json::parse_event_t event, const Json& json) {
    using Event = Json::parse_event_t;
    if (event == Event::value || event == Event::object_start || event == Event::array_start) {
      reader.keep(most_of_a_value + (json.is_string() ? json.get_ref<const std::string&>().size() : 0));
    }
    return true;
  });
}

void JsonReader::keep(std::uint64_t bytes) {
  kept_ += bytes;
  if (kept_ > memory_) throw TooLarge(name_, memory_);
}

void JsonReader::refuse(const std::string& what) const {
  throw Error::at(name_, fmt::format("{} is damaged: {}; verify the store, and repair it from its scene", name_, what));
}

}  // namespace roam::store
