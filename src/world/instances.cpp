#include "roam/instances.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "math/finite.h"
#include "math/floating_point.h"
#include "math/mix.h"
#include "roam/filtered.h"
#include "text/number.h"
#include "world/box_tree.h"
#include "world/floor_only.h"
#include "world/frame.h"
#include "world/many.h"
#include "world/query.h"

namespace roam {
namespace {

/// The number of the first instance.
constexpr ObjectId first_instance = ObjectId{1} << 31;

/// As many as the numbers of triangles allow (frame.h).
constexpr std::size_t most_instances = std::size_t{1} << 30;

/// Rounding of a turned point or way, relative to its largest length: a difference, two products, their sum and the
/// cosine's own error, times four.
constexpr double turn_rounding = 0x1p-48;

void check(const Pose& pose) {
  if (!is_finite(pose.position) || !std::isfinite(pose.heading)) throw Error("the pose of an instance is not finite");
  if (largest(pose.position) > coordinate_limit) {
    throw Error("an instance cannot be put " + number_text(largest(pose.position)) +
                " m from the origin; the limit is " + number_text(coordinate_limit) + " m");
  }
}

/// The space inside all filters.
const Space& unfiltered(const Space& space) {
  const Space* inner = &space;
  while (const auto* filtered = dynamic_cast<const Filtered*>(inner)) inner = &filtered->space();
  return *inner;
}

/// The query without filters that only name instances.
Query for_base(const Query& query) {
  for (const ObjectFilter* f = query.ignored; f != nullptr; f = f->also) {
    if (!f->beyond.empty() || (!f->objects.empty() && f->objects.front() < first_instance)) return query;
  }
  return {query.body, query.from, query.motion};
}

/// The box about a turned box.
Box turned(const Box& box, const query::Frame& frame) {
  if (box.empty()) return box;
  const Vec3 half = 0.5 * box.size(), center = frame.to_scene(box.center());
  const double c = std::abs(frame.cosine), s = std::abs(frame.sine);
  const Vec3 around(c * half.x + s * half.y, s * half.x + c * half.y, half.z);
  // Rounding is far below box_slack.
  return {center - around, center + around};
}

}  // namespace

Vec3 Pose::to_scene(const Vec3& p) const {
  const DefaultFloatingPoint guard;
  const double c = std::cos(heading), s = std::sin(heading);
  return position + Vec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
}

Vec3 Pose::to_instance(const Vec3& p) const {
  const DefaultFloatingPoint guard;
  const double c = std::cos(heading), s = std::sin(heading);
  const Vec3 v = p - position;
  return {c * v.x + s * v.y, c * v.y - s * v.x, v.z};
}

Vec3 Velocity::at(const Pose& pose, const Vec3& point) const {
  const DefaultFloatingPoint guard;
  const Vec3 arm = point - pose.position;
  return linear + turning * Vec3(-arm.y, arm.x, 0.0);
}

struct Instances::State {
  struct Instance {
    ObjectId number = no_object;
    std::shared_ptr<const World> world;
    const WorldData* data = nullptr;
    Pose pose;
    Velocity velocity;
    std::string name;
    std::uint64_t user_data = 0;
    query::Frame frame;
  };

  explicit State(const Space& unmoved) : space(unmoved), error(std::max(unmoved.largest_error(), usual_error)) {}

  const Space& space;                       ///< the space that does not move
  LiveSpace* live = nullptr;                ///< the same, if it needs updates
  std::vector<Instance> instances;          ///< slots; the tree's numbers are their indices
  std::vector<std::uint32_t> unused;        ///< free slots; has room for all slots
  std::map<ObjectId, std::uint32_t> known;  ///< the slot of each instance
  ObjectId next = first_instance;           ///< the number of the instance that is added next
  BoxTree tree;
  std::uint64_t state = next_revision();  ///< a new number after each change, unique in the program
  double error;                           ///< metres: the largest error of all worlds
  bool lossless = false;                  ///< one of the worlds is lossless

  [[nodiscard]] std::uint32_t index(ObjectId instance) const {
    const auto at = known.find(instance);
    if (at == known.end()) throw Error("there is no instance with the number " + std::to_string(instance));
    return at->second;
  }
  [[nodiscard]] const Instance& at(ObjectId instance) const { return instances[index(instance)]; }

