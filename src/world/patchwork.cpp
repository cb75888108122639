#include "roam/patchwork.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

#include "math/floating_point.h"
#include "math/largest.h"
#include "text/number.h"
#include "world/many.h"
#include "world/patches.h"
#include "world/query.h"
#include "world/unknown.h"

namespace roam {
namespace {

/// Metres that a finer patch must leave between the body and its triangles. Two stored versions of one floor differ by
/// less than 2 * error_limit. A Walker stands its skin above one of them. The skin is 0.1 mm more, so half of that is
/// left above the other. A larger value would keep a body at rest from ever getting the exact floor.
constexpr double room_kept = 5e-5;

/// Numbers of the sides of an unknown box, in place of a triangle's number in its world.
constexpr TriangleId first_side = 0xFFFFFFF0;
static_assert(first_side + unknown::sides <= TriangleId{1} << 32);

TriangleId first_id(std::uint32_t index) { return (TriangleId{index} + 1) << 32; }

std::uint32_t index_of(PatchId patch) { return static_cast<std::uint32_t>(patch) - 1; }

std::string number(PatchId patch) { return "patch " + std::to_string(static_cast<std::uint64_t>(patch)); }

/// Larger than the box of any patch.
constexpr Box everywhere{Vec3(-2.0 * coordinate_limit), Vec3(2.0 * coordinate_limit)};

/// A message since the last update; messages are in order.
struct Message {
  enum class Kind : std::uint8_t { expected, delivered, failed, forgotten };

  Kind kind;
  PatchId patch;  ///< for Kind::expected: the patch that it refines
  Box where = {};
  std::optional<World> world = {};
  std::string reason = {};
};

/// The first impact with an unknown box.
FirstImpact met_unknown(const Box& box, const Query& query) {
  const Impact met = unknown::sweep(box, Patchwork::margin, query.body, query.from, query.motion);
  FirstImpact first;
  if (!met.hit) return first;
  first.hit = first.unknown = true;
  first.time = met.time;
  first.triangle = met.triangle;
  first.contact = Contact{{met.point, met.normal, met.feature, met.distance}, met.triangle, no_object, true};
  return first;
}

}  // namespace

struct Patchwork::State {
  // Shared by all threads.
  mutable std::mutex mutex;
  std::vector<bool> delivered;  ///< for all patch numbers given out
  std::vector<Message> inbox;
  std::vector<World> replaced;  ///< to be freed by a thread other than the body's
  PatchworkStats stats;

  // Used by the thread that moves the body.
  Patches patches;
  /// A patch to forget once the body has left it, and the reason if it was reported as failed since.
  struct Leaving {
    std::uint32_t patch;
    std::optional<std::string> failed = {};
  };
  std::vector<Leaving> leaving;
  BoxTree tree;
  std::uint64_t revision = 0;
  /// An update ran out of memory: patches may be missing, so all space is unknown, and no message matters.
  std::atomic<bool> lost = false;

  /// Posts a message and returns the worlds to free. The caller holds the lock, and frees them after releasing it.
  [[nodiscard]] std::vector<World> post(Message message) {
    if (!lost) inbox.push_back(std::move(message));
    return std::exchange(replaced, {});
  }
  /// The index of the patch in `delivered`. Throws if the patch is not expected, or if its `delivered` differs from
  /// `is`.
  [[nodiscard]] std::size_t check(PatchId patch, const char* what, bool is) const {
    const auto refuse = [&](const char* why) {
      throw Error(std::string("cannot ") + what + ' ' + number(patch) + why);
    };
    const std::size_t index = static_cast<std::uint64_t>(patch) - 1;
    if (index >= delivered.size()) refuse(": not expected");
    if (delivered[index] != is) refuse(is ? ": not delivered" : ": delivered already");
    return index;
  }

  void take(std::vector<Message> messages) {
    const auto is = [](PatchId patch) {
      return [index = index_of(patch)](const Leaving& it) { return it.patch == index; };
    };
    for (Message& m : messages) {
      switch (m.kind) {
        case Message::Kind::expected:
          patches.expect(m.where, m.patch);
          break;
        case Message::Kind::delivered:
          if (std::erase_if(leaving, is(m.patch)) > 0) patches.forget(index_of(m.patch));
          patches.deliver(m.patch, std::move(*m.world));
          break;
        case Message::Kind::failed:
          if (const auto at = std::find_if(leaving.begin(), leaving.end(), is(m.patch)); at != leaving.end()) {
            at->failed = std::move(m.reason);
          } else {
            patches.fail(m.patch, std::move(m.reason));
          }
          break;
        case Message::Kind::forgotten:
          leaving.push_back({index_of(m.patch)});
          break;
      }
    }
  }

