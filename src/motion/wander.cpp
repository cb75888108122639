#include "roam/wander.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>
#include <optional>
#include <unordered_map>

#include "math/floating_point.h"
#include "math/slope.h"
#include "motion/demand.h"
#include "motion/event_filter.h"
#include "motion/vain_steps.h"
#include "roam/error.h"
#include "text/number.h"

namespace roam {
namespace {

constexpr int most_floors = 64;       // that are looked at in a column
constexpr double lift = 0.05;         // m, a start is looked for so high above a floor, then let down
constexpr double floor_gap = 0.01;    // m, at least: the next floor of a column is looked for so far below the last
constexpr int most_more_rays = 2048;  // in all, for scenes that are higher than a ray is long
constexpr double wall_reach = 30.0;   // m, farther is the open
constexpr double hall = 15.0;         // m, who sees farther from within walls is in no closet and no hollow house
constexpr double inside_worth = 4.0;
constexpr double hollow = 1.0;            // m, of air below a floor under the sky: that is a roof
constexpr double least_open_room = 10.0;  // m, the sum of eight directions: under the sky, less is no ground to walk on
constexpr int room_strides = 20;          // 10 m: farther is free enough
constexpr double fly_height = 2.0;        // m above the floor, where there is no ceiling to stay under
constexpr std::size_t most_rooms = 16;    // whose views are compared
constexpr double same_room = 3.0;         // m: nearer places are in the same room
constexpr double long_view = 7.0;         // m: who sees so far is in no small room
constexpr double view_share = 0.75;       // of the longest view: that is long, too

constexpr int headings = 16;
constexpr double stride = 0.5;  // m of one probe of the look ahead
constexpr int most_strides = static_cast<int>(Wander::look_around / stride);
constexpr double cell_side = 1.0;  // m, a place that was visited
// A body that moves by less than this share of free motion in this time is stuck.
constexpr double stuck_share = 0.2;
constexpr double stuck_seconds = 0.5;
// However long it goes, it remembers no more: cells of some ten hours, then it begins anew.
constexpr std::size_t most_visits = 1 << 15;
constexpr std::ptrdiff_t most_events = 10'000, most_voids = 1'000;
constexpr double held_limit = 2.0;  // s after which a body that cannot move is given up

/// What a body flies in: the scene, and the air around it that takes the body over a roof and round an object.
Box airspace(const Space& space, const WalkerSettings& settings) {
  return space.bounds().grown(fly_height + settings.height + stride);
}

Vec3 level(int i, int count) {
  const double angle = 2.0 * std::numbers::pi * i / count;
  return {std::cos(angle), std::sin(angle), 0.0};
}

/// What a body is that looks ahead.
struct Prober {
  const Space& space;
  const WalkerSettings& settings;
  Mode mode;
  Body body;
};

/// Strides from `place` in a direction: where each leads to is handed to `visit`, with its length seen from above (or,
/// flying, its length). Ends at a wall, where the ground ends, at the border of the scene, and after `count`.
template <class Visit>
void stride_ahead(const Prober& prober, Vec3 place, const Vec3& direction, int count, const Visit& visit) {
  const auto& [space, settings, mode, body] = prober;
  const bool on_foot = mode == Mode::walk;
  // What a stride may climb, on a slope or up a kerb.
  const double slope = std::tan(settings.slope_degrees * std::numbers::pi / 180.0);
  const double climb = on_foot ? std::min(stride * slope + settings.step, settings.height) : 0.0;
  for (int i = 0; i < count; ++i) {
    const Vec3 high = place + Vec3(0, 0, climb * space.first_impact(body, place, {0, 0, climb}).time);
    const FirstImpact along = space.first_impact(body, high, stride * direction);
    if (along.hit && along.time < 0.5) return;
    Vec3 next = high + along.time * stride * direction;
    if (on_foot) {
      const double down = high.z - place.z + climb;
      const FirstImpact ground = space.first_impact(body, next, {0, 0, -down});
      if (!ground.hit) return;
      next.z -= ground.time * down;
    } else if (!airspace(space, settings).holds(next)) {
      return;
    }
    visit(next, along.time * stride);
    if (along.hit) return;
    place = next;
  }
}

/// Whether there is air below the surface at `floor`, over another one.
bool is_over_hollow(const Space& space, const Vec3& floor) {
  const double gap = std::max(floor_gap, 8.0 * space.largest_error());
  const double depth = std::min(floor.z - space.bounds().lower.z + 1.0, Space::motion_limit);
  const Impact below = space.ray(floor - Vec3(0, 0, gap), {0, 0, -depth});
  return below.hit && gap + below.time * depth > hollow;
}

/// A place on the floor at `floor`, or in the air above it, and how much room there is; less than 0: the body does not
/// fit.
WanderStart start_at(const Space& space, const WalkerSettings& settings, Mode mode, const Vec3& floor) {
  const Body body = Body::capsule(settings.radius, settings.height);
  WanderStart start{.room = -1.0};
  const FirstImpact above = space.first_impact({0.0, 0.0}, floor + Vec3(0, 0, lift), {0, 0, wall_reach});
  const double ceiling = lift + above.time * wall_reach;
  if (mode == Mode::fly) {
    start.place = floor + Vec3(0, 0, above.hit ? 0.5 * ceiling : fly_height + 0.5 * settings.height);
  } else {
    start.place = floor + Vec3(0, 0, 0.5 * settings.height + lift);
  }
  if (space.clearance(body, start.place, lift).distance <= 0.0) return start;
  if (mode == Mode::walk) {
    const Vec3 down{0, 0, -2.0 * lift - settings.radius};
    const Impact ground = space.sweep(body, start.place, down);
    if (!ground.hit || ground.normal.z < least_upright(settings.slope_degrees)) return start;
  }
  start.room = 0.0;
  constexpr int directions = 8;
  int walls = above.hit ? 1 : 0;
  double sight = 0.0;
  for (int i = 0; i < directions; ++i) {
    const FirstImpact wall = space.first_impact({0.0, 0.0}, start.place, wall_reach * level(i, directions));
    walls += wall.hit ? 1 : 0;
    sight = std::max(sight, (wall.hit ? wall.time : 1.0) * wall_reach);
    stride_ahead({space, settings, mode, body}, start.place, level(i, directions), room_strides,
                 [&](const Vec3&, double length) { start.room += length; });
  }
  start.on_top = !above.hit && (start.room < least_open_room || is_over_hollow(space, floor));
  // In the open, a place with walls all around has no view: a hollow of the land.
  if (above.hit || sight >= wall_reach) start.room *= 1.0 + walls;
  // A long corridor is open at its ends.
  if (above.hit && walls >= directions - 1 && sight > hall) start.room *= inside_worth;
  return start;
}

/// Metres to the walls at the height of the eye, on average over a sixth of the horizon: where they are farthest.
double view_from(const Space& space, const WalkerSettings& settings, const Vec3& place) {
  constexpr int directions = 32, beside = 2;
  constexpr double slit = 0.2;  // m, radius: nobody looks through narrower ones
  const Vec3 eye = place + Vec3(0, 0, std::max(0.0, settings.eye - 0.5 * settings.height));
  std::array<double, directions> way{};
  for (int i = 0; i < directions; ++i) {
    const FirstImpact wall = space.first_impact({slit, 0.0}, eye, wall_reach * level(i, directions));
    way[static_cast<std::size_t>(i)] = wall.hit ? wall.time * wall_reach : 0.0;
  }
  double best = 0.0;
  for (int i = 0; i < directions; ++i) {
    double sum = 0.0;
    for (int k = -beside; k <= beside; ++k) sum += way[static_cast<std::size_t>((i + k + directions) % directions)];
    best = std::max(best, sum / (2 * beside + 1));
  }
  return best;
}

/// Puts places with a long view before the others, of places that are sorted, best first. A bed leaves more room to
/// stride than a table and chairs, but a living room is larger than a bedroom. In the open nothing changes.
void prefer_views(std::vector<WanderStart>& places, const Space& space, const WalkerSettings& settings) {
  if (places.empty() || !space.first_impact({0.0, 0.0}, places.front().place, {0, 0, wall_reach}).hit) return;
  struct Room {
    WanderStart start;
    double view;
  };
  std::vector<Room> rooms;
  double longest = 0.0;
  for (const WanderStart& start : places) {
    if (rooms.size() == most_rooms || start.on_top != places.front().on_top) break;
    if (std::any_of(rooms.begin(), rooms.end(),
                    [&](const Room& room) { return glm::distance(room.start.place, start.place) < same_room; })) {
      continue;
    }
    rooms.push_back({start, std::min(view_from(space, settings, start.place), long_view)});
    if (rooms.front().view == long_view) return;
    longest = std::max(longest, rooms.back().view);
  }
  std::erase_if(rooms, [&](const Room& room) { return room.view < view_share * longest; });
  std::vector<WanderStart> preferred;
  for (const Room& room : rooms) preferred.push_back(room.start);
  places.insert(places.begin(), preferred.begin(), preferred.end());
}

/// Metres from a place down to the triangle below it, if that is within `depth`. A ray reaches no farther than a
/// motion; `more_rays` is how many more may be cast.
std::optional<double> drop_from(const Space& space, const Vec3& place, double depth, int& more_rays) {
  for (double begin = 0.0; begin < depth && (begin == 0.0 || --more_rays >= 0); begin += Space::motion_limit) {
    const double part = std::min(depth - begin, Space::motion_limit);
    const Impact down = space.ray(place - Vec3(0, 0, begin), {0, 0, -part});
    if (down.hit) return begin + down.time * part;
  }
  return std::nullopt;
}

}  // namespace

std::optional<WanderStart> wander_start(const Space& space, const WalkerSettings& settings, Mode mode,
                                        std::span<const Vec3> floors, int columns, const std::function<bool()>& goes_on,
                                        const std::function<bool(const Vec3&)>& accepts) {
  const DefaultFloatingPoint guard;
  check(settings);
  const Box& box = space.bounds();
  if (box.empty()) return std::nullopt;
  const Vec3 size = box.size();
  std::vector<WanderStart> found;
  // A hit may be some errors above the triangle: it must not be found again.
  int more_rays = most_more_rays;
  const double below = std::max(floor_gap, 8.0 * space.largest_error());
  const auto consider = [&](const Vec3& floor) {
    if (goes_on && !goes_on()) throw Cancelled();
    const WanderStart start = start_at(space, settings, mode, floor);
    if (start.room >= 0.0) found.push_back(start);
  };
  for (const Vec3& floor : floors) consider(floor);
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < columns; ++j) {
      Vec3 top{box.lower.x + size.x * (i + 0.5) / columns, box.lower.y + size.y * (j + 0.5) / columns,
               box.upper.z + 1.0};
      for (int level_below = 0; level_below < most_floors; ++level_below) {
        const std::optional<double> drop = drop_from(space, top, top.z - box.lower.z + 1.0, more_rays);
        if (!drop) break;
        top.z -= *drop;
        consider(top);
        top.z -= below;
      }
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const WanderStart& a, const WanderStart& b) {
    return a.on_top != b.on_top ? b.on_top : a.room > b.room;
  });
  prefer_views(found, space, settings);
  const auto best = std::find_if(found.begin(), found.end(),
                                 [&](const WanderStart& start) { return !accepts || accepts(start.place); });
  return best == found.end() ? std::nullopt : std::optional(*best);
}

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

  /// A way that ended in the void.
  struct Leg {
    Vec3 from{0.0};
    Vec3 heading{0.0};
  };

  Walker* walker_;
  WanderOptions options_;
  std::unordered_map<std::uint64_t, std::uint32_t> visits_;  ///< of each cell
  std::uint64_t last_cell_ = 0;
  Vec3 heading_{0.0};             ///< unit; zero before the first look
  double way_left_ = 0.0;         ///< metres to go along heading_
  double window_seconds_ = 0.0;   ///< since getting on was last judged
  double window_length_ = 0.0;    ///< metres moved since
  std::uint64_t vain_steps_ = 0;  ///< see is_vain_again
  bool stuck_ = false;
  Vec3 leg_start_{0.0};
  std::vector<Leg> voids_;
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

