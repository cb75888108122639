#include "view/live_plan.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <iterator>
#include <span>
#include <string>
#include <utility>

#include "math/boxes.h"
#include "roam/error.h"
#include "roam/pager.h"
#include "roam/standing.h"
#include "roam/world.h"
#include "store/meshes.h"
#include "view/plan_scan.h"

namespace roam::app {
namespace {

using graphics::PlanSize;

constexpr double large_factor = 2.5;  // the large plan shows so much more, if there is more
constexpr double least_half = 2.0, largest_half = 200.0;
constexpr double margin_factor = 1.4;  // of what is shown: cut, so that the body can go on
constexpr double rays_across = 500.0;
constexpr double least_spacing = 0.02;                // m
constexpr double knee = 0.3;                          // m above the feet: the lower cut
constexpr double storey = 0.25;                       // m: a change of height that needs a new cut
constexpr double trail_spacing = 0.25;                // m
constexpr std::size_t longest_trail = 4000;           // points
constexpr std::size_t most_plan_triangles = 500'000;  // of a store in one plan

/// The triangles of a store in a box, without those that cannot be read: the pager says which.
World part_of(const Store& store, const Box& box, const std::function<bool()>& goes_on) {
  Mesh mesh;
  std::vector<Triangle> near;
  const auto take = [&](std::span<const Triangle> triangles, std::span<const TriangleId>) {
    if (!goes_on()) throw Cancelled();
    near.clear();
    std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(near),
                 [&](const Triangle& triangle) { return meet(box, box_around(triangle)); });
    if (mesh.triangles.size() + near.size() <= most_plan_triangles) store::append(mesh, near);
  };
  store.for_each_triangle(box, take, [&](const std::string&) {
    if (!goes_on()) throw Cancelled();
  });
  return World::build({&mesh, 1}, {.threads = 1});
}

glm::dvec2 seen_from_above(const Vec3& p) { return {p.x, p.y}; }

struct Surfaces {
  std::vector<double> heights;  ///< those nearest to `at` first
  bool unknown = false;         ///< some of the column is not known
};

/// The surfaces above and below a point.
Surfaces surfaces_of(const Space& space, const Vec3& at) {
  constexpr int most = 64;         // on either side
  constexpr double beyond = 5e-3;  // m behind a surface: there the search goes on
  const Box bounds = space.bounds();
  Surfaces found;
  if (bounds.empty()) return found;
  for (const double end : {bounds.lower.z - 1.0, bounds.upper.z + 1.0}) {
    const double way = end < at.z ? -1.0 : 1.0;
    double z = at.z;
    for (int i = 0; i < most && way * (end - z) > 0.0; ++i) {
      const double left = std::clamp(end - z, -Space::motion_limit, Space::motion_limit);
      const FirstImpact hit = space.first_impact({0.0, 0.0}, {at.x, at.y, z}, {0.0, 0.0, left});
      found.unknown |= hit.hit && hit.unknown;
      if (!hit.hit || hit.unknown) break;
      z += hit.time * left;
      found.heights.push_back(z);
      z += way * beyond;
    }
  }
  std::sort(found.heights.begin(), found.heights.end(),
            [&](double a, double b) { return std::abs(a - at.z) < std::abs(b - at.z); });
  return found;
}

}  // namespace

LivePlan::~LivePlan() {
  stops_ = true;
  if (cutting_.valid()) cutting_.wait();
}

void LivePlan::cycle() {
  size_ = size_ == PlanSize::none ? PlanSize::small : size_ == PlanSize::small ? PlanSize::large : PlanSize::none;
}

double LivePlan::half() const {
  if (size_ != PlanSize::large) return half_;
  // Wherever the body is in it, its side reaches as far as the scene does.
  const Box scene = roamer_.walker()->space().bounds();
  const double side = scene.empty() ? 0.0 : std::max(scene.size().x, scene.size().y);
  return std::min(large_factor * half_, std::max(half_, side));
}

void LivePlan::zoom(double factor) { half_ = std::clamp(half_ * factor, least_half, largest_half); }

/// The box between the two heights of the cut.
Box LivePlan::box_of(const Wish& wish) {
  const Vec3 reach(wish.half, wish.half, 0.0);
  Box box{wish.centre - reach, wish.centre + reach};
  box.lower.z = std::min(wish.low, wish.centre.z);
  box.upper.z = std::max(wish.low, wish.centre.z);
  return box;
}

graphics::PlanLines LivePlan::cut(const Wish& wish, const std::atomic<bool>& stops) {
  const auto goes_on = [&] { return !stops; };
  const Space* space = wish.met.space.get();
  // A pager may only be queried between two frames. Its store may be read at any time.
  World part;
  if (const auto* const pager = dynamic_cast<const Pager*>(space)) {
    part = part_of(pager->store(), box_of(wish), goes_on);
    space = &part;
  }
  Filtered met(*space);
  met.ignore_beyond(wish.met.open);
  graphics::PlanLines made{.base = seen_from_above(wish.centre)};
  PlanArea area{wish.centre, wish.half, std::max(least_spacing, 2.0 * wish.half / rays_across)};
  made.walls = scan_plan(met, area, goes_on);
  area.centre.z = wish.low;
  made.below = scan_plan(met, area, goes_on);
  return made;
}

