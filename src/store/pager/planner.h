#pragma once
/// \file
/// Chooses the items to load, their place, and the items to evict. The loading threads use it, one at a time.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "store/opened.h"
#include "store/pager/handover.h"
#include "store/pager/units.h"

namespace roam::paging {

/// One item to be read.
struct Work {
  PagedItem item;
  std::uint32_t unit = 0;
  const store::TileEntry* entry = nullptr;  ///< of a tile
};

/// The result of a Work.
struct Outcome {
  const char* why = nullptr;  ///< the reason of a failure, never freed; null: success
  PageInMemory page;
  double read_s = 0.0, decode_s = 0.0;
  std::uint64_t bytes = 0;
};

class Planner {
 public:
  Planner(const Store::State& store, std::byte* arena, std::uint32_t units, double horizon, Handover& handover);

  /// Takes the results of update() and chooses the next item to read. False if there is nothing to do now.
  bool next(Work& work);
  /// Hands over an item that was read, or schedules a failed one again.
  void done(const Work& work, const Outcome& outcome);
  /// Why an item is unknown, as a text for people.
  [[nodiscard]] std::string reason(const PagedItem& item) const;

  /// State of a tile, or of a page. Those of a page's tiles lie behind the page in memory.
  struct TileState {
    const char* why = nullptr;
    Clock::time_point again{};
    std::uint32_t unit = 0;
    std::uint8_t attempts = 0;
    bool requested = false;
    bool here = false;     ///< in memory
    bool leaving = false;  ///< in memory, and update() is to remove it
  };
  /// Bytes of a page in memory, and the offset at which the states of its tiles begin.
  [[nodiscard]] static std::size_t page_bytes(std::uint32_t coded, std::uint32_t tiles);
  [[nodiscard]] static std::size_t tiles_offset(std::uint32_t coded);
  static constexpr std::size_t page_cost = 128;

 private:
  struct PageState {
    TileState self;
    const store::TileEntry* entries = nullptr;  ///< null: not in memory
    TileState* tiles = nullptr;
    std::uint32_t requests = 0;  ///< requests for its tiles
  };
  struct Request {
    enum class State : std::uint8_t { none, clearing, ready, reading, cancelled };
    State state = State::none;
    PagedItem item;
    std::uint32_t unit = 0, units = 0;
    std::uint32_t leaving = 0;  ///< items still to be evicted
    double key = 0.0;
  };
  struct Candidate {
    PagedItem item;
    double key = 0.0;
  };
  static constexpr std::size_t most_requests = 64;
  static constexpr std::size_t most_candidates = 32;
  /// Items beyond the horizon are loaded while more than 1 / reserve_part of the memory is free.
  static constexpr std::uint32_t reserve_part = 8;

  void settle();
  void settle(const Gone& gone);
  void forget(const PagedItem& item);
  void end(Request& request);
  [[nodiscard]] Request* request_over(const Run& run);
  [[nodiscard]] bool stale(const TrackedBody& now, Clock::time_point time) const;
  void plan(const TrackedBody& tracked, Clock::time_point time);
  void look_again_at_requests(const TrackedBody& tracked);
  void consider_all(const TrackedBody& tracked, Clock::time_point time);
  void consider(const PagedItem& item, const TileState& state, double key, Clock::time_point time);
  [[nodiscard]] bool place(const Candidate& candidate, const TrackedBody& tracked);
  [[nodiscard]] Run clear(const Candidate& candidate, std::uint32_t units, const TrackedBody& tracked,
                          Request& request);
  void appraise(const TrackedBody& tracked);
  [[nodiscard]] Run run_of(const PagedItem& item) const;
  [[nodiscard]] std::uint32_t units_of(const PagedItem& item) const;
  [[nodiscard]] TileState& state_of(const PagedItem& item);
  [[nodiscard]] const TileState& state_of(const PagedItem& item) const;
  [[nodiscard]] Box box(const PagedItem& item) const;
  [[nodiscard]] bool filling() const { return units_.free() > units_.size() / reserve_part; }
  void set_failure(TileState& state, const char* why);

  const Store::State& store_;
  std::byte* arena_;
  double horizon_;
  Handover& handover_;
  Units units_;
  std::vector<PageState> pages_;
  std::array<Request, most_requests> requests_;
  std::array<Candidate, most_candidates> candidates_;
  std::size_t candidate_count_ = 0;
  std::uint64_t wanted_ = 0, failed_ = 0, failed_may_pass_ = 0;
  bool appraised_ = false;  ///< in this plan
  bool full_ = false;       ///< no room was found in this plan
  // State of the last plan.
  TrackedBody planned_for_;
  bool changed_ = true;  ///< an item came, went or failed since
  bool more_ = false;    ///< there were more candidates than fit into the array
  Clock::time_point retry_at_ = Clock::time_point::max();
};

}  // namespace roam::paging
