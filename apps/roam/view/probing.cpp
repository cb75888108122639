#include "view/probing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

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
  scene.ignore.insert(scene.ignore.end(), ignored.begin(), ignored.end());
  for (std::string& argument : scene.arguments()) arguments.push_back(std::move(argument));
  return arguments;
}

Vec3 point_of(const Json& json) { return {json.at(0), json.at(1), json.at(2)}; }

ProbeReply reply_of(const Json& json) {
  ProbeReply reply;
  reply.from = point_of(json.at("from"));
  reply.to = point_of(json.at("to"));
  reply.passable = json.at("passable");
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

/// Whether the window shows a row: the answer, the places that decide, and an end that was moved.
bool decides(const StatusText& row) {
  constexpr std::array<std::string_view, 4> others{"way", "widest way", "narrower", "certainty"};
  if (row.label == "A" || row.label == "B") return row.value.find(", moved: ") != std::string::npos;
  return std::find(others.begin(), others.end(), row.label) == others.end();
}

}  // namespace

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

void Probing::ask(const Vec3& from, const Vec3& to, const std::vector<std::string>& ignored) {
  search_.reset();
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

const std::vector<ProbeReply>& Probing::replies() {
  receive();
  return replies_;
}

void Probing::fill(Status& status) {
  receive();
  if (!search_) return;
  const LoadState state = search_->loading.state();
  if (state.phase == LoadState::Phase::failed) {
    status.tool.push_back({"probe", state.error.what(), true});
  } else if (!search_->received) {
    status.tool.push_back({"probe", "searching"});
  } else {
    constexpr std::size_t most_rows = 6;
    std::vector<StatusText> rows = rows_of(replies_.back().text);
    std::erase_if(rows, [](const StatusText& row) { return !decides(row); });
    rows.resize(std::min(rows.size(), most_rows));
    if (!rows.empty()) rows.front().warning = !replies_.back().passable;
    std::move(rows.begin(), rows.end(), std::back_inserter(status.tool));
  }
}

void Probing::add_to(graphics::Marks& marks, const Vec3& origin) {
  receive();
  if (!search_ || !search_->received) return;
  const ProbeReply& reply = replies_.back();
  const Vec3 above_floor(0.0, 0.0, 0.05);
  for (std::size_t i = 0; i + 1 < reply.way.size(); ++i) {
    marks.lines.push_back({reply.way[i] - origin + above_floor, reply.way[i + 1] - origin + above_floor});
  }
  for (const auto& [place, text] : reply.marks) {
    marks.points.push_back(place - origin);
    marks.labels.push_back({place - origin, text});
  }
}

Json to_json(const ProbeReply& reply) {
  return {{"from", to_json(reply.from)}, {"to", to_json(reply.to)}, {"passable", reply.passable}, {"text", reply.text}};
}

}  // namespace roam::app