Wander::State::Look Wander::State::probe(const Vec3& direction) const {
  Look look;
  stride_ahead({walker_->space(), walker_->settings(), walker_->mode(), walker_->body()}, walker_->position(),
               direction, most_strides, [&](const Vec3& place, double length) {
                 look.way += length;
                 const auto visits = visits_.find(cell(place));
                 look.novelty += visits == visits_.end() ? 1.0 : 1.0 / (1.0 + visits->second);
               });
  return look;
}

bool Wander::State::is_barred(const Vec3& direction) const {
  constexpr double same_place = 1.0;    // m
  constexpr double same_heading = 0.9;  // cosine
  // Where the body got stuck it does not try the same at once; where it fell into the void, never again.
  if (stuck_ && glm::dot(direction, heading_) > same_heading) return true;
  return std::any_of(voids_.begin(), voids_.end(), [&](const Leg& leg) {
    return glm::distance(leg.from, walker_->position()) < same_place && glm::dot(direction, leg.heading) > same_heading;
  });
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
  if (done) throw Error("the wandering has ended: ask done() before each step");
  look();
  if (done) return walker_->report();
  const StepReport& report = walker_->step({.velocity = options_.speed * heading_}, options_.dt);
  result.add_step(report);
  const double moved = report.length();
  way_left_ -= moved;
  window_length_ += moved;
  window_seconds_ += report.elapsed;
  const bool is_vain = is_vain_again(report, vain_steps_);
  if (window_seconds_ >= stuck_seconds) {
    stuck_ = window_length_ < stuck_share * options_.speed * window_seconds_;
    window_length_ = window_seconds_ = 0.0;
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
    // Put back to where it stood last: from there, and from where this leg began, it does not go the same way again.
    voids_.push_back({report.to, heading_});
    voids_.push_back({leg_start_, heading_});
    if (std::ssize(voids_) > most_voids) voids_.erase(voids_.begin(), voids_.begin() + 2);
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
