#include "view/probing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "math/level_distance.h"
#include "view/roam_child.h"

namespace roam::app {
namespace {

std::string option(const char* name, const Vec3& point) {
  return fmt::format("--{}={},{},{}", name, point.x, point.y, point.z);
}

/// The verb's arguments for a body: ways through the air are found for spheres.
std::vector<std::string> arguments_of(const SceneAndStore& what, const WalkerSettings& body, Mode mode,
                                      const Vec3& from, const Vec3& to, const std::vector<std::string>& ignored) {
  std::vector<std::string> arguments{"probe", "--json", option("from", from), option("to", to),
                                     fmt::format("--radius={}", body.radius)};
  if (mode == Mode::fly) {
    arguments.insert(arguments.end(), {"--mode=fly", "--sphere"});
  } else {
    arguments.push_back(fmt::format("--height={}", body.height));
    arguments.push_back(fmt::format("--step={}", body.step));
    arguments.push_back(fmt::format("--slope={}", body.slope_degrees));
    if (body.support_radius > 0.0) arguments.push_back(fmt::format("--support-radius={}", body.support_radius));
  }
  SceneOptions scene = what.scene;
  if (!what.store.empty()) scene.scenes = {what.store};
  scene.memory.reset();  // it is that of the window's store
  scene.ignore.insert(scene.ignore.end(), ignored.begin(), ignored.end());
  for (std::string& argument : scene.arguments()) arguments.push_back(std::move(argument));
  return arguments;
}

Vec3 point_of(const Json& json) { return {json.at(0), json.at(1), json.at(2)}; }

ProbeReply reply_of(const Json& json) {
  ProbeReply reply;
  reply.from = point_of(json.at("from"));
  reply.to = point_of(json.at("to"));
  reply.start = point_of(json.at("start"));
  reply.target = point_of(json.at("target"));
  reply.passable = json.at("passable");
  if (!reply.passable && json.at("walked").is_object()) {
    reply.stopped_at = point_of(json.at("walked").at("at"));
  } else if (!reply.passable && json.at("opening").is_object()) {
    reply.stopped_at = point_of(json.at("opening").at("point"));
  }
  for (const Json& point : json.at("way")) reply.way.push_back(point_of(point));
  for (const Json& mark : json.at("marks")) reply.marks.emplace_back(point_of(mark.at("point")), mark.at("text"));
  reply.text = json.at("text").get<std::vector<std::string>>();
  return reply;
}

/// The lines of the verb's answer, "  label       text", as rows. A deeper line goes on with the row above.
std::vector<StatusText> rows_of(const std::vector<std::string>& lines) {
  constexpr std::size_t indent = 2;
  std::vector<StatusText> rows;
  for (const std::string& line : lines) {
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    if (begin == line.size()) continue;
    if (begin > indent && !rows.empty()) {
      rows.back().value += ' ' + line.substr(begin);
      continue;
    }
    const std::size_t end = begin == 0 ? 0 : line.find("  ", begin);
    const std::size_t value = line.find_first_not_of(' ', std::min(end, line.size()));
    rows.push_back({begin == 0 ? "probe" : line.substr(begin, end - begin), line.substr(std::min(value, line.size()))});
  }
  return rows;
}

/// Whether the window shows a row: the answer, the way, the places that decide, and the ends.
bool decides(const StatusText& row) {
  constexpr std::array<std::string_view, 3> others{"widest way", "narrower", "certainty"};
  return std::find(others.begin(), others.end(), row.label) == others.end();
}

/// The verb's error of an end without room, which it names as its options.
std::string told_error(const std::string& text) {
  for (const auto& [option, end] : {std::pair("--from (", "A ("), std::pair("--to (", "B (")}) {
    const std::string_view begin = option;
    if (text.starts_with(begin)) return fmt::format("NO: no room at {}{}", end, text.substr(begin.size()));
  }
  return text;
}

/// Says of an end how far its place is from the clicked point, which the verb does not know.
StatusText told_from_click(const StatusText& row, const Vec3& place, const std::optional<Vec3>& click, bool flies) {
  constexpr double moved = 0.005;  // m
  StatusText told = row;
  told.label = "at " + row.label;
  if (!click) return told;
  told.value.resize(std::min(told.value.find(", moved by "), told.value.size()));
  const double aside = flies ? glm::distance(place, *click) : level_distance(place, *click);
  told.value = (aside < moved ? "not moved: " : fmt::format("moved {:.2f} m from the click: ", aside)) + told.value;
  return told;
}

/// A dash of each two, along the way, at most 1000.
std::vector<std::array<Vec3, 2>> dashes(const std::vector<Vec3>& way, const Vec3& offset) {
  double length = 0.0, gone = 0.0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) length += glm::distance(way[i], way[i + 1]);
  const double dash = std::max(0.1, length / 2000.0);  // m
  std::vector<std::array<Vec3, 2>> all;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const double piece = glm::distance(way[i], way[i + 1]);
    const auto at = [&](double along) {
      return way[i] + offset + std::clamp((along - gone) / piece, 0.0, 1.0) * (way[i + 1] - way[i]);
    };
    for (double k = std::floor(0.5 * gone / dash); piece > 0.0 && 2.0 * k * dash < gone + piece; k += 1.0) {
      if ((2.0 * k + 1.0) * dash > gone) all.push_back({at(2.0 * k * dash), at((2.0 * k + 1.0) * dash)});
    }
    gone += piece;
  }
  return all;
}

}  // namespace

