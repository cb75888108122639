#pragma once
/// \file
/// Counts what a test program allocates, and lets one allocation fail: replaces operator new and delete, so one source
/// file of a program includes it.

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> allocations{0};
/// The number of the one that fails; 0: none.
[[maybe_unused]] std::atomic<long> failing_allocation{0};
/// Those of this thread are not counted, and do not fail.
thread_local bool spared = false;
}  // namespace

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which have an operator new of their own
// Not inlined: g++ takes malloc and free that it sees through them for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (!spared && ++allocations == failing_allocation) throw std::bad_alloc();
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
#endif
