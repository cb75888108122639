#pragma once
/// The memory that some work needs at its peak.

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <string>

#include "roam/error.h"

namespace memory_cost {

inline std::uint64_t status_kilobytes(const char* field) {
  std::ifstream in("/proc/self/status");
  std::string name;
  std::uint64_t value = 0;
  while (in >> name) {
    if (name == std::string(field) + ":" && in >> value) return value;
    in.ignore(1000, '\n');
  }
  return 0;
}

/// The growth of the process at its peak, in MiB, and the message of the roam::Error thrown, if any.
struct Cost {
  std::uint64_t mebibytes = 0;
  std::string said;
};
template <class Work>
Cost cost_of(Work&& work) {
  std::ofstream("/proc/self/clear_refs") << 5;  // sets the peak to the present
  const std::uint64_t before = status_kilobytes("VmRSS");
  Cost cost;
  try {
    work();
  } catch (const roam::Error& error) {
    cost.said = error.what();
  }
  cost.mebibytes = (std::max(status_kilobytes("VmHWM"), before) - before) >> 10;
  return cost;
}

}  // namespace memory_cost
