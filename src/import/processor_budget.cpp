#include "import/processor_budget.h"

#include <sys/stat.h>
#include <time.h>

#include <algorithm>
#include <fstream>
#include <limits>

namespace roam::reader {
namespace {

/// Bytes that the process has read by system calls, files again and again included; the largest number where the
/// kernel does not count.
std::uint64_t bytes_read_by(int process) {
  std::ifstream counts("/proc/" + std::to_string(process) + "/io");
  std::string name;
  std::uint64_t value = 0;
  while (counts >> name >> value) {
    if (name == "rchar:") return value;
  }
  return std::numeric_limits<std::uint64_t>::max();
}

}  // namespace

ProcessorBudget::ProcessorBudget(int process) : process_(process) {}

void ProcessorBudget::add_file(const std::filesystem::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return;
  if (!files_.insert({status.st_dev, status.st_ino}).second) return;
  file_bytes_ += static_cast<std::uint64_t>(status.st_size);
}

std::uint64_t ProcessorBudget::bytes() const {
  // A file may say that it is larger than what is on the disk, and may be read more than once.
  return std::min(file_bytes_, bytes_read_by(process_));
}

double ProcessorBudget::allowed() const {
  return std::max(least_seconds, seconds_per_byte * static_cast<double>(bytes()));
}

double ProcessorBudget::used() const {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(process_, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0.0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace roam::reader
