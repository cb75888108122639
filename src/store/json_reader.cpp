#include "store/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "store/files.h"

namespace roam::store {
namespace {

/// Tracks the position and forwards events to the reader.
class Events {
 public:
  explicit Events(JsonReader& reader) : reader_(reader) {}

  bool null() { return value({}); }
  bool boolean(bool value_) { return value(value_); }
  bool number_integer(nlohmann::json::number_integer_t number) { return value(std::int64_t{number}); }
  bool number_unsigned(nlohmann::json::number_unsigned_t number) { return value(std::uint64_t{number}); }
  bool number_float(nlohmann::json::number_float_t number, const std::string&) { return value(number); }
  bool string(std::string& text) { return value(&text); }
  bool binary(nlohmann::json::binary_t&) { return false; }
  bool start_object(std::size_t) {
    enter();
    reader_.object_begins(place_);
    open(false);
    return true;
  }
  bool key(std::string& name) {
    place_.path.resize(level_[depth_ - 1].path);
    if (!place_.path.empty()) place_.path += '/';
    // No known member is long or contains '/' or '*', which would look like a path of several members.
    const bool plain = name.size() <= longest_member && name.find_first_of("/*") == std::string::npos;
    place_.path += plain ? name : "?";
    return true;
  }
  bool end_object() {
    close();
    reader_.object_ends(place_);
    return true;
  }
  bool start_array(std::size_t) {
    enter();
    reader_.list_begins(place_);
    open(true);
    return true;
  }
  bool end_array() {
    --place_.lists;
    close();
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) { return false; }

 private:
  static constexpr std::size_t longest_member = 64;
  struct Level {
    std::size_t path = 0;  ///< length of the path to this list or object
    bool list = false;
  };

  bool value(JsonValue value) {
    enter();
    reader_.value(place_, value);
    return true;
  }
  /// Called before each value: if it is in a list, it is the next element.
  void enter() {
    if (depth_ == 0 || !level_[depth_ - 1].list) return;
    place_.path.resize(level_[depth_ - 1].path);
    place_.path += "/*";
    place_.index[place_.lists - 1] = next_[place_.lists - 1]++;
  }
  void open(bool list) {
    if (depth_ == JsonPlace::most_depth) reader_.refuse("it is nested deeper than any of its kind");
    level_[depth_++] = {place_.path.size(), list};
    if (list) next_[place_.lists++] = 0;
  }
  void close() { place_.path.resize(level_[--depth_].path); }

  JsonReader& reader_;
  JsonPlace place_;
  std::array<Level, JsonPlace::most_depth> level_;
  std::array<std::uint64_t, JsonPlace::most_depth> next_{};
  std::size_t depth_ = 0;
};

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

void JsonReader::read(std::string_view text) {
  if (longest_token(text) > most_token) refuse("a text or a number in it is longer than any of its kind");
  Events events(*this);
  if (!nlohmann::json::sax_parse(text.begin(), text.end(), &events)) refuse("it is no JSON");
}

namespace {

/// Counts the memory of a tree of values.
class Weighed : public JsonReader {
 public:
  using JsonReader::JsonReader;
  void value(const JsonPlace&, JsonValue value) override {
    const auto* const text = std::get_if<std::string*>(&value);
    keep(most_of_a_value + (text != nullptr ? (*text)->size() : 0));
  }
  void list_begins(const JsonPlace&) override { keep(most_of_a_value); }
  void object_begins(const JsonPlace&) override { keep(most_of_a_value); }
  void object_ends(const JsonPlace&) override {}

