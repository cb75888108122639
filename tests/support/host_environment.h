#pragma once
/// \file
/// Floating-point environments that a host may have set.

#include <cfenv>
#include <string>
#include <vector>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace host {

struct Environment {
  int rounding = FE_TONEAREST;
  bool trapped = false;  ///< every exception raises a signal
  bool flushed = false;  ///< subnormal numbers count as 0
};

inline std::string name(const Environment& e) {
  return "rounding " + std::to_string(e.rounding) + (e.trapped ? ", trapped" : "") + (e.flushed ? ", flushed" : "");
}

inline std::vector<Environment> environments() {
  std::vector<Environment> all;
  for (const int rounding : {FE_TONEAREST, FE_DOWNWARD, FE_UPWARD, FE_TOWARDZERO}) {
    for (const bool trapped : {false, true}) {
      for (const bool flushed : {false, true}) all.push_back({rounding, trapped, flushed});
    }
  }
  return all;
}

/// All settings, without the exception flags.
inline std::vector<long> control() {
  std::vector<long> all{std::fegetround(), fegetexcept()};
#if defined(__SSE2__)
  constexpr unsigned flags = 0x3F;
  all.push_back(static_cast<long>(_mm_getcsr() & ~flags));
#elif defined(__aarch64__)
  unsigned long fpcr = 0;
  asm volatile("mrs %0, fpcr" : "=r"(fpcr));
  all.push_back(static_cast<long>(fpcr));
#endif
  return all;
}

/// The exception flag that an environment has from its host.
constexpr int host_flag = FE_DIVBYZERO;

/// Sets an environment and the host's flag for its lifetime. Only call the library meanwhile: a trapped rounding is a
/// signal.
class Set {
 public:
  explicit Set(const Environment& environment) {
    std::fegetenv(&before_);
    std::feclearexcept(FE_ALL_EXCEPT);
    std::fesetround(environment.rounding);
    if (environment.flushed) flush();
    raise();
    if (environment.trapped) feenableexcept(FE_ALL_EXCEPT);
  }
  ~Set() { std::fesetenv(&before_); }
  Set(const Set&) = delete;
  Set& operator=(const Set&) = delete;

 private:
  /// Raises no signal where the exception is trapped later.
  static void raise() {
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | host_flag);  // it has the bits of <cfenv>
#else
    std::feraiseexcept(host_flag);
#endif
  }
  static void flush() {
#if defined(__SSE2__)
    constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x40;
    _mm_setcsr(_mm_getcsr() | flush_to_zero | denormals_are_zero);
#elif defined(__aarch64__)
    unsigned long fpcr = 0;
    asm volatile("mrs %0, fpcr" : "=r"(fpcr));
    asm volatile("msr fpcr, %0" : : "r"(fpcr | 1UL << 24));
#endif
  }

  std::fenv_t before_{};
};

}  // namespace host
