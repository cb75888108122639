#include "view/rereading.h"

#include <fmt/format.h>

#include <filesystem>

#include "roam/error.h"
#include "roam/profile.h"
#include "roam/world.h"
#include "scenes/frame.h"
#include "text/printable.h"
#include "view/body.h"
#include "view/patterns.h"

namespace roam::app {

SceneFrame next_unit(const SceneFrame& frame, std::optional<LengthUnit> stated) {
  if (stated) return {frame.up, *stated};
  const std::size_t next = (static_cast<std::size_t>(frame.unit) + 1) % length_unit_names.size();
  return {frame.up, static_cast<LengthUnit>(next)};
}

std::string go_on(ViewOptions& options, const NextSession& next, const ViewOptions& given) {
  options.bookmark.clear();
  options.at.clear();
  options.pass_hidden = next.passes;
  if (next.frame) {
    options.mode = given.mode;
    options.scene.up = to_string(next.frame->up);
    options.scene.unit = to_string(next.frame->unit);
    return fmt::format("read with {}{}{}", options_of(*next.frame), next.note.empty() ? "" : "; ", next.note);
  }
  const Vec3& place = next.at.position;
  options.at = {place.x, place.y, place.z, next.at.yaw, next.at.pitch};
  options.mode = next.mode;
  if (next.leave_out.empty()) {
    options.scene.ignore = given.scene.ignore;
    return "all objects are shown";
  }
  options.scene.ignore.push_back(next.leave_out);
  return fmt::format("left out: {}", printable(next.leave_out));
}

void keep_view(ViewPlan& plan, const NextSession& next) {
  plan.hidden = next.hidden;
  plan.hud = next.hud;
  plan.edges = next.edges;
  if (next.frame) return;
  plan.section = next.section;
  plan.walker.speed = next.speed;
}

void Rereading::add_to(Commands& commands) {
  commands.add("turn", [this] {
    read_with([this](const SceneFrame& frame) { return next_frame(frame, arrival_.likely_up()); });
  });
  commands.add("unit", [this] {
    read_with([this](const SceneFrame& frame) { return next_unit(frame, arrival_.stated_unit()); });
  });
  commands.add("leave_out", [this] { leave_out_ahead(); });
  commands.add("show_all", [this] { show_all(); });
}

/// Whether another session may follow this one. Says why not.
bool Rereading::is_possible() {
  const bool writes = !options_.trace.empty() || !options_.record.empty() || !options_.record_path.empty();
  if (!options_.path.empty() || options_.verify || writes || records_.is_recording()) {
    news_.tell("the scene is not read anew on a path, or while a trace, a film or a way is written");
    return false;
  }
  if (building_.is_building()) {
    news_.tell("the scene is not read anew while its store is built: stop that before, or wait");
    return false;
  }
  return true;
}

/// In another frame, which the profile keeps.
void Rereading::read_with(const std::function<SceneFrame(const SceneFrame&)>& changed) {
  const std::optional<SceneFrame> frame = frame_of(what_.scene);
  if (!what_.store.empty()) {
    news_.tell("a store keeps the frame in which it was built: change that of its scene, and build it again");
  } else if (!frame) {
    news_.tell("these scenes have different axes up, so no key changes them: give --up and --unit, or view one alone");
  } else if (is_possible()) {
    next_.emplace().frame = changed(*frame);
    if (what_.scene.no_profile) return;
    try {
      const std::filesystem::path file = profile_path(what_.scene.scenes);
      if (!save_frame(*next_->frame, file)) {
        next_.reset();
        news_.tell(
            fmt::format("{} has a body for the scene as it is: delete it, or view with --no-profile", file.string()));
      }
    } catch (const Error& error) {
      next_->note = fmt::format("the frame is not kept: {}", error.what());
    }
  }
}

void Rereading::leave_out_ahead() {
  const std::string& name = display_.shown().around.ahead;
  if (!arrival_.is_placed() || name.empty()) {
    news_.tell("no object with a name is in the middle of the picture");
  } else if (arrival_.pager() != nullptr) {
    news_.tell("a store keeps its objects: build one with --ignore to leave some out");
  } else if (const auto world = arrival_.world(); world != nullptr && world->stats().objects == 1) {
    news_.tell("the scene has only this object");
  } else if (is_possible()) {
    leave_out(pattern_of(name));
  }
}

void Rereading::show_all() {
  if (arrival_.is_placed() && is_possible()) leave_out({});
}

void Rereading::leave_out(const std::string& pattern) {
  next_.emplace();
  next_->leave_out = pattern;
  next_->at = standing_pose_of(roamer_);
  next_->mode = roamer_.mode();
}

}  // namespace roam::app
