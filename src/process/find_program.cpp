#include "process/find_program.h"

#include <dlfcn.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <system_error>

#include "text/stream_of.h"

#ifdef __APPLE__
#include <mach-o/dyld.h>
#endif

namespace roam::process {

namespace fs = std::filesystem;

bool can_run(const fs::path& program) {
  std::error_code none;
  return fs::is_regular_file(program, none) && ::access(program.c_str(), X_OK) == 0;
}

fs::path find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  for (const std::string& folder : parts_of(path != nullptr ? path : "", ':')) {
    // A relative folder would depend on the current folder, which may belong to a stranger.
    if (!folder.starts_with('/')) continue;
    const fs::path program = fs::path(folder) / name;
    if (can_run(program)) return program;
  }
  return {};
}

fs::path own_program() {
#ifdef __APPLE__
  char path[4096];
  std::uint32_t size = sizeof(path);
  return _NSGetExecutablePath(path, &size) == 0 ? fs::path(path) : fs::path();
#else
  std::error_code none;
  return fs::read_symlink("/proc/self/exe", none);
#endif
}

fs::path library_folder() {
  Dl_info info;
  if (dladdr(reinterpret_cast<const void*>(&library_folder), &info) == 0 || info.dli_fname == nullptr) return {};
  const fs::path file(info.dli_fname);
  // A relative path would depend on the current folder, which may belong to a stranger.
  return file.is_absolute() && file.filename().string().find(".so") != std::string::npos ? file.parent_path()
                                                                                         : fs::path();
}

fs::path own_folder() { return own_program().parent_path(); }

}  // namespace roam::process
