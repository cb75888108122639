#pragma once
/// \file
/// Counts a test program's allocations, and lets one of them fail. Replaces operator new and delete, so only one source
/// file of a program may include it.

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> allocations{0};
/// The number of the failing allocation; 0: none.
[[maybe_unused]] std::atomic<long> failing_allocation{0};
/// Allocations of this thread are not counted and do not fail.
thread_local bool spared = false;
}  // namespace

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // these have an operator new of their own
// Not inlined: g++ would see malloc and free through them and report a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (!spared && ++allocations == failing_allocation) throw std::bad_alloc();
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
#endif
