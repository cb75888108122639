#include "roam/wander.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_map>

#include "math/floating_point.h"
#include "motion/demand.h"
#include "motion/event_filter.h"
#include "motion/look_ahead.h"
#include "motion/vain_steps.h"
#include "roam/error.h"
#include "text/number.h"

namespace roam {

namespace {

using namespace wandering;

constexpr int headings = 16;
constexpr int most_strides = static_cast<int>(Wander::look_around / stride);
constexpr double cell_side = 1.0;  // m, a place that was visited
// A body that moves by less than this share of free motion in this time is stuck.
constexpr double stuck_share = 0.2;
constexpr double stuck_seconds = 0.5;
// However long it goes, it remembers no more: cells of some ten hours, then it begins anew.
constexpr std::size_t most_visits = 1 << 15;
constexpr std::ptrdiff_t most_events = 10'000, most_legs = 1'000;
constexpr double same_heading = 0.9;  // cosine
constexpr double held_limit = 2.0;    // s after which a body that cannot move is given up

}  // namespace

class Wander::State {
 public:
  State(Walker& walker, const WanderOptions& options);
  void look();
  const StepReport& advance();

  RouteResult result;
  bool done = false;

 private:
  struct Look {
    double way = 0.0;      ///< metres that are free
    double novelty = 0.0;  ///< of the cells along it
  };
  [[nodiscard]] Look probe(const Vec3& direction) const;
  [[nodiscard]] std::uint64_t cell(const Vec3& place) const;
  [[nodiscard]] bool is_barred(const Vec3& direction) const;
  void note(const StepReport& report);

  /// A way that failed.
  struct Leg {
    Vec3 from{0.0};
    Vec3 heading{0.0};
  };
  /// Whether one of `legs` began within `reach` metres of `place`, in about this direction.
  [[nodiscard]] static bool has_failed(const std::vector<Leg>& legs, const Vec3& place, const Vec3& direction,
                                       double reach);
  /// Adds the present way: from `place`, and from where it began, the body does not go the same way again.
  void give_up(std::vector<Leg>& legs, const Vec3& place) const;

  Walker* walker_;
  WanderOptions options_;
  std::unordered_map<std::uint64_t, std::uint32_t> visits_;  ///< of each cell
  std::uint64_t last_cell_ = 0;
  Vec3 heading_{0.0};             ///< unit; zero before the first look
  double way_left_ = 0.0;         ///< metres to go along heading_
  double window_seconds_ = 0.0;   ///< since getting on was last judged
  double window_length_ = 0.0;    ///< metres moved since
  double window_wish_ = 0.0;      ///< metres of free motion since, in a space that slows the body down
  bool hindered_ = false;         ///< since then, unknown space or an overlap has stopped it: that may pass
  std::uint64_t vain_steps_ = 0;  ///< see is_vain_again
  bool stuck_ = false;
  Vec3 leg_start_{0.0};
  std::vector<Leg> voids_;  ///< ways that ended in the void
  std::vector<Leg> vain_;   ///< ways that a look finds free, but where the body got stuck
  double held_seconds_ = 0.0;
  bool was_inside_ = false;  ///< has been in the box of the scene
  EventFilter filter_;
};

Wander::State::State(Walker& walker, const WanderOptions& options) : walker_(&walker), options_(options) {
  const DefaultFloatingPoint guard;
  constexpr const char* whose = "the wandering's";
  demand(whose, "speed", options.speed, "m/s", {0.0, Route::highest_speed, true});
  demand(whose, "time", options.seconds, "s", positive);
  if (!(options.dt >= Route::shortest_step && std::isfinite(options.dt)))
    throw Error("the wandering's time step is " + number_text(options.dt) + " s; it must be at least 1e-6 s");
  if (walker.mode() == Mode::ghost) throw Error("a ghost meets nothing that could turn it; wander in fly or walk mode");
  // Of a step before, only where it ended belongs to this walk.
  StepReport start = walker.report();
  if (start.elapsed > 0.0) {
    start.events.clear();
    start.elapsed = 0.0;
  } else {
    result.add_placement(start);
  }
  note(start);
}

std::uint64_t Wander::State::cell(const Vec3& place) const {
  constexpr std::uint64_t bits = 21;
  constexpr std::uint64_t mask = (1ull << bits) - 1;
  const Box& scene = walker_->space().bounds();
  const Vec3 local = scene.empty() ? place : place - scene.lower;
  std::uint64_t key = 0;
  for (int k = 0; k < 3; ++k) {
    key =
        key << bits | (static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(local[k] / cell_side))) & mask);
  }
  return key;
}

bool Wander::State::has_failed(const std::vector<Leg>& legs, const Vec3& place, const Vec3& direction, double reach) {
  return std::any_of(legs.begin(), legs.end(), [&](const Leg& leg) {
    return glm::distance(leg.from, place) < reach && glm::dot(direction, leg.heading) > same_heading;
  });
}

Wander::State::Look Wander::State::probe(const Vec3& direction) const {
  // At a door, the body may be stuck beside it, and pass through its middle.
  constexpr double as_vain = 0.4;  // m
  Look look;
  const auto goes_on = [&](const Vec3& place) { return !has_failed(vain_, place, direction, as_vain); };
  if (!goes_on(walker_->position())) return look;
  stride_ahead({walker_->space(), walker_->settings(), walker_->mode(), walker_->body()}, walker_->position(),
               direction, most_strides, [&](const Vec3& place, double length) {
                 look.way += length;
                 const auto visits = visits_.find(cell(place));
                 look.novelty += visits == visits_.end() ? 1.0 : 1.0 / (1.0 + visits->second);
                 return goes_on(place);
               });
  return look;
}