bool LivePlan::is_stale(const Wish& wish) const {
  if (!wished_ || wished_->met != wish.met || wished_->half != wish.half) return true;
  const Vec3 way = wish.centre - wished_->centre;
  return std::abs(way.z) > storey || std::max(std::abs(way.x), std::abs(way.y)) > wish.half - half();
}

void LivePlan::receive() {
  if (!cutting_.valid() || cutting_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  try {
    shown_ = cutting_.get();
  } catch (const Cancelled&) {
    return;
  } catch (const Error& error) {
    problem_ = error.what();
    return;
  }
  panel_.set_lines(*shown_);
  trail_shown_ = 0;  // it has another base
  is_way_new_ = true;
}

void LivePlan::follow() {
  const Vec3 feet = roamer_.walker()->feet();
  if (!trail_.empty() && glm::distance(trail_.back().at, feet) < trail_spacing) return;
  trail_.push_back({feet, std::exchange(has_jumped_, false)});
  if (trail_.size() <= longest_trail) return;
  // Every other point, so that the trail keeps its length.
  for (std::size_t i = 0; 2 * i < trail_.size(); ++i) {
    const bool is_first = trail_[2 * i].is_first || (i > 0 && trail_[2 * i - 1].is_first);
    trail_[i] = {trail_[2 * i].at, is_first};
  }
  trail_.resize((trail_.size() + 1) / 2);
}

std::vector<Vec3> LivePlan::trail() const {
  std::vector<Vec3> pairs;
  for (std::size_t i = 1; i < trail_.size(); ++i) {
    if (!trail_[i].is_first) pairs.insert(pairs.end(), {trail_[i - 1].at, trail_[i].at});
  }
  return pairs;
}

void LivePlan::set_way(const ProbedWay& way) {
  if (way.open == way_.open && way.barred == way_.barred) return;
  way_ = way;
  is_way_new_ = true;
}

void LivePlan::update(bool visible, HiddenSpace::Met met, const std::vector<graphics::PlanPlace>& places) {
  if (roamer_.walker() == nullptr) return;
  follow();
  receive();
  graphics::PlanView view;
  if (!visible || size_ == PlanSize::none) {
    wished_.reset();  // it keeps the space, which may be gigabytes that nothing else needs
    panel_.set_view(view);
    return;
  }
  const Vec3 centre = roamer_.walker()->position();
  const Wish wish{std::move(met), centre, roamer_.walker()->feet().z + knee, margin_factor * half()};
  if (!cutting_.valid() && is_stale(wish)) {
    wished_ = wish;
    cutting_ = std::async(std::launch::async, [wish, this] { return cut(wish, stops_); });
  }
  if (shown_ && trail_shown_ != trail_.size()) {
    std::vector<glm::vec2> trail;
    for (const Vec3& p : this->trail()) trail.emplace_back(seen_from_above(p) - shown_->base);
    panel_.set_trail(trail);
    trail_shown_ = trail_.size();
  }
  if (shown_ && std::exchange(is_way_new_, false)) {
    const auto flat = [&](const std::vector<Vec3>& way) {
      std::vector<glm::vec2> points;
      for (const Vec3& p : way) points.emplace_back(seen_from_above(p) - shown_->base);
      return points;
    };
    panel_.set_way(flat(way_.open), flat(way_.barred));
  }
  panel_.set_places(places);
  view.size = size_;
  view.centre = seen_from_above(centre);
  view.half = half();
  view.yaw = roamer_.yaw();
  view.is_coming = !shown_ && cutting_.valid();
  panel_.set_view(view);
}

std::string LivePlan::go(double x, double y) {
  const auto at = panel_.at(x, y);
  if (!at || roamer_.walker() == nullptr) return "There is no floor there";
  const Walker& walker = *roamer_.walker();
  const auto [heights, unknown] = surfaces_of(walker.space(), Vec3(at->x, at->y, walker.feet().z));
  const WalkerSettings& settings = walker.settings();
  for (const double z : heights) {
    const Vec3 centre(at->x, at->y, z + 0.5 * settings.height);
    const auto place = place_to_stand(walker.space(), settings, centre, settings.radius);
    if (!place) continue;
    roamer_.goTo(*place - Vec3(0.0, 0.0, 0.5 * settings.height), {0.0, 0.0, 1.0});
    return {};
  }
  if (unknown) return "That place is not loaded yet";
  if (walker.mode() != Mode::walk && !heights.empty()) {  // it need not stand there
    roamer_.goTo(Vec3(at->x, at->y, heights.front()), {0.0, 0.0, 1.0});
    return {};
  }
  return heights.empty() ? "There is no floor there" : "There is no floor with room for the body there";
}

std::vector<glm::dvec2> LivePlan::walls() const {
  std::vector<glm::dvec2> all;
  if (!shown_) return all;
  for (const glm::vec2& p : shown_->walls) all.push_back(glm::dvec2(p) + shown_->base);
  return all;
}

}  // namespace roam::app
