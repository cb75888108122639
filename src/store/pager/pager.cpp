#include "roam/pager.h"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <new>
#include <thread>

#include "math/floating_point.h"
#include "math/largest.h"
#include "store/pager/loader.h"
#include "store/pager/paged_scene.h"
#include "store/pager/speed_limiter.h"
#include "store/tile_reader.h"
#include "world/scene_queries.h"
#include "world/vicinity.h"

namespace roam {
namespace {

using namespace paging;

/// Most changes that one update makes; each takes about 50 ns.
constexpr int most_changes = 64;

/// Metres. Even for the shortest wait, the space that the body occupies must be known.
constexpr double least_wait_reach = 1e-3;

/// Bytes for all data whose size depends on no store and no option.
constexpr std::uint64_t fixed_cost = 512 << 10;

/// Part of the memory that loading threads take unless the options say how many there are.
constexpr std::uint64_t loaders_part = 8;

struct Plan {
  std::uint64_t memory = 0;
  std::uint32_t units = 0;
  int loaders = 1;
};

/// Divides the memory between tables and items.
Plan divide(const Store::State& store, const PagerOptions& options) {
  if (options.memory < Pager::least_memory) {
    throw Error(fmt::format("a pager with {} bytes of memory: it needs {} MiB at least", options.memory,
                            Pager::least_memory >> 20));
  }
  if (options.loaders < 0 || options.loaders > static_cast<int>(Handover::most_loaders)) {
    throw Error(fmt::format(
        "a pager with {} loading threads: 1 to 16 are possible, and 0 for as many as suit the store", options.loaders));
  }
  if (!(options.horizon > 0.0 && options.horizon <= 3600.0)) {
    throw Error(
        fmt::format("a pager that looks {} s ahead: more than 0 and at most 3600 are possible", options.horizon));
  }
  Plan plan;
  const auto that_fit = static_cast<int>(std::min<std::uint64_t>(options.memory / (loaders_part * Loaders::cost), 16));
  plan.loaders =
      options.loaders > 0 ? options.loaders : std::clamp(store.bytes->best_at_once(), 1, std::max(1, that_fit));
  const std::uint64_t threads = static_cast<std::uint64_t>(plan.loaders) * Loaders::cost;
  const std::uint64_t tables = store.pages.size() * (Residents::page_cost + Planner::page_cost);
  // The largest pages and tiles that may have to be in memory together.
  std::uint64_t page = 0;
  for (const Store::State::Page& p : store.pages) {
    page = std::max<std::uint64_t>(page, Planner::page_bytes(p.ref.bytes, p.ref.tiles) + unit_bytes);
  }
  const std::uint64_t least =
      std::max(2 * tables, tables + 4 * page + 8 * store::tile_bytes) + threads + fixed_cost + store.memory;
  if (options.memory < least) {
    throw Error(
        store.name,
        fmt::format("{} MiB of memory are not enough for its index and {} loading threads; give the pager {} MiB",
                    options.memory >> 20, plan.loaders, (least >> 20) + 1));
  }
  const std::uint64_t rest = options.memory - threads - tables - fixed_cost - store.memory;
  plan.units = static_cast<std::uint32_t>(std::min<std::uint64_t>(rest / (unit_bytes + Units::unit_cost),
                                                                  UINT32_MAX / (unit_bytes / sizeof(index::Block))));
  plan.memory = threads + tables + fixed_cost + store.memory + plan.units * (unit_bytes + Units::unit_cost);
  return plan;
}

/// Memory that the system has committed: every byte of it has been written.
class Memory {
 public:
  explicit Memory(std::size_t bytes) : bytes_(static_cast<std::byte*>(::operator new(bytes, alignment))) {
    // Large pages, where the system has them: a step into new tiles then misses the address cache no more than others.
    ::madvise(bytes_, bytes, MADV_HUGEPAGE);
    std::memset(bytes_, 0, bytes);
  }
  ~Memory() { ::operator delete(bytes_, alignment); }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  [[nodiscard]] std::byte* get() const { return bytes_; }

