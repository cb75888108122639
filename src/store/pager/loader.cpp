#include "store/pager/loader.h"

#include <fmt/format.h>

#include <new>
#include <system_error>

#include "store/files.h"
#include "store/mask.h"
#include "store/tile_view.h"

namespace roam::paging {
namespace {

/// Sleep of an idle thread, and so the longest delay after a body begins to move.
constexpr std::chrono::milliseconds nap{2};

constexpr const char* unnamed_reason = "whatever reads it has failed";

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

}  // namespace

struct Loaders::Tools {
  store::TileDecoder decoder;
  alignas(128) std::byte coded[store::tile_bytes];
};

Loaders::Loaders(std::shared_ptr<const Store> store, std::byte* arena, Planner& planner, Handover& handover,
                 Names& names, int count)
    : store_(std::move(store)), arena_(arena), handover_(handover), names_(names), planner_(planner) {
  for (int i = 0; i < count; ++i) tools_.push_back(std::make_unique<Tools>());
  threads_.reserve(static_cast<std::size_t>(count) + 1);
  for (int i = 0; i <= count; ++i) {
    try {
      threads_.emplace_back([this, i, count] { i < count ? run(i) : run_names(); });
    } catch (const std::system_error& error) {
      end();
      throw Error(fmt::format("cannot start loading thread {} of {}: {}; give the pager fewer, or end other programs",
                              i + 1, count + 1, error.what()));
    } catch (...) {
      end();
      throw;
    }
  }
}

Loaders::~Loaders() { end(); }

void Loaders::end() {
  {
    const std::lock_guard lock(sleeping_);
    stop_ = true;
  }
  ending_.request_stop();
  wake_.notify_all();
  for (std::thread& t : threads_) t.join();
}

void Loaders::mark(int number, Clock::time_point since) {
  const std::lock_guard lock(handover_.mutex);
  handover_.reading_since[static_cast<std::size_t>(number)] = since;
}

void Loaders::run(int number) {
  for (;;) {
    names_.serve(Names::Kind::reason, [this](TriangleId triangle) { return reason(triangle); });
    Work work;
    bool found = false;
    {
      const std::lock_guard lock(planning_);
      found = planner_.next(work);
    }
    if (found) {
      mark(number, Clock::now());
      const Outcome outcome = load(work, *tools_[static_cast<std::size_t>(number)]);
      mark(number, {});
      const std::lock_guard lock(planning_);
      planner_.done(work, outcome);
    }
    std::unique_lock lock(sleeping_);
    if (stop_ || (!found && wake_.wait_for(lock, nap, [this] { return stop_; }))) return;
  }
}

void Loaders::run_names() {
  for (;;) {
    const bool served =
        names_.serve(Names::Kind::object, [this](TriangleId triangle) { return object_name(triangle); });
    std::unique_lock lock(sleeping_);
    if (stop_ || (!served && wake_.wait_for(lock, nap, [this] { return stop_; }))) return;
  }
}

Outcome Loaders::load(const Work& work, Tools& tools) noexcept {
  Outcome outcome;
  try {
    outcome.why = work.item.is_page() ? load_page(work, outcome) : load_tile(work, tools, outcome);
  } catch (const std::bad_alloc&) {
    outcome.why = "there is no memory left to read it";
  } catch (const std::exception& error) {
    outcome.why = reasons_.keep(error.what());
  } catch (...) {
    outcome.why = unnamed_reason;
  }
  return outcome;
}

const char* Loaders::Reasons::keep(const char* text) noexcept {
  try {
    const std::lock_guard lock(mutex_);
    const auto known = texts_.find(text);
    if (known != texts_.end()) return known->c_str();
    return texts_.size() < most ? texts_.emplace(text).first->c_str() : unnamed_reason;
  } catch (...) {
    return unnamed_reason;
  }
}

const char* Loaders::read(const Work& work, std::span<std::byte> out, Outcome& outcome) const {
  const Store::State& s = store_->state();
  const Store::State::Page& page = s.pages[work.item.page];
  const std::uint64_t offset = work.entry ? work.entry->offset : page.ref.offset;
  const std::uint64_t hash = work.entry ? work.entry->hash : page.ref.hash;
  const auto begin = Clock::now();
  const char* const problem = s.bytes->read_checked(s.packs[page.shard], offset, out, hash, ending_.get_token());
  outcome.read_s = seconds_since(begin);
  if (!problem) outcome.bytes = out.size();
  return problem;
}

const char* Loaders::load_tile(const Work& work, Tools& tools, Outcome& outcome) const {
  if (work.entry->bytes > sizeof tools.coded) return "it has more bytes than a tile may have";
  const std::span<std::byte> coded(tools.coded, work.entry->bytes);
  if (const char* problem = read(work, coded, outcome)) return problem;
  const auto begin = Clock::now();
  const store::TileShape shape = shape_of(*work.entry);
  const std::span<std::byte> out(arena_ + work.unit * unit_bytes, shape.bytes());
  const char* problem = tools.decoder.decode(coded, shape, out);
  if (!problem) problem = store::check_place(*work.entry, store::view_tile(*work.entry, out));
  outcome.decode_s = seconds_since(begin);
  return problem;
}

const char* Loaders::load_page(const Work& work, Outcome& outcome) const {
  const Store::State& s = store_->state();
  const Store::State::Page& page = s.pages[work.item.page];
  std::byte* const memory = arena_ + work.unit * unit_bytes;
  const std::span<std::byte> bytes(memory, page.ref.bytes);
  if (const char* problem = read(work, bytes, outcome)) return problem;
  const auto begin = Clock::now();
  PageInMemory in;
  if (const char* problem = store::view_page_of(s, work.item.page, bytes, in.view)) return problem;
  std::byte* const tiles = memory + Planner::tiles_offset(page.ref.bytes);
  in.tiles = reinterpret_cast<index::Tile*>(tiles);
  for (std::size_t i = 0; i < in.view.tiles.size(); ++i) {
    new (tiles + i * sizeof(index::Tile)) index::Tile(store::absent_tile(in.view.tiles[i]));
  }
  std::byte* const states = tiles + in.view.tiles.size() * sizeof(index::Tile);
  for (std::size_t i = 0; i < in.view.tiles.size(); ++i) {
    new (states + i * sizeof(Planner::TileState)) Planner::TileState();
  }
  outcome.page = in;
  outcome.decode_s = seconds_since(begin);
  return nullptr;
}

/// Nothing if it is not available now. Never throws.
std::optional<std::string> Loaders::object_name(TriangleId triangle) {
  try {
    return store::find_source(store_->state(), triangle, ending_.get_token()).object;
  } catch (...) {
    return std::nullopt;
  }
}

/// Nothing if it is not available now. Never throws.
std::optional<std::string> Loaders::reason(TriangleId triangle) {
  try {
    const std::lock_guard lock(planning_);
    return planner_.reason(unknown_thing(triangle));
  } catch (...) {
    return std::nullopt;
  }
}

}  // namespace roam::paging
