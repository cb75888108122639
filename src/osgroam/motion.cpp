// Motion of the body from frame to frame.
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <osg/Notify>
#include <utility>

#include "osgroam/manipulator_state.h"
#include "osgroam/places.h"

namespace osgRoam {
namespace {

/// Seconds for which a jump requested before landing stays valid.
constexpr double jump_patience = 0.2;

/// Part of a step by which a frame may seem longer, because times since a distant start are rounded. Enough for a day
/// at 60 Hz.
constexpr double clock_rounding = 1e-9;

/// Seconds. A pilot's step below this is only rounding.
constexpr double least_owed = 1e-6;

/// Most steps of a pilot in one frame, however short they are.
constexpr int pilot_limit = 256;

/// Processor time of this thread since its start, nanoseconds.
std::int64_t own_nanoseconds() {
  timespec used{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  return std::int64_t{used.tv_sec} * 1'000'000'000 + used.tv_nsec;
}

/// Adds the time of one step to those of a frame.
class StepTimer {
 public:
  StepTimer(std::int64_t& passed, std::int64_t& own)
      : passed_(passed), own_(own), begin_(Clock::now()), own_begin_(own_nanoseconds()) {}
  ~StepTimer() {
    own_ += own_nanoseconds() - own_begin_;
    passed_ += std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now() - begin_).count();
  }
  StepTimer(const StepTimer&) = delete;
  StepTimer& operator=(const StepTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  std::int64_t& passed_;
  std::int64_t& own_;
  Clock::time_point begin_;
  std::int64_t own_begin_;
};

}  // namespace

double EasedTurn::advance(double wanted, double seconds, double easing) {
  const double from = std::exchange(rate, wanted);
  if (!(easing > 0.0) || from == wanted) {
    pace = std::abs(wanted);
    return seconds * wanted;
  }
  pace = std::max({pace, std::abs(from), std::abs(wanted)});
  const double all = easing * std::abs(wanted / pace - from / pace), spent = std::min(seconds, all);
  const double share = spent < all ? spent / all : 1.0;
  rate = (1.0 - share) * from + share * wanted;
  return spent * (0.5 * from + 0.5 * rate) + (seconds - spent) * wanted;
}

roam::Vec3 Manipulator::State::eye() const { return walker ? soft.eye(*walker) : pose.eye; }

roam::Vec3 Manipulator::State::centre_under(const roam::Vec3& eye) const {
  return eye - roam::Vec3(0.0, 0.0, eye_height(settings, settings.height));
}

roam::Vec3 Manipulator::State::centre_above(const roam::Vec3& feet) const {
  return feet + roam::Vec3(0.0, 0.0, 0.5 * settings.height);
}

void Manipulator::State::fail(const std::string& what) {
  problem = what;
  stuck = true;
  pilot = nullptr;
  journey.end();
  OSG_WARN << "osgRoam::Manipulator: " << what << std::endl;
}

void Manipulator::State::tell_placed() {
  soft.reset();
  journey.end();
  problem.clear();
  stuck = false;
  jump_left = eased_speed = 0.0;
  turning_left = looking_up = {};
  if (walker) guarded([&] { call(on_step, walker->report(), 0.0); });
}

void Manipulator::State::change_space(std::shared_ptr<const roam::Space> to, Update update_of_it, bool is_built) {
  const roam::Vec3 centre = walker ? centre_above(walker->feet()) : centre_under(pose.eye);
  // A walker refers to its space by address, so the old space stays until the old walker is gone.
  const std::shared_ptr<const roam::Space> before = std::exchange(space, std::move(to));
  space_is_built = is_built;
  update = std::move(update_of_it);
  make_walker(centre);
  if (lands && walker) land();
}

void Manipulator::State::make_walker(const roam::Vec3& centre) {
  if (walker) pose.eye = soft.eye(*walker);
  walker.reset();
  ++walkers;
  soft.reset();
  journey.end();
  problem.clear();
  stuck = false;
  if (!space) return;
  guarded([&] {
    call(update, roam::Body::capsule(settings.radius, settings.height), centre, roam::Vec3(0.0));
    if (!space || walker) return;  // the callback has exchanged the space, and the body with it
    walker = std::make_unique<roam::Walker>(*space, settings, mode, centre);
    if (!regions.empty()) {
      walker->set_regions(regions);
      walker->place(centre);  // with the size of the region there
    }
    if (walker->held()) place_safely(*walker, centre);
    tell_placed();
  });
}

void Manipulator::State::put(const roam::Vec3& centre) {
  if (!walker) {
    if (space) make_walker(centre);  // a walker that failed before may work here
    return;
  }
  guarded([&] {
    call(update, roam::Body::capsule(settings.radius, settings.height), centre, roam::Vec3(0.0));
    if (!walker) return;  // the callback has removed the space
    place_safely(*walker, centre);
    tell_placed();
  });
}

void Manipulator::State::put_eye(const CameraPose& where) {
  pose = where;
  at_computed_home = lands = false;
  put(centre_under(where.eye));
}

void Manipulator::State::land() {
  lands = !walker;
  if (!walker || mode != roam::Mode::walk || walker->report().met_unknown) return;
  guarded([&] {
    if (!walker->held() && has_floor(*space, settings, walker->position())) return;
    if (const auto place = landing_place(*space, settings, eye(), forward(pose.yaw, pose.pitch))) {
      pose.pitch = 0.0;
      put(*place);
    }
  });
}

void Manipulator::State::change_mode(roam::Mode to) {
  if (to == roam::Mode::ghost && mode != roam::Mode::ghost) before_ghost = mode;
  mode = to;
  journey.end();
  if (!walker) return;
  guarded([&] {
    if (walker->set_mode(to).held && !walker->report().met_unknown) place_safely(*walker, walker->position());
    tell_placed();
  });
}

void Manipulator::State::change_speed(double to) { settings.speed = std::clamp(to, least_speed, greatest_speed); }

bool Manipulator::State::take_build() {
  if (!build || !build->ready()) return false;
  const std::unique_ptr<BackgroundBuild> done = std::move(build);
  bool taken = false;
  guarded([&] {
    change_space(done->take(), nullptr, true);
    taken = true;
  });
  return taken;
}

void Manipulator::State::frame(double time) {
  nanoseconds = own_ns = 0;
  steps = 0;
  moved = false;
  const std::vector<Keyboard::Change> changes = keyboard.take_changes();
  if (!last_time || !std::isfinite(time)) {
    if (std::isfinite(time)) last_time = time;
    // A body in the air falls, which only the next frame finds out.
    moved = last_time.has_value();
    held_before = keyboard.held();
    return;
  }
  const double begin = std::max(*last_time, time - longest_frame);
  last_time = time;
  turn(time - begin);
  guarded([&] {
    if (walker && !stuck) {
      // The callback may replace the walker, so copy its values.
      const roam::Vec3 place = walker->position(), velocity = walker->velocity();
      call(update, walker->body(), place, velocity);
    }
    double at = begin;
    for (const Keyboard::Change& change : changes) {
      const double until = std::clamp(change.time, at, std::max(at, time));
      run(until - at, held_before);
      at = until;
      held_before = change.held;
      if (change.jump) jump_left = jump_patience;
    }
    run(time - at, held_before);
    if (walker) soft.keep_free(*walker);
  });
  held_before = keyboard.held();
}

void Manipulator::State::turn(double seconds) {
  if (!(seconds > 0.0)) return;
  pose.yaw = wrapped_yaw(pose.yaw + turning_left.advance(axes.turn_left, seconds, easing));
  pose.pitch = limited_pitch(pose.pitch + looking_up.advance(axes.look_up, seconds, easing));
}

bool Manipulator::State::moves(const HeldCommands& held) const {
  return held.move() || axes.forward != 0.0 || axes.right != 0.0 || axes.up != 0.0;
}

void Manipulator::State::run(double seconds, const HeldCommands& held) {
  if (!(seconds > 0.0)) return;
  const double pieces = std::ceil(seconds / longest_step - clock_rounding);
  for (double i = 0.0; i < pieces && walker && !stuck; ++i) {
    if (pilot) {
      fly_pilot(seconds / pieces);
    } else {
      step(seconds / pieces, held);
    }
  }
}

void Manipulator::State::step(double seconds, const HeldCommands& held) {
  const bool jumps = jump_left > 0.0;
  jump_left -= seconds;
  if (moves(held) || jumps) {
    journey.end();
    at_computed_home = false;
  }
  roam::WalkerInput input;
  input.crouch = held.crouch || axes.crouch;
  input.jump = jumps;
  if (journey.under_way()) {
    input.velocity = journey.velocity(*walker, settings.speed * settings.fast_factor, seconds);
    eased_speed = 0.0;
  } else {
    input.velocity = wish(held);
    ease(input, held);
  }

  const SoftEye::Before before = SoftEye::before(*walker);
  const roam::StepReport& report = [&]() -> const roam::StepReport& {
    const StepTimer timer(nanoseconds, own_ns);
    return walker->step(input, seconds);
  }();
  ++steps;
  if (report.has(roam::EventKind::jumped)) jump_left = 0.0;
  moved |= !report.segments.empty();
  soft.follow(*walker, before, seconds);
  call(on_step, report, seconds);
}

void Manipulator::State::go(const roam::Vec3& point, const roam::Vec3& normal) {
  at_computed_home = false;
  journey.begin(*walker, point, normal);
}

void Manipulator::State::fly_pilot(double seconds) {
  owed += seconds;
  for (int count = 0; count < pilot_limit && pilot && walker && owed > least_owed; ++count) {
    const double asked = std::min(owed, longest_step);
    const SoftEye::Before before = SoftEye::before(*walker);
    const Pilot now = pilot;  // it may end or replace itself while it runs, or change the body
    const unsigned number = pilots, flown = walkers;
    const roam::StepReport* report = [&] {
      const StepTimer timer(nanoseconds, own_ns);
      return now(*walker, asked);
    }();
    if (!report) {
      if (number == pilots) pilot = nullptr;
      break;
    }
    if (walkers != flown) {  // the report ended with the walker
      owed -= asked;
      continue;
    }
    ++steps;
    moved = true;
    at_computed_home = false;
    const double simulated = report->elapsed > 0.0 ? report->elapsed : asked;
    owed -= simulated;
    soft.follow(*walker, before, simulated);
    call(on_step, *report, simulated);
  }
}

roam::Vec3 Manipulator::State::wish(const HeldCommands& held) const {
  const auto axis = [](bool plus, bool minus, double more) {
    return static_cast<double>(plus) - static_cast<double>(minus) + more;
  };
  const double pitch = mode == roam::Mode::walk ? 0.0 : pose.pitch;
  const roam::Vec3 direction = axis(held.forward, held.back, axes.forward) * forward(pose.yaw, pitch) +
                               axis(held.right, held.left, axes.right) * right(pose.yaw) +
                               roam::Vec3(0.0, 0.0, axis(held.up, held.down, axes.up));
  const double factor = held.slow || axes.slow ? slow_factor : 1.0;
  return roam::wish_velocity(settings, direction, held.fast || axes.fast) * factor;
}

void Manipulator::State::ease(roam::WalkerInput& input, const HeldCommands& held) {
  if (moves(held)) eased_speed = std::max(glm::length(input.velocity), glm::length(walker->pace()));
  if (easing > 0.0 && eased_speed > 0.0) input.acceleration = input.braking = eased_speed / easing;
}

bool Manipulator::State::restless() const {
  if (build) return true;
  if (!walker || stuck) return false;
  return moved || moves(keyboard.held()) || axes.turn_left != 0.0 || axes.look_up != 0.0 || turning_left.rate != 0.0 ||
         looking_up.rate != 0.0 || journey.under_way() || pilot || soft.moving() || jump_left > 0.0 ||
         walker->report().met_unknown;
}

}  // namespace osgRoam
