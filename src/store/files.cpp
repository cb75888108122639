#include "store/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <utility>

#include "roam/error.h"
#include "store/manifest.h"

// Everything in a store is little endian, and is read and written as it lies in memory.
static_assert(std::endian::native == std::endian::little, "stores are read and written by little-endian machines only");

namespace roam::store {
namespace {

namespace fs = std::filesystem;

/// What a person can do about it.
const char* advice(int error, bool reading) {
  if (reading && (error == EACCES || error == EPERM)) return "give yourself the right to read it";
  switch (error) {
    case ENOSPC:
    case EDQUOT:
      return "make room there or choose another output, and start again: what is complete is kept";
    case EACCES:
    case EPERM:
      return "give yourself the right to write there or choose another output";
    case EROFS:
      return "the file system can only be read; choose another output";
    case EIO:
      return "the disk or the network does not work; see the system's log";
    case EMFILE:
    case ENFILE:
      return "too many files are open; raise the limit (ulimit -n)";
    default:
      return "";
  }
}

[[noreturn]] void fail(const char* what, const fs::path& file, int error, bool reading = false) {
  const std::string advised = advice(error, reading);
  throw FileError(fmt::format("cannot {} {}: {}{}{}", what, file.string(), std::strerror(error),
                              advised.empty() ? "" : "; ", advised),
                  error);
}
[[noreturn]] void fail_to_read(const fs::path& file, int error) { fail("read", file, error, true); }

/// Calls a system call again when a signal interrupts it.
template <class Call>
auto again(const Call& call) {
  for (;;) {
    const auto result = call();
    if (result >= 0 || errno != EINTR) return result;
  }
}

void sync_folder(const fs::path& folder) {
  const int descriptor = again([&] { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
  if (descriptor < 0) fail("open", folder, errno);
  const int result = again([&] { return ::fsync(descriptor); });
  const int error = errno;
  ::close(descriptor);
  // Some network file systems know no fsync of folders.
  if (result != 0 && error != EINVAL) fail("sync", folder, error);
}

fs::path folder_of(const fs::path& file) { return file.has_parent_path() ? file.parent_path() : fs::path("."); }

/// Closes when it goes.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

constexpr std::size_t kPiece = 1 << 20;

}  // namespace

std::string sha256_of_file(const fs::path& file, const std::function<void(std::uint64_t)>& tick) {
  const Descriptor open(again([&] { return ::open(file.c_str(), O_RDONLY | O_CLOEXEC); }));
  if (open.number() < 0) fail_to_read(file, errno);
  Sha256 hash;
  std::vector<std::byte> piece(kPiece);
  for (;;) {
    const ssize_t got = again([&] { return ::read(open.number(), piece.data(), piece.size()); });
    if (got < 0) fail_to_read(file, errno);
    if (got == 0) return hash.digits();
    hash.add({piece.data(), static_cast<std::size_t>(got)});
    if (tick) tick(static_cast<std::uint64_t>(got));
  }
}

// --------------------------------------------------------------------------------------------------------- new files

NewFile::NewFile(fs::path final_path) : path_(std::move(final_path)) {
  static std::atomic<std::uint64_t> number{0};
  temporary_ = path_;
  temporary_ += fmt::format(".{}.{}{}", ::getpid(), number++, temporary_suffix);
  listed_.begin(temporary_);
  descriptor_ = again([&] { return ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); });
  if (descriptor_ < 0) fail("write", temporary_, errno);
}

NewFile::~NewFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void NewFile::write(std::span<const std::byte> bytes) {
  hash_.add(bytes);
  while (!bytes.empty()) {
    const ssize_t written = again([&] { return ::write(descriptor_, bytes.data(), bytes.size()); });
    if (written < 0) fail("write", path_, errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    size_ += static_cast<std::uint64_t>(written);
  }
}

void NewFile::rename_to(const fs::path& path) {
  if (again([&] { return ::fsync(descriptor_); }) != 0) fail("write", path_, errno);
  // Some network file systems tell of a full disk only now.
  const int closed = ::close(std::exchange(descriptor_, -1));
  if (closed != 0 && errno != EINTR) fail("write", path_, errno);
  if (::rename(temporary_.c_str(), path.c_str()) != 0) fail("write", path, errno);
  temporary_.clear();
  sync_folder(folder_of(path));
}

void NewFile::commit() { rename_to(path_); }

std::string NewFile::commit_by_hash() {
  std::string digits = hash_.digits();
  rename_to(folder_of(path_) / (digits + path_.extension().string()));
  return digits;
}

void write_file(const fs::path& file, std::string_view text) {
  NewFile out(file);
  out.write(std::as_bytes(std::span(text)));
  out.commit();
}

std::vector<std::byte> read_file(const fs::path& file, std::uint64_t limit) {
  const Descriptor open(again([&] { return ::open(file.c_str(), O_RDONLY | O_CLOEXEC); }));
  if (open.number() < 0) fail_to_read(file, errno);
  struct stat status {};
  if (::fstat(open.number(), &status) != 0) fail_to_read(file, errno);
  if (static_cast<std::uint64_t>(status.st_size) > limit) {
    throw FileError(
        fmt::format("cannot read {}: it has {} bytes, more than any file of its kind", file.string(), status.st_size),
        EFBIG);
  }
  std::vector<std::byte> bytes(static_cast<std::size_t>(status.st_size));
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t got = again([&] { return ::read(open.number(), bytes.data() + done, bytes.size() - done); });
    if (got < 0) fail_to_read(file, errno);
    if (got == 0) throw Error(fmt::format("cannot read {}: it became shorter while it was read", file.string()));
    done += static_cast<std::size_t>(got);
  }
  return bytes;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  if (fs::is_directory(folder, error)) return;
  // Each by itself: one that is not synced may be gone after a power cut, with all that is in it.
  fs::path path;
  for (const fs::path& name : folder) {
    path /= name;
    if (fs::is_directory(path, error)) continue;
    if (!fs::create_directory(path, error) && error) fail("make the folder", folder, error.value());
    sync_folder(folder_of(path));
  }
}

std::string pack_file(const std::string& hash) { return "packs/" + hash + ".pack"; }
std::string part_file(const std::string& hash) { return "parts/" + hash + ".part"; }
std::string manifest_file(const std::string& hash) { return "manifests/" + hash + ".json"; }
std::string spare_file(const std::string& hash) { return "spare/" + hash + ".json"; }

// -------------------------------------------------------------------------------------------------------------- packs

PackWriter::PackWriter(const fs::path& store) : file_(store / "packs" / "new.pack") {
  std::array<std::byte, pack_header_bytes> header{};
  std::memcpy(header.data(), "ROAMPACK", 8);
  const std::uint32_t version = format_version;
  std::memcpy(header.data() + 8, &version, sizeof version);
  file_.write(header);
}

std::uint64_t PackWriter::add(std::span<const std::byte> blob) {
  static constexpr std::array<std::byte, pack_alignment> zeros{};
  file_.write(std::span(zeros).first((pack_alignment - file_.size() % pack_alignment) % pack_alignment));
  const std::uint64_t offset = file_.size();
  file_.write(blob);
  return offset;
}

std::string PackWriter::commit() { return file_.commit_by_hash(); }

// --------------------------------------------------------------------------------------------------------------- lock

namespace {

/// The number of the process that a lock's file names; empty: it does not.
std::string process_in(int descriptor) {
  std::array<char, 32> text{};
  const ssize_t got = ::pread(descriptor, text.data(), text.size() - 1, 0);
  std::string process(text.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
  process.erase(std::find_if(process.begin(), process.end(), [](char c) { return c < '0' || c > '9'; }), process.end());
  return process;
}

/// Whether nobody but its parent knows the process any more, who has not asked how it ended.
bool is_dead(long process) {
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string line;
  std::getline(file, line);
  const auto name_end = line.rfind(')');  // a name may hold anything, and the state comes after it and a blank
  if (name_end == std::string::npos || name_end + 2 >= line.size()) return false;
  const char state = line[name_end + 2];
  return state == 'Z' || state == 'X';
}

/// Whether it is certain that no such process runs here.
bool has_ended(const std::string& process) {
  const long number = process.empty() ? 0 : std::strtol(process.c_str(), nullptr, 10);
  if (number <= 0 || number > std::numeric_limits<pid_t>::max()) return false;
  return (::kill(static_cast<pid_t>(number), 0) != 0 && errno == ESRCH) || is_dead(number);
}

std::string held_by(const fs::path& store, const std::string& process, bool ended) {
  if (ended) {
    return fmt::format(
        "{} is still locked, though process {}, which built it, has ended here; it may run on another machine or in a "
        "container: wait for it, or end it; what it has done is kept",
        store.string(), process);
  }
  return fmt::format("{} is being built by {}: wait for it, or end it; what it has done is kept", store.string(),
                     process.empty() ? "another process" : "process " + process);
}

}  // namespace

BuildLock::BuildLock(const fs::path& store) {
  const fs::path file = store / "LOCK";
  descriptor_ = again([&] { return ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666); });
  if (descriptor_ < 0) fail("write", file, errno);
  if (again([&] { return ::flock(descriptor_, LOCK_EX | LOCK_NB); }) != 0) {
    const int error = errno;
    const std::string process = process_in(descriptor_);
    ::close(std::exchange(descriptor_, -1));
    if (error != EWOULDBLOCK) fail("lock", file, error);
    const bool ended = has_ended(process);
    throw LockedError(held_by(store, process, ended), ended);
  }
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0 || status.st_nlink == 0) {
    ::close(std::exchange(descriptor_, -1));
    throw LockedError(fmt::format("{} was given up by another build just now; build again", store.string()), false);
  }
  const std::string process = std::to_string(::getpid()) + "\n";
  // Only for people, and for has_ended: whoever comes next reads it.
  if (::ftruncate(descriptor_, 0) == 0) static_cast<void>(!::pwrite(descriptor_, process.data(), process.size(), 0));
}

BuildLock::~BuildLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace roam::store
