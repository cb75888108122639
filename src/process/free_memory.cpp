#include "process/free_memory.h"

#include <fstream>
#include <string>

namespace roam::process {

std::optional<std::uint64_t> free_memory() {
  std::ifstream in("/proc/meminfo");
  std::string name;
  std::uint64_t kilobytes = 0;
  while (in >> name >> kilobytes) {
    std::string unit;
    std::getline(in, unit);
    if (name == "MemAvailable:") return kilobytes << 10;
  }
  return std::nullopt;
}

}  // namespace roam::process
