// Walkers.
#include "c/walker.h"

#include <limits>

#include "c/query.h"
#include "c/structs.h"

namespace roam::c {
namespace {

WalkerSettings settings_of(const roam_walker_settings& s) {
  WalkerSettings settings;
  settings.radius = s.radius;
  settings.height = s.height;
  settings.eye = s.eye;
  settings.step = s.step;
  settings.slope_degrees = s.slope_degrees;
  settings.support_radius = s.support_radius;
  settings.gravity = s.gravity;
  settings.jump_height = s.jump_height;
  settings.crouch_height = s.crouch_height;
  settings.clearance_reach = s.clearance_reach;
  return settings;
}

roam_walker_settings settings_of(const WalkerSettings& s) {
  return {0,
          s.radius,
          s.height,
          s.eye,
          s.step,
          s.slope_degrees,
          s.support_radius,
          s.gravity,
          s.jump_height,
          s.crouch_height,
          s.clearance_reach};
}

int32_t number_of(Mode mode) { return mode == Mode::walk ? ROAM_WALK : mode == Mode::fly ? ROAM_FLY : ROAM_GHOST; }

roam_step step_of(const StepReport& report) {
  roam_step step{};
  step.from = c_of(report.from);
  step.to = c_of(report.to);
  step.radius = report.radius;
  step.height = report.height;
  step.gap = report.axis_clearance - report.radius;
  step.least_gap = report.least_gap;
  step.length = report.length();
  step.elapsed = report.elapsed;
  step.landing_speed = report.landing_speed;
  step.blocked_by = report.blocked && !report.contacts.empty() ? report.contacts.back().triangle : no_triangle;
  for (const Event& event : report.events) step.events |= 1u << static_cast<unsigned>(event.kind);
  step.grounded = report.grounded ? 1 : 0;
  step.blocked = report.blocked ? 1 : 0;
  step.held = report.held ? 1 : 0;
  step.unknown = report.met_unknown ? 1 : 0;
  return step;
}

/// Runs a call of a walker that makes a report.
template <class Call>
roam_status reported(roam_walker* walker, roam_step* step, const Call& call) {
  return guarded([&] {
    Walker& body = needed(walker, "the walker").walker;
    if (step != nullptr) check_room(step, "roam_step");
    const StepReport& report = call(body);
    if (step != nullptr) put(*step, step_of(report));
  });
}

}  // namespace

Mode mode_of(int32_t mode) {
  for (const Mode one : {Mode::walk, Mode::fly, Mode::ghost}) {
    if (number_of(one) == mode) return one;
  }
  throw Invalid("the mode is " + std::to_string(mode) + "; it must be ROAM_WALK, ROAM_FLY or ROAM_GHOST");
}

void apply_to(roam_walker_settings& settings, const Profile& profile) {
  put(settings, settings_of(apply(profile, settings_of(given(&settings, "roam_walker_settings")))));
}

}  // namespace roam::c

using namespace roam::c;

roam_status roam_walker_person(roam_walker_settings* settings, double radius, double height) {
  return guarded([&] {
    check_room(settings, "roam_walker_settings");
    const roam::WalkerSettings person = roam::WalkerSettings::person(radius, height);
    check(person);
    put(*settings, settings_of(person));
  });
}

roam_status roam_walker_create(const roam_space* space, const roam_walker_settings* settings, int32_t mode,
                               roam_vec3 start, roam_walker** walker) {
  return guarded([&] {
    const roam_space& in = needed(space, "the space");
    const roam_walker_settings body = given(settings, "roam_walker_settings");
    (void)needed(walker, "the address for the walker");
    *walker = new roam_walker{in, roam::Walker(*in.space, settings_of(body), mode_of(mode), cpp_of(start))};
  });
}

roam_status roam_walker_copy(const roam_walker* walker, roam_walker** copy) {
  return guarded([&] {
    (void)needed(copy, "the address for the walker");
    *copy = new roam_walker(needed(walker, "the walker"));
  });
}

void roam_walker_free(roam_walker* walker) { delete walker; }

roam_status roam_walker_step(roam_walker* walker, const roam_walker_input* input, double dt, roam_step* step) {
  return reported(walker, step, [&](roam::Walker& body) -> const roam::StepReport& {
    const roam_walker_input wish = given(input, "roam_walker_input");
    roam::WalkerInput how;
    how.velocity = cpp_of(wish.velocity);
    how.jump = wish.jump != 0;
    how.crouch = wish.crouch != 0;
    if (wish.acceleration != 0.0) how.acceleration = wish.acceleration;
    if (wish.braking != 0.0) how.braking = wish.braking;
    return body.step(how, dt);
  });
}

roam_status roam_walker_place(roam_walker* walker, roam_vec3 centre, roam_step* step) {
  return reported(walker, step,
                  [&](roam::Walker& body) -> const roam::StepReport& { return body.place(cpp_of(centre)); });
}

roam_status roam_walker_place_feet(roam_walker* walker, roam_vec3 feet, roam_step* step) {
  return reported(walker, step,
                  [&](roam::Walker& body) -> const roam::StepReport& { return body.place_feet(cpp_of(feet)); });
}

roam_status roam_walker_set_mode(roam_walker* walker, int32_t mode, roam_step* step) {
  return reported(walker, step,
                  [&](roam::Walker& body) -> const roam::StepReport& { return body.set_mode(mode_of(mode)); });
}

roam_status roam_walker_get_state(const roam_walker* walker, roam_walker_state* state) {
  return guarded([&] {
    const roam::Walker& body = needed(walker, "the walker").walker;
    check_room(state, "roam_walker_state");
    roam_walker_state now{};
    now.position = c_of(body.position());
    now.feet = c_of(body.feet());
    now.eye = c_of(body.eye());
    now.velocity = c_of(body.velocity());
    now.radius = body.body().radius;
    now.height = body.body().height();
    now.rise_speed = body.rise_speed();
    now.skin = body.skin();
    now.mode = number_of(body.mode());
    now.grounded = body.grounded() ? 1 : 0;
    now.crouched = body.crouched() ? 1 : 0;
    now.held = body.held() ? 1 : 0;
    put(*state, now);
  });
}

roam_status roam_walker_get_settings(const roam_walker* walker, roam_walker_settings* settings) {
  return guarded([&] {
    const roam::Walker& body = needed(walker, "the walker").walker;
    check_room(settings, "roam_walker_settings");
    put(*settings, settings_of(body.settings()));
  });
}

roam_status roam_walker_get_contacts(const roam_walker* walker, roam_contact* contacts, size_t capacity,
                                     size_t* count) {
  return guarded([&] {
    const auto& list = needed(walker, "the walker").walker.report().contacts;
    (void)needed(count, "the address for the number of contacts");
    if (capacity > 0) check_room(contacts, "roam_contact");
    put_contacts({list.begin(), std::min(capacity, list.size())}, contacts, count);
  });
}
