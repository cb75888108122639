#include "cli/failure.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

namespace roam::app {
namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// Options, files and other words; no numbers, which a sentence may mention by chance.
std::vector<std::string_view> names_in(std::span<const std::string> arguments) {
  std::vector<std::string_view> names;
  for (const std::string& argument : arguments) {
    const std::size_t sign = argument.starts_with('-') ? argument.find('=') : std::string::npos;
    const std::string_view text = argument;
    names.push_back(text.substr(0, sign));
    if (sign != std::string::npos) names.push_back(text.substr(sign + 1));
  }
  std::erase_if(names, [](std::string_view name) {
    return name.size() < 2 || std::none_of(name.begin(), name.end(), is_letter);
  });
  return names;
}

/// Whether the sentence has the name as a whole word.
bool mentions(std::string_view sentence, std::string_view name) {
  const auto in_word = [](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '/';
  };
  for (std::size_t at = sentence.find(name); at != std::string_view::npos; at = sentence.find(name, at + 1)) {
    const std::size_t end = at + name.size();
    if ((at == 0 || !in_word(sentence[at - 1])) && (end == sentence.size() || !in_word(sentence[end]))) return true;
  }
  return false;
}

/// The end of the place that a sentence begins with: "--radius", "--trace t.csv", "house.obj:3", "house.obj.roam.json".
/// 0 if that is not the name or a place in it. A verb is a place only before a colon.
std::size_t place_at_start(std::string_view sentence, std::string_view name, bool is_verb) {
  if (!sentence.starts_with(name)) return 0;
  const std::size_t colon = std::min(sentence.find(": "), sentence.size());
  std::size_t end = name.size();
  if (is_verb) return end == colon ? end : 0;
  if (end < sentence.size() && std::isalnum(static_cast<unsigned char>(sentence[end])) != 0) return 0;
  if (name.starts_with('-') && colon < sentence.size()) return colon;
  while (end < colon && sentence[end] != ' ') ++end;
  return end;
}

}  // namespace

Json failure_report(const std::string& message, std::span<const std::string> arguments) {
  const std::vector<std::string_view> names = names_in(arguments);
  std::string what = message, where;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::size_t end = place_at_start(message, names[i], i == 0);
    if (end <= where.size()) continue;
    where = message.substr(0, end);
    what = message.substr(end, 2) == ": " ? message.substr(end + 2) : message;
  }
  const bool begins_with_place = !where.empty();
  // The verb is no place within a sentence.
  for (std::size_t i = 1; i < names.size() && !begins_with_place; ++i) {
    if (names[i].size() > where.size() && mentions(message, names[i])) where = names[i];
  }
  return {{"error", {{"message", message}, {"what", what}, {"where", where.empty() ? Json(nullptr) : Json(where)}}}};
}

bool wants_json(std::span<const std::string> arguments) {
  return std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
}

}  // namespace roam::app
