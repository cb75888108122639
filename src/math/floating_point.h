#pragma once
/// \file
/// The floating-point environment that every result counts on: rounding to nearest, subnormal numbers kept, no
/// exception trapped. A host may have set another one.

#include <cfenv>
#if defined(__SSE2__)
#include <xmmintrin.h>
#elif defined(__aarch64__)
#include <cstdint>
#endif

namespace roam {

/// Sets the default environment for its life, and then the host's own again. The first statement of a public function
/// that reckons: what the compiler inlines must not come before it. Where the host has the default one, it is read and
/// not written, and the flags of exceptions grow as in any function of C; else the flags are as before, too.
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
  // What is set by the functions of C is set here and in the x87 unit alike.
  static constexpr unsigned flags = 0x3F;         ///< of MXCSR: which exceptions there were
  static constexpr unsigned all_masked = 0x1F80;  ///< the rest of it, as a process begins

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
    _mm_setcsr(all_masked);  // not every library of C keeps subnormal numbers again
#endif
  }

  const bool differs_ = differs();
  std::fenv_t host_;  // only set, and only used, where it differs
};

}  // namespace roam
