#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "import/reader/file_names.h"
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

bool limit(int resource, rlim_t value) {
  const struct rlimit both { value, value };
  return setrlimit(static_cast<__rlimit_resource_t>(resource), &both) == 0;
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
  all = limit(RLIMIT_CORE, 0) && all;
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
  std::string folder = temporary_folder() + "/roam-empty-XXXXXX";
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
    confinement.landlock = restrict_files(rights, highest_landlock);
    confinement.system_calls = restrict_system_calls();
  }
  return confinement;
}

}  // namespace roam::reader
