#include "roam/route.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "math/finite.h"
#include "math/floating_point.h"
#include "motion/demand.h"
#include "motion/event_filter.h"
#include "motion/pace.h"
#include "motion/vain_steps.h"
#include "roam/error.h"
#include "roam/opening.h"
#include "text/names.h"
#include "text/number.h"

namespace roam {
namespace {

/// Part of the way that free motion would cover during the time of patience; see RouteOptions::patience.
constexpr double progress_part = 0.05;
constexpr std::uint64_t least_patience_steps = 8;

/// Metres. A body this close to a waypoint is at it. Ten times the rounding of coordinates at 6.4e6 m.
constexpr double at_waypoint = 1e-8;

/// Metres above the feet. A waypoint of a tall person's path may be this high and still count for a low body that sees
/// it.
constexpr double tall_person = 2.0;

/// Cosine of a turn of less than half a degree, for which a limited body does not slow down.
constexpr double straight_on = 0.99997;

/// Whether a body is in a box, or at most its own size outside.
bool inside(const Vec3& p, const Box& box, const Body& body) {
  return box.grown(Vec3(2.0 * body.radius, 2.0 * body.radius, body.height())).holds(p);
}

bool above_or_below(const Vec3& p, const Box& box) {
  return p.x >= box.lower.x && p.x <= box.upper.x && p.y >= box.lower.y && p.y <= box.upper.y;
}

/// From the body to the waypoint; for walking without the height.
Vec3 way_to(const Vec3& waypoint, const Walker& walker) {
  Vec3 way = waypoint - walker.position();
  if (walker.mode() == Mode::walk) way.z = 0.0;
  return way;
}

/// Whether only the space's speed limit, and no contact, keeps the body from going on.
bool waits_for_space(const Vec3& way, const StepReport& report) {
  const Contact* c = most_against(report, way);
  return report.has(EventKind::slowed) &&
         (c == nullptr || glm::dot(c->normal, way) >= -progress_part * glm::length(way));
}

bool counts_as_reached(const Vec3& waypoint, const Walker& walker) {
  const Body body = walker.body();
  const Vec3 way = waypoint - walker.position();
  const double beside = glm::length(Vec3(way.x, way.y, 0.0));
  if (walker.mode() == Mode::walk) {
    if (beside > body.radius) return false;
    if (std::abs(way.z) <= 0.5 * body.height() + walker.settings().step) return true;
    return way.z > 0.0 && way.z + 0.5 * body.height() <= tall_person &&
           !walker.space().first_impact({0.0, 0.0}, walker.position(), way).hit;
  }
  const double above = std::max(0.0, std::abs(way.z) - body.half_height);
  return beside * beside + above * above <= body.radius * body.radius;
}

}  // namespace

void check(const RouteOptions& options, std::span<const Vec3> waypoints, const Walker& walker) {
  constexpr const char* whose = "the route's";
  demand(whose, "speed", options.speed, "m/s", {0.0, Route::highest_speed, true});
  demand(whose, "time step", options.dt, "s", positive);
  if (options.dt < Route::shortest_step) {
    throw Error("the route's time step is shorter than a microsecond; it would take for ever");
  }
  demand(whose, "patience", options.patience, "s", positive);
  if (!(options.acceleration > 0.0 && options.braking > 0.0)) {
    throw Error("the route accelerates by at most " + number_text(options.acceleration) +
                " m/s^2 and brakes by at most " + number_text(options.braking) + " m/s^2; both must be more than 0");
  }
  if (!(options.wait >= 0.0) || !std::isfinite(options.wait)) {
    throw Error("the route's longest wait is " + number_text(options.wait) + " s; it must be at least 0");
  }
  if (waypoints.empty()) throw Error("the route has no waypoint; give at least the place to start from");
  for (std::size_t i = 0; i < waypoints.size(); ++i) {
    if (!is_within_limit(waypoints[i])) {
      throw Error("waypoint " + std::to_string(i + 1) + " of the route is not a point within 1e9 m of the origin");
    }
  }
  if (walker.mode() == Mode::ghost) throw Error("a ghost meets nothing; follow a route in fly or walk mode");
}

const char* to_string(Outcome outcome) {
  return name_in({"reached", "blocked", "left_scene", "fell", "held"}, outcome);
}

class Route::State {
 public:
  State(Walker& walker, std::span<const Vec3> waypoints, const RouteOptions& options);
  const StepReport& advance();
  void start_window();

