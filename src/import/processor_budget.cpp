#include "import/processor_budget.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <limits>

namespace roam::reader {
namespace {

constexpr std::uint64_t not_counted = std::numeric_limits<std::uint64_t>::max();

/// Bytes that the process has read by system calls, files again and again included, or not_counted.
std::uint64_t bytes_read_by(int process) {
  std::ifstream counts("/proc/" + std::to_string(process) + "/io");
  std::string name;
  std::uint64_t value = 0;
  while (counts >> name >> value) {
    if (name == "rchar:") return value;
  }
  return not_counted;
}

/// A hole in a file costs its author nothing. A file system that knows no holes says that all is data.
std::uint64_t bytes_without_holes(const std::filesystem::path& file, std::uint64_t size) {
  // As many pieces of data as are looked at: more are an author's game.
  constexpr int pieces = 10'000;
  const int descriptor = open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return 0;
  std::uint64_t bytes = 0;
  off_t end = 0;
  for (int i = 0; i < pieces; ++i) {
    const off_t begin = lseek(descriptor, end, SEEK_DATA);
    if (begin < 0) {
      if (errno != ENXIO) bytes = size;
      break;
    }
    end = lseek(descriptor, begin, SEEK_HOLE);
    if (end <= begin) break;
    bytes += static_cast<std::uint64_t>(end - begin);
  }
  close(descriptor);
  return std::min(bytes, size);
}

}  // namespace

ProcessorBudget::ProcessorBudget(int process) : process_(process) {
  used_before_ = used();
  read_before_ = bytes_read_by(process);
}

void ProcessorBudget::add_file(const std::filesystem::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return;
  if (!files_.insert({status.st_dev, status.st_ino}).second) return;
  file_bytes_ += bytes_without_holes(file, static_cast<std::uint64_t>(status.st_size));
}

std::uint64_t ProcessorBudget::bytes() const {
  // A file may say that it is larger than what is on the disk, and may be read more than once.
  const std::uint64_t read = bytes_read_by(process_);
  return std::min(file_bytes_, read == not_counted ? read : read - std::min(read, read_before_));
}

std::uint64_t ProcessorBudget::triangles() const {
  return std::max(least_triangles, triangles_per_byte * std::min(file_bytes_, std::uint64_t{1} << 60));
}

double ProcessorBudget::allowed() const {
  return std::max(least_seconds, seconds_per_byte * static_cast<double>(bytes()));
}

double ProcessorBudget::used() const {
  clockid_t clock{};
  timespec time{};
  if (clock_getcpuclockid(process_, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0.0;
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec) - used_before_;
}

}  // namespace roam::reader
