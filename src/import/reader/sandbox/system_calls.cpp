#include "import/reader/sandbox/sandbox.h"

#ifdef __linux__

#include <fcntl.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <initializer_list>
#include <memory>
#include <type_traits>

namespace roam::reader {
namespace {

using Filter = std::unique_ptr<std::remove_pointer_t<scmp_filter_ctx>, void (*)(scmp_filter_ctx)>;

/// Calls for reading files and computing. The names are resolved at run time, because no processor has all of them.
constexpr std::initializer_list<const char*> allowed{
    // open files, and files opened by the rules below
    "read", "pread64", "readv", "preadv", "preadv2", "write", "pwrite64", "writev", "close", "lseek", "_llseek",
    "fstat", "fstat64", "newfstatat", "fstatat64", "stat", "stat64", "lstat", "lstat64", "statx", "statfs", "fstatfs",
    "readlink", "readlinkat", "access", "faccessat", "faccessat2", "getdents", "getdents64", "getcwd", "fadvise64",
    "fadvise64_64", "poll", "ppoll", "ppoll_time64", "select", "pselect6", "dup",
    // memory; rules below cover mmap and mprotect
    "brk", "munmap", "mremap", "madvise", "mincore", "membarrier",
    // time, signals to itself, its own process
    "clock_gettime", "clock_gettime64", "clock_getres", "clock_nanosleep", "clock_nanosleep_time64", "nanosleep",
    "gettimeofday", "time", "rt_sigaction", "rt_sigprocmask", "rt_sigreturn", "sigreturn", "sigaltstack",
    "restart_syscall", "exit", "exit_group", "futex", "futex_time64", "set_robust_list", "get_robust_list", "rseq",
    "sched_yield", "sched_getaffinity", "getpid", "gettid", "getppid", "getuid", "geteuid", "getgid", "getegid",
    "getrusage", "times", "sysinfo", "uname", "getrandom", "getrlimit", "ugetrlimit", "getpriority"};

/// Calls that no scene needs. The process is killed if it tries one.
constexpr std::initializer_list<const char*> killed{
    // programs and processes
    "execve", "execveat", "fork", "vfork", "clone", "clone3", "ptrace", "process_vm_readv", "process_vm_writev", "kill",
    "tkill", "rt_sigqueueinfo", "rt_tgsigqueueinfo", "pidfd_open", "pidfd_getfd", "pidfd_send_signal", "setuid",
    "setgid", "setreuid", "setregid", "setresuid", "setresgid", "capset", "unshare", "setns", "chroot", "pivot_root",
    "mount", "umount2", "open_by_handle_at", "bpf", "perf_event_open", "userfaultfd", "keyctl", "add_key",
    "request_key", "init_module", "finit_module", "kexec_load", "reboot", "io_uring_setup", "memfd_create",
    "memfd_secret",
    // networks and other programs
    "socket", "socketpair", "socketcall", "connect", "bind", "listen", "accept", "accept4", "sendto", "sendmsg",
    "sendmmsg", "recvfrom", "recvmsg", "recvmmsg", "shmget", "shmat", "semget", "msgget", "mq_open",
    // changing files
    "creat", "truncate", "truncate64", "unlink", "unlinkat", "rename", "renameat", "renameat2", "link", "linkat",
    "symlink", "symlinkat", "mkdir", "mkdirat", "rmdir", "mknod", "mknodat", "chmod", "fchmod", "fchmodat", "fchmodat2",
    "chown", "fchown", "lchown", "fchownat", "utime", "utimes", "utimensat", "futimesat", "setxattr", "lsetxattr",
    "fsetxattr", "removexattr", "lremovexattr", "fremovexattr", "openat2", "name_to_handle_at"};

class Rules {
 public:
  explicit Rules(scmp_filter_ctx filter) : filter_(filter) {}

  void add(std::uint32_t action, const char* name, std::initializer_list<scmp_arg_cmp> conditions = {}) {
    const int number = seccomp_syscall_resolve_name(name);
    // A call that this processor lacks needs no rule.
    if (number < 0) return;
    whole_ = whole_ && seccomp_rule_add_array(filter_, action, number, static_cast<unsigned>(conditions.size()),
                                              conditions.begin()) == 0;
  }
  [[nodiscard]] bool whole() const { return whole_; }

