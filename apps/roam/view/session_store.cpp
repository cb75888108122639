// The collision store of a session's scene: found, offered, built, and changed to.
#include <fmt/format.h>

#include <utility>

#include "roam/error.h"
#include "view/session.h"

namespace roam::app {
namespace {

using Phase = LoadState::Phase;

constexpr double failure_period = 10.0;    // s: not every tile that fails is news
constexpr std::size_t most_failures = 20;  // that the report names

}  // namespace

std::string Session::key_of(const char* command) const {
  const auto* found = roamer_->controls().find(command);
  return found == nullptr ? std::string() : osgRoam::Controls::keyText(*found);
}

/// In each frame.
void Session::see_to_store() {
  if (const auto choice = collision_->take_choice()) {
    store_is_stale_ = choice->stale;
    if (!choice->note.empty()) note(choice->note);
  }
  if (!store_offered_ && collision_->wants_store()) {
    store_offered_ = true;
    const std::string key = key_of("store");
    note(fmt::format("a collision store makes this scene open at once, in little memory: {}`roam build {}` builds it",
                     key.empty() ? key : key + " or ", options_.scene.names()));
  }
  if (builder_) follow_builder();
}

/// Begins to build the scene's store, or stops that.
void Session::toggle_building() {
  if (builder_) {
    builder_stopped_ = true;
    builder_->cancel();
  } else if (what_.store_only) {
    tell(fmt::format("the scene of {} is not known: nothing can be built", what_.store.string()));
  } else if (pager_ && !store_is_stale_) {
    tell(fmt::format("{} is of this very scene: there is nothing to build", pager_->store().name()));
  } else {
    builder_stopped_ = false;
    const Vec3 place = placed_ ? roamer_->walker()->position() : scene_->bounds().center();
    builder_.emplace(options_.program, what_, roamer_->settings(), place);
    tell(fmt::format("building {}, what is near first; {} stops it", builder_->output().string(), key_of("store")));
  }
}

void Session::follow_builder() {
  const LoadState state = builder_->state();
  if (state.phase == Phase::failed) {
    if (builder_stopped_) {
      tell(fmt::format("stopped; what was done is kept in {}, and {} goes on from there", builder_->output().string(),
                       key_of("store")));
    } else {
      note(fmt::format("the store could not be built: {}", state.error));
    }
    builder_.reset();
    return;
  }
  if (!placed_) return;
  builder_->follow(roamer_->walker()->position());
  // A path that is being replayed keeps its walker, and that its space.
  if (state.phase != Phase::done || (replay_ && !replay_->done())) return;
  BuildProcess::Built built = builder_->take();
  for (const std::string& sentence : built.notes) note(sentence);
  change_to(std::move(built.pager));
  builder_.reset();
}

/// From here on the body collides with what the store holds. It stays where it is.
void Session::change_to(std::shared_ptr<Pager> pager) {
  if (std::exchange(ghost_only_, false)) {
    roamer_->controls().rebind(all_keys_);
    stage_->hud().set_help(key_lines(roamer_->controls()));
  }
  auto before = std::exchange(pager_, std::move(pager));
  store_is_stale_ = false;
  roamer_->setSpace(pager_);
  take_sizes();
  status_.triangles = pager_->store().info().triangles;
  tell(fmt::format("the walls come from {} now", pager_->store().name()));
  std::shared_ptr<const World> world;
  if (loaded_) {
    loaded_->pager.reset();
    world = std::exchange(loaded_->world, nullptr);
  }
  // To give gigabytes back takes longer than a frame, and so may the end of what a pager is reading.
  freeing_ = std::async(std::launch::async, [world = std::move(world), before = std::move(before)]() mutable {
    world.reset();
    before.reset();
  });
}

void Session::tell_of_failures(const PagerStats& paging) {
  if (paging.last_failure.empty() || paging.last_failure == failure_told_) return;
  if (now_ - failure_told_at_ < failure_period || notes_.size() > most_failures) return;
  failure_told_ = paging.last_failure;
  failure_told_at_ = now_;
  note(paging.last_failure + "; it is solid");
}

void Session::name_blockage(ViewReport& report) const {
  Blockage& blockage = *report.result->blocked_at;
  if (!pager_ || report.result->outcome == Outcome::held) {
    report.object = roamer_->space()->object_name(blockage.triangle);
    return;
  }
  try {
    const SourceTriangle source = pager_->store().source(blockage.triangle);
    report.object = source.object;
    blockage.triangle = source.scene;
  } catch (const Error& error) {
    report.notes.emplace_back(error.what());
  }
}

}  // namespace roam::app
