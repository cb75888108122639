// Access to the bytes of a store in a folder.
#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <utility>

#include "files/holes.h"
#include "store/files.h"
#include "store/read_ahead.h"

namespace roam::store {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds longest_wait_for_lock{1};

/// A static text; strerror's may be overwritten by the next call.
const char* reason(int error) {
  switch (error) {
    case ENOENT:
      return "the file is not there";
    case EACCES:
    case EPERM:
      return "the file may not be read";
    case EIO:
      return "the disk reports an input/output error";
    case EMFILE:
    case ENFILE:
      return "too many files are open (raise the limit: ulimit -n)";
    case ESTALE:
      return "the network file system has lost the file";
    case is_a_link:
      return "it, or the folder that it should be in, is a symbolic link, which no store has";
    case is_a_folder:
    case is_something_else:
      return "it is no ordinary file";
    default:
      return "the operating system cannot read it";
  }
}

class Files : public StoreBytes {
 public:
  explicit Files(Folder folder) : folder_(std::move(folder)) {
    rlimit limit{};
    if (::getrlimit(RLIMIT_NOFILE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) most_open_ = limit.rlim_cur / 2;
  }
  ~Files() override {
    for (const auto& [file, descriptor] : open_) ::close(descriptor);
  }

  std::vector<std::byte> whole(const std::string& file, std::uint64_t limit) override {
    if (file.starts_with("manifests/")) hold(file);
    return read_file(folder_, file, limit);
  }

  const char* read(const std::string& file, std::uint64_t offset, std::span<std::byte> out,
                   const std::stop_token& /*stop*/) override {
    if (const int kept = find(file); kept >= 0) {
      if (is_removed(kept)) open_again(file, kept);
      return fill(kept, offset, out);
    }
    Descriptor opened = open_file(folder_, file, O_RDONLY);
    if (!opened.is_open()) return reason(errno);
    if (files::is_mostly_holes(opened.number())) return mostly_holes;
    const char* problem = fill(opened.number(), offset, out);
    keep(file, opened);
    return problem;
  }

 private:
  /// Locks a manifest for the life of this object: no builder removes a locked manifest, nor files that it names. If it
  /// was removed before or cannot be opened, the next read of it fails.
  void hold(const std::string& manifest) {
    Descriptor opened = open_file(folder_, manifest, O_RDONLY);
    if (!opened.is_open()) return;
    // Builders lock it only as long as removal takes, but anybody who may read it may lock it for ever. Some file
    // systems have no locks.
    const auto until = std::chrono::steady_clock::now() + longest_wait_for_lock;
    while (::flock(opened.number(), LOCK_SH | LOCK_NB) != 0 && (errno == EINTR || errno == EWOULDBLOCK) &&
           std::chrono::steady_clock::now() < until) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const std::lock_guard lock(mutex_);
    held_ = std::move(opened);
  }

  /// The descriptor of a file kept open for the life of this object; -1: none.
  [[nodiscard]] int find(const std::string& file) {
    const std::lock_guard lock(mutex_);
    const auto it = open_.find(file);
    return it == open_.end() ? -1 : it->second;
  }
  void keep(const std::string& file, Descriptor& opened) {
    const std::lock_guard lock(mutex_);
    if (open_.size() < most_open_ && open_.emplace(file, opened.number()).second) (void)opened.release();
  }

  /// Whether the file has no name any more, or the network has lost it.
  [[nodiscard]] static bool is_removed(int descriptor) {
    struct stat status {};
    return ::fstat(descriptor, &status) != 0 || status.st_nlink == 0;
  }
  /// A repaired pack is another file of the same name. If there is none, the old file is still read.
  void open_again(const std::string& file, int kept) const {
    const Descriptor opened = open_file(folder_, file, O_RDONLY);
    if (!opened.is_open() || files::is_mostly_holes(opened.number())) return;
    ::dup3(opened.number(), kept, O_CLOEXEC);  // atomic, so that concurrent reads of the old file are not disturbed
  }

  static const char* fill(int descriptor, std::uint64_t offset, std::span<std::byte> out) {
    if (files::read_fully(descriptor, offset, out) == out.size()) return nullptr;
    return errno == 0 ? "the file is shorter than the manifest says" : reason(errno);
  }

  Folder folder_;
  std::size_t most_open_ = 512;
  std::mutex mutex_;
  std::unordered_map<std::string, int> open_;
  Descriptor held_;  ///< the locked manifest
};

}  // namespace

const char* StoreBytes::read_checked(const std::string& file, std::uint64_t offset, std::span<std::byte> out,
                                     std::uint64_t hash, const std::stop_token& stop) {
  if (const char* problem = read(file, offset, out, stop)) return problem;
  return xxh3(out) == hash ? nullptr : wrong_checksum;
}

std::shared_ptr<StoreBytes> files_of(const Folder& folder) { return std::make_shared<Files>(folder); }

}  // namespace roam::store