  /// Forgets the patches that are leaving, except those whose box the body, if any, is in.
  void forget(const Body* body, const Vec3& place) {
    std::erase_if(leaving, [&](Leaving& it) {
      const std::uint32_t index = it.patch;
      if (body != nullptr && !patches.is_replaced(index)) {
        const double around = body->radius + 2.0 * margin;
        if (patches[index].where.grown({around, around, around + body->half_height}).holds(place)) return false;
      }
      patches.forget(index);
      if (it.failed) patches.fail(PatchId{index + std::uint64_t{1}}, std::move(*it.failed));
      return true;
    });
  }

  /// Repairs the tree after changes.
  void mend(std::vector<std::uint32_t> changed) {
    std::sort(changed.begin(), changed.end());
    changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
    std::vector<BoxTree::Item> put;
    std::vector<std::uint32_t> erased;
    for (const std::uint32_t index : changed) {
      const Patch& patch = patches[index];
      const Box box = patch.world ? patch.world->data_->reach : patch.where;
      if (patch.role == Patch::Role::shown && !box.empty()) {
        put.push_back({box, index});
      } else {
        erased.push_back(index);
      }
    }
    tree.change(put, erased);
    ++revision;
  }

  bool update(const Patchwork& self, const Body* body, const Vec3& place) {
    const DefaultFloatingPoint guard;
    // Errors must be thrown before the messages are taken, because these are not sent again.
    if (body) query::check({*body, place});
    if (lost) throw Error("this patchwork lost patches when memory ran out, and is solid: make a new one");
    std::vector<Message> messages;
    {
      const std::lock_guard lock(mutex);
      messages.swap(inbox);
    }
    if (messages.empty() && !patches.unsettled() && leaving.empty()) return false;
    try {
      // A body that overlaps something already has nothing to protect.
      const bool guarded = body && self.clearance(*body, place, room_kept).distance > 0.0;
      return settle(std::move(messages), guarded ? body : nullptr, body, place);
    } catch (...) {
      lost = true;
      ++revision;
      throw;
    }
  }

  /// Takes the messages into use. `guarded` is the body if it is to be kept free.
  bool settle(std::vector<Message> messages, const Body* guarded, const Body* body, const Vec3& place) {
    take(std::move(messages));
    forget(body, place);
    Patches::Fits fits;
    if (guarded != nullptr) {
      fits = [&](const World& world) { return world.clearance(*guarded, place, room_kept).distance >= room_kept; };
    }
    const std::vector<std::uint32_t> changed = patches.settle(fits);
    if (!changed.empty()) mend(changed);
    PatchworkStats counts = patches.stats();
    std::vector<World> gone = patches.take_replaced();
    const std::lock_guard lock(mutex);
    for (World& world : gone) replaced.push_back(std::move(world));
    for (const World& world : replaced) counts.bytes += world.stats().bytes;
    stats = counts;
    return !changed.empty();
  }

