#include "view/arrival.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "cli/interrupt.h"
#include "cli/tell.h"
#include "measure/slope.h"
#include "roam/error.h"
#include "scenes/frame.h"
#include "text/web_address.h"
#include "view/body.h"
#include "view/commands.h"
#include "words/frame.h"

namespace roam::app {
namespace {

constexpr double reach_of_light = 30.0;    // m: walls and roofs that decide how light a picture is
constexpr double failure_period = 10.0;    // s: minimum between two notes of failed tiles
constexpr std::size_t most_failures = 20;  // named in the report

CollisionWish wish_for(const ViewOptions& options, const ViewPlan& plan, std::uint64_t store_memory) {
  CollisionWish wish;
  wish.keep_meshes = options.verify;
  if (plan.at) {
    wish.place = plan.at->position;
  } else if (!plan.path.empty()) {
    wish.place = plan.path.front().position;
  }
  wish.memory = store_memory;
  wish.walker = plan.walker;
  wish.mode = plan.mode;
  wish.patient = options.headless;
  return wish;
}

/// "-z is up, as you chose", if the profile keeps a frame; else empty.
std::string kept_text(const SceneOptions& scene) {
  const std::optional<SceneFrame> frame = scene.frame_file.empty() ? std::nullopt : frame_of(scene);
  if (!frame) return {};
  const std::string unit = frame->unit == LengthUnit::m ? "" : fmt::format(", {} is the unit", to_string(frame->unit));
  return fmt::format("{} is up{}, as you chose", to_string(frame->up), unit);
}

}  // namespace

Arrival::Arrival(const ViewOptions& options, const ViewPlan& plan, const SceneAndStore& what,
                 osgRoam::Manipulator& roamer, News& news)
    : plan_(plan),
      scene_names_(what.scene.names()),
      kept_(plan.note.empty() ? kept_text(what.scene) : std::string()),
      unit_is_chosen_(!what.scene.unit.empty()),
      needs_collision_(!options.path.empty() || options.verify),
      roamer_(roamer),
      news_(news),
      loader_(what, wish_for(options, plan, what.store_memory)) {}

bool Arrival::receive(const Seen& seen) {
  const LoadState state = loader_.state();
  if (!is_over(state)) return false;
  const bool failed = state.phase == LoadState::Phase::failed;
  if (failed && seen.state.phase == LoadState::Phase::failed) throw Error(seen.state.error);
  // The first piece fixes the graph's origin. Without any piece, collision and eye need not match a graph.
  if (!seen.has_pieces && !is_over(seen.state)) return false;
  roamer_.setOrigin({seen.origin.x, seen.origin.y, seen.origin.z});
  if (failed) {
    place_ghost(seen, state.error);
    return true;
  }
  loaded_ = loader_.take();
  loaded_->world = Freeing::later(freeing_, std::move(loaded_->world));
  loaded_->pager = Freeing::later(freeing_, std::move(loaded_->pager));
  if (plan_.profile) {
    demand_belongs(*plan_.profile, loaded_->identity, scene_names_);
    app::tell(describe(*plan_.profile));
  }
  Mode mode = plan_.mode;
  if (loaded_->start) {
    start_ = loaded_->start->pose;
    mode = loaded_->start->mode;
    if (mode == Mode::ghost && plan_.mode != Mode::ghost) {
      // Before a small scene a key leads past it within a second, not within a frame.
      const Box box = loaded_->pager ? loaded_->pager->bounds() : loaded_->world->bounds();
      roamer_.setSpeed(std::min(roamer_.speed(), glm::length(box.size())));
    }
    if (!loaded_->start->note.empty()) news_.note_first(loaded_->start->note);
  } else {
    start_ = plan_.at ? *plan_.at : Pose{plan_.path.front().position, 0.0, 0.0};
  }
  note_frame();
  roamer_.setMode(mode);
  pager_ = loaded_->pager;
  if (pager_) {
    roamer_.setSpace(pager_);
  } else {
    roamer_.setSpace(std::shared_ptr<const Space>(loaded_->world));
  }
  return true;
}

/// Notes what the file states about its frame, and what its geometry makes likely, with the keys that apply it.
void Arrival::note_frame() {
  const auto remedy = [&](const char* command, const char* effect) {
    const std::string key = key_of(roamer_.controls(), command);
    return key.empty() ? key : fmt::format("{} {}", key, effect);
  };
  const std::string turns = remedy("turn", "turns it");
  for (const std::string& note : loaded_->report.notes) {
    const bool of_unit = note.find("--unit ") != std::string::npos;
    if (of_unit && stated_unit()) news_.note_first(note, remedy("unit", "applies it"));
    if (of_unit || note.find("--up=") == std::string::npos) continue;
    // A person who sees the scene upright needs no note of the file's axis.
    if (loaded_->is_upright) {
      news_.keep_for_report(note);
    } else {
      news_.note_first(note, turns);
    }
  }
  if (const auto up = loaded_->likely_up) news_.note_first(words::likely_up(scene_names_, *up), turns);
  if (loaded_->doubted_ceilings) {
    news_.note_first(words::high_ceilings(scene_names_, *loaded_->doubted_ceilings),
                     remedy("unit", "applies the next unit"));
  }
  if (!kept_.empty()) news_.tell(turns.empty() ? kept_ : kept_ + "; " + key_of(roamer_.controls(), "turn") + " turns");
}

void Arrival::place_ghost(const Seen& seen, const Error& why) {
  if (needs_collision_) {
    throw Error::at(why.where(),
                    fmt::format("the collision could not be loaded: {}{}", why.what(),
                                loader_.wants_store() ? "; a store of it (roam build) takes little memory" : ""));
  }
  news_.note(fmt::format("the collision could not be loaded, so walls are passed through: {}", why.what()));
  collision_keys_ = roamer_.controls().text();
  roamer_.controls().rebind("gravity =\nghost =");
  roamer_.setMode(Mode::ghost);
  roamer_.setSpace(std::make_shared<const World>());
  start_ = plan_.at.value_or(seen.overview);
}

void Arrival::enter() {
  go_to(roamer_, *start_);
  tell_where_put();
  const WalkerSettings& body = roamer_.settings();
  roamer_.setHomePose(start_->position + Vec3(0.0, 0.0, body.eye - 0.5 * body.height), glm::radians(start_->yaw),
                      glm::radians(start_->pitch));
  placed_ = true;
}

/// Says that the body begins elsewhere because it does not fit at the position of --at.
void Arrival::tell_where_put() {
  if (!plan_.at || is_ghost_only() || roamer_.walker() == nullptr || roamer_.held()) return;
  const Vec3& at = plan_.at->position;
  const double apart = glm::distance(standing_pose_of(roamer_).position, at);
  if (apart < 0.5 * roamer_.settings().radius) return;
  news_.note(fmt::format("The body does not fit at {:.2f}, {:.2f}, {:.2f}: it begins {:.2f} m away.", at.x, at.y, at.z,
                         apart));
}

void Arrival::change_to(std::shared_ptr<Pager> pager) {
  if (is_ghost_only()) roamer_.controls().rebind(std::exchange(collision_keys_, {}));
  around_.reset();
  pager_ = Freeing::later(freeing_, std::move(pager));
  roamer_.setSpace(pager_);
  news_.tell(fmt::format("the walls come from {} now", pager_->store().name()));
  if (!loaded_) return;
  loaded_->pager.reset();
  loaded_->world.reset();
}

void Arrival::wait_for_tiles(double seconds) {
  const Walker& walker = *roamer_.walker();
  if (!pager_) return;
  if (!around_) around_.emplace(*pager_, [] { return !interrupted(); });
  const double pace = std::max(plan_.walker.speed, roamer_.speed());
  const double reach = std::max(reach_of_light, pace * (TilesAround::ahead + seconds));
  around_->wait(walker.body(), walker.position(), walker.velocity(), reach);
}

void Arrival::watch_footing(const StepReport& report, double seconds) {
  const Walker& walker = *roamer_.walker();
  if (walker.mode() != Mode::walk || roamer_.piloted()) return;
  if (report.put_back) {
    without_ground_ = walker.held();
  } else if (seconds <= 0.0 && !walker.held()) {
    without_ground_ = !report.grounded && !is_ground_below();
  } else if (report.grounded) {
    without_ground_ = false;
  }
}

/// Whether a body that falls from here lands on something.
bool Arrival::is_ground_below() const {
  const Walker& walker = *roamer_.walker();
  const Box box = walker.space().bounds();
  if (box.empty()) return false;
  const double drop = std::min(walker.position().z - box.lower.z + walker.settings().height, Space::motion_limit);
  return drop > 0.0 && walker.space().first_impact(walker.body(), walker.position(), {0.0, 0.0, -drop}).hit;
}

void Arrival::fly_without_ground() {
  if (!std::exchange(without_ground_, false)) return;
  roamer_.setMode(Mode::fly);
  const std::string key = key_of(roamer_.controls(), "gravity");
  news_.note("There is nothing below to stand on: flying." + (key.empty() ? key : " " + key + " walks again."));
}

void Arrival::note_failures(double now) {
  if (!pager_) return;
  const std::string failure = pager_->stats().last_failure;
  if (failure.empty() || failure == failure_told_) return;
  if (now - failure_told_at_ < failure_period || news_.notes().size() > most_failures) return;
  failure_told_ = failure;
  failure_told_at_ = now;
  news_.note(failure + "; it is solid");
}

std::uint64_t Arrival::triangles() const {
  return pager_ ? pager_->store().info().triangles : loaded_ ? loaded_->triangles : 0;
}

void Arrival::fill(Status& status) const {
  status.collision = loader_.state();
  status.triangles = triangles();
  if (pager_) {
    status.paging = pager_->stats();
    status.world_bytes = status.paging->memory;
    status.coming = coming_text(status.paging->wanted, web_host(pager_->store().name()));
  } else if (loaded_) {
    status.world_bytes = loaded_->world->stats().bytes;
  }
}

void Arrival::fill(ViewReport& report) {
  if (plan_.profile) report.profile = plan_.profile->file.string();
  report.settings = roamer_.settings();
  report.mode = roamer_.mode();
  report.roamed = placed_;
  if (placed_) {
    report.end = pose_of(roamer_);
    report.eye = roamer_.eye();
  }
  report.start = start_;
  if (pager_) {
    report.store = pager_->store().name();
    report.paging = pager_->stats();
  }
  if (report.result && report.result->blocked_at) name_blockage(report);
  if (placed_ && report.result && report.result->outcome == Outcome::fell) {
    const Body body = Body::capsule(report.settings.radius, report.settings.height);
    report.slope = measure::slope_below(*roamer_.space(), body, report.result->end);
  }
  if (!loaded_) return;
  append(report.notes, loaded_->report.notes);
  report.meshes = std::move(loaded_->meshes);
}

void Arrival::name_blockage(ViewReport& report) const {
  Blockage& blockage = *report.result->blocked_at;
  if (!pager_ || report.result->outcome == Outcome::held) {
    report.object = roamer_.space()->object_name(blockage.triangle);
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
