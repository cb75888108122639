#pragma once
/// \file
/// The floating-point environment that every result relies on: rounding to nearest, subnormal numbers kept, no
/// exception trapped. The host may have set another one.

#include <cfenv>
#if defined(__SSE2__)
#include <xmmintrin.h>
#elif defined(__aarch64__)
#include <cstdint>
#endif

namespace roam {

/// Sets the default environment and restores the host's at the end of its life. It must be the first statement of a
/// public function that computes, because code that the compiler inlines must not come before it. If the host already
/// has the default, the environment is only read, and exception flags accumulate as in any C function. Otherwise the
/// flags are restored too.
class DefaultFloatingPoint {
 public:
  DefaultFloatingPoint() {
    if (differs_) set_default();
  }
  ~DefaultFloatingPoint() {
    if (differs_) std::fesetenv(&host_);
  }
  DefaultFloatingPoint(const DefaultFloatingPoint&) = delete;
  DefaultFloatingPoint& operator=(const DefaultFloatingPoint&) = delete;

 private:
#if defined(__SSE2__)
  // The functions of <cfenv> set both this unit and the x87 unit.
  static constexpr unsigned flags = 0x3F;         ///< the exception flags of MXCSR
  static constexpr unsigned all_masked = 0x1F80;  ///< the rest of MXCSR when a process begins

  static bool differs() { return __builtin_expect((_mm_getcsr() & ~flags) != all_masked, 0) != 0; }
#elif defined(__aarch64__)
  static bool differs() {
    std::uint64_t control = 0;
    asm volatile("mrs %0, fpcr" : "=r"(control));
    return __builtin_expect(control != 0, 0) != 0;
  }
#else
  static bool differs() { return true; }
#endif

  void set_default() {
    std::fegetenv(&host_);
    std::fesetenv(FE_DFL_ENV);
#if defined(__SSE2__)
    _mm_setcsr(all_masked);  // some C libraries do not restore subnormal numbers
#endif
  }

  const bool differs_ = differs();
  std::fenv_t host_;  // set and used only if differs_
};

}  // namespace roam
