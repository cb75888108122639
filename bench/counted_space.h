#pragma once
/// \file
/// A space that counts what a walker asks of it.

#include <array>
#include <chrono>
#include <cstdint>
#include <string>

#include "roam/space.h"

namespace roam::bench {

/// Passes every query on to another space, counts it and takes its time.
class CountedSpace final : public Space {
 public:
  enum Kind : std::size_t { sweeps, gaps, clearances, contact_lists, floors, kinds };
  static constexpr std::array<const char*, kinds> names{"sweep", "gap", "clearance", "contacts", "floor"};
  struct Tally {
    std::uint64_t asked = 0;
    double nanoseconds = 0.0;  ///< in all, with what reading the clock takes
  };

  explicit CountedSpace(const Space& space) : space_(space) {}

  [[nodiscard]] const std::array<Tally, kinds>& tallies() const { return tallies_; }

 private:
  template <class Ask>
  auto counted(Kind kind, const Ask& ask) const {
    const auto begin = std::chrono::steady_clock::now();
    const auto answer = ask();
    const std::chrono::duration<double, std::nano> passed = std::chrono::steady_clock::now() - begin;
    tallies_[kind].nanoseconds += passed.count();
    ++tallies_[kind].asked;
    return answer;
  }

 public:
  [[nodiscard]] Impact sweep(const Body& body, const Vec3& from, const Vec3& motion) const override {
    return counted(sweeps, [&] { return space_.sweep(body, from, motion); });
  }
  std::size_t contacts(const Body& body, const Vec3& from, const Vec3& motion, double reach,
                       std::span<Contact> contacts) const override {
    return counted(contact_lists, [&] { return space_.contacts(body, from, motion, reach, contacts); });
  }
  using Space::clearance;
  [[nodiscard]] Clearance clearance(const Body& body, const Vec3& from, const Vec3& motion,
                                    double reach) const override {
    return counted(clearances, [&] { return space_.clearance(body, from, motion, reach); });
  }
  [[nodiscard]] double gap(const Body& body, const Vec3& from, const Vec3& motion, double reach) const override {
    return counted(gaps, [&] { return space_.gap(body, from, motion, reach); });
  }
  [[nodiscard]] Impact sweep_in(Vicinity& vicinity, const Body& body, const Vec3& from,
                                const Vec3& motion) const override {
    return counted(sweeps, [&] { return space_.sweep_in(vicinity, body, from, motion); });
  }
  [[nodiscard]] double gap_in(Vicinity& vicinity, const Body& body, const Vec3& from, const Vec3& motion,
                              double reach) const override {
    return counted(gaps, [&] { return space_.gap_in(vicinity, body, from, motion, reach); });
  }
  using Space::floor_clearance;
  [[nodiscard]] Clearance floor_clearance(const Body& body, const Vec3& place, double reach,
                                          const Floor& floor) const override {
    return counted(floors, [&] { return space_.floor_clearance(body, place, reach, floor); });
  }
  [[nodiscard]] Box bounds() const override { return space_.bounds(); }
  [[nodiscard]] double largest_error() const override { return space_.largest_error(); }
  [[nodiscard]] std::string object_name(TriangleId triangle) const override { return space_.object_name(triangle); }
  [[nodiscard]] std::uint64_t revision() const override { return space_.revision(); }
  [[nodiscard]] bool tells_changes() const override { return space_.tells_changes(); }
  [[nodiscard]] double speed_limit() const override { return space_.speed_limit(); }

 private:
  const Space& space_;
  mutable std::array<Tally, kinds> tallies_;
};

}  // namespace roam::bench
