#include "store/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <utility>

#include "files/holes.h"
#include "roam/error.h"
#include "store/manifest.h"

// All data of a store is little endian; bytes on disk and in memory are the same.
static_assert(std::endian::native == std::endian::little, "stores are read and written by little-endian machines only");

namespace roam::store {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t piece_bytes = 1 << 20;

}  // namespace

namespace {

/// Throws FileError.
Descriptor opened_to_read(const Folder& store, const std::string& name) {
  Descriptor file = open_file(store, name, O_RDONLY);
  if (!file.is_open()) fail("read", store, name, errno);
  return file;
}

std::string sha256_of(const Descriptor& file, const Folder& store, const std::string& name,
                      const std::function<void(std::uint64_t)>& tick) {
  if (files::is_mostly_holes(file.number())) {
    const std::string path = (store / name).string();
    throw Error::at(path, fmt::format("cannot read {}: {}", path, mostly_holes));
  }
  Sha256 hash;
  std::vector<std::byte> piece(piece_bytes);
  for (;;) {
    const ssize_t got = again([&] { return ::read(file.number(), piece.data(), piece.size()); });
    if (got < 0) fail("read", store, name, errno);
    if (got == 0) return hash.digits();
    hash.add({piece.data(), static_cast<std::size_t>(got)});
    if (tick) tick(static_cast<std::uint64_t>(got));
  }
}

}  // namespace

std::string sha256_of_file(const Folder& store, const std::string& name,
                           const std::function<void(std::uint64_t)>& tick) {
  return sha256_of(opened_to_read(store, name), store, name, tick);
}

std::string FileHashes::sha256(const std::string& name, const std::function<void(std::uint64_t)>& tick) {
  const Descriptor file = opened_to_read(store_, name);
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) fail("read", store_, name, errno);
  std::promise<std::string> mine;
  std::shared_future<std::string> hash;
  bool is_first = false;
  {
    const std::lock_guard lock(mutex_);
    const auto [place, added] = hashes_.try_emplace({status.st_dev, status.st_ino});
    is_first = added;
    if (is_first) place->second = mine.get_future().share();
    hash = place->second;
  }
  if (is_first) {
    try {
      mine.set_value(sha256_of(file, store_, name, tick));
    } catch (...) {
      mine.set_exception(std::current_exception());
    }
  }
  return hash.get();
}

// --------------------------------------------------------------------------------------------------------- new files

namespace {

/// The folder of a store's file, opened for a WholeFile.
Descriptor folder_to_write(const Folder& store, const std::string& name) {
  Descriptor folder = open_folder(store, split(name).first);
  if (!folder.is_open()) fail("write", store, name, errno);
  return folder;
}

}  // namespace

NewFile::NewFile(const Folder& store, const std::string& name)
    : store_(store),
      name_(name),
      file_(folder_to_write(store, name), (store / name).parent_path(), std::string(split(name).second)) {}

void NewFile::write(std::span<const std::byte> bytes) {
  hash_.add(bytes);
  file_.write(bytes);
  size_ += bytes.size();
}

void NewFile::commit_as(const std::string& last) {
  try {
    file_.commit_as(last);
  } catch (const FileError& error) {
    if (is_foreign(error.number)) fail("write", store_, name_, error.number);
    throw;
  }
}

void NewFile::commit() { commit_as(std::string(split(name_).second)); }

std::string NewFile::commit_by_hash() {
  std::string digits = hash_.digits();
  commit_as(digits + fs::path(name_).extension().string());
  return digits;
}

bool NewFile::commit_if_hash_is(const std::string& digits) {
  if (hash_.digits() != digits) return false;
  commit_as(digits + fs::path(name_).extension().string());
  return true;
}

void write_file(const Folder& store, const std::string& name, std::string_view text) {
  NewFile out(store, name);
  out.write(std::as_bytes(std::span(text)));
  out.commit();
}

std::vector<std::byte> read_file(const Folder& store, const std::string& name, std::uint64_t limit) {
  const Descriptor file = open_file(store, name, O_RDONLY);
  if (!file.is_open()) fail("read", store, name, errno);
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) fail("read", store, name, errno);
  const std::string path = (store / name).string();
  if (static_cast<std::uint64_t>(status.st_size) > limit) {
    throw FileError(Error::at(path, fmt::format("cannot read {}: it has {} bytes, more than any file of its kind", path,
                                                status.st_size)),
                    EFBIG);
  }
  std::vector<std::byte> bytes(static_cast<std::size_t>(status.st_size));
  if (files::read_fully(file.number(), bytes) < bytes.size()) {
    if (errno != 0) fail("read", store, name, errno);
    throw Error::at(path, fmt::format("cannot read {}: it became shorter while it was read", path));
  }
  return bytes;
}