  /// Changes nothing if memory runs out.
  void put(std::uint32_t i, const Pose& pose) {
    Instance& it = instances[i];
    const query::Frame frame{pose.position, std::cos(pose.heading), std::sin(pose.heading),
                             query::instance_bit | TriangleId{it.number - first_instance} << 32, it.number};
    tree.change({{turned(it.data->reach, frame), i}}, {});
    it.pose = pose;
    it.frame = frame;
    state = next_revision();
  }

  /// A query in the frame of an instance.
  struct Seen {
    query::Frame frame;
    Query query;

    Seen(const query::Frame& of, const Query& original) : frame(of) {
      frame.pad = turn_rounding * (largest(original.from - of.position) + largest(original.motion));
      query.body = {original.body.radius + frame.pad, original.body.half_height};
      query.from = of.to_instance(original.from);
      query.motion = of.to_instance_way(original.motion);
    }
    /// The part of the motion that can concern it, if there is one.
    [[nodiscard]] std::optional<query::Part> part(const WorldData& data, double reach) const {
      const Interval when = query::reached(query, reach).meets(data.reach);
      if (when.empty()) return std::nullopt;
      return query::part_of(query, when);
    }
  };

  [[nodiscard]] bool is_ignored(std::uint32_t i, const Query& query) const {
    return query.ignored != nullptr && query.ignored->ignores(instances[i].number);
  }

