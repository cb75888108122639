#pragma once
/// \file
/// Other random cases, for long runs.

#include <cstdint>
#include <cstdlib>
#include <string>

/// `usual`, or another seed for each value of the environment variable ROAM_TEST_SEED (1, 2, ...).
inline std::uint64_t test_seed(std::uint64_t usual) {
  const char* said = std::getenv("ROAM_TEST_SEED");
  return said == nullptr ? usual : usual + 1'000'003 * std::stoull(said);
}
