#include "files/mark.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "files/descriptor.h"

namespace roam::files {
namespace {

using namespace std::string_view_literals;

/// Bytes that are searched. The index of a film stands before its comment, with some 12 bytes for each picture.
constexpr std::uint64_t head = 4 << 20, tail = 64;

/// PNG, "Chunk naming conventions": the case of the letters says ancillary, private, unsafe to copy.
constexpr std::string_view png_chunk = "\0\0\0\x0croAMmade by roam\xa8\x68\x17\x62"sv;
constexpr std::string_view png_start = "\x89PNG\r\n\x1a\n"sv;
constexpr std::size_t png_header = 33;                                     ///< bytes, with IHDR, which must be first
constexpr std::string_view jpeg_segment = "\xff\xef\0\x0emade by roam"sv;  ///< APP15
constexpr std::string_view jpeg_start = "\xff\xd8\xff\xe0"sv;              ///< then the length of JFIF's segment
constexpr std::string_view svg_comment = "<!-- made by roam -->\n"sv;
constexpr std::string_view gif_comment_and_end = "\x21\xfe\x0cmade by roam\0;"sv;
constexpr std::string_view webp_chunk = "ROAM\x0c\0\0\0made by roam"sv;  ///< of a type that readers do not know

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

std::uint64_t size_of(int file) {
  struct stat status {};
  return ::fstat(file, &status) == 0 && status.st_size > 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

std::string read(int file, std::uint64_t offset, std::uint64_t size) {
  std::string text(size, '\0');
  text.resize(read_fully(file, offset, std::as_writable_bytes(std::span(text))));
  return text;
}

}  // namespace

void add_mark(std::string& picture) {
  if (picture.starts_with(png_start) && picture.size() > png_header) {
    picture.insert(png_header, png_chunk);
  } else if (picture.starts_with(jpeg_start) && picture.size() > 6) {
    const auto byte = [&](std::size_t i) { return std::size_t{static_cast<unsigned char>(picture[i])}; };
    const std::size_t end = 4 + 256 * byte(4) + byte(5);
    if (end < picture.size()) picture.insert(end, jpeg_segment);
  } else if (picture.starts_with("<?xml ")) {
    const std::size_t end = picture.find('\n');
    if (end != std::string::npos) picture.insert(end + 1, svg_comment);
  }
}

void add_mark(WholeFile& film) {
  const std::uint64_t size = size_of(film.descriptor());
  const std::string start = read(film.descriptor(), 0, 12);
  if (start.starts_with("GIF89a") && read(film.descriptor(), size - 1, 1) == ";") {
    film.write_at(size - 1, bytes_of(gif_comment_and_end));
  } else if (start.starts_with("RIFF") && start.ends_with("WEBP")) {
    constexpr std::uint64_t before = 8;  // the size that RIFF states does not count these bytes
    const auto stated = static_cast<std::uint32_t>(size + webp_chunk.size() - before);
    std::array<std::byte, 4> little_endian;
    for (std::size_t i = 0; i < 4; ++i) little_endian[i] = static_cast<std::byte>(stated >> (8 * i));
    film.write_at(size, bytes_of(webp_chunk));
    film.write_at(4, little_endian);
  }
}

bool is_marked(const std::filesystem::path& file) {
  const Descriptor opened(again([&] { return ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC); }));
  if (!opened.is_open()) return false;
  const std::uint64_t size = size_of(opened.number());
  const auto has_mark = [&](std::uint64_t offset, std::uint64_t length) {
    return read(opened.number(), offset, length).find(mark) != std::string::npos;
  };
  return size == 0 || has_mark(0, std::min(size, head)) || has_mark(size - std::min(size, tail), tail);
}

}  // namespace roam::files
