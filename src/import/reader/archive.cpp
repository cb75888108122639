#include "import/reader/archive.h"

#include <fmt/format.h>
#include <minizip/unzip.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <new>
#include <string_view>
#include <system_error>

#include "import/reader/file_names.h"
#include "import/reader/machine_failure.h"
#include "import/scene_scope.h"
#include "text/printable.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

// Methods of compression, by number (APPNOTE.TXT, 4.4.5).
constexpr std::uint64_t stored = 0, deflated = 8, zstd = 93;
/// Bit of an entry's flags (APPNOTE.TXT, 4.4.4).
constexpr unsigned encrypted = 1;
/// A table of the entries' places, which is no file of the scene.
constexpr std::string_view index_entry = "@3dtilesIndex1@";
/// Deflate makes at most 258 bytes of two bits, so an entry has at most this many times its packed bytes.
constexpr std::uint64_t most_ratio = 1032;

std::string shown(std::string_view name) { return printable(name, 100); }

/// The name in normal form; empty if it leads out of the archive.
std::string normal(std::string name) {
  // Archives of some Windows programs.
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path path = fs::path(name).lexically_normal();
  const bool leads_out = path.is_absolute() || (!path.empty() && *path.begin() == "..");
  return leads_out || name.find('\0') != std::string::npos ? std::string() : path.string();
}

}  // namespace

bool is_archive_name(const fs::path& file) {
  const std::string extension = extension_of(file);
  return extension == "3tz" || extension == "zip";
}

void Archive::Close::operator()(void* zip) const { unzClose(zip); }

Archive::Archive(const fs::path& file, std::string name, const std::optional<ArchiveEntry>& known)
    : file_(file), name_(std::move(name)), known_(known) {
  errno = 0;
  zip_.reset(unzOpen64(file.c_str()));
  if (zip_ != nullptr) return;
  if (errno == ENOMEM) throw std::bad_alloc();
  fail_unless_missing(errno, name_);
  throw Error(name_, "this is no whole zip archive: it has no directory at its end. Copy or export it again.");
}

Error Archive::damaged(const std::string& what) const {
  return {name_, fmt::format("this archive is damaged: {}. Copy or export it again.", what)};
}

void Archive::check(int result) const {
  if (result == UNZ_OK) return;
  if (errno == ENOMEM) throw std::bad_alloc();
  if (result == UNZ_ERRNO) fail_unless_missing(errno, name_);
  if (result == UNZ_CRCERROR) throw damaged("an entry does not have its checksum");
  throw damaged("its directory or an entry cannot be read");
}

std::pair<std::string, ArchiveEntry> Archive::current() {
  unz_file_info64 info{};
  std::array<char, longest_path> text{};
  check(unzGetCurrentFileInfo64(zip_.get(), &info, text.data(), text.size(), nullptr, 0, nullptr, 0));
  if (info.size_filename > text.size()) {
    throw damaged(fmt::format("the name of an entry has {} bytes", info.size_filename));
  }
  const std::string name(text.data(), info.size_filename);
  const std::string file = normal(name);
  if (file.empty()) {
    throw Error(name_, fmt::format("its entry '{}' leads out of the archive. Do not trust this file.", shown(name)));
  }
  unz64_file_pos place{};
  check(unzGetFilePos64(zip_.get(), &place));
  const ArchiveEntry entry{0,
                           info.compressed_size,
                           info.uncompressed_size,
                           info.compression_method,
                           place.pos_in_zip_directory,
                           place.num_of_file};
  if (file.back() == '/' || file == index_entry) return {std::string(), entry};
  if ((info.flag & encrypted) != 0) {
    throw Error(name_, fmt::format("its entry '{}' is encrypted; unpack it, and give its folder.", shown(name)));
  }
  if (entry.method != stored && entry.method != deflated) {
    const std::string how = entry.method == zstd ? "zstd" : fmt::format("method {} of zip", entry.method);
    throw Error(name_, fmt::format("its entry '{}' is compressed by {}, which is not read; unpack it and give its "
                                   "folder, or pack it by deflate.",
                                   shown(name), how));
  }
  const bool can_be = entry.method == stored ? entry.bytes == entry.packed : entry.bytes / most_ratio <= entry.packed;
  if (!can_be) {
    throw damaged(
        fmt::format("its entry '{}' states {} bytes, packed into {}", shown(name), entry.bytes, entry.packed));
  }
  return {file, entry};
}

void Archive::list() {
  if (is_listed_) return;
  std::error_code none;
  const std::uint64_t all = fs::file_size(file_, none);
  std::uint64_t packed = 0;
  errno = 0;
  for (int at = unzGoToFirstFile(zip_.get()); at != UNZ_END_OF_LIST_OF_FILE; at = unzGoToNextFile(zip_.get())) {
    check(at);
    auto [name, entry] = current();
    if (entry.packed > all - packed) throw damaged("its entries have more bytes than the archive");
    packed += entry.packed;
    if (name.empty()) continue;
    if (!entries_.emplace(std::move(name), entry).second) {
      throw damaged(fmt::format("two of its entries have the name '{}'", shown(current().first)));
    }
  }
  is_listed_ = true;
}

std::optional<ArchiveEntry> Archive::find(const std::string& name) {
  if (known_ && !is_listed_) {
    try {
      go_to(*known_);
      const auto [there, entry] = current();
      if (there == name) return entry;
    } catch (const Error&) {
      // The archive has changed meanwhile.
    }
  }
  list();
  const auto found = entries_.find(name);
  return found == entries_.end() ? std::nullopt : std::optional(found->second);
}

void Archive::go_to(const ArchiveEntry& entry) {
  errno = 0;
  const unz64_file_pos place{entry.record, entry.number};
  check(unzGoToFilePos64(zip_.get(), &place));
}

std::string Archive::read(const ArchiveEntry& entry, std::uint64_t most) {
  go_to(entry);
  check(unzOpenCurrentFile(zip_.get()));
  struct End {
    void* zip;
    ~End() { unzCloseCurrentFile(zip); }
  } end{zip_.get()};
  std::string content(static_cast<std::size_t>(std::min(most, entry.bytes)), '\0');
  for (std::size_t done = 0; done < content.size();) {
    constexpr std::size_t step = 1u << 20;
    const auto wanted = static_cast<unsigned>(std::min(content.size() - done, step));
    const int got = unzReadCurrentFile(zip_.get(), content.data() + done, wanted);
    if (got < 0) check(got);
    if (got <= 0) throw damaged("an entry ends before its end");
    done += static_cast<std::size_t>(got);
  }
  check(unzCloseCurrentFile(std::exchange(end.zip, nullptr)));
  return content;
}

ArchiveEntry Archive::located(ArchiveEntry entry) {
  go_to(entry);
  int method = 0, level = 0;
  constexpr int packed = 1;
  check(unzOpenCurrentFile2(zip_.get(), &method, &level, packed));
  entry.begin = unzGetCurrentFileZStreamPos64(zip_.get());
  unzCloseCurrentFile(zip_.get());
  return entry;
}

}  // namespace roam::reader