bool is_digits(std::string_view text, std::size_t count) {
  return text.size() == count && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

bool is_named_by_hash(std::string_view name, std::string_view extension) {
  name.remove_prefix(name.rfind('/') + 1);  // npos + 1 is 0
  return name.ends_with(extension) && is_digits(name.substr(0, name.size() - extension.size()), 64);
}

std::string pack_file(const std::string& hash) { return "packs/" + hash + ".pack"; }
std::string part_file(const std::string& hash) { return "parts/" + hash + ".part"; }
std::string manifest_file(const std::string& hash) { return "manifests/" + hash + ".json"; }
std::string spare_file(const std::string& hash) { return "spare/" + hash + ".json"; }

// -------------------------------------------------------------------------------------------------------------- packs

PackWriter::PackWriter(const Folder& store) : file_(store, pack_file("new")) {
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

/// Greatest size of a lock file: the number of a process and a line feed.
constexpr std::size_t lock_bytes = 24;

/// The number of the process in a lock file; empty if there is none. Nothing if the file is not a lock file.
std::optional<std::string> process_in(int descriptor) {
  std::array<char, lock_bytes + 1> text{};
  const ssize_t got = ::pread(descriptor, text.data(), text.size(), 0);
  std::string process(text.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
  if (process.ends_with('\n')) process.pop_back();
  if (process.size() > lock_bytes || process.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
  return process;
}

/// Whether the process is a zombie: it has ended, and its parent has not yet asked for its status.
bool is_dead(long process) {
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string line;
  std::getline(file, line);
  const auto name_end = line.rfind(')');  // the state follows the name and a blank; the name may hold any characters
  if (name_end == std::string::npos || name_end + 2 >= line.size()) return false;
  const char state = line[name_end + 2];
  return state == 'Z' || state == 'X';
}

/// Whether it is certain that no such process runs on this machine.
bool has_ended(const std::string& process) {
  const long number = process.empty() ? 0 : std::strtol(process.c_str(), nullptr, 10);
  if (number <= 0 || number > std::numeric_limits<pid_t>::max()) return false;
  return (::kill(static_cast<pid_t>(number), 0) != 0 && errno == ESRCH) || is_dead(number);
}

std::string held_by(const std::string& process, bool ended) {
  if (ended) {
    return fmt::format(
        "it is still locked, though process {}, which built it, has ended here; it may run on another machine or in a "
        "container: wait for it, or end it; what it has done is kept",
        process);
  }
  return fmt::format("it is being built by {}: wait for it, or end it; what it has done is kept",
                     process.empty() ? "another process" : "process " + process);
}

}  // namespace

BuildLock::BuildLock(const Folder& store) {
  const std::string name = lock_file;
  Descriptor lock = open_file(store, name, O_RDWR | O_CREAT);
  if (!lock.is_open()) fail("write", store, name, errno);
  const auto process = process_in(lock.number());
  if (again([&] { return ::flock(lock.number(), LOCK_EX | LOCK_NB); }) != 0) {
    if (errno != EWOULDBLOCK) fail("lock", store, name, errno);
    const bool ended = has_ended(process.value_or(""));
    throw LockedError(store.string(), held_by(process.value_or(""), ended), ended);
  }
  struct stat status {};
  if (::fstat(lock.number(), &status) != 0 || status.st_nlink == 0) {
    throw LockedError(store.string(), "another build has just given it up; build again", false);
  }
  // The lock is the only file written in place, so it must have no other name.
  if (status.st_nlink > 1 || !process) {
    throw Error::at((store / name).string(),
                    fmt::format("cannot lock {}: {}; remove it", (store / name).string(),
                                process ? "other names, perhaps outside of the store, lead to the same file"
                                        : "it is not what a build leaves there"));
  }
  const std::string own = std::to_string(::getpid()) + "\n";
  // Only for messages and has_ended, in the next process that tries.
  if (::ftruncate(lock.number(), 0) == 0) static_cast<void>(!::pwrite(lock.number(), own.data(), own.size(), 0));
  descriptor_ = std::move(lock);
}

}  // namespace roam::store
