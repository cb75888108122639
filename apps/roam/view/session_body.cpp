// How the body comes into the scene, and what is watched of it there.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "cli/tell.h"
#include "roam/error.h"
#include "view/session.h"

namespace roam::app {
namespace {

using Phase = LoadState::Phase;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double status_period = 0.1;  // s: nobody reads faster
constexpr double speed_time = 0.2;     // s over which the speed that is told is a mean

bool is_over(const LoadState& state) { return state.phase == Phase::done || state.phase == Phase::failed; }

}  // namespace

void Session::receive_collision() {
  if (!is_over(status_.collision)) return;
  const bool failed = status_.collision.phase == Phase::failed;
  if (failed && status_.display.phase == Phase::failed) throw Error(status_.display.error);
  // The graph's origin is known with its first piece; without any, collision and eye have no graph to agree with.
  if (!scene_->has_pieces() && !is_over(status_.display)) return;
  const Vec3& origin = scene_->origin();
  roamer_->setOrigin({origin.x, origin.y, origin.z});
  if (failed) {
    place_ghost(status_.collision.error);
  } else {
    loaded_ = collision_->take();
    if (plan_.profile) {
      demand_belongs(*plan_.profile, loaded_->identity, options_.scene.names());
      app::tell(describe(*plan_.profile));
    }
    place();
  }
}

void Session::place() {
  Mode mode = plan_.mode;
  if (loaded_->start) {
    start_ = loaded_->start->pose;
    mode = loaded_->start->mode;
    if (!loaded_->start->note.empty()) note(loaded_->start->note);
  } else if (plan_.at) {
    start_ = plan_.at;
  } else {
    start_ = Pose{plan_.path.front().position, 0.0, 0.0};
  }
  roamer_->setMode(mode);
  status_.triangles = loaded_->triangles;
  if (loaded_->pager) {
    pager_ = loaded_->pager;
    roamer_->setSpace(pager_);
  } else {
    roamer_->setSpace(std::shared_ptr<const Space>(loaded_->world));
    status_.world_bytes = loaded_->world->stats().bytes;
  }
  begin_learning();
  enter();
  if (!plan_.path.empty()) begin_replay();
}

void Session::place_ghost(const std::string& why) {
  if (!options_.path.empty() || options_.verify) {
    throw Error(fmt::format("the collision could not be loaded: {}{}", why,
                            collision_->wants_store() ? "; a store of it (roam build) takes little memory" : ""));
  }
  note(fmt::format("the collision could not be loaded, so walls are passed through: {}", why));
  ghost_only_ = true;
  // An empty space has nothing to stand on.
  all_keys_ = roamer_->controls().text();
  roamer_->controls().rebind("gravity =\nghost =");
  stage_->hud().set_help(key_lines(roamer_->controls()));
  roamer_->setMode(Mode::ghost);
  roamer_->setSpace(std::make_shared<const World>());
  start_ = plan_.at ? *plan_.at : overview(scene_->bounds(), plan_.fov);
  enter();
}

void Session::enter() {
  go_to(*start_);
  tell_where_put();
  const WalkerSettings& body = roamer_->settings();
  roamer_->setHomePose(start_->position + Vec3(0.0, 0.0, body.eye - 0.5 * body.height), start_->yaw * degree,
                       start_->pitch * degree);
  placed_ = true;
  placed_at_ = now_;
  // The way that led here is none of the session's.
  roamer_->setStepCallback([this](const StepReport& report, double seconds) { step_taken(report, seconds); });
  if (plan_.path.empty()) step_taken(roamer_->report(), 0.0);
  cameras_->setNode(stage_->frame().root());
  stage_->viewer().setCameraManipulator(cameras_, false);
  if (!options_.record_path.empty()) {
    recorder_.emplace(options_.record_path, roamer_->settings(), roamer_->mode());
  }
}

/// Somebody who asked for a place is told when the body does not fit there and begins elsewhere.
void Session::tell_where_put() {
  if (!plan_.at || ghost_only_ || roamer_->walker() == nullptr || roamer_->held()) return;
  const WalkerSettings& body = roamer_->settings();
  // Whoever crouches has the feet where they would be otherwise.
  const Vec3 asked = plan_.at->position - Vec3(0.0, 0.0, 0.5 * body.height);
  const double apart = glm::distance(roamer_->walker()->feet(), asked);
  if (apart < 0.5 * body.radius) return;
  const Vec3& at = plan_.at->position;
  note(fmt::format("The body does not fit at {:.2f}, {:.2f}, {:.2f}: it begins {:.2f} m away.", at.x, at.y, at.z,
                   apart));
}

void Session::begin_replay() {
  RouteOptions route;
  route.speed = plan_.walker.speed;
  route.dt = options_.dt;
  replay_.emplace(*roamer_->walker(), plan_.path, route);
  // The pilot first: whether there is something to stand on is the path's to find out, as in `roam walk`.
  roamer_->setPilot([this](Walker&, double) { return replay_->advance(); });
  roamer_->placed();
  look_along_path(0.0);
}

void Session::look_along_path(double seconds) {
  if (replay_->done()) return;
  const Replay::Gaze gaze = replay_->gaze(seconds);
  roamer_->look(gaze.yaw, gaze.pitch);
}

void Session::step_taken(const StepReport& report, double seconds) {
  log_.take(report, roamer_->mode(), seconds);
  if (report.elapsed > 0.0) {
    const double share = std::min(1.0, report.elapsed / speed_time);
    speed_ += share * (glm::distance(report.from, report.to) / report.elapsed - speed_);
  } else {
    speed_ = 0.0;
  }
  if (roamer_->walker() == nullptr) return;
  hold_.take(*roamer_->walker(), wish(), report.elapsed, status_.paging && status_.paging->failed > 0);
  if (learning_) learning_->watch(*roamer_->walker(), wish(), report.elapsed);
  watch_footing(report, seconds);
}

/// A person who falls out of the scene is put back; one who has nowhere to stand there is held, and flies instead.
void Session::watch_footing(const StepReport& report, double seconds) {
  const Walker& walker = *roamer_->walker();
  if (walker.mode() != Mode::walk || roamer_->piloted()) return;
  if (report.put_back) {
    without_ground_ = walker.held();
  } else if (seconds <= 0.0 && !walker.held()) {
    without_ground_ = !report.grounded && !ground_below();
  } else if (report.grounded) {
    without_ground_ = false;
  }
}

/// Whether a body that falls from here comes down on something.
bool Session::ground_below() const {
  const Walker& walker = *roamer_->walker();
  const Box box = walker.space().bounds();
  if (box.empty()) return false;
  const double drop = walker.position().z - box.lower.z + walker.settings().height;
  return drop > 0.0 && walker.space().sweep(walker.body(), walker.position(), {0.0, 0.0, -drop}).hit;
}

void Session::fly_without_ground() {
  if (!std::exchange(without_ground_, false)) return;
  roamer_->setMode(Mode::fly);
  const std::string key = key_of("gravity");
  note("There is nothing below to stand on: flying." + (key.empty() ? key : " " + key + " walks again."));
}

/// Where the person, or the path, would have the body go, m/s; the length is only roughly right.
Vec3 Session::wish() const {
  if (replay_ && !replay_->left()) {
    const std::size_t next = std::min(replay_->result().waypoints, plan_.path.size() - 1);
    const Vec3 way = plan_.path[next].position - roamer_->walker()->position();
    const double length = glm::length(way);
    return length > 0.0 ? plan_.walker.speed / length * way : Vec3(0.0);
  }
  const double yaw = roamer_->yaw();
  const double pitch = roamer_->mode() == Mode::walk ? 0.0 : roamer_->pitch();
  const Vec3 ahead(std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch));
  const Vec3 right(std::sin(yaw), -std::cos(yaw), 0.0);
  const auto sign = [&](const char* plus, const char* minus) {
    return (roamer_->down(plus) ? 1.0 : 0.0) - (roamer_->down(minus) ? 1.0 : 0.0);
  };
  Vec3 direction = sign("forward", "back") * ahead + sign("right", "left") * right;
  if (roamer_->mode() != Mode::walk) direction.z += sign("up", "down");
  if (roamer_->going()) direction = ahead;
  const double length = glm::length(direction);
  return length > 0.0 ? roamer_->speed() / length * direction : Vec3(0.0);
}

