#include "store/web/disk_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <thread>

#include "files/file_error.h"
#include "roam/error.h"

namespace roam::web {

/// At the start of the file. Then come the table's slots, then the entries, one after the other and round and round.
struct DiskCache::Header {
  char magic[8];
  std::uint64_t bytes;    ///< of the file
  std::uint64_t buckets;  ///< of slots
  std::uint64_t written;  ///< bytes of entries so far; modulo entries() it is the place of the next one

  [[nodiscard]] std::uint64_t entries() const;
  [[nodiscard]] std::uint64_t first() const;
};

/// A place in the table. All zero: free.
struct DiskCache::Slot {
  char key[key_bytes];
  std::uint64_t at;  ///< Header::written when it was kept
  std::uint64_t bytes;
  std::uint64_t check;  ///< of the entry
  std::uint64_t zero;
};

namespace {

using files::again;

constexpr char magic[8] = {'R', 'O', 'A', 'M', 'W', 'E', 'B', '1'};
constexpr std::uint64_t header_bytes = 4096;
constexpr std::size_t bucket_slots = 8;
/// An entry, a tile, has more bytes on average.
constexpr std::uint64_t bytes_a_slot = 16 << 10;
/// Part of all entries' bytes that one may take.
constexpr std::uint64_t largest_part = 8;

std::uint64_t check_of(std::string_view key, std::span<const std::byte> bytes) {
  return XXH3_64bits_withSeed(bytes.data(), bytes.size(), XXH3_64bits(key.data(), key.size()));
}

/// Waits for another process that opens the cache: tries, and pauses between them.
constexpr int tries = 20;
constexpr std::chrono::milliseconds pause{10};

/// The lock of the file, against other processes. One that is stopped may hold it for ever, so that nobody waits.
class Locked {
 public:
  explicit Locked(int file) : file_(file), held_(again([&] { return ::flock(file, LOCK_EX | LOCK_NB); }) == 0) {}
  ~Locked() {
    if (held_) ::flock(file_, LOCK_UN);
  }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;
  explicit operator bool() const { return held_; }

 private:
  int file_;
  bool held_;
};

template <class T>
bool read_at(int file, std::uint64_t place, std::span<T> out) {
  const auto bytes = std::as_writable_bytes(out);
  return files::read_fully(file, place, bytes) == bytes.size();
}

template <class T>
bool write_at(int file, std::uint64_t place, std::span<const T> from) {
  const auto bytes = std::as_bytes(from);
  return files::write_fully(file, place, bytes) == bytes.size();
}

}  // namespace

std::uint64_t DiskCache::Header::first() const { return header_bytes + buckets * bucket_slots * sizeof(Slot); }
std::uint64_t DiskCache::Header::entries() const { return bytes - first(); }

DiskCache::DiskCache(const std::filesystem::path& file, std::uint64_t bytes) {
  const std::string name = file.string();
  if (bytes < least_bytes) throw Error(name, fmt::format("a cache has {} MiB at least", least_bytes >> 20));
  std::error_code none;
  for (std::filesystem::path above; const auto& part : file.parent_path()) {
    above /= part;
    ::mkdir(above.c_str(), 0700);  // fails for those that are there
  }
  file_ = files::Descriptor(
      again([&] { return ::open(file.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK, 0600); }));
  if (!file_.is_open()) files::fail("open", file, errno);
  struct stat status {};
  if (::fstat(file_.number(), &status) != 0) files::fail("open", file, errno);
  if (!S_ISREG(status.st_mode) || status.st_uid != ::geteuid() || status.st_nlink != 1) {
    throw Error(name, "this is no file of your own with one name; name another for the cache");
  }
  if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0) {
    throw Error(name, "others may write to this file; remove it, or name another for the cache");
  }
  for (int i = 0; i < tries; ++i) {
    if (is_made(file, bytes)) return;
    std::this_thread::sleep_for(pause);
  }
  file_.close();
}

bool DiskCache::is_made(const std::filesystem::path& file, std::uint64_t bytes) const {
  Header header{};
  if (read(header) && header.bytes == bytes) return true;
  const Locked lock(file_.number());
  if (!lock) return false;
  if (read(header) && header.bytes == bytes) return true;
  // A power cut may leave zeros at the start of a cache.
  std::array<std::byte, header_bytes> start{};
  static_cast<void>(files::read_fully(file_.number(), 0, start));
  const bool is_empty = std::all_of(start.begin(), start.end(), [](std::byte b) { return b == std::byte{0}; });
  if (!is_empty && std::memcmp(start.data(), magic, sizeof magic) != 0) {
    throw Error(file.string(), "this is no cache, and would be overwritten; remove it, or name another file");
  }
  header = {};
  std::memcpy(header.magic, magic, sizeof magic);
  header.bytes = bytes;
  header.buckets = std::max<std::uint64_t>(1, bytes / (bytes_a_slot * bucket_slots));
  header.written = 8;  // every entry is younger than a free slot
  if (::ftruncate(file_.number(), 0) != 0 || !write_at<Header>(file_.number(), 0, {&header, 1}) ||
      ::ftruncate(file_.number(), static_cast<off_t>(bytes)) != 0) {
    files::fail("write", file, errno);
  }
  return true;
}

