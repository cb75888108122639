// https://docs.kernel.org/userspace-api/landlock.html
#include "import/reader/sandbox/sandbox.h"

#ifdef __linux__

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace roam::reader {
namespace {

// Names and numbers of the kernel's interface. The header of Debian 12 ends with version 2; older systems have none.
constexpr long create_ruleset = 444, add_rule = 445, restrict_self = 446;
constexpr std::uint32_t ask_version = 1;
constexpr int rule_path_beneath = 1;
constexpr std::uint64_t read_file = 1u << 2, read_folder = 1u << 3;

struct RulesetAttributes {
  std::uint64_t files;
  std::uint64_t networks;
  std::uint64_t scopes;
};
struct __attribute__((packed)) PathBeneath {
  std::uint64_t allowed;
  std::int32_t parent;
};

/// Rights over files in versions 1, 2, ... of the interface. Known rights that no rule allows are denied.
constexpr std::array<std::uint64_t, 5> file_rights{(1u << 13) - 1, (1u << 14) - 1, (1u << 15) - 1, (1u << 15) - 1,
                                                   (1u << 16) - 1};
/// TCP bind and connect, from version 4; signals and abstract sockets, from version 6.
constexpr std::uint64_t tcp_rights = 3, all_scopes = 3;
constexpr int version_with_networks = 4, version_with_scopes = 6;

/// Opens a path of a scope, which has no links. A path that has become a link would let its target in.
int open_without_links(const std::filesystem::path& path) {
  open_how how{};
  how.flags = O_PATH | O_CLOEXEC;
  how.resolve = RESOLVE_NO_SYMLINKS;
  const long descriptor = syscall(SYS_openat2, AT_FDCWD, path.c_str(), &how, sizeof(how));
  if (descriptor >= 0 || (errno != ENOSYS && errno != EPERM)) return static_cast<int>(descriptor);
  // Some containers refuse openat2. Then only the last part is checked.
  const int last = open(path.c_str(), O_PATH | O_NOFOLLOW | O_CLOEXEC);
  struct stat status {};
  if (last < 0 || (fstat(last, &status) == 0 && !S_ISLNK(status.st_mode))) return last;
  close(last);
  return -1;
}

/// An absent path needs no rule, because nothing can be read there.
void allow(int ruleset, const std::filesystem::path& path, std::uint64_t rights) {
  const int descriptor = open_without_links(path);
  if (descriptor < 0) return;
  const PathBeneath rule{rights, descriptor};
  syscall(add_rule, ruleset, rule_path_beneath, &rule, 0);
  close(descriptor);
}

}  // namespace

int restrict_files(const Rights& rights, int highest_landlock) {
  const long offered = syscall(create_ruleset, nullptr, 0, ask_version);
  const int version = static_cast<int>(std::min<long>(offered, highest_landlock));
  if (version < 1) return 0;
  const auto known = std::min<std::size_t>(static_cast<std::size_t>(version), file_rights.size()) - 1;
  RulesetAttributes attributes{file_rights[known], version >= version_with_networks ? tcp_rights : 0,
                               version >= version_with_scopes ? all_scopes : 0};
  const std::size_t size = version >= version_with_scopes     ? sizeof(attributes)
                           : version >= version_with_networks ? 2 * sizeof(std::uint64_t)
                                                              : sizeof(std::uint64_t);
  const int ruleset = static_cast<int>(syscall(create_ruleset, &attributes, size, 0));
  if (ruleset < 0) return 0;
  for (const auto& folder : rights.scope.folders) allow(ruleset, folder, read_file | read_folder);
  for (const auto& file : rights.scope.files) allow(ruleset, file, read_file);
  const bool done = syscall(restrict_self, ruleset, 0) == 0;
  close(ruleset);
  return done ? version : 0;
}

}  // namespace roam::reader

#else

namespace roam::reader {
int restrict_files(const Rights&, int) { return 0; }
}  // namespace roam::reader

#endif
