#include "import/reader/named_file.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

#include "files/descriptor.h"
#include "files/escaped.h"
#include "import/reader/machine_failure.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// The value of a digit of base64; -1 for other bytes.
int digit_of(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  return c == '/' || c == '_' ? 63 : -1;
}

}  // namespace

bool has_scheme(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  // One letter is a drive of another system.
  if (colon == std::string_view::npos || colon < 2 || std::isalpha(static_cast<unsigned char>(uri[0])) == 0)
    return false;
  return std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' || c == '.';
  });
}

fs::path named_file(const fs::path& folder, const std::string& uri,
                    const std::function<bool(const fs::path&)>& is_there) {
  if (has_scheme(uri) || uri.empty()) return {};
  std::string spelling = uri;
  std::replace(spelling.begin(), spelling.end(), '\\', '/');
  const fs::path written = (folder / spelling).lexically_normal();
  spelling = files::unescaped(spelling.substr(0, spelling.find_first_of("?#")));
  const fs::path meant = (folder / spelling).lexically_normal();
  const bool is_usual = spelling.empty() || spelling.find('\0') != std::string::npos || meant == written;
  return is_usual || is_there(written) ? written : meant;
}

std::optional<std::string> named_bytes(SceneFiles& files, const fs::path& folder, const std::string& uri) {
  if (std::optional<std::string> inside = data_of(uri)) return inside;
  const fs::path named = named_file(folder, uri, [&](const fs::path& path) { return !files.look_up(path).empty(); });
  return named.empty() ? std::nullopt : whole_file(files, named);
}

std::optional<std::string> data_of(std::string_view uri) {
  if (!uri.starts_with("data:")) return std::nullopt;
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  std::string_view content = uri.substr(comma + 1);
  std::string plain;
  if (content.find('%') != std::string_view::npos) content = plain = files::unescaped(std::string(content));
  if (!uri.substr(0, comma).ends_with(";base64")) return std::string(content);
  std::string bytes;
  bytes.reserve(content.size() / 4 * 3);
  std::uint32_t held = 0;
  int bits = 0;
  for (const char c : content) {
    if (c == '=') break;
    const int digit = digit_of(c);
    if (digit < 0) return std::nullopt;
    held = held << 6 | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(held >> bits & 0xff);
  }
  return bytes;
}

std::optional<std::string> whole_file(SceneFiles& files, const fs::path& path) {
  if (!files.resolve(path)) files.leave_out(path);
  const fs::path file = files.open(path);
  if (file.empty()) return std::nullopt;
  if (files.is_in_archive(file)) return files.read_entry(file, std::numeric_limits<std::uint64_t>::max());
  const files::Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status {};
  if (!descriptor.is_open()) {
    fail_unless_missing(errno, path);
    return std::nullopt;
  }
  if (::fstat(descriptor.number(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  const std::size_t read = files::read_fully(descriptor.number(), std::as_writable_bytes(std::span(bytes)));
  if (read < bytes.size()) fail_unless_missing(errno, path);
  bytes.resize(read);
  return bytes;
}

}  // namespace roam::reader
