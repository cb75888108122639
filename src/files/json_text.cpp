#include "files/json_text.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>

#include "roam/error.h"

namespace roam::files {
namespace {

using Json = nlohmann::ordered_json;

class Limits {
 public:
  bool operator()(int depth, Json::parse_event_t event, Json&) {
    const bool begins = event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
    // `depth` counts what is around it.
    if (begins && depth >= most_depth) throw Error(fmt::format("is nested deeper than {} levels", most_depth));
    if (event == Json::parse_event_t::key && ++members_.at(static_cast<std::size_t>(depth)) > most_members) {
      throw Error(fmt::format("has an object of more than {} members", most_members));
    }
    if ((begins || event == Json::parse_event_t::value) && ++values_ > most_values) {
      throw Error(fmt::format("holds more than {} values", most_values));
    }
    if (begins) members_.at(static_cast<std::size_t>(depth) + 1) = 0;
    return true;
  }

 private:
  static constexpr int most_depth = 16;
  static constexpr std::size_t most_members = 1000;
  /// A region of a profile has 13.
  static constexpr std::size_t most_values = 1'000'000;
  std::array<std::size_t, most_depth + 1> members_{};
  std::size_t values_ = 0;
};

/// Where and why, of "[json.exception.parse_error.101] parse error at line 3, column 7: ...; last read: '...'". What
/// was read stays out: it may be of another file than was meant.
std::string reason_of(std::string what) {
  if (const std::size_t tag = what.find("] "); tag != std::string::npos) what.erase(0, tag + 2);
  return what.substr(0, what.find("; last read: "));
}

}  // namespace

nlohmann::ordered_json parse_json(const std::string& text) {
  Limits limits;
  try {
    return Json::parse(text, std::ref(limits), true, true);
  } catch (const Json::exception& error) {
    throw Error("is no JSON: " + reason_of(error.what()));
  }
}

}  // namespace roam::files
