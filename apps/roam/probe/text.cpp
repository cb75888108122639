// Output of `roam probe`: table, JSON.
#include "probe/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/exit_status.h"
#include "scenes/body_options.h"
#include "text/printable.h"
#include "words/measures.h"
#include "words/probe.h"

namespace roam::app {
namespace {

using namespace words;
using Kind = ProbeLimit::Kind;

bool is_number(const std::string& text, double& value) {
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && after == end;
}

Json json_limit(const std::optional<ProbeLimit>& of) {
  if (!of) return nullptr;
  const ProbeLimit& limit = *of;
  Json json = {{"kind", to_string(limit.kind)},
               {"point", to_json(limit.point)},
               {"direction", to_json(limit.direction)},
               {"along_m", limit.along}};
  if (is_end(limit.kind)) json["end"] = end_name(limit.kind);
  const char* const size = limit.kind == Kind::height || limit.too_low      ? "height_m"
                           : is_end(limit.kind) || limit.kind == Kind::edge ? "distance_m"
                           : limit.kind == Kind::step                       ? "step_m"
                                                                            : "width_m";
  if (limit.kind != Kind::apart) json[size] = limit.size;
  if (limit.kind == Kind::height && limit.width > 0.0) json["width_m"] = limit.width;
  return json;
}

}  // namespace

std::vector<ProbedSize> parse_sizes(const std::string& text, const std::string& where, bool spheres) {
  std::vector<ProbedSize> sizes;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t begin = std::min(text.find_first_not_of(", \t\r", i), text.size());
    const bool between = !sizes.empty() && begin < text.size();
    const std::string separator = text.substr(i, begin - i);
    const auto commas = std::count(separator.begin(), separator.end(), ',');
    if (commas > (between ? 1 : 0)) {
      throw UsageError(where, "a comma has no size before or behind it; leave it out, or add the size");
    }
    if (begin == text.size()) break;
    if (between && commas == 0 && separator.find('\t') != std::string::npos) {
      throw UsageError(where,
                       "a tab separates two numbers; write a radius and a height as 0.3x1.9, and put a comma or "
                       "a blank between two sizes");
    }
    const std::size_t end = std::min(text.find_first_of(", \t\r", begin), text.size());
    const std::string item = text.substr(begin, end - begin);
    const std::size_t cross = item.find('x');
    ProbedSize size;
    bool good = is_number(item.substr(0, cross), size.radius);
    size.height = default_height(size.radius, spheres);
    if (spheres && cross != std::string::npos)
      throw UsageError(where, fmt::format("'{}' has a height, and --sphere excludes it: leave one out", excerpt(item)));
    if (good && cross != std::string::npos) good = is_number(item.substr(cross + 1), size.height);
    if (!good)
      throw UsageError(where, fmt::format("'{}' is no size: R or RxH, in metres, e.g. 0.3x1.9", excerpt(item)));
    sizes.push_back(size);
    i = end;
  }
  return sizes;
}

Json json_report(const ProbeAnswer& answer, bool with_way) {
  const Passage& p = answer.passage;
  Json json = {
      {"radius", answer.size.radius},      {"height", answer.size.height},   {"passable", answer.passable},
      {"wide_enough", answer.wide_enough}, {"clearance_m", p.radius},        {"limited", p.limited},
      {"passing_m", answer.passing},       {"start", to_json(answer.start)}, {"target", to_json(answer.target)}};
  if (with_way) {
    Json way = Json::array();
    for (const Vec3& place : p.way) way.push_back(to_json(place));
    json["way"] = std::move(way);
    json["marks"] = Json::array();
    for (const ProbeMark& mark : marks_of(answer))
      json["marks"].push_back({{"point", to_json(mark.place)}, {"text", mark.text}});
    json["length_m"] = p.length;
  }
  json["drops"] = Json::array();
  for (const ProbeDrop& drop : answer.drops)
    json["drops"].push_back({{"point", to_json(drop.rim)}, {"down_m", drop.height()}});
  json["opening"] = json_limit(answer.limit);
  if (answer.limit) {
    json["opening"]["missing_m"] = answer.limit->kind == Kind::apart ? Json(nullptr) : Json(answer.missing);
    if (is_end(answer.limit->kind)) json["opening"]["room"] = answer.room ? to_json(*answer.room) : Json(nullptr);
  }
  json["other"] = json_limit(answer.other);
  json["proven"] = answer.proven;
  json["bound_m"] = std::isfinite(p.bound) && p.bound > 0.0 ? Json(p.bound) : Json(nullptr);
  json["complete"] = p.complete;
  json["places"] = p.places;
  json["walked"] = nullptr;
  if (const auto& walk = answer.walk) {
    json["walked"] = {{"outcome", to_string(walk->outcome)}, {"at", to_json(walk->at)}};
    json["walked"]["step_m"] = walk->step > 0.0 ? Json(walk->step) : Json(nullptr);
  }
  return json;
}

void add_details(Json& json, const words::ProbeDetails& details) {
  if (json["opening"].is_object()) json["opening"]["objects"] = {details.left, details.right};
  json["steepest"] = nullptr;
  if (const auto& slope = details.slope) {
    json["steepest"] = {
        {"degrees", slope->degrees}, {"point", to_json(slope->place)}, {"up_m", slope->rise}, {"down_m", slope->fall}};
  }
  json["narrower"] = nullptr;
  if (!(details.narrower > 0.0)) return;
  json["narrower"] = Json::array();
  for (const auto& [place, left, right] : details.narrow) {
    json["narrower"].push_back({{"width_m", place.width},
                                {"point", to_json(place.centre)},
                                {"along_m", place.along},
                                {"from_m", place.from},
                                {"to_m", place.to},
                                {"objects", {left, right}}});
  }
}

std::string table(const ProbeQuestion& question, std::span<const ProbeAnswer> answers) {
  std::string text = fmt::format("{:>8}  {:>8}  {:<4}  {:>11}  {:>9}  {}\n", "radius", "height", "", "widest way",
                                 "missing", "what decides");
  for (const ProbeAnswer& answer : answers) {
    const Passage& p = answer.passage;
    const bool ended_early = !p.found && !p.complete;
    std::string width = p.found ? metres_down(2.0 * p.radius) : ended_early ? "not known" : "none";
    if (p.found && !p.limited) width = ">= " + width;
    std::string what;
    if (is_unknown(answer))
      what = "the search ended";
    else if (answer.walk && !answer.passable)
      what = fmt::format("walker {} at {}", to_string(answer.walk->outcome), at(answer.walk->at));
    else if (answer.limit)
      what = fmt::format("{} at {}", text_of(*answer.limit), at(answer.limit->point));
    else if (!p.found)
      what = is_shut(answer) ? "no way at all" : ended_early ? "none that wide: certified" : "no way was found";
    const bool contradicts = answer.walk && !answer.passable && !falls(*answer.walk, question.mode);
    const std::string missing = answer.missing <= 0.0 ? "" : answer.missing < 1e-3 ? "< 1 mm" : metres(answer.missing);
    const char* const word = answer.passable ? "yes" : contradicts || is_unknown(answer) ? "?" : "no";
    text += fmt::format("{:>6.3f} m  {:>6.3f} m  {:<4}  {:>11}  {:>9}  {}\n", answer.size.radius, answer.size.height,
                        word, width, missing, what);
  }
  return text;
}

}  // namespace roam::app