  /// Offers the collector the near triangles of one instance.
  void offer(std::uint32_t i, const Query& query, Collector& collector) const {
    const Instance& it = instances[i];
    const Seen seen(it.frame, query);
    const query::FloorOnly* const floor = collector.floor();
    std::optional<query::FloorOnly> turned;
    if (floor != nullptr) collector.take_floor_only(turned.emplace(floor->seen_in(seen.frame, seen.query.from)));
    collector.enter(&seen.frame);
    if (collector.only() != nullptr) {
      query::collect_one(it.data->index, seen.query, collector);
    } else if (const auto part = seen.part(*it.data, collector.initial_reach())) {
      query::collect(*it.data, seen.query, *part, 0, collector);
    }
    collector.enter(nullptr);
    if (floor != nullptr) collector.take_floor_only(*floor);
  }
};

Instances::Instances(const Space& space) : state_(std::make_unique<State>(space)) {
  if (dynamic_cast<const Instances*>(&unfiltered(space)) != nullptr) {
    throw Error("instances cannot be put into a space of instances: add them to that one");
  }
}
Instances::Instances(LiveSpace& space) : Instances(static_cast<const Space&>(space)) { state_->live = &space; }
Instances::~Instances() = default;

ObjectId Instances::add(std::shared_ptr<const World> world, const Pose& pose, std::string name,
                        std::uint64_t user_data) {
  const DefaultFloatingPoint guard;
  State& s = *state_;
  check(pose);
  if (!world) throw Error("an instance needs a world");
  if (world->largest_error() > s.error) {
    throw Error("cannot add an instance: its world is stored to " + number_text(world->largest_error()) +
                " m, and this space is exact to " + number_text(s.error) + " m; build it with BuildOptions::lossless");
  }
  if (world->stats().triangles > query::source_bits) {
    throw Error("cannot add an instance: its world has more than 4 billion triangles; divide it");
  }
  if (s.next - first_instance >= most_instances) throw Error("there are no more numbers for instances");
  if (s.unused.empty()) {
    if (s.unused.capacity() <= s.instances.size()) s.unused.reserve(2 * s.instances.size() + 1);
    s.instances.emplace_back();
    s.unused.push_back(static_cast<std::uint32_t>(s.instances.size() - 1));
  }
  const std::uint32_t i = s.unused.back();
  const WorldData* const data = world->data_.get();
  const auto known = s.known.emplace(s.next, i).first;
  s.instances[i] = {s.next, std::move(world), data, pose, {}, std::move(name), user_data, {}};
  try {
    s.put(i, pose);
  } catch (...) {
    s.known.erase(known);
    s.instances[i] = {};
    throw;
  }
  s.unused.pop_back();
  s.lossless |= data->lossless;
  return s.next++;
}

void Instances::remove(ObjectId instance) {
  State& s = *state_;
  const std::uint32_t i = s.index(instance);
  s.tree.change({}, {i});
  s.known.erase(instance);
  s.instances[i] = {};
  s.unused.push_back(i);
  s.state = next_revision();
}

void Instances::set_pose(ObjectId instance, const Pose& pose) {
  const DefaultFloatingPoint guard;
  check(pose);
  const std::uint32_t i = state_->index(instance);
  const Pose& old = state_->instances[i].pose;
  if (old.position == pose.position && old.heading == pose.heading) return;
  state_->put(i, pose);
}

void Instances::set_velocity(ObjectId instance, const Velocity& velocity) {
  if (!is_finite(velocity.linear) || !std::isfinite(velocity.turning)) {
    throw Error("the velocity of an instance is not finite");
  }
  state_->instances[state_->index(instance)].velocity = velocity;
}

const Pose& Instances::pose(ObjectId instance) const { return state_->at(instance).pose; }
const Velocity& Instances::velocity(ObjectId instance) const { return state_->at(instance).velocity; }
const World& Instances::world(ObjectId instance) const { return *state_->at(instance).world; }

std::vector<ObjectId> Instances::instances() const {
  std::vector<ObjectId> all;
  for (const auto& [number, i] : state_->known) all.push_back(number);
  return all;
}

bool Instances::has(ObjectId instance) const { return state_->known.contains(instance); }

bool Instances::update(const Body& body, const Vec3& place, const Vec3& velocity) {
  const DefaultFloatingPoint guard;
  query::check_update(body, place, velocity);
  return state_->live != nullptr && state_->live->update(body, place, velocity);
}

SpaceFacts Instances::facts() const {
  const State& s = *state_;
  SpaceFacts facts = s.space.facts();
  facts.bounds.include(s.tree.bounds());
  facts.largest_error = s.error;
  if (facts.revision) facts.revision = mix(*facts.revision) + s.state;
  return facts;
}

Object Instances::object(TriangleId triangle) const {
  if (!query::is_of_instance(triangle)) return state_->space.object(triangle);
  const auto known =
      state_->known.find(first_instance + static_cast<ObjectId>((triangle & ~query::instance_bit) >> 32));
  if (known == state_->known.end()) return {};
  const State::Instance& it = state_->instances[known->second];
  if ((triangle & query::source_bits) >= it.world->stats().triangles) return {};
  return {it.number, it.name, it.user_data};
}

TriangleId Instances::source_triangle(TriangleId triangle) {
  return !query::is_of_instance(triangle) ? triangle : triangle & query::source_bits;
}

FirstImpact Instances::find_first(const Query& query, Vicinity* vicinity) const {
  const State& s = *state_;
  FirstImpact first = find_first_of(s.space, for_base(query), vicinity);
  double until = first.time;
  s.tree.along(query::reached(query, query::hit_reach), until, [&](std::uint32_t i, const Interval&) {
    if (s.is_ignored(i, query)) return;
    const State::Instance& it = s.instances[i];
    const State::Seen seen(it.frame, query);
    const auto part = seen.part(*it.data, query::hit_reach);
    if (!part) return;
    FirstImpact met = query::first_impact(*it.data, seen.query, *part);
    if (!met.hit) return;
    met.triangle |= it.frame.triangles;
    met.object = it.frame.object;
    if (met.contact) met.contact = seen.frame.in_scene(*met.contact);
    if (first.hit && !query::is_earlier(met, first)) return;
    first = met;
    until = first.time;
  });
  return first;
}

void Instances::find_near(const Query& query, Collector& collector, Vicinity* vicinity) const {
  const State& s = *state_;
  if (const FirstImpact* const only = collector.only(); only && query::is_of_instance(only->triangle)) {
    return s.offer(s.index(only->object), query, collector);
  }
  if (s.lossless && collector.only() == nullptr) collector.demand(query::lossless_tolerance);
  find_near_of(s.space, for_base(query), collector, vicinity);
  if (collector.only() != nullptr) return;
  Sweep look = query::reached(query, collector.reach());
  s.tree.near(look, [&](std::uint32_t i, const Interval&) {
    if (!s.is_ignored(i, query)) s.offer(i, query, collector);
    look = query::reached(query, collector.reach());
  });
}

}  // namespace roam