  /// Offers the collector everything within its reach of the motion.
  void collect(const Query& query, Collector& collector) const {
    // The part of the motion that is searched must not depend on earlier finds, or the last bits would depend on them
    // too.
    const Sweep whole = query::reached(query, collector.initial_reach(), margin);
    Sweep look = whole;
    tree.near(look, [&](std::uint32_t index, const Interval&) {
      const Patch& patch = patches[index];
      if (patch.world) {
        const WorldData& data = *patch.world->data_;
        query::collect(data, query, query::part_of(query, whole.meets(data.reach)), first_id(index), collector);
      } else if (collector.takes_unknown(patch.where, query.body.radius, margin)) {
        Contact c = unknown::nearest(patch.where, margin, query.body, query.from, query.motion);
        c.triangle += first_id(index) + first_side;
        collector.offer(c, margin);
      }
      look = query::reached(query, collector.reach(), margin);
    });
    for (Contact& c : collector.kept()) {
      if (!c.unknown) c.object = world(c.triangle).object(triangle_in_patch(c.triangle));
    }
  }
  /// The world of the shown patch that a triangle belongs to.
  [[nodiscard]] const WorldData& world(TriangleId triangle) const {
    return *patches[index_of(patch(triangle))].world->data_;
  }
};

Patchwork::Patchwork() : state_(std::make_unique<State>()) {}
Patchwork::~Patchwork() = default;

PatchId Patchwork::expect(const Box& where, PatchId refines) {
  const DefaultFloatingPoint guard;
  const bool finite = std::isfinite(largest(where.lower)) && std::isfinite(largest(where.upper));
  if (where.empty() || !finite || largest(where.lower) > coordinate_limit || largest(where.upper) > coordinate_limit) {
    throw Error("cannot expect a patch: its box is empty, not finite, or beyond 1e9 m");
  }
  State& s = *state_;
  std::vector<World> replaced;  // freed after the lock is released
  const std::lock_guard lock(s.mutex);
  if (static_cast<std::uint64_t>(refines) > s.delivered.size()) {
    throw Error("cannot expect a patch that refines " + number(refines) + ": that one is not expected");
  }
  // A number without its message would shift the numbers of all patches after it.
  if (s.delivered.size() == s.delivered.capacity()) s.delivered.reserve(2 * s.delivered.size() + 64);
  replaced = s.post({Message::Kind::expected, refines, where});
  s.delivered.push_back(false);
  return PatchId{s.delivered.size()};
}

void Patchwork::deliver(PatchId patch, World world) {
  if (world.largest_error() > error_limit) {
    throw Error("cannot deliver " + number(patch) + ": its world is stored to " + number_text(world.largest_error()) +
                " m, which is more than 1 mm; build it in smaller parts");
  }
  if (world.stats().triangles > first_side) {
    throw Error("cannot deliver " + number(patch) + ": it has more than 4 billion triangles; divide it");
  }
  State& s = *state_;
  std::vector<World> replaced;  // freed after the lock is released
  const std::lock_guard lock(s.mutex);
  const std::size_t index = s.check(patch, "deliver", false);
  replaced = s.post({Message::Kind::delivered, patch, {}, std::move(world)});
  s.delivered[index] = true;
}

void Patchwork::fail(PatchId patch, const std::string& reason) {
  State& s = *state_;
  std::vector<World> replaced;  // freed after the lock is released
  const std::lock_guard lock(s.mutex);
  static_cast<void>(s.check(patch, "fail", false));
  replaced = s.post({Message::Kind::failed, patch, {}, {}, reason});
}

void Patchwork::forget(PatchId patch) {
  State& s = *state_;
  std::vector<World> replaced;  // freed after the lock is released
  const std::lock_guard lock(s.mutex);
  const std::size_t index = s.check(patch, "forget", true);
  replaced = s.post({Message::Kind::forgotten, patch});
  s.delivered[index] = false;
}

bool Patchwork::update(const Body& body, const Vec3& place) { return state_->update(*this, &body, place); }

bool Patchwork::update(const Body& body, const Vec3& place, const Vec3& velocity) {
  const DefaultFloatingPoint guard;
  query::check_update(body, place, velocity);
  return update(body, place);
}

bool Patchwork::update() { return state_->update(*this, nullptr, Vec3(0.0)); }

FirstImpact Patchwork::find_first(const Query& query, Vicinity* /*vicinity*/) const {
  const State& s = *state_;
  FirstImpact first;
  if (s.lost) {
    first = met_unknown(everywhere, query);
    first.triangle += first_side;
    if (first.contact) first.contact->triangle = first.triangle;
    return first;
  }
  double until = 1.0;
  s.tree.along(query::reached(query, 0.0, margin), until, [&](std::uint32_t index, const Interval& when) {
    const Patch& patch = s.patches[index];
    FirstImpact met = patch.world ? query::first_impact(*patch.world->data_, query, query::part_of(query, when))
                                  : met_unknown(patch.where, query);
    met.triangle += first_id(index) + (patch.world ? 0 : first_side);
    if (met.contact) met.contact->triangle = met.triangle;
    if (!met.hit || (first.hit && !query::is_earlier(met, first))) return;
    first = met;
    until = first.time;
  });
  return first;
}

void Patchwork::find_near(const Query& query, Collector& collector, Vicinity* /*vicinity*/) const {
  if (const FirstImpact* const only = collector.only()) {
    return query::collect_one(state_->world(only->triangle).index, query, collector);
  }
  // With a tolerance the last digits would depend on the order in which patches came.
  collector.demand(0.0);
  if (state_->lost) {
    if (!collector.takes_unknown(everywhere, query.body.radius, margin)) return;
    Contact all = unknown::nearest(everywhere, margin, query.body, query.from, query.motion);
    all.triangle += first_side;
    return collector.offer(all, margin);
  }
  state_->collect(query, collector);
}

SpaceFacts Patchwork::facts() const {
  return {.bounds = state_->tree.bounds(), .largest_error = error_limit, .revision = state_->revision};
}

Object Patchwork::object(TriangleId triangle) const {
  if (state_->lost) return {no_object, "memory ran out"};
  const Patches& patches = state_->patches;
  const auto number = static_cast<std::uint64_t>(patch(triangle));
  if (number == 0 || number > patches.size() || patches.is_replaced(static_cast<std::uint32_t>(number - 1))) return {};
  const Patch& it = patches[static_cast<std::uint32_t>(number - 1)];
  const TriangleId local = triangle_in_patch(triangle);
  if (it.role != Patch::Role::shown || it.world.has_value() != (local < first_side)) return {};
  if (it.world) return it.world->object(local);
  return {no_object, it.failed ? it.reason : "not loaded yet"};
}

PatchworkStats Patchwork::stats() const {
  const std::lock_guard lock(state_->mutex);
  return state_->stats;
}

}  // namespace roam
