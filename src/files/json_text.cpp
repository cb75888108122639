#include "files/json_text.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "roam/error.h"

namespace roam::files {
namespace {

using Json = nlohmann::ordered_json;

/// Where and why, of "[json.exception.parse_error.101] parse error at line 3, column 7: ...; last read: '...'". What
/// was read stays out: it may be of another file than was meant.
std::string reason_of(std::string what) {
  if (const std::size_t tag = what.find("] "); tag != std::string::npos) what.erase(0, tag + 2);
  return what.substr(0, what.find("; last read: "));
}

/// Counts what nlohmann's parser finds, and throws at the first thing that is too much. Its own callback sees the same,
/// but costs a time that grows with the square of a list's length.
class Limits : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return count(); }
  bool boolean(bool) override { return count(); }
  bool number_integer(Json::number_integer_t) override { return count(); }
  bool number_unsigned(Json::number_unsigned_t) override { return count(); }
  bool number_float(Json::number_float_t, const Json::string_t&) override { return count(); }
  bool string(Json::string_t&) override { return count(); }
  bool binary(Json::binary_t&) override { return count(); }
  bool start_object(std::size_t) override { return begin(); }
  bool start_array(std::size_t) override { return begin(); }
  bool end_object() override { return end(); }
  bool end_array() override { return end(); }
  bool key(Json::string_t&) override {
    if (++members_.at(depth_) > most_members) {
      throw Error(fmt::format("has an object of more than {} members", most_members));
    }
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const Json::exception& error) override {
    throw Error("is no JSON: " + reason_of(error.what()));
  }

 private:
  bool begin() {
    if (depth_ == most_depth) throw Error(fmt::format("is nested deeper than {} levels", most_depth));
    members_.at(++depth_) = 0;
    return count();
  }
  bool end() {
    --depth_;
    return true;
  }
  bool count() {
    if (++values_ > most_values) throw Error(fmt::format("holds more than {} values", most_values));
    return true;
  }

  static constexpr std::size_t most_depth = 16;
  static constexpr std::size_t most_members = 1000;
  /// A region of a profile has 13.
  static constexpr std::size_t most_values = 1'000'000;
  std::array<std::size_t, most_depth + 1> members_{};
  std::size_t depth_ = 0, values_ = 0;
};

}  // namespace

nlohmann::ordered_json parse_json(const std::string& text) {
  Limits limits;
  (void)Json::sax_parse(text, &limits, Json::input_format_t::json, true, true);
  return Json::parse(text, nullptr, true, true);
}

}  // namespace roam::files
