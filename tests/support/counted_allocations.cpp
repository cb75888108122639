#include "counted_allocations.h"

#include <cstdlib>
#include <new>

std::atomic<long> allocations{0};
std::atomic<long> failing_allocation{0};
thread_local bool spared = false;

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
void* operator new(std::size_t size) {
  if (!spared && ++allocations == failing_allocation) throw std::bad_alloc();
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
#endif