  RouteResult result;
  bool done = false;

 private:
  [[nodiscard]] bool limited() const;
  [[nodiscard]] double until_rest(const Vec3& way) const;
  [[nodiscard]] Box scene() const { return options_.scene ? *options_.scene : walker_->space().bounds(); }
  void turn_to_next(bool hindered);
  void judge(const StepReport& report, double distance_before, double free_way);
  [[nodiscard]] bool gets_on() const;
  void describe_blockage(const StepReport& report);
  void finish(Outcome outcome);

  Walker* walker_;
  std::vector<Vec3> waypoints_;
  RouteOptions options_;
  bool coming_down_ = false;  ///< to the ground, before it goes anywhere
  bool inside_ = false;       ///< has been in the box of the scene
  std::size_t next_ = 1;
  double window_best_ = 0.0;  ///< distance to the waypoint when the window of patience began
  Vec3 window_from_{0.0};     ///< where the body was then
  double window_time_ = 0.0;  ///< since then
  double window_free_ = 0.0;  ///< the way that free motion would have brought since
  std::uint64_t window_steps_ = 0;
  std::uint64_t vain_steps_ = 0;  ///< see is_vain_again
  EventFilter filter_;
};

Route::State::State(Walker& walker, std::span<const Vec3> waypoints, const RouteOptions& options)
    : walker_(&walker), waypoints_(waypoints.begin(), waypoints.end()), options_(options) {
  const DefaultFloatingPoint guard;
  check(options, waypoints, walker);
  const StepReport& start = walker.place(waypoints_[0]);
  result.add_placement(start);
  result.waypoints = 1;
  result.end = walker.position();
  inside_ = inside(result.end, scene(), walker.body());
  filter_.append(result.events, 0, start);
  start_window();
  coming_down_ = walker.mode() == Mode::walk && !walker.stance().level && walker.settings().gravity > 0.0;
  if (walker.held()) {
    finish(Outcome::held);
  } else if (next_ == waypoints_.size()) {
    finish(Outcome::reached);
  }
}

void Route::State::start_window() {
  window_best_ = next_ < waypoints_.size() ? glm::length(way_to(waypoints_[next_], *walker_)) : 0.0;
  window_from_ = walker_->position();
  window_time_ = window_free_ = 0.0;
  window_steps_ = 0;
}

void Route::State::turn_to_next(bool hindered) {
  while (next_ < waypoints_.size()) {
    const Vec3& goal = waypoints_[next_];
    if (!counts_as_reached(goal, *walker_)) return;
    if (!hindered && glm::length(way_to(goal, *walker_)) > at_waypoint) return;
    ++next_;
    ++result.waypoints;
    start_window();
    hindered = false;
  }
  finish(Outcome::reached);
}

bool Route::State::limited() const {
  return walking::limits({.acceleration = options_.acceleration, .braking = options_.braking});
}

/// Metres to where the body must be at rest, if the next waypoint is `way` off. Not computed farther than the braking
/// distance.
double Route::State::until_rest(const Vec3& way) const {
  const double enough = options_.speed * options_.dt + 0.5 * options_.speed * options_.speed / options_.braking;
  double sum = glm::length(way);
  Vec3 before = way / sum;
  for (std::size_t i = next_; i + 1 < waypoints_.size() && sum <= enough; ++i) {
    Vec3 leg = waypoints_[i + 1] - waypoints_[i];
    if (walker_->mode() == Mode::walk) leg.z = 0.0;
    const double length = glm::length(leg);
    if (!(length > 0.0)) continue;
    if (glm::dot(leg, before) < straight_on * length) break;
    before = leg / length;
    sum += length;
  }
  return sum;
}

const StepReport& Route::State::advance() {
  const DefaultFloatingPoint guard;
  if (done)
    throw Error("the route has ended (" + std::string(to_string(result.outcome)) + "): call done() before each step");
  const Vec3 way = way_to(waypoints_[next_], *walker_);
  const double distance = glm::length(way);
  double dt = options_.dt, planned = 0.0;
  WalkerInput input{.acceleration = options_.acceleration, .braking = options_.braking};
  if (distance > at_waypoint && !coming_down_) {
    if (limited()) {
      const Vec3 ahead = way / distance;
      const double speed = std::max(0.0, glm::dot(walker_->pace(), ahead));
      const auto step = walking::approach(speed, options_.speed, distance, until_rest(way), dt, input);
      dt = std::max(step.seconds, shortest_step);
      input.velocity = ahead * step.speed;
      planned = step.way;
    } else {
      dt = std::min(dt, distance / options_.speed);
      input.velocity = way * (std::min(options_.speed, distance / dt) / distance);
    }
  }
  const StepReport& report = walker_->step(input, dt);
  result.add_step(report);
  result.end = walker_->position();
  filter_.append(result.events, result.steps, report);
  judge(report, distance, limited() ? planned : options_.speed * report.elapsed);
  return report;
}

void Route::State::judge(const StepReport& report, double distance_before, double free_way) {
  const Box scene = this->scene();
  const bool is_vain = is_vain_again(report, vain_steps_);
  if (report.has(EventKind::fell))
    return finish(above_or_below(report.to, scene) ? Outcome::fell : Outcome::left_scene);
  if (report.held) return finish(Outcome::held);
  if (report.put_back) return finish(walker_->stance().level ? Outcome::fell : Outcome::held);
  const bool inside_now = inside(report.to, scene, walker_->body());
  if (walker_->mode() == Mode::fly && inside_ && !inside_now) return finish(Outcome::left_scene);
  inside_ = inside_ || inside_now;
  if (coming_down_) {
    // Without ground the body may also be caught between slopes; then it goes on from there.
    coming_down_ = !walker_->stance().level && walker_->rise_speed() < 0.0;
    if (coming_down_ && (is_vain || result.simulated > longest_descent)) return finish(Outcome::held);
    start_window();
    return;
  }
  const double distance = glm::length(way_to(waypoints_[next_], *walker_));
  const bool nearer = distance_before - distance > progress_part * free_way;
  turn_to_next(!report.contacts.empty() || !nearer);
  if (done) return;
  window_time_ += report.elapsed;
  window_free_ += free_way;
  ++window_steps_;
  if (!is_vain && (window_time_ < options_.patience || window_steps_ < least_patience_steps)) return;
  if (is_vain || !gets_on()) {
    const Vec3 way = way_to(waypoints_[next_], *walker_);
    const Contact* c = most_against(report, way);
    const bool unknown = c != nullptr && c->unknown;
    describe_blockage(report);
    finish(unknown || waits_for_space(way, report) ? Outcome::held : Outcome::blocked);
  } else {
    start_window();
  }
}

/// Whether the body came nearer during the window, or slides along an obstacle.
bool Route::State::gets_on() const {
  const double least = progress_part * window_free_;
  const double nearer = window_best_ - glm::length(way_to(waypoints_[next_], *walker_));
  Vec3 moved = walker_->position() - window_from_;
  if (walker_->mode() == Mode::walk) moved.z = 0.0;
  // A slide that covers this part of free motion comes nearer by the square of that part.
  return nearer > least || (glm::length(moved) > least && nearer > progress_part * least);
}

void Route::State::describe_blockage(const StepReport& report) {
  const Vec3 way = way_to(waypoints_[next_], *walker_);
  const Contact* c = most_against(report, way);
  if (c == nullptr || waits_for_space(way, report)) return;
  Blockage blockage{*c, std::nullopt};
  const double length = glm::length(way);
  if (length > at_waypoint && !c->unknown) {
    if (const auto opening = measure_opening(*walker_, way / length)) blockage.opening = opening->width;
  }
  result.blocked_at = blockage;
}

void Route::State::finish(Outcome outcome) {
  result.outcome = outcome;
  done = true;
}

Route::Route(Walker& walker, std::span<const Vec3> waypoints, const RouteOptions& options)
    : state_(std::make_unique<State>(walker, waypoints, options)) {}
Route::~Route() = default;
Route::Route(const Route& other) : state_(std::make_unique<State>(*other.state_)) {}
Route::Route(Route&& other) noexcept = default;
Route& Route::operator=(const Route& other) { return *this = Route(other); }
Route& Route::operator=(Route&& other) noexcept = default;
bool Route::done() const { return state_->done; }
const StepReport& Route::advance() { return state_->advance(); }
const RouteResult& Route::result() const { return state_->result; }
void Route::start_window() { state_->start_window(); }

RouteResult follow(Walker& walker, std::span<const Vec3> waypoints, const RouteOptions& options) {
  Route route(walker, waypoints, options);
  while (!route.done()) route.advance();
  return route.result();
}

}  // namespace roam