 private:
  /// Includes the member's name and the growth of lists.
  static constexpr std::uint64_t most_of_a_value = 192;
};

}  // namespace

Json parse_json(std::string_view text, const std::string& name, std::uint64_t memory) {
  Weighed(name, memory).read(text);
  return Json::parse(text.begin(), text.end());
}

void JsonReader::keep(std::uint64_t bytes) {
  kept_ += bytes;
  if (kept_ > memory_) throw TooLarge(name_, memory_);
}

void JsonReader::refuse(const std::string& what) const {
  throw Error::at(name_, fmt::format("{} is damaged: {}; verify the store, and repair it from its scene", name_, what));
}

bool JsonMembers::is(const char* name, std::string_view tail, std::uint64_t part, int parts) {
  const int first = bit_;
  bit_ += parts;
  const std::uint64_t all = ((std::uint64_t{1} << parts) - 1) << first;
  if (ends_) {
    if ((seen_ & all) != all) bad(name);
    return false;
  }
  const std::string_view own(name);
  if (!member_.starts_with(own)) return false;
  if (member_.substr(own.size()) != tail) {
    // Here should be a single value.
    if (member_.size() == own.size() || member_[own.size()] == '/') bad(name);
    return false;
  }
  const std::uint64_t bit = std::uint64_t{1} << (static_cast<std::uint64_t>(first) + part);
  if (part >= static_cast<std::uint64_t>(parts) || (seen_ & bit) != 0) bad(name);
  seen_ |= bit;
  return true;
}

template <class T>
T& JsonMembers::as(const char* name) const {
  T* const found = value_ != nullptr ? std::get_if<T>(value_) : nullptr;
  if (found == nullptr) bad(name);
  return *found;
}

void JsonMembers::text(const char* name, std::string& out, std::size_t most) {
  if (!is(name)) return;
  std::string& found = *as<std::string*>(name);
  if (found.size() > most) bad(name);
  reader_.keep(found.size());
  out = found;  // copied, so that it takes only its own size
}

void JsonMembers::digits(const char* name, std::size_t count, std::string& out) {
  if (!is(name)) return;
  const std::string& found = *as<std::string*>(name);
  if (!is_digits(found, count)) bad(name);
  out = found;
}

void JsonMembers::hash(const char* name, std::uint64_t& out) {
  std::string text;
  const std::uint64_t before = seen_;
  digits(name, 16, text);
  if (!ends_ && seen_ != before) out = std::stoull(text, nullptr, 16);
}

void JsonMembers::whole(const char* name, std::uint64_t& out) {
  if (is(name)) out = as<std::uint64_t>(name);
}

void JsonMembers::whole(const char* name, std::uint32_t& out) {
  if (!is(name)) return;
  const std::uint64_t found = as<std::uint64_t>(name);
  if (found > std::numeric_limits<std::uint32_t>::max()) bad(name);
  out = static_cast<std::uint32_t>(found);
}

namespace {

/// NaN if the value is not a number.
double number_in(const JsonValue* value) {
  if (value == nullptr) return std::numeric_limits<double>::quiet_NaN();
  if (const auto* n = std::get_if<double>(value)) return *n;
  if (const auto* n = std::get_if<std::uint64_t>(value)) return static_cast<double>(*n);
  if (const auto* n = std::get_if<std::int64_t>(value)) return static_cast<double>(*n);
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

void JsonMembers::number(const char* name, double& out) {
  if (!is(name)) return;
  out = number_in(value_);
  if (!std::isfinite(out)) bad(name);
}

void JsonMembers::truth(const char* name, bool& out) {
  if (is(name)) out = as<bool>(name);
}

void JsonMembers::box(const char* name, Box& out) {
  // The two levels of lists that hold the numbers.
  if (!ends_ && value_ == nullptr && member_.starts_with(name)) {
    const std::string_view tail = member_.substr(std::string_view(name).size());
    if (tail.empty() || tail == "/*") {
      bit_ += 6;
      return;
    }
  }
  const std::uint64_t k = at_ != nullptr ? at_->number() : 0, side = at_ != nullptr ? at_->number(1) : 0;
  if (!is(name, "/*/*", k < 3 && side < 2 ? 3 * side + k : 6, 6)) {
    if (ends_ && out.empty()) bad(name);
    return;
  }
  const double found = number_in(value_);
  if (!std::isfinite(found)) bad(name);
  (side == 0 ? out.lower : out.upper)[static_cast<int>(k)] = found;
}

void JsonMembers::list(const char* name) {
  // Elements of the list are handled elsewhere.
  const bool inside = !ends_ && member_.size() > std::string_view(name).size() && member_.starts_with(name);
  if (inside) {
    ++bit_;
    return;
  }
  if (is(name) && value_ != nullptr) bad(name);
}

void JsonMembers::bad(const char* name) const {
  reader_.refuse(fmt::format("'{}' of {} is missing or not what it should be", name, what_));
}

}  // namespace roam::store
