#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>
#include <system_error>

#include "files/unnamed_file.h"
#include "import/reader/sandbox/sandbox.h"

#ifdef __linux__
#include <sys/prctl.h>
#endif

// Sanitizers reserve terabytes of address space; a limit on it would end the reader before it begins.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ROAM_SHADOW_MEMORY 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ROAM_SHADOW_MEMORY 1
#endif
#endif

namespace roam::reader {
namespace {

/// A scene's files are read one by one, and each may name others before it is closed.
constexpr rlim_t open_files = 256;

/// A limit that is stricter already stays.
bool limit(int resource, rlim_t value) {
  struct rlimit both {};
  if (getrlimit(static_cast<__rlimit_resource_t>(resource), &both) == 0) value = std::min(value, both.rlim_max);
  both = {value, value};
  return setrlimit(static_cast<__rlimit_resource_t>(resource), &both) == 0;
}

/// Whether no other thread runs: it would not be behind Landlock.
bool is_alone() {
  std::error_code none;
  std::filesystem::directory_iterator thread("/proc/self/task", none);
  return none || std::next(thread) == std::filesystem::directory_iterator();
}

}  // namespace

bool limit_process(const Rights& rights, [[maybe_unused]] int last_descriptor) {
  bool all = true;
#ifdef ROAM_SHADOW_MEMORY
  all = false;
#else
  if (rights.address_space > 0) all = limit(RLIMIT_AS, rights.address_space) && all;
  if (rights.data > 0) all = limit(RLIMIT_DATA, rights.data) && all;
#endif
  // By 1 Linux writes no core dump and starts no program that takes one; by 0 it still starts that.
  all = limit(RLIMIT_CORE, 1) && all;
  all = limit(RLIMIT_NPROC, 0) && all;
  all = limit(RLIMIT_NOFILE, open_files) && all;
  all = limit(RLIMIT_FSIZE, rights.file_size) && all;
  // Beyond it writing fails and is reported, instead of ending the process.
  signal(SIGXFSZ, SIG_IGN);
#ifdef __linux__
  const pid_t parent = getppid();
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(EXIT_FAILURE);
  all = close_range(static_cast<unsigned>(last_descriptor) + 1, ~0u, 0) == 0 && all;
#endif
  return all;
}

bool enter_empty_folder() {
  std::string folder = files::temporary_folder() + "/roam-empty-XXXXXX";
  if (mkdtemp(folder.data()) == nullptr) return false;
  const bool inside = chdir(folder.c_str()) == 0;
  // A folder that is gone takes no new file.
  rmdir(folder.c_str());
  return inside;
}

Confinement enter(const Rights& rights, int highest_landlock) {
  Confinement confinement;
#ifdef __linux__
  confinement.no_new_privileges = prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
#endif
  if (confinement.no_new_privileges) {
    const bool alone = is_alone();
    const int landlock = restrict_files(rights, highest_landlock);
    confinement.landlock = alone ? landlock : 0;
    confinement.system_calls = restrict_system_calls();
  }
  return confinement;
}

}  // namespace roam::reader
