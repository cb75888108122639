#pragma once
/// \file
/// The protocol from roam-reader to the program that started it: frames on file descriptor stream_fd.
///
/// A frame is a FrameHeader followed by `bytes` bytes of payload, in the byte order of the machine, which both ends
/// share. Frames are numbered from 0 without a gap. A payload is the fields below in this order. Text is a 32-bit
/// length and that many bytes.
///
///     hello         Greeting                                                 first, once
///     opened        text file                                                at any time; each file once
///     outside       text file                                                a reference that was left out
///     looked_up     text path; LookedUp                                      each path once, before its file is
///     opened;
///                                                                            empty: a library opens files by itself
///     progress      u64 bytes read so far                                    at any time
///     georeference  f64 x, y, z; text srs                                    of a folder of tiles, at most once
///     unit          u8 LengthUnit that a file states, and that is not applied
///     tile          text file; u8 whether it exists; text part;              in a list of the parts of a scene: the
///                   ArchiveEntry                                             root of a folder's tile, then `part` is
///                                                                            empty; or a file of a tileset's part, one
///                                                                            after the other, with its place if it is
///                                                                            in an archive
///     object        text name; u8 continues                                  begins a mesh or a piece; a piece that
///                                                                            continues has the object of the one
///                                                                            before
///     vertices      f64 x, y, z of each                                      of the current mesh or piece
///     triangles     u32 a, b, c of each                                      indices of the vertices sent so far of
///                                                                            the current mesh or piece
///     left_out      u8 LeftOutReason; text name; u64 vertices; u64 triangles
///     part          f64 x, y, z of the origin, of the lower and of the upper corner; u64 triangles, bytes;
///                   begins a display part (display.h); only on request, and then there is neither object, vertices
///                   nor triangles
///     part_bytes    bytes of the current part (part_format.h), until all are sent
///     missing_page  text file
///     missing_texture  text file
///     note          text sentence
///     failure       text place; text sentence                                last: the file cannot be read; the place
///                                                                            is that of roam::Error
///     end           Totals; u32 n, u8 matched of each of the n ignore patterns     last: reading is complete
///
/// The receiver trusts nothing. It checks the numbering and the sizes, that vertices are finite and within the limit,
/// that indices are in range, and that the totals of `end` equal the contents received.

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace roam::reader {

inline constexpr int stream_fd = 3;
inline constexpr std::uint32_t stream_version = 11;
inline constexpr std::uint32_t frame_magic = 0x31524d52;  // "RMR1"
/// Largest payload, in bytes; a sender splits vertices and triangles accordingly.
inline constexpr std::uint32_t payload_limit = 4u << 20;
/// Largest text, in bytes; the sender cuts longer names.
inline constexpr std::uint32_t text_limit = 64u << 10;
/// Most bytes of an object's name that the receiver keeps.
inline constexpr std::size_t object_name_limit = 1024;

enum class FrameKind : std::uint16_t {
  hello,
  opened,
  outside,
  looked_up,
  progress,
  georeference,
  unit,
  tile,
  object,
  vertices,
  triangles,
  left_out,
  part,
  part_bytes,
  missing_page,
  missing_texture,
  note,
  failure,
  end
};

struct FrameHeader {
  std::uint32_t magic = frame_magic;
  FrameKind kind = FrameKind::hello;
  std::uint16_t zero = 0;
  std::uint32_t number = 0;
  std::uint32_t bytes = 0;
};
static_assert(sizeof(FrameHeader) == 16);

/// The state of a regular file when its path was looked up; `found` is 0 if there is none in the scene.
struct LookedUp {
  std::uint64_t bytes = 0;
  std::int64_t changed_ns = 0;  ///< ctime
  std::uint64_t found = 0;
};

enum class LeftOutReason : std::uint8_t { bad_vertices, ignored };

/// The sender's version of this protocol, and the walls around it: see Confinement.
struct Greeting {
  std::uint32_t version = stream_version;
  std::int32_t landlock = 0;
  std::uint8_t system_calls = 0, no_new_privileges = 0, limits = 0, empty_folder = 0;
};

struct Totals {
  std::uint64_t files = 0, vertices = 0, triangles = 0;
  std::uint64_t bad_vertices = 0, bad_triangles = 0, ignored_triangles = 0, missing_pages = 0;
  std::uint64_t textures = 0, missing_textures = 0;
};

/// The header of a part; see display.h.
struct PartHeader {
  double origin[3];
  double lower[3], upper[3];
  std::uint64_t triangles;
  std::uint64_t bytes;
};

/// Builds a payload field by field.
class PayloadWriter {
 public:
  template <class T>
  PayloadWriter& add(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    return append(std::as_bytes(std::span(&value, 1)));
  }
  PayloadWriter& add_text(std::string_view text) {
    text = text.substr(0, text_limit);
    return add(static_cast<std::uint32_t>(text.size())).append(std::as_bytes(std::span(text)));
  }
  PayloadWriter& append(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  [[nodiscard]] std::vector<std::byte> take_bytes() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

/// Reads a payload field by field. A missing field reads as zero or empty, and makes complete() false.
class PayloadReader {
 public:
  explicit PayloadReader(std::span<const std::byte> bytes) : rest_(bytes) {}

  template <class T>
  T take() {
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    if (rest_.size() < sizeof(T)) {
      ok_ = false;
      return value;
    }
    std::memcpy(&value, rest_.data(), sizeof(T));
    rest_ = rest_.subspan(sizeof(T));
    return value;
  }
  std::string take_text() {
    const auto length = take<std::uint32_t>();
    if (length > text_limit || length > rest_.size()) {
      ok_ = false;
      return {};
    }
    std::string text(reinterpret_cast<const char*>(rest_.data()), length);
    rest_ = rest_.subspan(length);
    return text;
  }
  /// Whether every field was present and nothing is left over.
  [[nodiscard]] bool complete() const { return ok_ && rest_.empty(); }

 private:
  std::span<const std::byte> rest_;
  bool ok_ = true;
};

}  // namespace roam::reader
