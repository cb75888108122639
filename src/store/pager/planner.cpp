#include "store/pager/planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "store/tile_reader.h"
#include "store/web/server.h"

namespace roam::paging {
namespace {

/// An incoming item must be needed earlier than the displaced one by this factor and time, or they would alternate.
constexpr double hysteresis_factor = 1.25, hysteresis_seconds = 0.05;

/// Seconds until a failed item is tried again: the first time, and at most.
constexpr double first_retry = 0.05, last_retry = 4.0;

/// Factor of a page's time. Pages come before tiles that are needed at the same time, because the planner does not know
/// tiles without their page.
constexpr double page_haste = 0.75;

/// Places in the message queue that are kept free for the items being read.
constexpr std::size_t spare_messages = 256;

std::uint32_t units_for(std::size_t bytes) { return static_cast<std::uint32_t>((bytes + unit_bytes - 1) / unit_bytes); }

constexpr double infinite = std::numeric_limits<double>::infinity();

double worth_of(double key) { return 1.0 / std::max(key, 1e-3); }

}  // namespace

std::size_t Planner::tiles_offset(std::uint32_t coded) {
  constexpr std::size_t line = sizeof(index::Block);
  return (coded + line - 1) / line * line;
}

std::size_t Planner::page_bytes(std::uint32_t coded, std::uint32_t tiles) {
  return tiles_offset(coded) + tiles * (sizeof(index::Tile) + sizeof(TileState));
}

Planner::Planner(const Store::State& store, std::byte* arena, std::uint32_t units, double horizon, Handover& handover)
    : store_(store), arena_(arena), horizon_(horizon), handover_(handover), units_(units), pages_(store.pages.size()) {
  static_assert(sizeof(PageState) <= page_cost);
}

std::uint32_t Planner::units_of(const PagedItem& item) const {
  if (!item.is_page()) return units_for(shape_of(pages_[item.page].entries[item.tile]).bytes());
  const store::PageRef& ref = store_.pages[item.page].ref;
  return units_for(page_bytes(ref.bytes, ref.tiles));
}

Planner::TileState& Planner::state_of(const PagedItem& item) {
  PageState& page = pages_[item.page];
  return item.is_page() ? page.self : page.tiles[item.tile];
}

const Planner::TileState& Planner::state_of(const PagedItem& item) const {
  const PageState& page = pages_[item.page];
  return item.is_page() ? page.self : page.tiles[item.tile];
}

Run Planner::run_of(const PagedItem& item) const { return {state_of(item).unit, units_of(item)}; }

Box Planner::box(const PagedItem& item) const {
  return item.is_page() ? store_.pages[item.page].ref.box : box_of(pages_[item.page].entries[item.tile]);
}

// --- results of update()

void Planner::settle() {
  for (;;) {
    std::array<Gone, 64> some;
    std::size_t count = 0;
    {
      const std::lock_guard lock(handover_.mutex);
      while (count < some.size() && !handover_.gone.empty()) some[count++] = handover_.gone.pop();
    }
    if (count == 0) return;
    for (std::size_t i = 0; i < count; ++i) settle(some[i]);
  }
}

Planner::Request* Planner::request_over(const Run& run) {
  for (Request& r : requests_) {
    if (r.leaving > 0 && r.unit < run.unit + run.count && run.unit < r.unit + r.units) return &r;
  }
  return nullptr;
}

void Planner::settle(const Gone& gone) {
  changed_ = true;
  const Run run = run_of(gone.item);
  Request* const request = request_over(run);
  if (gone.kept) {
    state_of(gone.item).leaving = false;
    if (request) request->state = Request::State::cancelled;
  } else {
    forget(gone.item);
    if (request) {
      const std::uint32_t begin = std::max(run.unit, request->unit);
      units_.reserve({begin, std::min(run.unit + run.count, request->unit + request->units) - begin});
    }
  }
  if (!request || --request->leaving > 0) return;
  if (request->state == Request::State::clearing) {
    request->state = Request::State::ready;
  } else {
    end(*request);
  }
}

/// Releases the units of an item that is no longer used. A page releases those of its tiles too.
void Planner::forget(const PagedItem& item) {
  units_.release(run_of(item));
  TileState& state = state_of(item);
  state.here = state.leaving = false;
  if (!item.is_page()) return;
  PageState& page = pages_[item.page];
  for (std::uint32_t i = 0; i < store_.pages[item.page].ref.tiles; ++i) {
    TileState& tile = page.tiles[i];
    if (tile.here) units_.release({tile.unit, units_of({item.page, i})});
    set_failure(tile, nullptr);
  }
  page.entries = nullptr;
  page.tiles = nullptr;
}

/// Ends a request without result. Its units become free, except those of items that have been kept.
void Planner::end(Request& request) {
  for (std::uint32_t i = request.unit; i < request.unit + request.units; ++i) {
    if (units_.is_reserved(i)) units_.release({i, 1});
  }
  state_of(request.item).requested = false;
  if (!request.item.is_page()) --pages_[request.item.page].requests;
  request = {};
}

// --- items to load

bool Planner::next(Work& work) {
  settle();
  TrackedBody tracked;
  std::uint64_t told = 0;
  {
    const std::lock_guard lock(handover_.mutex);
    told = handover_.told;
    if (told == 0 || handover_.messages.room() < spare_messages) return false;
    tracked = handover_.tracked;
  }
  const auto time = Clock::now();
  if (stale(tracked, time)) plan(tracked, time);
  Request* first = nullptr;
  for (Request& r : requests_) {
    if (r.state == Request::State::ready && (!first || r.key < first->key)) first = &r;
  }
  if (!first) {
    const bool idle = std::all_of(requests_.begin(), requests_.end(),
                                  [](const Request& r) { return r.state == Request::State::none; });
    if (full_ && idle && !changed_) {
      const std::lock_guard lock(handover_.mutex);
      handover_.full_at = told;
    }
    return false;
  }
  first->state = Request::State::reading;
  work.item = first->item;
  work.unit = first->unit;
  work.entry = first->item.is_page() ? nullptr : &pages_[first->item.page].entries[first->item.tile];
  return true;
}

bool Planner::stale(const TrackedBody& now, Clock::time_point time) const {
  if (changed_ || time >= retry_at_ || !now.like(planned_for_)) return true;
  const auto waiting = std::count_if(requests_.begin(), requests_.end(),
                                     [](const Request& r) { return r.state == Request::State::ready; });
  return more_ && waiting < static_cast<std::ptrdiff_t>(most_candidates / 4);
}

void Planner::plan(const TrackedBody& tracked, Clock::time_point time) {
  planned_for_ = tracked;
  changed_ = more_ = appraised_ = full_ = false;
  look_again_at_requests(tracked);
  consider_all(tracked, time);
  for (std::size_t i = 0; i < candidate_count_; ++i) {
    // Its page may have been evicted for an earlier candidate.
    if (pages_[candidates_[i].item.page].self.leaving) continue;
    // A farther item must not take the room that a nearer item did not find.
    if (!place(candidates_[i], tracked)) break;
  }
  const std::lock_guard lock(handover_.mutex);
  handover_.stats.wanted = wanted_;
  handover_.stats.failed = failed_;
  handover_.stats.failed_may_pass = failed_may_pass_;
  handover_.stats.full = full_;
}

void Planner::look_again_at_requests(const TrackedBody& tracked) {
  for (Request& r : requests_) {
    if (r.state == Request::State::none) continue;
    r.key = tracked.time_to(box(r.item));
    if (r.state == Request::State::ready && r.key > horizon_ && !filling()) end(r);
  }
}

void Planner::consider_all(const TrackedBody& tracked, Clock::time_point time) {
  candidate_count_ = 0;
  wanted_ = 0;
  retry_at_ = Clock::time_point::max();
  const double farthest = filling() ? infinite : horizon_;
  for (std::uint32_t p = 0; p < pages_.size(); ++p) {
    const PageState& page = pages_[p];
    const double key = tracked.time_to(store_.pages[p].ref.box);
    if (key > farthest) continue;
    if (!page.self.here) {
      consider({p, PagedItem::whole}, page.self, page_haste * key, time);
      continue;
    }
    if (page.self.leaving ||
        (key > horizon_ && candidate_count_ == most_candidates && key >= candidates_[candidate_count_ - 1].key)) {
      continue;
    }
    for (std::uint32_t t = 0; t < store_.pages[p].ref.tiles; ++t) {
      const TileState& state = page.tiles[t];
      if (state.here) continue;
      const double tile_key = tracked.time_to(box_of(page.entries[t]));
      if (tile_key <= farthest) consider({p, t}, state, tile_key, time);
    }
  }
}

void Planner::consider(const PagedItem& item, const TileState& state, double key, Clock::time_point time) {
  if (key <= horizon_) ++wanted_;
  if (state.requested || state.leaving) return;
  if (state.why && state.again > time) {
    retry_at_ = std::min(retry_at_, state.again);
    return;
  }
  const auto end = candidates_.begin() + static_cast<std::ptrdiff_t>(candidate_count_);
  const auto at =
      std::upper_bound(candidates_.begin(), end, key, [](double k, const Candidate& c) { return k < c.key; });
  if (candidate_count_ == most_candidates) {
    more_ = true;
    if (at == end) return;
    std::move_backward(at, end - 1, end);
  } else {
    std::move_backward(at, end, end + 1);
    ++candidate_count_;
  }
  *at = {item, key};
}

bool Planner::place(const Candidate& candidate, const TrackedBody& tracked) {
  const auto slot = std::find_if(requests_.begin(), requests_.end(),
                                 [](const Request& r) { return r.state == Request::State::none; });
  if (slot == requests_.end()) {
    more_ = true;
    return false;
  }
  const std::uint32_t units = units_of(candidate.item);
  Request request;
  request.state = Request::State::ready;
  Run run = candidate.key <= horizon_ || filling() ? units_.find(units) : Run{};
  if (run.found()) {
    units_.reserve(run);
  } else if (candidate.key <= horizon_) {
    run = clear(candidate, units, tracked, request);
  }
  if (!run.found()) {
    full_ = candidate.key <= horizon_;
    return false;
  }
  request.item = candidate.item;
  request.unit = run.unit;
  request.units = run.count;
  request.key = candidate.key;
  *slot = request;
  state_of(candidate.item).requested = true;
  if (!candidate.item.is_page()) ++pages_[candidate.item.page].requests;
  return true;
}

/// Makes room by evicting the items that are worth least.
Run Planner::clear(const Candidate& candidate, std::uint32_t units, const TrackedBody& tracked, Request& request) {
  if (!appraised_) appraise(tracked);
  double worth = 0.0;
  const Run run = units_.cheapest(units, worth);
  if (!run.found() || worth >= worth_of(candidate.key * hysteresis_factor + hysteresis_seconds)) return {};
  // A page goes after its tiles. Otherwise a message could name a tile that has gone with its page.
  std::size_t items = 0;
  bool own_page = false;
  units_.for_each(run, [&](const Run&, const PagedItem& item) {
    ++items;
    own_page = own_page || (item.is_page() && item.page == candidate.item.page);
  });
  if (own_page) return {};
  const std::lock_guard lock(handover_.mutex);
  if (handover_.messages.room() < spare_messages + items) {
    changed_ = true;  // when the body's thread has taken some, there may be room
    return {};
  }
  for (const bool pages : {false, true}) {
    units_.for_each(run, [&](const Run& of, const PagedItem& item) {
      if (item.is_page() != pages) return;
      handover_.messages.push({.kind = Message::Kind::go, .item = item});
      state_of(item).leaving = true;
      units_.set_worth(of.unit, infinite);
      if (!pages) return;
      const PageState& page = pages_[item.page];
      for (std::uint32_t i = 0; i < store_.pages[item.page].ref.tiles; ++i) {
        if (page.tiles[i].here) units_.set_worth(page.tiles[i].unit, infinite);
      }
    });
  }
  request.state = Request::State::clearing;
  request.leaving = static_cast<std::uint32_t>(items);
  for (std::uint32_t i = run.unit; i < run.unit + run.count; ++i) {
    if (units_.is_free(i)) units_.reserve({i, 1});
  }
  return run;
}

void Planner::appraise(const TrackedBody& tracked) {
  appraised_ = true;
  units_.for_each({0, units_.size()}, [&](const Run& run, const PagedItem& item) {
    const TileState& state = state_of(item);
    const PageState& page = pages_[item.page];
    const Box where = box(item);
    const bool stays =
        state.leaving || page.self.leaving || (item.is_page() && page.requests > 0) || tracked.holds(where);
    units_.set_worth(run.unit, stays ? infinite : worth_of(tracked.time_to(where)));
  });
}

// --- items that were read

void Planner::done(const Work& work, const Outcome& outcome) {
  changed_ = changed_ || full_ || work.item.is_page() || outcome.why;  // what came may be evicted for something nearer
  const auto request = std::find_if(requests_.begin(), requests_.end(), [&](const Request& r) {
    return r.state == Request::State::reading && r.item == work.item;
  });
  const Run run{request->unit, request->units};
  TileState& state = state_of(work.item);
  if (outcome.why) {
    end(*request);
    set_failure(state, outcome.why);
    const double wait =
        std::min(last_retry, first_retry * static_cast<double>(1U << std::min<int>(state.attempts, 10)));
    state.again = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(wait));
    state.attempts = static_cast<std::uint8_t>(std::min(state.attempts + 1, 255));
  } else {
    state.requested = false;
    if (!work.item.is_page()) --pages_[work.item.page].requests;
    *request = {};
    units_.give(run, work.item);
    set_failure(state, nullptr);
    state = {};
    state.here = true;
    state.unit = run.unit;
    if (work.item.is_page()) {
      PageState& page = pages_[work.item.page];
      page.entries = outcome.page.view.tiles.data();
      page.tiles = reinterpret_cast<TileState*>(outcome.page.tiles + outcome.page.view.tiles.size());
    }
  }
  const std::lock_guard lock(handover_.mutex);
  handover_.messages.push({.kind = outcome.why ? Message::Kind::failed : Message::Kind::come,
                           .item = work.item,
                           .unit = run.unit,
                           .page = outcome.page});
  PagerStats& stats = handover_.stats;
  stats.bytes_read += outcome.bytes;
  stats.longest_read = std::max(stats.longest_read, outcome.read_s);
  stats.longest_decode = std::max(stats.longest_decode, outcome.decode_s);
  stats.failures += outcome.why ? 1 : 0;
  stats.failed = failed_;
  stats.failed_may_pass = failed_may_pass_;
  if (outcome.why) handover_.last_failure = {work.item, box(work.item), outcome.why};
  // A recent maximum: it decays to one half in about fifty loads.
  handover_.latency = std::max(outcome.read_s + outcome.decode_s, 0.985 * handover_.latency);
}

/// `why`: null ends a failure.
void Planner::set_failure(TileState& state, const char* why) {
  if (state.why) {
    --failed_;
    if (web::may_pass(state.why)) --failed_may_pass_;
  }
  if (why) {
    ++failed_;
    if (web::may_pass(why)) ++failed_may_pass_;
  }
  state.why = why;
}

std::string Planner::reason(const PagedItem& item) const {
  if (item.page >= pages_.size()) return "";
  const PageState& page = pages_[item.page];
  if (!item.is_page() && (!page.entries || item.tile >= store_.pages[item.page].ref.tiles)) return "not loaded yet";
  const TileState& state = state_of(item);
  if (!state.why) return "not loaded yet";
  const std::string what =
      item.is_page() ? store::name_of(item.page, box(item)) : store::name_of(item.page, item.tile, box(item));
  return fmt::format("{} cannot be used: {}", what, state.why);
}

}  // namespace roam::paging