 private:
  static constexpr std::align_val_t alignment{2 << 20};
  std::byte* bytes_;
};

}  // namespace

struct Pager::State {
  State(std::shared_ptr<const Store> of, const PagerOptions& options)
      : store(std::move(of)),
        plan(divide(store->state(), options)),
        arena(plan.units * unit_bytes),
        residents(store->state(), arena.get()),
        planner(store->state(), arena.get(), plan.units, options.horizon, handover),
        speed_limiter(options.horizon),
        loaders(store, arena.get(), planner, handover, names, plan.loaders) {
    handover.stats.memory = plan.memory;
  }

  std::shared_ptr<const Store> store;
  Plan plan;
  Memory arena;
  mutable Handover handover;
  Names names;

  // Used by the thread that moves the body.
  Residents residents;
  std::uint64_t revision = next_revision();  ///< different from that of every other space
  std::uint64_t tiles = 0, pages = 0, triangles = 0, used = 0, loads = 0, evictions = 0;

  Planner planner;  ///< used by the loading threads
  SpeedLimiter speed_limiter;
  Loaders loaders;  ///< last member, so that the threads end first

  void count(const PagedItem& item, bool comes);
  [[nodiscard]] bool take(const Message& message, const TrackedBody& tracked);
  [[nodiscard]] bool exchange(const TrackedBody& tracked, double& latency);
  /// Handover::told
  [[nodiscard]] std::uint64_t told() const;
  /// Whether memory was full, with nothing on its way, for a body that update() has set since told() was this.
  [[nodiscard]] bool holds_no_more(std::uint64_t told_before) const;
  /// The scene for a query of `reach` (m).
  [[nodiscard]] PagedScene scene(const Query& query, double reach, Vicinity* vicinity) const;
};

/// Updates the counters when an item comes or goes.
void Pager::State::count(const PagedItem& item, bool comes) {
  const std::uint64_t one = comes ? 1 : ~std::uint64_t{0};
  ++(comes ? loads : evictions);
  if (item.is_page()) {
    const store::PageRef& ref = store->state().pages[item.page].ref;
    pages += one;
    used += one * Planner::page_bytes(ref.bytes, ref.tiles);
  } else {
    const store::TileEntry& entry = residents.page(item.page).in.view.tiles[item.tile];
    tiles += one;
    triangles += one * entry.triangles;
    used += one * shape_of(entry).bytes();
  }
}

/// Applies a message. Returns whether the space has changed.
bool Pager::State::take(const Message& message, const TrackedBody& tracked) {
  const PagedItem& item = message.item;
  switch (message.kind) {
    case Message::Kind::come:
      if (item.is_page()) {
        residents.put_page(item.page, message.page);
      } else {
        residents.put_tile(item, message.unit);
      }
      count(item, true);
      return true;
    case Message::Kind::failed:
      residents.fail(item);
      return false;
    case Message::Kind::go:
      break;
  }
  const bool kept = tracked.holds(residents.box(item));
  handover.gone.push({item, kept});
  if (kept) return false;
  if (item.is_page()) {
    const PageInMemory& in = residents.page(item.page).in;
    for (std::uint32_t i = 0; i < in.view.tiles.size(); ++i) {
      if (!in.tiles[i].absent()) count({item.page, i}, false);
    }
  }
  count(item, false);
  residents.take(item);
  return true;
}

/// Takes what the loading threads have brought, and gives them the tracked body. Returns false if the lock is taken;
/// the next update tries again.
bool Pager::State::exchange(const TrackedBody& tracked, double& latency) {
  const std::unique_lock lock(handover.mutex, std::try_to_lock);
  if (!lock) return false;
  handover.tracked = tracked;
  ++handover.told;
  bool changed = false;
  for (int i = 0; i < most_changes && !handover.messages.empty() && handover.gone.room() > 0; ++i) {
    changed = take(handover.messages.pop(), tracked) || changed;
  }
  latency = handover.latency;
  const auto now = Clock::now();
  for (const Clock::time_point since : handover.reading_since) {
    if (since != Clock::time_point{}) latency = std::max(latency, std::chrono::duration<double>(now - since).count());
  }
  PagerStats& s = handover.stats;
  s.tiles = tiles;
  s.pages = pages;
  s.triangles = triangles;
  s.used = used;
  s.loads = loads;
  s.evictions = evictions;
  s.ready_radius = speed_limiter.ready();
  return changed;
}

std::uint64_t Pager::State::told() const {
  const std::lock_guard lock(handover.mutex);
  return handover.told;
}

bool Pager::State::holds_no_more(std::uint64_t told_before) const {
  const std::lock_guard lock(handover.mutex);
  return handover.full_at > told_before && handover.messages.empty();
}

namespace {

std::shared_ptr<const Store> demand(std::shared_ptr<const Store> store) {
  if (!store) throw Error("a pager needs a store, and was given none; open one with Store::open");
  return store;
}

}  // namespace

Pager::Pager(std::shared_ptr<const Store> store, const PagerOptions& options)
    : state_([&] {
        const DefaultFloatingPoint guard;  // which the loading threads inherit
        return std::make_unique<State>(demand(std::move(store)), options);
      }()) {}
Pager::~Pager() = default;

bool Pager::update(const Body& body, const Vec3& place, const Vec3& velocity) {
  const DefaultFloatingPoint guard;
  query::check_update(body, place, velocity);
  State& s = *state_;
  const TrackedBody tracked(body, place, velocity);
  double latency = s.speed_limiter.latency();
  const bool changed = s.exchange(tracked, latency);
  if (changed) s.revision = next_revision();
  const bool complete = s.tiles == s.store->info().tiles;
  s.speed_limiter.look(s.residents, tracked, latency, changed, complete);
  return changed;
}

bool Pager::wait(const Body& body, const Vec3& place, const Vec3& velocity, double seconds, double ahead,
                 const std::function<bool()>& goes_on) {
  const DefaultFloatingPoint guard;
  const auto begin = Clock::now();
  const auto limit = std::chrono::duration<double>(seconds);
  State& s = *state_;
  const std::uint64_t told_before = s.told();
  for (;;) {
    (void)update(body, place, velocity);
    const TrackedBody tracked(body, place, velocity);
    const double reach = std::clamp(tracked.pace() * ahead, least_wait_reach, reach_limit);
    if (!s.speed_limiter.anything_coming(s.residents, tracked, reach)) {
      s.speed_limiter.forget_latency();
      return true;
    }
    if (Clock::now() - begin >= limit || s.holds_no_more(told_before) || (goes_on && !goes_on())) return false;
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  }
}

PagedScene Pager::State::scene(const Query& query, double reach, Vicinity* vicinity) const {
  if (vicinity == nullptr) return {residents, nullptr, query.ignored};
  const QueryRegion region{query.body, query.from, query.motion, reach, store->info().largest_error, revision};
  const auto gathered = [this](const Box& box, index::Roots& out) { return gather(residents, box, out); };
  return {residents, roots_in(*vicinity, region, gathered), query.ignored};
}

FirstImpact Pager::find_first(const Query& query, Vicinity* vicinity) const {
  PagedScene scene = state_->scene(query, query::hit_reach, vicinity);
  return query::first_of(scene, query);
}

void Pager::find_near(const Query& query, Collector& collector, Vicinity* vicinity) const {
  if (const FirstImpact* const only = collector.only()) {
    return query::collect_one(index_of(state_->residents, *only), query, collector);
  }
  if (state_->store->info().lossless) collector.demand(query::lossless_tolerance);
  query::collect_of(state_->scene(query, collector.initial_reach(), vicinity), query, {}, collector);
}

SpaceFacts Pager::facts() const {
  const auto& info = state_->store->info();
  return {.bounds = info.bounds,
          .largest_error = info.largest_error,
          .revision = state_->revision,
          .speed_limit = state_->speed_limiter.limit()};
}

Object Pager::object(TriangleId triangle) const {
  return triangle == no_triangle ? Object{} : Object{no_object, state_->names.ask(triangle)};
}

const Store& Pager::store() const { return *state_->store; }

PagerStats Pager::stats() const {
  Handover& h = state_->handover;
  std::unique_lock lock(h.mutex);
  PagerStats stats = h.stats;
  for (const Clock::time_point since : h.reading_since) stats.reading += since != Clock::time_point{} ? 1 : 0;
  const auto failure = h.last_failure;
  lock.unlock();
  if (failure.why) {
    const std::string what = failure.item.is_page() ? store::name_of(failure.item.page, failure.box)
                                                    : store::name_of(failure.item.page, failure.item.tile, failure.box);
    stats.last_failure = fmt::format("{} cannot be used: {}", what, failure.why);
  }
  return stats;
}

}  // namespace roam