 private:
  scmp_filter_ctx filter_;
  bool whole_ = true;
};

scmp_arg_cmp masked(unsigned argument, scmp_datum_t mask, scmp_datum_t value) {
  return {argument, SCMP_CMP_MASKED_EQ, mask, value};
}

/// Allows opening files for reading only. `flags`: the number of the argument with the flags.
void rule_opening(Rules& rules, const char* name, unsigned flags) {
  // O_TMPFILE is O_DIRECTORY and one more bit.
  constexpr scmp_datum_t unnamed_file = O_TMPFILE & ~O_DIRECTORY;
  // A path opened with O_PATH would reveal what lies outside of the scene.
  constexpr scmp_datum_t changing = O_ACCMODE | O_CREAT | O_TRUNC | O_PATH | unnamed_file;
  rules.add(SCMP_ACT_ALLOW, name, {masked(flags, changing, O_RDONLY)});
  for (const scmp_datum_t bit :
       {scmp_datum_t{O_WRONLY}, scmp_datum_t{O_RDWR}, scmp_datum_t{O_CREAT}, scmp_datum_t{O_TRUNC}, unnamed_file}) {
    rules.add(SCMP_ACT_KILL_PROCESS, name, {masked(flags, bit, bit)});
  }
}

/// Memory may be writable or executable, not both, so no new code can enter.
void rule_memory(Rules& rules) {
  constexpr unsigned protection = 2;
  for (const char* name : {"mmap", "mmap2", "mprotect"}) {
    rules.add(SCMP_ACT_ALLOW, name, {masked(protection, PROT_EXEC, 0)});
    rules.add(SCMP_ACT_KILL_PROCESS, name, {masked(protection, PROT_EXEC, PROT_EXEC)});
  }
}

}  // namespace

bool restrict_system_calls() {
  // Calls that are not listed fail as in an older kernel; system libraries can handle that.
  const Filter filter(seccomp_init(SCMP_ACT_ERRNO(ENOSYS)), seccomp_release);
  if (filter == nullptr) return false;
  // The process has set no_new_privs itself.
  seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_NNP, 0);
  // Applies to existing threads too, which Landlock cannot do. See confine().
  seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_TSYNC, 1);
  // Kill calls with another processor's numbers, which the rules do not know.
  seccomp_attr_set(filter.get(), SCMP_FLTATR_ACT_BADARCH, SCMP_ACT_KILL_PROCESS);
  Rules rules(filter.get());
  for (const char* name : allowed) rules.add(SCMP_ACT_ALLOW, name);
  for (const char* name : killed) rules.add(SCMP_ACT_KILL_PROCESS, name);
  rule_opening(rules, "open", 1);
  rule_opening(rules, "openat", 2);
  rule_memory(rules);
  // abort() and assert() send a signal to their own thread.
  rules.add(SCMP_ACT_ALLOW, "tgkill", {{0, SCMP_CMP_EQ, static_cast<scmp_datum_t>(getpid()), 0}});
  // A descriptor may be copied and inspected, but may not send signals to other processes.
  for (const char* name : {"fcntl", "fcntl64"}) {
    for (const scmp_datum_t command : {F_GETFD, F_SETFD, F_GETFL, F_DUPFD, F_DUPFD_CLOEXEC, F_GETLK}) {
      rules.add(SCMP_ACT_ALLOW, name, {{1, SCMP_CMP_EQ, command, 0}});
    }
  }
  // The process may read its limits, but not set them. malloc names its memory.
  rules.add(SCMP_ACT_ALLOW, "prlimit64", {{0, SCMP_CMP_EQ, 0, 0}, {2, SCMP_CMP_EQ, 0, 0}});
#ifdef PR_SET_VMA
  rules.add(SCMP_ACT_ALLOW, "prctl", {{0, SCMP_CMP_EQ, PR_SET_VMA, 0}});
#endif
  return rules.whole() && seccomp_load(filter.get()) == 0;
}

}  // namespace roam::reader

#else

namespace roam::reader {
bool restrict_system_calls() { return false; }
}  // namespace roam::reader

#endif
