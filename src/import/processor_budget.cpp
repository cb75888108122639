#include "import/processor_budget.h"

#include <sys/stat.h>
#include <sys/vfs.h>
#include <time.h>

#include <algorithm>
#include <fstream>
#include <limits>

namespace roam::reader {
namespace {

constexpr std::uint64_t not_counted = std::numeric_limits<std::uint64_t>::max();

/// Bytes that the process has read by system calls, repeated reads included; or not_counted.
std::uint64_t bytes_read_by(int process) {
  std::ifstream counts("/proc/" + std::to_string(process) + "/io");
  std::string name;
  std::uint64_t value = 0;
  while (counts >> name >> value) {
    if (name == "rchar:") return value;
  }
  return not_counted;
}

/// Whether the file system reports truly how much of a file is on the disk. Others report 0, or too little.
bool counts_blocks(const std::filesystem::path& file) {
  struct statfs system {};
  if (statfs(file.c_str(), &system) != 0) return true;
  for (const long known : {0xEF53L /* ext */, 0x58465342L /* xfs */, 0x9123683EL /* btrfs */, 0x01021994L /* tmpfs */,
                           0x794C7630L /* overlayfs */, 0xF2F52010L /* f2fs */}) {
    if (static_cast<unsigned long>(system.f_type) == static_cast<unsigned long>(known)) return true;
  }
  return false;
}

}  // namespace

double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

ProcessorBudget ProcessorBudget::from_now_on(int process) {
  ProcessorBudget budget(process);
  budget.used_before_ = budget.used();
  budget.read_before_ = bytes_read_by(process);
  return budget;
}

void ProcessorBudget::add_file(const std::filesystem::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return;
  if (!files_.insert({status.st_dev, status.st_ino}).second) return;
  const auto size = static_cast<std::uint64_t>(status.st_size);
  // A hole in a file costs its author nothing. Some file systems compress data.
  constexpr std::uint64_t block = 512, compression = 16;
  const auto on_disk = compression * block * static_cast<std::uint64_t>(status.st_blocks);
  const std::uint64_t bytes = counts_blocks(file) ? std::min(size, on_disk) : size;
  file_bytes_ += bytes;
  if (scene_ != nullptr) scene_->add_file({status.st_dev, status.st_ino}, bytes);
}

void SceneBudget::add_file(const std::pair<std::uint64_t, std::uint64_t>& file, std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  if (files_.insert(file).second) file_bytes_ += bytes;
}

void SceneBudget::add_entry(const std::filesystem::path& archive, std::uint64_t begin) {
  const std::lock_guard lock(mutex_);
  entries_.emplace(archive, begin);
}

bool SceneBudget::add(double seconds) {
  const std::lock_guard lock(mutex_);
  seconds_ += seconds;
  return seconds_ <= allowed_now();
}

double SceneBudget::allowed() const {
  const std::lock_guard lock(mutex_);
  return allowed_now();
}

double SceneBudget::allowed_now() const {
  return ProcessorBudget::least_seconds + seconds_per_file * static_cast<double>(files_.size() + entries_.size()) +
         ProcessorBudget::seconds_per_byte * static_cast<double>(file_bytes_);
}

std::uint64_t ProcessorBudget::bytes() const {
  // A sparse file may state a size that is not on the disk, and a file may be read more than once. The lesser number
  // counts.
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
