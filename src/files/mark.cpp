#include "files/mark.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "files/descriptor.h"

namespace roam::files {
namespace {

using namespace std::string_view_literals;

/// Bytes of an MP4 or WebM that are searched. Its index stands before its comment, with some 12 bytes for each picture.
constexpr std::uint64_t film_head = 4 << 20;
/// Bytes of any other file in which the mark begins, unless it is at the end.
constexpr std::uint64_t head = 4096;

/// PNG, "Chunk naming conventions": the case of the letters says ancillary, private, unsafe to copy.
constexpr std::string_view png_chunk = "\0\0\0\x0croAMmade by roam\xa8\x68\x17\x62"sv;
constexpr std::string_view png_start = "\x89PNG\r\n\x1a\n"sv;
constexpr std::size_t png_header = 33;                                     ///< bytes, with IHDR, which must be first
constexpr std::string_view jpeg_segment = "\xff\xef\0\x0emade by roam"sv;  ///< APP15
constexpr std::string_view jpeg_start = "\xff\xd8\xff\xe0"sv;              ///< then the length of JFIF's segment
constexpr std::string_view svg_comment = "<!-- made by roam -->\n"sv;
constexpr std::string_view gif_comment_and_end = "\x21\xfe\x0cmade by roam\0;"sv;
constexpr std::string_view webp_chunk = "ROAM\x0c\0\0\0made by roam"sv;  ///< of a type that readers do not know

/// Beginnings of DXF, PLY, OBJ and STL.
constexpr std::array marked_starts{"999\nmade by roam\n"sv,
                                   "ply\nformat binary_little_endian 1.0\ncomment made by roam;"sv, "# made by roam;"sv,
                                   "binary STL made by roam;"sv};

/// Where bytes with the mark belong.
struct Spot {
  std::size_t at = 0;
  std::string_view bytes;
};

/// In a picture that begins with `start`; none if it is no PNG, JPEG or SVG.
std::optional<Spot> place_in(std::string_view start) {
  if (start.starts_with(png_start)) return Spot{png_header, png_chunk};
  if (start.starts_with(jpeg_start) && start.size() > 6) {
    const auto byte = [&](std::size_t i) { return std::size_t{static_cast<unsigned char>(start[i])}; };
    return Spot{4 + 256 * byte(4) + byte(5), jpeg_segment};
  }
  const std::size_t line = start.starts_with("<?xml ") ? start.find('\n') : std::string_view::npos;
  if (line != std::string_view::npos) return Spot{line + 1, svg_comment};
  return std::nullopt;
}

bool is_gif(std::string_view start) { return start.starts_with("GIF89a"); }
bool is_webp(std::string_view start) {
  return start.starts_with("RIFF") && start.size() >= 12 && start.substr(8).starts_with("WEBP");
}
bool is_mp4_or_webm(std::string_view start) {
  return start.starts_with("\x1a\x45\xdf\xa3") || (start.size() > 8 && start.substr(4).starts_with("ftyp"));
}

std::span<const std::byte> bytes_of(std::string_view text) { return std::as_bytes(std::span(text)); }

/// None if it is not open.
std::optional<std::uint64_t> known_size_of(int file) {
  struct stat status {};
  if (::fstat(file, &status) != 0) return std::nullopt;
  return static_cast<std::uint64_t>(std::max<off_t>(status.st_size, 0));
}
std::uint64_t size_of(int file) { return known_size_of(file).value_or(0); }

std::string read(int file, std::uint64_t offset, std::uint64_t size) {
  std::string text(size, '\0');
  text.resize(read_fully(file, offset, std::as_writable_bytes(std::span(text))));
  return text;
}

bool has_mark(int file) {
  const std::optional<std::uint64_t> known = known_size_of(file);
  if (!known) return false;
  const std::uint64_t size = *known;
  if (size == 0) return true;
  const std::string start = read(file, 0, std::min(size, head));
  const auto ends_with = [&](std::string_view bytes) {
    return size > bytes.size() && read(file, size - bytes.size(), bytes.size()) == bytes;
  };
  if (is_gif(start)) return ends_with(gif_comment_and_end);
  if (is_webp(start)) return ends_with(webp_chunk);
  if (is_mp4_or_webm(start)) return read(file, 0, std::min(size, film_head)).find(mark) != std::string::npos;
  if (const std::optional<Spot> place = place_in(start)) {
    return place->at < start.size() && std::string_view(start).substr(place->at).starts_with(place->bytes);
  }
  return std::any_of(marked_starts.begin(), marked_starts.end(), [&](auto words) { return start.starts_with(words); });
}

}  // namespace

void add_mark(std::string& picture) {
  const std::optional<Spot> place = place_in(picture);
  if (place && place->at < picture.size()) picture.insert(place->at, place->bytes);
}

void add_mark(WholeFile& film) {
  const std::uint64_t size = size_of(film.descriptor());
  const std::string start = read(film.descriptor(), 0, 12);
  if (is_gif(start) && read(film.descriptor(), size - 1, 1) == ";") {
    film.write_at(size - 1, bytes_of(gif_comment_and_end));
  } else if (is_webp(start)) {
    constexpr std::uint64_t before = 8;  // the size that RIFF states does not count these bytes
    const auto stated = static_cast<std::uint32_t>(size + webp_chunk.size() - before);
    std::array<std::byte, 4> little_endian;
    for (std::size_t i = 0; i < 4; ++i) little_endian[i] = static_cast<std::byte>(stated >> (8 * i));
    film.write_at(size, bytes_of(webp_chunk));
    film.write_at(4, little_endian);
  }
}

FileKind marked(const std::string& noun) { return {noun + " made by roam", has_mark}; }

}  // namespace roam::files
