// A reader that was taken over by its file: it enters the walls as roam-reader does, and then does what the file says,
// one word. It lives to tell only where the walls let it.

#include <dlfcn.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <seccomp.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "import/reader/frame_writer.h"
#include "import/reader/sandbox/sandbox.h"
#include "import/reader/scene_files.h"
#include "import/stream.h"

namespace {

using namespace roam::reader;

bool no_seccomp = false, no_close_range = false;  ///< of the kernel that this stands for

}  // namespace

// These take the place of the libraries' in this program.
extern "C" scmp_filter_ctx seccomp_init(std::uint32_t action) {
  using Init = scmp_filter_ctx (*)(std::uint32_t);
  return no_seccomp ? nullptr : reinterpret_cast<Init>(dlsym(RTLD_NEXT, "seccomp_init"))(action);
}
extern "C" int close_range(unsigned first, unsigned last, int flags) noexcept {
  if (!no_close_range) return static_cast<int>(syscall(SYS_close_range, first, last, flags));
  errno = ENOSYS;
  return -1;
}

namespace {

std::string beside;           ///< a path in the scene's folder
FrameWriter* said = nullptr;  ///< the stream that has begun

/// Each returns 0, or -1 and errno, as the system call that it makes.
const std::map<std::string, std::function<long()>> misdeeds{
    {"exec", [] { return execl("/bin/sh", "sh", "-c", "touch PWNED", nullptr); }},
    {"fork", [] { return fork(); }},
#ifdef SYS_vfork
    {"vfork", [] { return syscall(SYS_vfork); }},
#else
    {"vfork", [] { return fork(); }},
#endif
    {"clone", [] { return syscall(SYS_clone3, nullptr, 0); }},
    {"thread",
     []() -> long {
       std::thread(pause).detach();
       return 0;
     }},
    {"trace", [] { return syscall(SYS_ptrace, 0, 0, 0, 0); }},
    {"ring", [] { return syscall(SYS_io_uring_setup, 1, nullptr); }},
    {"memory-file", [] { return syscall(SYS_memfd_create, "f", 0); }},
    {"times", [] { return utimensat(AT_FDCWD, (beside + ".victim").c_str(), nullptr, 0); }},
    {"socket", [] { return socket(AF_INET, SOCK_STREAM, 0); }},
    {"local-socket", [] { return socket(AF_UNIX, SOCK_STREAM, 0); }},
    {"write", [] { return open(beside.c_str(), O_WRONLY | O_CREAT, 0600); }},
    {"overwrite", [] { return open((beside + ".victim").c_str(), O_RDWR | O_TRUNC); }},
    {"append", [] { return open((beside + ".victim").c_str(), O_WRONLY | O_APPEND); }},
    {"unnamed", [] { return open("/tmp", O_TMPFILE | O_RDWR, 0600); }},
    {"truncate", [] { return truncate((beside + ".victim").c_str(), 0); }},
    {"unlink", [] { return unlink((beside + ".victim").c_str()); }},
    {"rename", [] { return rename((beside + ".victim").c_str(), beside.c_str()); }},
    {"link", [] { return link((beside + ".victim").c_str(), beside.c_str()); }},
    {"symlink", [] { return symlink("/etc/passwd", beside.c_str()); }},
    {"mkdir", [] { return mkdir(beside.c_str(), 0700); }},
    {"chmod", [] { return chmod((beside + ".victim").c_str(), 0777); }},
    {"signal", [] { return kill(getppid(), SIGTERM); }},
    {"signal-by-descriptor",
     []() -> long {
       int ends[2];
       return pipe(ends) == 0 && fcntl(ends[0], F_SETOWN, getppid()) == 0 ? 0 : -1;
     }},
    {"code",
     [] {
       void* page = mmap(nullptr, 4096, PROT_READ | PROT_WRITE | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
       return page == MAP_FAILED ? -1L : 0L;
     }},
    {"more-time",
     [] {
       const rlimit any{RLIM_INFINITY, RLIM_INFINITY};
       return setrlimit(RLIMIT_AS, &any);
     }},
    // A descriptor that the program which started this one has left open.
    {"inherited", [] { return fcntl(9, F_GETFD); }},
    {"secret", [] { return open("/etc/passwd", O_RDONLY); }},
    {"neighbour",
     [] { return open((std::filesystem::path(beside).parent_path() / "../neighbour").c_str(), O_RDONLY); }},
    {"list", [] { return open("/etc", O_RDONLY | O_DIRECTORY); }},
    {"proc", [] { return open("/proc/self/environ", O_RDONLY); }},
    {"scene", [] { return open((beside + ".victim").c_str(), O_RDONLY); }},
    {"memory",
     [] {
       for (int i = 0; i < 10240; ++i) {
         void* some = std::malloc(1u << 20);
         if (some == nullptr) return -1L;
         std::memset(some, 1, 1u << 20);
       }
       return 0L;
     }},
    // Speaks for ever, and does nothing.
    {"drip",
     []() -> long {
       constexpr std::array<std::byte, sizeof(std::uint64_t)> nothing_read{};
       for (;;) {
         said->send(FrameKind::progress, nothing_read);
         said->flush();
         usleep(100'000);
       }
     }},
    {"loop",
     []() -> long {
       while (getpid() > 0) {
       }
       return 0;
     }},
};

}  // namespace

int main(int argc, char** argv) {
  Rights rights;
  int highest = any_landlock;
  std::string scene;
  for (int i = 1; i + 1 < argc; ++i) {
    const std::string name = argv[i];
    if (name == "--folder") rights.scope.folders.emplace_back(argv[i + 1]);
    if (name == "--file") rights.scope.files.emplace_back(argv[i + 1]);
    if (name == "--memory") rights.data = std::strtoull(argv[i + 1], nullptr, 10);
    if (name == "--no-seccomp") no_seccomp = true;
    if (name == "--no-close-range") no_close_range = true;
    if (name == "--thread") std::thread(pause).detach();
    if (name == "--highest-landlock") highest = std::atoi(argv[i + 1]);
    if (name == "--") rights.scope.scene = scene = argv[i + 1];
  }
  const roam::Confinement walls = confine(rights, stream_fd, highest);
  FrameWriter frames(stream_fd);
  frames.send(FrameKind::hello,
              PayloadWriter().add(Greeting{stream_version, walls.landlock, walls.system_calls, 1, 1, 1}));
  said = &frames;
  SceneFiles files(rights.scope, frames);
  std::ifstream file(files.open(scene));
  std::string deed, rest;
  file >> deed;
  std::getline(file, rest, '\0');
  beside = scene + ".new";
  if (deed == "landlock") deed.append(" ").append(std::to_string(walls.landlock));
  errno = 0;
  const auto found = misdeeds.find(deed);
  const long done = found == misdeeds.end() ? -2 : found->second();
  frames.fail(roam::Error(deed + (done == -2 && !deed.starts_with("landlock") ? " is not known"
                                  : done == -1 ? std::string(" was refused: ") + std::strerror(errno)
                                               : " was done")));
  _exit(1);
}
