#pragma once
/// \file
/// Lets each allocation of some work fail in turn.

#include <functional>
#include <new>

#include "counted_allocations.h"
#include "roam/error.h"

/// Does the work again and again, each time with another allocation that fails, until none of the first `margin` after
/// the last does; how many there were. The work may throw std::bad_alloc and roam::Error. Calls `after` each time, when
/// allocations succeed again.
inline long fail_each(
    const std::function<void()>& work, int margin = 1, const std::function<void()>& after = [] {}) {
  long failed = 0;
  for (int without = 0; without < margin;) {
    allocations = 0;
    failing_allocation = ++failed;
    try {
      work();
    } catch (const roam::Error&) {
    } catch (const std::bad_alloc&) {
    }
    without = allocations < failed ? without + 1 : 0;
    failing_allocation = 0;
    after();
  }
  return failed;
}
