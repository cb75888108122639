// The counters of clang's coverage, in a file without coverage: in others clang would take these names for its own.
#include <cstdint>
#include <span>

#include "reading.h"

extern "C" {
// Set by the linker; null in programs without coverage.
extern std::uint8_t __start___sancov_cntrs[] __attribute__((weak, visibility("hidden")));
extern std::uint8_t __stop___sancov_cntrs[] __attribute__((weak, visibility("hidden")));
}

namespace fuzz {

std::span<std::uint8_t> counters() {
  if (__start___sancov_cntrs == nullptr) return {};
  return {__start___sancov_cntrs, __stop___sancov_cntrs};
}

}  // namespace fuzz
