#pragma once
/// \file
/// The floating-point environment that every result counts on: rounding to nearest, subnormal numbers kept, no
/// exception trapped. A host may have set another one.

#if defined(__SSE2__)
#include <xmmintrin.h>
#elif defined(__aarch64__)
#include <cstdint>
#else
#include <cfenv>
#endif

namespace roam {

/// Sets the default environment for its life, and then the host's own again. The first statement of a public function
/// that reckons: what the compiler inlines must not come before it. Where the host has the default one, it is read and
/// not written, and the flags of exceptions grow as in any function of C; else the flags are as before, too.
class DefaultFloatingPoint {
 public:
  DefaultFloatingPoint() {
    if (differs()) set_default();
  }
  ~DefaultFloatingPoint() {
    if (differs()) restore();
  }
  DefaultFloatingPoint(const DefaultFloatingPoint&) = delete;
  DefaultFloatingPoint& operator=(const DefaultFloatingPoint&) = delete;

 private:
#if defined(__SSE2__)
  static constexpr unsigned flags = 0x3F;         ///< of MXCSR: which exceptions there were
  static constexpr unsigned all_masked = 0x1F80;  ///< the rest of it, as a process begins

  [[nodiscard]] bool differs() const { return __builtin_expect((host_ & ~flags) != all_masked, 0) != 0; }
  static void set_default() { _mm_setcsr(all_masked); }
  void restore() const { _mm_setcsr(host_); }

  const unsigned host_ = _mm_getcsr();
#elif defined(__aarch64__)
  // FPCR holds no flags; they are in FPSR.
  static std::uint64_t read() {
    std::uint64_t control = 0;
    asm volatile("mrs %0, fpcr" : "=r"(control));
    return control;
  }
  static std::uint64_t read_flags() {
    std::uint64_t flags = 0;
    asm volatile("mrs %0, fpsr" : "=r"(flags));
    return flags;
  }
  [[nodiscard]] bool differs() const { return __builtin_expect(host_ != 0, 0) != 0; }
  void set_default() {
    host_flags_ = read_flags();
    asm volatile("msr fpcr, xzr" : : : "memory");
  }
  void restore() const { asm volatile("msr fpcr, %0\n\tmsr fpsr, %1" : : "r"(host_), "r"(host_flags_) : "memory"); }

  const std::uint64_t host_ = read();
  std::uint64_t host_flags_ = 0;
#else
  [[nodiscard]] static bool differs() { return true; }
  void set_default() {
    std::fegetenv(&host_);
    std::fesetenv(FE_DFL_ENV);
  }
  void restore() const { std::fesetenv(&host_); }

  std::fenv_t host_{};
#endif
};

}  // namespace roam
