#pragma once
/// \file
/// A space that counts a walker's queries.

#include <array>
#include <chrono>
#include <cstdint>
#include <string>

#include "roam/collector.h"

namespace roam::bench {

/// Passes every query on to another space, counts it and times it.
class CountedSpace final : public Space {
 public:
  enum Kind : std::size_t { sweeps, gaps, clearances, contact_lists, floors, kinds };
  static constexpr std::array<const char*, kinds> names{"sweep", "gap", "clearance", "contacts", "floor"};
  struct Tally {
    std::uint64_t asked = 0;
    double nanoseconds = 0.0;  ///< in total, including reading the clock
  };

  explicit CountedSpace(const Space& space) : space_(space) {}

  [[nodiscard]] const std::array<Tally, kinds>& tallies() const { return tallies_; }
  [[nodiscard]] SpaceFacts facts() const override { return space_.facts(); }
  [[nodiscard]] Object object(TriangleId triangle) const override { return space_.object(triangle); }

 protected:
  [[nodiscard]] FirstImpact find_first(const Query& query, Vicinity* vicinity) const override {
    const Timed timed{tallies_[sweeps]};
    ++tallies_[sweeps].asked;
    return Space::find_first_of(space_, query, vicinity);
  }
  void find_near(const Query& query, Collector& collector, Vicinity* vicinity) const override {
    // The contact of a sweep counts as part of the sweep.
    const bool completes = collector.kind() == Collector::Kind::one_contact;
    const Kind kind = completes ? sweeps : kind_of(collector);
    const Timed timed{tallies_[kind]};
    tallies_[kind].asked += completes ? 0 : 1;
    Space::find_near_of(space_, query, collector, vicinity);
  }

 private:
  struct Timed {
    Tally& tally;
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
    ~Timed() {
      const std::chrono::duration<double, std::nano> passed = std::chrono::steady_clock::now() - begin;
      tally.nanoseconds += passed.count();
    }
  };

  static Kind kind_of(const Collector& collector) {
    switch (collector.kind()) {
      case Collector::Kind::gap:
        return gaps;
      case Collector::Kind::clearance:
        return clearances;
      case Collector::Kind::floor_clearance:
        return floors;
      default:
        return contact_lists;
    }
  }

  const Space& space_;
  mutable std::array<Tally, kinds> tallies_;
};

}  // namespace roam::bench