bool DiskCache::read(Header& header) const {
  return read_at<Header>(file_.number(), 0, {&header, 1}) && std::memcmp(header.magic, magic, sizeof magic) == 0 &&
         header.bytes >= least_bytes && header.buckets > 0 && header.buckets < header.bytes / sizeof(Slot) &&
         header.first() < header.bytes;
}

bool DiskCache::read(const Header& header, std::string_view key, std::span<Slot> slots) const {
  const std::uint64_t bucket = XXH3_64bits(key.data(), key.size()) % header.buckets;
  return read_at(file_.number(), header_bytes + bucket * bucket_slots * sizeof(Slot), slots);
}

bool DiskCache::find(const Header& header, std::string_view key, Slot& found) const {
  std::array<Slot, bucket_slots> slots;
  if (!read(header, key, slots)) return false;
  for (const Slot& slot : slots) {
    if (std::string_view(slot.key, key_bytes) != key || slot.bytes == 0) continue;
    found = slot;
    // Else it is of another table, or overwritten.
    return slot.at <= header.written && header.written - slot.at <= header.entries() &&
           slot.bytes <= header.entries() - slot.at % header.entries();
  }
  return false;
}

bool DiskCache::read(const Header& header, const Slot& slot, std::span<std::byte> out) const {
  return read_at(file_.number(), header.first() + slot.at % header.entries(), out) &&
         check_of({slot.key, key_bytes}, out) == slot.check;
}

bool DiskCache::find(std::string_view key, std::span<std::byte> out) noexcept {
  Header header{};
  Slot slot{};
  return key.size() == key_bytes && read(header) && find(header, key, slot) && slot.bytes == out.size() &&
         read(header, slot, out);
}

std::optional<std::vector<std::byte>> DiskCache::find(std::string_view key, std::uint64_t limit) noexcept {
  Header header{};
  Slot slot{};
  if (key.size() != key_bytes || !read(header) || !find(header, key, slot) || slot.bytes > limit) return std::nullopt;
  try {
    std::vector<std::byte> bytes(slot.bytes);
    if (read(header, slot, bytes)) return bytes;
  } catch (const std::exception&) {  // no memory left
  }
  return std::nullopt;
}

void DiskCache::keep(std::string_view key, std::span<const std::byte> bytes) noexcept {
  Header header{};
  Slot slot{};
  if (key.size() != key_bytes || bytes.empty() || !read(header)) return;
  if (bytes.size() > header.entries() / largest_part) return;
  const bool is_young = find(header, key, slot) && slot.bytes == bytes.size() && slot.check == check_of(key, bytes) &&
                        header.written - slot.at < header.entries() / 4 * 3;
  if (is_young) return;
  try {
    write(key, bytes);
  } catch (const std::exception&) {  // the mutex cannot be locked
  }
}

void DiskCache::write(std::string_view key, std::span<const std::byte> bytes) {
  const std::lock_guard guard(mutex_);
  const Locked lock(file_.number());
  Header header{};
  std::array<Slot, bucket_slots> slots;
  if (!lock || !read(header) || bytes.size() > header.entries() / largest_part || !read(header, key, slots)) return;
  const std::uint64_t rest = header.entries() - header.written % header.entries();
  const std::uint64_t at = header.written + (rest < bytes.size() ? rest : 0);
  header.written = at + bytes.size();
  // In this order: a slot never leads to bytes that another process may write.
  if (!write_at<Header>(file_.number(), 0, {&header, 1})) return;
  if (!write_at<std::byte>(file_.number(), header.first() + at % header.entries(), bytes)) return;
  std::size_t oldest = 0;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (std::string_view(slots[i].key, key_bytes) == key) {
      oldest = i;
      break;
    }
    if (slots[i].at < slots[oldest].at) oldest = i;
  }
  Slot& slot = slots[oldest];
  slot = {};
  std::memcpy(slot.key, key.data(), key_bytes);
  slot.at = at;
  slot.bytes = bytes.size();
  slot.check = check_of(key, bytes);
  const std::uint64_t bucket = XXH3_64bits(key.data(), key.size()) % header.buckets;
  const std::uint64_t place = header_bytes + (bucket * bucket_slots + oldest) * sizeof(Slot);
  write_at<Slot>(file_.number(), place, {&slot, 1});
}

}  // namespace roam::web
