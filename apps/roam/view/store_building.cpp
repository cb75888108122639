#include "view/store_building.h"

#include <fmt/format.h>

#include <utility>

#include "view/commands.h"
#include "view/status.h"

namespace roam::app {

StoreBuilding::StoreBuilding(const SceneAndStore& what, std::filesystem::path program,
                             const osgRoam::Manipulator& roamer, News& news)
    : what_(what), program_(std::move(program)), roamer_(roamer), news_(news) {}

std::string StoreBuilding::key() const { return key_of(roamer_.controls(), "store"); }

void StoreBuilding::cancel() {
  if (build_) build_->cancel();
}

void StoreBuilding::consider(const StoreChoice& choice) {
  is_stale_ = choice.stale;
  if (!choice.note.empty()) news_.note(choice.note);
}

void StoreBuilding::recommend() {
  if (std::exchange(recommended_, true)) return;
  news_.note(
      fmt::format("a collision store makes this scene open at once, in little memory: {}`roam build {}` builds it",
                  key().empty() ? key() : key() + " or ", what_.scene.names()));
}

/// Says what a build would write, before it begins.
void StoreBuilding::ask(std::uint64_t triangles) {
  const double most_bytes = what_.scene.lossless ? 5.5 : 3.5;  // a triangle, in a large store; docs/benchmarks.md
  constexpr std::uint64_t small = 1'000'000;
  const auto bytes = static_cast<std::uint64_t>(most_bytes * static_cast<double>(triangles));
  const std::string size = triangles == 0  ? fmt::format("{} bytes a triangle", most_bytes)
                           : bytes < small ? "less than 1 MB"
                                           : "up to " + byte_text(bytes);
  news_.tell_as_is(fmt::format("{} again builds the collision store {} ({})", key(),
                               std::filesystem::absolute(store_place(what_)).lexically_normal().string(), size));
}

void StoreBuilding::toggle(const Pager* used, const Vec3& place, std::uint64_t triangles) {
  if (build_) {
    stopped_ = true;
    build_->cancel();
  } else if (what_.store_only) {
    news_.tell(fmt::format("the scene of {} is not known: nothing can be built", what_.store.string()));
  } else if (used != nullptr && !is_stale_) {
    news_.tell(fmt::format("{} is of this very scene: there is nothing to build", used->store().name()));
  } else if (Store::is_address(what_.store.native())) {
    news_.tell(
        fmt::format("{} is on a web server: `roam build` and `roam publish` make it anew", what_.store.string()));
  } else if (!build_wish_.confirms(news_.now())) {
    ask(triangles);
  } else {
    stopped_ = false;
    build_.emplace(program_, what_, roamer_.settings(), place);
    news_.tell(fmt::format("building {}, what is near first; {} stops it", build_->output().string(), key()));
  }
}

void StoreBuilding::follow(const Vec3& place) {
  if (!build_) return;
  build_->follow(place);
  const LoadState state = build_->state();
  if (state.phase != LoadState::Phase::failed) return;
  if (stopped_) {
    news_.tell(fmt::format("stopped; what was done is kept in {}, and {} goes on from there", build_->output().string(),
                           key()));
  } else {
    news_.note(fmt::format("the store could not be built: {}", state.error.what()));
  }
  build_.reset();
}

std::shared_ptr<Pager> StoreBuilding::take() {
  if (!build_ || build_->state().phase != LoadState::Phase::done) return nullptr;
  BuildProcess::Built built = build_->take();
  build_.reset();
  for (const std::string& sentence : built.notes) news_.note(sentence);
  is_stale_ = false;
  return std::move(built.pager);
}

void StoreBuilding::fill(Status& status) const {
  if (build_) status.building = build_->state();
  if (recommended_ && !status.paging) status.store_key = key();
}

void StoreBuilding::fill(ViewReport& report) const {
  if (!build_ || build_->state().phase == LoadState::Phase::done) return;
  report.notes.push_back(fmt::format("{} is not finished; what is done is kept, and `roam build` goes on from there",
                                     build_->output().string()));
}

}  // namespace roam::app
