#pragma once
/// \file
/// Counts a test program's allocations, and lets one of them, or all from one on, fail. A program that links this
/// replaces operator new and delete. Sanitizers have an operator new of their own, so nothing is counted there.

#include <atomic>
#include <utility>

extern std::atomic<long> allocations;
extern std::atomic<long> failing_allocation;  ///< number of the allocation that fails; 0: none
extern std::atomic<bool> failing_on;          ///< all after that one fail, too
extern std::atomic<long> held_allocations;    ///< that are not freed
extern thread_local bool spared;              ///< allocations of this thread are not counted and do not fail

/// Spares its thread.
class Spare {
 public:
  Spare() = default;
  Spare(const Spare&) = delete;
  Spare& operator=(const Spare&) = delete;
  ~Spare() { spared = before_; }

 private:
  const bool before_ = std::exchange(spared, true);
};
