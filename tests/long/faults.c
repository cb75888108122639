// Makes system calls of a program go wrong: cc -shared -fPIC -o faults.so faults.c, then LD_PRELOAD=faults.so.
//
//   FAULT_CALLS=fsync,rename  which calls: read pread write pwrite truncate open fsync rename link mkdir unlink, by any
//                             of their names in C (rename, renameat, renameat2); all where not set
//   FAULT_AT=N                the N-th of them, over all threads of a process (0: none, they are only counted)
//   FAULT_KIND=KIND           kill: ends the process instead of the call; after: when the call is done;
//                             short: all reads and writes transfer half of what is asked, and every third is
//                             interrupted first (FAULT_AT is not used); a number: the call fails with this errno
//   FAULT_ON=1                not only the N-th fails, but all from there on
//   FAULT_PROGRAM=NAME        only in processes of this program
//   FAULT_COUNT=FILE          how many calls there were is written there when the process ends
//
// strace's inject does much the same, but counts the calls of each thread by itself.
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

static atomic_long count;
static long at;
static int on, error_number, shortens, kills, kills_after, enabled;
static const char* calls;

__attribute__((constructor)) static void begin(void) {
  const char* program = getenv("FAULT_PROGRAM");
  if (program != NULL && strcmp(program, program_invocation_short_name) != 0) return;
  const char* kind = getenv("FAULT_KIND");
  const char* number = getenv("FAULT_AT");
  if (kind == NULL) kind = "0";
  at = number == NULL ? 0 : atol(number);
  on = getenv("FAULT_ON") != NULL;
  calls = getenv("FAULT_CALLS");
  kills = strcmp(kind, "kill") == 0;
  kills_after = strcmp(kind, "after") == 0;
  shortens = strcmp(kind, "short") == 0;
  error_number = atoi(kind);
  enabled = 1;
}

__attribute__((destructor)) static void end(void) {
  const char* file = getenv("FAULT_COUNT");
  if (!enabled || file == NULL) return;
  const int descriptor = (int)syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  dprintf(descriptor, "%ld\n", (long)count);
  close(descriptor);
}

static int chosen(const char* name) {
  if (!enabled) return 0;
  if (calls == NULL) return 1;
  const size_t length = strlen(name);
  for (const char* p = calls; (p = strstr(p, name)) != NULL; p += length) {
    if ((p == calls || p[-1] == ',') && (p[length] == ',' || p[length] == '\0')) return 1;
  }
  return 0;
}

enum { goes_on, fails, dies_after };

static int fault(const char* name) {
  if (!chosen(name)) return goes_on;
  const long n = ++count;
  if (at == 0 || (on ? n < at : n != at)) return goes_on;
  if (kills) kill(getpid(), SIGKILL);
  if (kills_after) return dies_after;
  errno = error_number;
  return error_number != 0 ? fails : goes_on;
}

#define CALL(name, type, call)               \
  const int what = fault(name);              \
  if (what == fails) return -1;              \
  const type result = (call);                \
  if (what == dies_after) {                  \
    const int was = errno;                   \
    if (result >= 0) kill(getpid(), SIGKILL); \
    errno = was;                             \
  }                                          \
  return result

/// Half of the size for files, once it is its turn; 0 where the call is interrupted.
static size_t shortened(const char* name, int descriptor, size_t size) {
  struct stat status;
  if (!shortens || !chosen(name) || size < 2 || fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    return size;
  }
  return ++count % 3 == 0 ? 0 : (size + 1) / 2;
}
#define SHORTENED(name)                        \
  if (shortens) {                              \
    const size_t asked = size;                 \
    size = shortened(name, descriptor, asked); \
    if (size == 0 && asked != 0) {             \
      errno = EINTR;                           \
      return -1;                               \
    }                                          \
  }

ssize_t read(int descriptor, void* bytes, size_t size) {
  SHORTENED("read")
  CALL("read", ssize_t, syscall(SYS_read, descriptor, bytes, size));
}
ssize_t write(int descriptor, const void* bytes, size_t size) {
  SHORTENED("write")
  CALL("write", ssize_t, syscall(SYS_write, descriptor, bytes, size));
}
ssize_t pread(int descriptor, void* bytes, size_t size, off_t offset) {
  SHORTENED("pread")
  CALL("pread", ssize_t, syscall(SYS_pread64, descriptor, bytes, size, offset));
}
ssize_t pwrite(int descriptor, const void* bytes, size_t size, off_t offset) {
  SHORTENED("pwrite")
  CALL("pwrite", ssize_t, syscall(SYS_pwrite64, descriptor, bytes, size, offset));
}
ssize_t pread64(int descriptor, void* bytes, size_t size, off_t offset) { return pread(descriptor, bytes, size, offset); }
ssize_t pwrite64(int descriptor, const void* bytes, size_t size, off_t offset) {
  return pwrite(descriptor, bytes, size, offset);
}
int openat(int folder, const char* file, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  CALL("open", int, (int)syscall(SYS_openat, folder, file, flags, mode));
}
int open(const char* file, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return openat(AT_FDCWD, file, flags, mode);
}
int open64(const char* file, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return openat(AT_FDCWD, file, flags, mode);
}
int fsync(int descriptor) { CALL("fsync", int, (int)syscall(SYS_fsync, descriptor)); }
int ftruncate(int descriptor, off_t size) { CALL("truncate", int, (int)syscall(SYS_ftruncate, descriptor, size)); }
int ftruncate64(int descriptor, off_t size) { return ftruncate(descriptor, size); }
int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  CALL("rename", int, (int)syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
}
int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  return renameat2(from_folder, from, to_folder, to, 0);
}
int rename(const char* from, const char* to) { return renameat2(AT_FDCWD, from, AT_FDCWD, to, 0); }
int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
  CALL("link", int, (int)syscall(SYS_linkat, from_folder, from, to_folder, to, flags));
}
int mkdirat(int above, const char* folder, mode_t mode) {
  CALL("mkdir", int, (int)syscall(SYS_mkdirat, above, folder, mode));
}
int mkdir(const char* folder, mode_t mode) { return mkdirat(AT_FDCWD, folder, mode); }
int unlinkat(int folder, const char* file, int flags) {
  CALL("unlink", int, (int)syscall(SYS_unlinkat, folder, file, flags));
}
int remove(const char* file) {
  struct stat status;
  const int is_folder = lstat(file, &status) == 0 && S_ISDIR(status.st_mode);
  return unlinkat(AT_FDCWD, file, is_folder ? AT_REMOVEDIR : 0);
}
int unlink(const char* file) { CALL("unlink", int, (int)syscall(SYS_unlinkat, AT_FDCWD, file, 0)); }
void _exit(int status) {
  end();
  syscall(SYS_exit_group, status);
  __builtin_unreachable();
}
