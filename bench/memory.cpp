#include "memory.h"

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace roam::bench {

std::size_t allocated_bytes() {
#if defined(__GLIBC__)
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
#else
  return 0;
#endif
}

}  // namespace roam::bench
