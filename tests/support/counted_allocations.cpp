#include "counted_allocations.h"

#include <cstdlib>
#include <new>

std::atomic<long> allocations{0};
std::atomic<long> failing_allocation{0};
std::atomic<bool> failing_on{false};
std::atomic<long> held_allocations{0};
thread_local bool spared = false;

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

void* counted(void* p) {
  if (p == nullptr) throw std::bad_alloc();
  ++held_allocations;
  return p;
}
void release(void* p) {
  if (p != nullptr) --held_allocations;
  std::free(p);
}
void may_fail() {
  if (spared) return;
  const long number = ++allocations, failing = failing_allocation;
  if (failing > 0 && (number == failing || (number > failing && failing_on))) throw std::bad_alloc();
}

}  // namespace

// Not inlined: g++ takes malloc and free that it sees through them for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  may_fail();
  return counted(std::malloc(size));
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  may_fail();
  const auto a = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(a, (size + a - 1) / a * a));
}
[[gnu::noinline]] void operator delete(void* p) noexcept { release(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { release(p); }
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept { release(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept { release(p); }
#endif