bool Wander::State::is_barred(const Vec3& direction) const {
  constexpr double same_place = 1.0;  // m
  // Where the body got stuck it does not try the same at once; where it fell into the void, never again.
  if (stuck_ && glm::dot(direction, heading_) > same_heading) return true;
  return has_failed(voids_, walker_->position(), direction, same_place);
}

void Wander::State::give_up(std::vector<Leg>& legs, const Vec3& place) const {
  legs.push_back({place, heading_});
  legs.push_back({leg_start_, heading_});
  if (std::ssize(legs) > most_legs) legs.erase(legs.begin(), legs.begin() + 2);
}

void Wander::State::look() {
  const DefaultFloatingPoint guard;
  if (way_left_ > 0.0 && !stuck_) return;
  const bool fly = walker_->mode() == Mode::fly;
  double best = -1.0;
  Vec3 next = heading_;
  for (const double pitch : {0.0, 0.5, -0.5}) {
    if (pitch != 0.0 && !fly) break;
    for (int i = 0; i < headings; ++i) {
      const Vec3 direction = glm::normalize(level(i, headings) + Vec3(0, 0, pitch));
      if (is_barred(direction)) continue;
      const Look seen = probe(direction);
      // Going on as before is worth a little: fewer turns, longer ways.
      const double score = seen.novelty * (1.0 + 0.1 * glm::dot(direction, heading_));
      if (score <= best) continue;
      best = score;
      way_left_ = std::max(seen.way, stride);
      next = direction;
    }
  }
  if (best < 0.0) {
    // Every way from here has failed.
    result.outcome = Outcome::held;
    done = true;
  }
  heading_ = next;
  leg_start_ = walker_->position();
  stuck_ = false;
}

const StepReport& Wander::State::advance() {
  const DefaultFloatingPoint guard;
  if (done) throw Error("the wandering has ended: call done() before each step");
  look();
  if (done) return walker_->report();
  const double speed = std::min(options_.speed, walker_->space().facts().speed_limit);
  const StepReport& report = walker_->step({.velocity = options_.speed * heading_}, options_.dt);
  result.add_step(report);
  const double moved = report.length();
  way_left_ -= moved;
  window_length_ += moved;
  window_wish_ += speed * report.elapsed;
  window_seconds_ += report.elapsed;
  hindered_ = hindered_ || report.met_unknown || report.held;
  const bool is_vain = is_vain_again(report, vain_steps_);
  if (window_seconds_ >= stuck_seconds) {
    stuck_ = window_length_ < stuck_share * window_wish_;
    if (stuck_ && !hindered_) give_up(vain_, report.to);
    window_length_ = window_wish_ = window_seconds_ = 0.0;
    hindered_ = false;
  }
  note(report);
  if (is_vain && !done) {
    result.outcome = Outcome::held;
    done = true;
  }
  if (!done && result.simulated >= options_.seconds) {
    if (report.held) result.outcome = Outcome::held;
    done = true;
  }
  return report;
}

void Wander::State::note(const StepReport& report) {
  result.end = report.to;
  filter_.append(result.events, result.steps, report);
  auto& events = result.events;
  if (std::ssize(events) > most_events) events.erase(events.begin() + (most_events - 1), events.end() - 1);
  const std::uint64_t here = cell(report.to);
  if (visits_.size() >= most_visits) visits_.clear();
  if (here != last_cell_ || visits_.empty()) ++visits_[here];
  last_cell_ = here;

  if (report.put_back && !done && result.steps > 0) {
    give_up(voids_, report.to);
    way_left_ = 0.0;
  }
  held_seconds_ = report.held ? held_seconds_ + report.elapsed : 0.0;
  if (held_seconds_ > held_limit) {
    result.outcome = Outcome::held;
    done = true;
  }
  const bool flies = walker_->mode() == Mode::fly;
  const Box scene = flies ? airspace(walker_->space(), walker_->settings()) : walker_->space().bounds();
  bool inside = true;
  const Vec3 reach(walker_->settings().radius, walker_->settings().radius, 0.5 * report.height);
  const Vec3 low = report.to - reach;
  const Vec3 high = report.to + reach;
  for (int k = 0; k < 3; ++k) {
    // Above everything one may be flying or about to land.
    const bool above = k == 2 && !flies;
    inside = inside && high[k] >= scene.lower[k] && (low[k] <= scene.upper[k] || above);
  }
  // A body may fly in from outside.
  if (!inside && (!flies || was_inside_)) {
    result.outcome = Outcome::left_scene;
    done = true;
  }
  was_inside_ = was_inside_ || inside;
}

Wander::Wander(Walker& walker, const WanderOptions& options) : state_(std::make_unique<State>(walker, options)) {}
Wander::~Wander() = default;
Wander::Wander(const Wander& other) : state_(std::make_unique<State>(*other.state_)) {}
Wander::Wander(Wander&& other) noexcept = default;
Wander& Wander::operator=(const Wander& other) { return *this = Wander(other); }
Wander& Wander::operator=(Wander&& other) noexcept = default;
bool Wander::done() const { return state_->done; }
void Wander::look() { state_->look(); }
const StepReport& Wander::advance() { return state_->advance(); }
const RouteResult& Wander::result() const { return state_->result; }

}  // namespace roam