ProbedWay way_of(const ProbeReply& reply) {
  ProbedWay parts;
  if (reply.passable || !reply.stopped_at) {
    (reply.passable ? parts.open : parts.barred) = reply.way;
    return parts;
  }
  const Vec3 stop = *reply.stopped_at;
  std::size_t piece = 0;
  Vec3 nearest = reply.way.empty() ? stop : reply.way.front();
  for (std::size_t i = 0; i + 1 < reply.way.size(); ++i) {
    const Vec3 from = reply.way[i], along = reply.way[i + 1] - from;
    const double square = glm::dot(along, along);
    const Vec3 at = from + (square > 0.0 ? std::clamp(glm::dot(stop - from, along) / square, 0.0, 1.0) : 0.0) * along;
    if (glm::distance(at, stop) >= glm::distance(nearest, stop)) continue;
    nearest = at;
    piece = i;
  }
  if (reply.way.size() < 2) return parts;
  const auto cut = reply.way.begin() + static_cast<std::ptrdiff_t>(piece) + 1;
  parts.open.assign(reply.way.begin(), cut);
  parts.open.push_back(nearest);
  parts.barred.push_back(nearest);
  parts.barred.insert(parts.barred.end(), cut, reply.way.end());
  return parts;
}

struct Probing::Search {
  Search(std::filesystem::path program, std::vector<std::string> arguments)
      : loading([this, program = std::move(program), arguments = std::move(arguments)] { run(program, arguments); }) {}

  void run(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
    std::string text;
    const VerbEnd end = run_verb(
        program, arguments, [this] { return loading.wanted(); }, [&](const std::string& line) { text += line + '\n'; });
    const Json json = Json::parse(text, nullptr, false);
    if (json.is_object() && json.contains("error")) throw printed_error(json.at("error"));
    if (!json.is_object() || !json.contains("passable")) throw silent_end("probe", end);
    ProbeReply found = reply_of(json);
    loading.with_state([&](LoadState& state) {
      state.phase = LoadState::Phase::done;
      reply = std::move(found);
    });
  }

  std::optional<ProbeReply> reply;
  bool received = false;
  Loading loading;
};

Probing::Probing(std::filesystem::path program, SceneAndStore what, const osgRoam::Manipulator& roamer)
    : program_(std::move(program)), what_(std::move(what)), roamer_(roamer) {}

Probing::~Probing() = default;

void Probing::ask(const Vec3& from, const Vec3& to, const std::vector<std::string>& ignored, const Clicked& clicked) {
  search_.reset();
  clicked_ = clicked;
  flies_ = roamer_.mode() == Mode::fly;
  search_ =
      std::make_unique<Search>(program_, arguments_of(what_, roamer_.settings(), roamer_.mode(), from, to, ignored));
}

bool Probing::clear() {
  receive();
  const bool searched = search_ && !search_->received && !is_over(search_->loading.state());
  search_.reset();
  return searched;
}

void Probing::receive() {
  if (!search_ || search_->received || search_->loading.state().phase != LoadState::Phase::done) return;
  replies_.push_back(*search_->reply);
  search_->received = true;
}

const ProbeReply* Probing::shown() {
  receive();
  return search_ && search_->received ? &replies_.back() : nullptr;
}

const std::vector<ProbeReply>& Probing::replies() {
  receive();
  return replies_;
}

void Probing::fill(Status& status) {
  receive();
  if (!search_) return;
  const LoadState state = search_->loading.state();
  if (state.phase == LoadState::Phase::failed) {
    status.tool.push_back({"probe", told_error(state.error.what()), true});
  } else if (!search_->received) {
    status.tool.push_back({"probe", "searching"});
  } else {
    constexpr std::size_t most_rows = 7;
    const ProbeReply& reply = replies_.back();
    std::vector<StatusText> rows = rows_of(reply.text);
    std::erase_if(rows, [](const StatusText& row) { return !decides(row); });
    for (StatusText& row : rows) {
      if (row.label == "A") row = told_from_click(row, reply.start, clicked_.from, flies_);
      if (row.label == "B") row = told_from_click(row, reply.target, clicked_.to, flies_);
    }
    rows.resize(std::min(rows.size(), most_rows));
    if (!rows.empty()) rows.front().warning = !reply.passable;
    std::move(rows.begin(), rows.end(), std::back_inserter(status.tool));
  }
}

void Probing::add_to(graphics::Marks& marks, const Vec3& origin) {
  const ProbeReply* const reply = shown();
  if (reply == nullptr) return;
  const Vec3 above_floor = Vec3(0.0, 0.0, 0.05) - origin;
  const ProbedWay way = way_of(*reply);
  for (std::size_t i = 0; i + 1 < way.open.size(); ++i)
    marks.way.push_back({way.open[i] + above_floor, way.open[i + 1] + above_floor});
  marks.barred = dashes(way.barred, above_floor);
  for (const auto& [place, text] : reply->marks) {
    marks.points.push_back(place - origin);
    marks.labels.push_back({place - origin, text});
  }
}

Json to_json(const ProbeReply& reply) {
  return {{"from", to_json(reply.from)}, {"to", to_json(reply.to)}, {"passable", reply.passable}, {"text", reply.text}};
}

}  // namespace roam::app