void Session::go_to(const Pose& pose) {
  roamer_->setFeet(pose.position - Vec3(0.0, 0.0, 0.5 * roamer_->settings().height), pose.yaw * degree,
                   pose.pitch * degree);
}

Pose Session::pose() const {
  return {roamer_->walker()->position(), roamer_->yaw() / degree, roamer_->pitch() / degree};
}

bool Session::roamer_leads() const { return placed_ && cameras_->getCurrentMatrixManipulator() == roamer_.get(); }

void Session::update_status(bool at_once) {
  if (!at_once && now_ - status_at_ < status_period && status_at_ >= 0.0) return;
  status_at_ = now_;
  Status& s = status_;
  s.display = scene_->state();
  s.collision = collision_->state();
  s.resident = resident_bytes();
  s.frame_ms = stage_->last_frame_ms();
  std::erase_if(news_, [&](const News& news) { return news.until < now_; });
  s.news.clear();
  for (const News& news : news_) s.news.push_back(news.told);
  if (!roamer_->problem().empty()) s.news.push_back({roamer_->problem(), true});
  s.recording.clear();
  s.paging.reset();
  if (pager_) {
    s.paging = pager_->stats();
    s.world_bytes = s.paging->memory;
    tell_of_failures(*s.paging);
  }
  s.building.reset();
  if (builder_) s.building = builder_->state();
  s.store_key = store_offered_ && !pager_ ? key_of("store") : std::string();
  if (recorder_) s.recording = fmt::format("{:.0f} s", recorder_->seconds());
  if (placed_) {
    const Walker& walker = *roamer_->walker();
    s.mode = roamer_->mode();
    s.body = walker.settings();
    s.size_reason = size_reason(walker);
    s.crouched = walker.crouched();
    s.grounded = walker.grounded();
    const Pose at = pose();
    s.place = at.position;
    s.yaw = at.yaw;
    s.pitch = at.pitch;
    s.pace = roamer_->speed();
    s.speed = speed_;
    s.collision_us = static_cast<double>(roamer_->collisionNanoseconds()) * 1e-3;
    s.camera = roamer_leads() ? std::string() : camera_name();
    s.hold = hold_.told();
    if (const std::string offer = learning_ ? learning_->offer(key_of("adapt")) : std::string(); !offer.empty()) {
      s.hold.text += (s.hold.text.empty() ? "" : "\n") + offer;
    }
  }
  stage_->show(s);
}

}  // namespace roam::app
