#pragma once
/// Whether this build has a sanitizer of addresses or threads. It takes memory of its own, and its processes have no
/// limit of memory.

#include <gtest/gtest.h>

namespace roam::test {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool has_sanitizer = true;
#else
inline constexpr bool has_sanitizer = false;
#endif

}  // namespace roam::test

/// Skips the test in a build with a sanitizer.
#define ROAM_NEEDS_PLAIN_MEMORY() \
  if (roam::test::has_sanitizer) GTEST_SKIP() << "a sanitizer allocates memory by itself, and has no limit of it"
