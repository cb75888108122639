// Confines a reader: limits, an empty folder, then Landlock and seccomp.
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "files/unnamed_file.h"
#include "import/reader/sandbox/sandbox.h"

#ifdef __linux__
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#endif

// Sanitizers reserve terabytes of address space. A limit on it would end the reader at once.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define ROAM_SHADOW_MEMORY 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define ROAM_SHADOW_MEMORY 1
#endif
#endif

namespace roam::reader {
namespace {

/// A scene's files are read one by one, and each may name others while it is open.
constexpr rlim_t open_files = 256;

/// Keeps a limit that is already stricter.
bool limit(int resource, rlim_t value) {
  struct rlimit both {};
  if (getrlimit(static_cast<__rlimit_resource_t>(resource), &both) == 0) value = std::min(value, both.rlim_max);
  both = {value, value};
  return setrlimit(static_cast<__rlimit_resource_t>(resource), &both) == 0;
}

/// Whether no other thread runs, which Landlock would not confine. False if /proc cannot be read.
bool is_alone() {
  std::error_code none;
  std::filesystem::directory_iterator thread("/proc/self/task", none);
  return !none && std::next(thread) == std::filesystem::directory_iterator();
}

#ifdef __linux__
/// Closes every descriptor above `last`. Returns whether it could.
bool close_above(int last) {
  if (close_range(static_cast<unsigned>(last) + 1, ~0u, 0) == 0) return true;
  // For Linux before 5.9, and containers that do not know the call.
  std::vector<int> above;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", none)) {
    const int number = std::atoi(entry.path().filename().c_str());
    if (number > last) above.push_back(number);
  }
  for (const int number : above) close(number);
  return !none;
}

/// Makes the system end this process before its parent when memory runs out.
void be_ended_first() {
  const int file = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  constexpr std::string_view most = "1000";
  [[maybe_unused]] const ssize_t written = write(file, most.data(), most.size());
  close(file);
}

/// Drops the capabilities of root. Returns whether none is left.
bool drop_capabilities() {
  // Only root can drop these, and only root regains them by starting a program.
  for (int right = 0; prctl(PR_CAPBSET_READ, right) >= 0; ++right) prctl(PR_CAPBSET_DROP, right);
  prctl(PR_CAP_AMBIENT, PR_CAP_AMBIENT_CLEAR_ALL, 0, 0, 0);
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> none{};
  return syscall(SYS_capset, &header, none.data()) == 0;
}
#endif

/// Returns whether all limits hold.
bool limit_process(const Rights& rights, [[maybe_unused]] int last_descriptor) {
  bool all = true;
#ifdef ROAM_SHADOW_MEMORY
  all = false;
#else
  if (rights.address_space > 0) all = limit(RLIMIT_AS, rights.address_space) && all;
  if (rights.data > 0) all = limit(RLIMIT_DATA, rights.data) && all;
#endif
  // With 1, Linux writes no core dump and does not start a program that takes one. With 0 it still starts that program.
  all = limit(RLIMIT_CORE, 1) && all;
  all = limit(RLIMIT_NPROC, 0) && all;
  all = limit(RLIMIT_NOFILE, open_files) && all;
  all = limit(RLIMIT_FSIZE, rights.file_size) && all;
  // Writing beyond the limit then fails and is reported, instead of ending the process.
  signal(SIGXFSZ, SIG_IGN);
#ifdef __linux__
  const pid_t parent = getppid();
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(EXIT_FAILURE);
  be_ended_first();
  all = close_above(last_descriptor) && all;
#endif
  return all;
}

/// Moves the process into an empty folder in which no file can be made. Returns whether it could.
bool enter_empty_folder() {
  std::string folder = files::temporary_folder() + "/roam-empty-XXXXXX";
  if (mkdtemp(folder.data()) == nullptr) return false;
  const bool inside = chdir(folder.c_str()) == 0;
  // A removed folder accepts no new file.
  rmdir(folder.c_str());
  return inside;
}

/// Sets no_new_privs, Landlock and seccomp. Returns which of them hold.
Confinement give_up_rights(const Rights& rights, int highest_landlock) {
  Confinement confinement;
#ifdef __linux__
  const bool gains_none = prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
#else
  const bool gains_none = false;
#endif
  if (!gains_none) return confinement;
  const bool alone = is_alone();
  const int landlock = restrict_files(rights, highest_landlock);
  confinement.landlock = alone ? landlock : 0;
#ifdef __linux__
  confinement.no_new_privileges = drop_capabilities();
#endif
  confinement.system_calls = restrict_system_calls();
  return confinement;
}

}  // namespace

Confinement confine(const Rights& rights, int last_descriptor, int highest_landlock,
                    const std::function<void()>& prepare) {
  const bool limits = limit_process(rights, last_descriptor);
  const bool empty_folder = enter_empty_folder();
  prepare();
  Confinement confinement = give_up_rights(rights, highest_landlock);
  confinement.limits = limits;
  confinement.empty_folder = empty_folder;
  return confinement;
}

}  // namespace roam::reader
