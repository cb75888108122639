#include "view/build_process.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <future>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/report.h"
#include "roam/error.h"
#include "scenes/beside_scene.h"
#include "view/collision_loader.h"
#include "view/roam_child.h"

namespace roam::app {
namespace {

/// Lowers this thread's priority; a child that it starts inherits it.
void give_way() {
  constexpr int nicer = 5;
  // Not more: without a graphics card, drawing takes all cores. A failure only costs smoothness.
  (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), nicer);
}

double share(std::uint64_t done, std::uint64_t total) {
  return total > 0 ? std::min(1.0, static_cast<double>(done) / static_cast<double>(total)) : 0.0;
}

/// Progress of the phase, for the display.
LoadState state_of(const Json& progress) {
  const auto number = [&](const char* name) { return progress.at(name).get<std::uint64_t>(); };
  const std::string step = progress.at("step");
  LoadState state;
  state.phase = step == "read" ? LoadState::Phase::reading : LoadState::Phase::indexing;
  state.share = step == "read"     ? share(number("bytes_done"), number("bytes_total"))
                : step == "shards" ? share(number("triangles_done"), number("triangles_total"))
                : step == "merge"  ? 1.0
                                   : 0.0;
  state.triangles = number("triangles_done");
  return state;
}

StoreBuildReport report_of(const Json& json) {
  StoreBuildReport report;
  report.triangles = json.at("triangles");
  report.parts = json.at("parts");
  report.parts_read = json.at("parts_read");
  report.notes = json.at("notes");
  report.store.hash = json.at("hash");
  return report;
}

}  // namespace

BuildProcess::BuildProcess(std::filesystem::path program, const SceneAndStore& what, const WalkerSettings& walker,
                           const Vec3& place)
    : program_(std::move(program)),
      what_(what),
      output_(store_place(what)),
      walker_(walker),
      place_(place),
      loading_([this] { load(); }) {}

void BuildProcess::follow(const Vec3& place) {
  loading_.with_state([&](const LoadState&) { place_ = place; });
}

Vec3 BuildProcess::place() {
  return loading_.with_state([this](const LoadState&) { return place_; });
}

BuildProcess::Built BuildProcess::take() {
  return loading_.with_state([this](const LoadState&) { return std::move(built_); });
}

StoreBuildReport BuildProcess::build() {
  const Vec3 near = place();
  std::vector<std::string> arguments{"build", "--json-lines", fmt::format("--near={},{},{}", near.x, near.y, near.z)};
  // Do not name a store beside the scene: the builder then refuses a link there.
  if (!what_.store.empty()) arguments.push_back("--output=" + output_.string());
  SceneOptions scene = what_.scene;
  scene.threads = work_threads(scene.threads);
  for (std::string& argument : scene.arguments()) arguments.push_back(std::move(argument));

  std::optional<StoreBuildReport> report;
  std::optional<Error> error;
  const VerbEnd end = run_verb(
      program_, arguments, [this] { return loading_.wanted(); },
      [&](const std::string& line) {
        const Json json = Json::parse(line);
        if (json.contains("step")) {
          const LoadState state = state_of(json);
          loading_.tell(state.phase, state.share, state.triangles);
        } else if (json.contains("error")) {
          error = printed_error(json.at("error"));
        } else {
          report = report_of(json);
        }
      });
  if (!report || !end.ending.is_success()) throw error ? *error : silent_end("build", end);
  return *report;
}

void BuildProcess::load() {
  // Use another thread: the pager's threads inherit this one's priority, and must keep it.
  const StoreBuildReport report = std::async(std::launch::async, [this] {
                                    give_way();
                                    return build();
                                  }).get();
  loading_.tell(LoadState::Phase::looking, 0.0, report.triangles);
  std::shared_ptr<const Store> store = what_.store.empty() ? open_store_beside(output_, what_.manifest_memory())
                                                           : Store::open(output_, what_.manifest_memory());
  if (store->info().hash != report.store.hash) {
    throw Error::at(output_.string(),
                    fmt::format("{} is not what was built just now: another store has taken its place; build again",
                                output_.string()));
  }
  auto pager = std::make_shared<Pager>(std::move(store), PagerOptions{.memory = what_.store_memory});
  wait_at(*pager, walker_, place(), [this] { return loading_.wanted(); });
  loading_.with_state([&](LoadState& state) {
    state = {};
    state.phase = LoadState::Phase::done;
    state.share = 1.0;
    built_ = {std::move(pager), notes_as_sentences(report, output_)};
  });
}

}  // namespace roam::app
