#include "store/pager/planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "store/tile_reader.h"

namespace roam::paging {
namespace {

/// What comes must be wanted sooner by this much than what goes for it, or the two would take turns.
constexpr double hysteresis_factor = 1.25, hysteresis_seconds = 0.05;

/// Seconds until what failed is tried again: at first, and at most.
constexpr double first_retry = 0.05, last_retry = 4.0;

/// Pages come before tiles that are this much farther: without them nobody knows what to bring.
constexpr double page_haste = 0.75;

/// Messages that must find room beside those of a plan: of what is being read.
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

std::uint32_t Planner::units_of(const Thing& thing) const {
  if (!thing.is_page()) return units_for(shape_of(pages_[thing.page].entries[thing.tile]).bytes());
  const store::PageRef& ref = store_.pages[thing.page].ref;
  return units_for(page_bytes(ref.bytes, ref.tiles));
}

Planner::TileState& Planner::state_of(const Thing& thing) {
  PageState& page = pages_[thing.page];
  return thing.is_page() ? page.self : page.tiles[thing.tile];
}

const Planner::TileState& Planner::state_of(const Thing& thing) const {
  const PageState& page = pages_[thing.page];
  return thing.is_page() ? page.self : page.tiles[thing.tile];
}

Run Planner::run_of(const Thing& thing) const { return {state_of(thing).unit, units_of(thing)}; }

Box Planner::box(const Thing& thing) const {
  return thing.is_page() ? store_.pages[thing.page].ref.box : box_of(pages_[thing.page].entries[thing.tile]);
}

// --- what update() answered

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
  const Run run = run_of(gone.thing);
  Request* const request = request_over(run);
  if (gone.kept) {
    state_of(gone.thing).leaving = false;
    if (request) request->state = Request::State::cancelled;
  } else {
    forget(gone.thing);
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

/// What is not in use any more: gives its units back, and those of the tiles of a page.
void Planner::forget(const Thing& thing) {
  units_.release(run_of(thing));
  TileState& state = state_of(thing);
  state.here = state.leaving = false;
  if (!thing.is_page()) return;
  PageState& page = pages_[thing.page];
  for (std::uint32_t i = 0; i < store_.pages[thing.page].ref.tiles; ++i) {
    const TileState& tile = page.tiles[i];
    if (tile.here) units_.release({tile.unit, units_of({thing.page, i})});
    if (tile.why) --failed_;
  }
  page.entries = nullptr;
  page.tiles = nullptr;
}

/// A request that comes to nothing: its units are free again, but for those of what has been kept.
void Planner::end(Request& request) {
  for (std::uint32_t i = request.unit; i < request.unit + request.units; ++i) {
    if (units_.is_reserved(i)) units_.release({i, 1});
  }
  state_of(request.thing).requested = false;
  if (!request.thing.is_page()) --pages_[request.thing.page].requests;
  request = {};
}

// --- what is to come

bool Planner::next(Work& work) {
  settle();
  Traveller traveller;
  {
    const std::lock_guard lock(handover_.mutex);
    if (handover_.told == 0 || handover_.messages.room() < spare_messages) return false;
    traveller = handover_.traveller;
  }
  const auto time = Clock::now();
  if (stale(traveller, time)) plan(traveller, time);
  Request* first = nullptr;
  for (Request& r : requests_) {
    if (r.state == Request::State::ready && (!first || r.key < first->key)) first = &r;
  }
  if (!first) return false;
  first->state = Request::State::reading;
  work.thing = first->thing;
  work.unit = first->unit;
  work.entry = first->thing.is_page() ? nullptr : &pages_[first->thing.page].entries[first->thing.tile];
  return true;
}

bool Planner::stale(const Traveller& now, Clock::time_point time) const {
  if (changed_ || time >= retry_at_ || !now.like(planned_for_)) return true;
  const auto waiting = std::count_if(requests_.begin(), requests_.end(),
                                     [](const Request& r) { return r.state == Request::State::ready; });
  return more_ && waiting < static_cast<std::ptrdiff_t>(most_candidates / 4);
}

void Planner::plan(const Traveller& traveller, Clock::time_point time) {
  planned_for_ = traveller;
  changed_ = more_ = appraised_ = false;
  look_again_at_requests(traveller);
  consider_all(traveller, time);
  for (std::size_t i = 0; i < candidate_count_; ++i) {
    // Its page may have been sent away for one that came before it.
    if (pages_[candidates_[i].thing.page].self.leaving) continue;
    // What is farther must not take the room of what is nearer and did not find any.
    if (!place(candidates_[i], traveller)) break;
  }
  const std::lock_guard lock(handover_.mutex);
  handover_.stats.wanted = wanted_;
  handover_.stats.failed = failed_;
}

void Planner::look_again_at_requests(const Traveller& traveller) {
  for (Request& r : requests_) {
    if (r.state == Request::State::none) continue;
    r.key = traveller.time_to(box(r.thing));
    if (r.state == Request::State::ready && r.key > horizon_ && !filling()) end(r);
  }
}

void Planner::consider_all(const Traveller& traveller, Clock::time_point time) {
  candidate_count_ = 0;
  wanted_ = 0;
  retry_at_ = Clock::time_point::max();
  const double farthest = filling() ? infinite : horizon_;
  for (std::uint32_t p = 0; p < pages_.size(); ++p) {
    const PageState& page = pages_[p];
    const double key = traveller.time_to(store_.pages[p].ref.box);
    if (key > farthest) continue;
    if (!page.self.here) {
      consider({p, Thing::whole}, page.self, page_haste * key, time);
      continue;
    }
    if (page.self.leaving ||
        (key > horizon_ && candidate_count_ == most_candidates && key >= candidates_[candidate_count_ - 1].key)) {
      continue;
    }
    for (std::uint32_t t = 0; t < store_.pages[p].ref.tiles; ++t) {
      const TileState& state = page.tiles[t];
      if (state.here) continue;
      const double tile_key = traveller.time_to(box_of(page.entries[t]));
      if (tile_key <= farthest) consider({p, t}, state, tile_key, time);
    }
  }
}

void Planner::consider(const Thing& thing, const TileState& state, double key, Clock::time_point time) {
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
  *at = {thing, key};
}

bool Planner::place(const Candidate& candidate, const Traveller& traveller) {
  const auto slot = std::find_if(requests_.begin(), requests_.end(),
                                 [](const Request& r) { return r.state == Request::State::none; });
  if (slot == requests_.end()) {
    more_ = true;
    return false;
  }
  const std::uint32_t units = units_of(candidate.thing);
  Request request;
  request.state = Request::State::ready;
  Run run = candidate.key <= horizon_ || filling() ? units_.find(units) : Run{};
  if (run.found()) {
    units_.reserve(run);
  } else if (candidate.key <= horizon_) {
    run = clear(candidate, units, traveller, request);
  }
  if (!run.found()) return false;
  request.thing = candidate.thing;
  request.unit = run.unit;
  request.units = run.count;
  request.key = candidate.key;
  *slot = request;
  state_of(candidate.thing).requested = true;
  if (!candidate.thing.is_page()) ++pages_[candidate.thing.page].requests;
  return true;
}

/// Makes room by sending away what is worth least.
Run Planner::clear(const Candidate& candidate, std::uint32_t units, const Traveller& traveller, Request& request) {
  if (!appraised_) appraise(traveller);
  double worth = 0.0;
  const Run run = units_.cheapest(units, worth);
  if (!run.found() || worth >= worth_of(candidate.key * hysteresis_factor + hysteresis_seconds)) return {};
  // A page after its tiles: then none is spoken of that has gone with its page.
  std::size_t things = 0;
  bool own_page = false;
  units_.for_each(run, [&](const Run&, const Thing& thing) {
    ++things;
    own_page = own_page || (thing.is_page() && thing.page == candidate.thing.page);
  });
  if (own_page) return {};
  const std::lock_guard lock(handover_.mutex);
  if (handover_.messages.room() < spare_messages + things) return {};
  for (const bool pages : {false, true}) {
    units_.for_each(run, [&](const Run& of, const Thing& thing) {
      if (thing.is_page() != pages) return;
      Message message;
      message.kind = Message::Kind::go;
      message.thing = thing;
      handover_.messages.push(message);
      state_of(thing).leaving = true;
      units_.set_worth(of.unit, infinite);
      if (!pages) return;
      const PageState& page = pages_[thing.page];
      for (std::uint32_t i = 0; i < store_.pages[thing.page].ref.tiles; ++i) {
        if (page.tiles[i].here) units_.set_worth(page.tiles[i].unit, infinite);
      }
    });
  }
  request.state = Request::State::clearing;
  request.leaving = static_cast<std::uint32_t>(things);
  for (std::uint32_t i = run.unit; i < run.unit + run.count; ++i) {
    if (units_.is_free(i)) units_.reserve({i, 1});
  }
  return run;
}

void Planner::appraise(const Traveller& traveller) {
  appraised_ = true;
  units_.for_each({0, units_.size()}, [&](const Run& run, const Thing& thing) {
    const TileState& state = state_of(thing);
    const PageState& page = pages_[thing.page];
    const Box where = box(thing);
    const bool stays =
        state.leaving || page.self.leaving || (thing.is_page() && page.requests > 0) || traveller.holds(where);
    units_.set_worth(run.unit, stays ? infinite : worth_of(traveller.time_to(where)));
  });
}

// --- what was read

void Planner::done(const Work& work, const Outcome& outcome) {
  changed_ = changed_ || work.thing.is_page() || outcome.why;
  const auto request = std::find_if(requests_.begin(), requests_.end(), [&](const Request& r) {
    return r.state == Request::State::reading && r.thing == work.thing;
  });
  const Run run{request->unit, request->units};
  TileState& state = state_of(work.thing);
  if (outcome.why) {
    end(*request);
    note_failure(work.thing, outcome.why);
    const double wait =
        std::min(last_retry, first_retry * static_cast<double>(1U << std::min<int>(state.attempts, 10)));
    state.again = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(wait));
    state.attempts = static_cast<std::uint8_t>(std::min(state.attempts + 1, 255));
  } else {
    state.requested = false;
    if (!work.thing.is_page()) --pages_[work.thing.page].requests;
    *request = {};
    units_.give(run, work.thing);
    if (state.why) --failed_;
    state = {};
    state.here = true;
    state.unit = run.unit;
    if (work.thing.is_page()) {
      PageState& page = pages_[work.thing.page];
      page.entries = outcome.page.view.tiles.data();
      page.tiles = reinterpret_cast<TileState*>(outcome.page.tiles + outcome.page.view.tiles.size());
    }
  }
  const std::lock_guard lock(handover_.mutex);
  Message message;
  message.kind = outcome.why ? Message::Kind::failed : Message::Kind::come;
  message.thing = work.thing;
  message.unit = run.unit;
  message.page = outcome.page;
  handover_.messages.push(message);
  PagerStats& stats = handover_.stats;
  stats.bytes_read += outcome.bytes;
  stats.worst_read_s = std::max(stats.worst_read_s, outcome.read_s);
  stats.worst_decode_s = std::max(stats.worst_decode_s, outcome.decode_s);
  stats.failures += outcome.why ? 1 : 0;
  stats.failed = failed_;
  if (outcome.why) handover_.last_failure = {work.thing, box(work.thing), outcome.why};
  // The worst of late: it is forgotten by halves in some fifty loads.
  handover_.latency = std::max(outcome.read_s + outcome.decode_s, 0.985 * handover_.latency);
}

void Planner::note_failure(const Thing& thing, const char* why) {
  TileState& state = state_of(thing);
  if (!state.why) ++failed_;
  state.why = why;
}

std::string Planner::reason(const Thing& thing) const {
  if (thing.page >= pages_.size()) return "";
  const PageState& page = pages_[thing.page];
  if (!thing.is_page() && (!page.entries || thing.tile >= store_.pages[thing.page].ref.tiles)) return "not loaded yet";
  const TileState& state = state_of(thing);
  if (!state.why) return "not loaded yet";
  const std::string what =
      thing.is_page() ? store::name_of(thing.page, box(thing)) : store::name_of(thing.page, thing.tile, box(thing));
  return fmt::format("{} cannot be used: {}", what, state.why);
}

}  // namespace roam::paging
