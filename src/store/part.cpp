#include "store/part.h"

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

#include "roam/error.h"

namespace roam::store {
namespace {

constexpr char magic_number[8] = {'R', 'O', 'A', 'M', 'P', 'A', 'R', 'T'};
constexpr int compression_level = 3;

struct Header {
  char magic[8];
  std::uint64_t triangles;
  std::uint64_t objects;
  std::uint64_t cells;
  std::uint32_t cell_bits;
  std::uint32_t zero;
  std::uint64_t content_bytes;  ///< before compression
};
static_assert(sizeof(Header) == 48);

class Writer {
 public:
  /// Seven bits per byte, low ones first; the last byte has its high bit clear.
  void number(CurveKey value) {
    for (; value >= 128; value >>= 7) put(static_cast<std::uint8_t>(value | 128U));
    put(static_cast<std::uint8_t>(value));
  }
  void text(const std::string& value) {
    number(value.size());
    const auto* first = reinterpret_cast<const std::byte*>(value.data());
    bytes.insert(bytes.end(), first, first + value.size());
  }
  std::vector<std::byte> bytes;

 private:
  void put(std::uint8_t value) { bytes.push_back(std::byte{value}); }
};

/// Bytes. More than the names of a hundred million objects need.
constexpr std::uint64_t most_content = 1ull << 32;

/// Log2 of the window of a zstd frame in bytes, which the reader must keep; encode_part uses the same.
constexpr int window_log = 21;

/// The numbers and texts of a part's content, decompressed piece by piece from a zstd frame.
class Content {
 public:
  Content(const std::function<std::size_t(std::span<std::byte>)>& more, std::uint64_t size)
      : more_(more), zstd_(ZSTD_createDCtx(), ZSTD_freeDCtx), left_(size) {
    if (!zstd_) throw std::bad_alloc();
    ZSTD_DCtx_setParameter(zstd_.get(), ZSTD_d_windowLogMax, window_log);
    packed_.resize(ZSTD_DStreamInSize());
    content_.resize(ZSTD_DStreamOutSize());
  }

  CurveKey number() {
    CurveKey value = 0;
    for (int shift = 0; shift < 128; shift += 7) {
      if (at_ == end_ && !unpack()) break;
      const auto byte = static_cast<std::uint8_t>(content_[at_++]);
      value |= CurveKey{byte & 127U} << shift;
      if (byte < 128) return value;
    }
    ok_ = false;
    return 0;
  }
  std::uint64_t count() {
    const CurveKey value = number();
    if (value > UINT64_MAX) ok_ = false;
    return static_cast<std::uint64_t>(value);
  }
  /// Reads a text and keeps at most its first longest_name bytes.
  void text(std::string& start) {
    start.clear();
    for (std::uint64_t size = count(); ok_ && size > 0;) {
      if (at_ == end_ && !unpack()) {
        ok_ = false;
        return;
      }
      const auto piece = static_cast<std::size_t>(std::min<std::uint64_t>(size, end_ - at_));
      const auto* first = reinterpret_cast<const char*>(content_.data() + at_);
      start.append(first, std::min(piece, longest_name - start.size()));
      at_ += piece;
      size -= piece;
    }
  }
  [[nodiscard]] bool ok() const { return ok_; }
  /// Whether all content was read, in one frame, with nothing after it.
  [[nodiscard]] bool complete() { return ok_ && at_ == end_ && !unpack() && !broken_ && ended_ && left_ == 0; }

 private:
  /// Decompresses more content. False at the end, and if that fails.
  bool unpack() {
    while (!broken_) {
      if (in_.pos == in_.size) {
        in_ = {packed_.data(), more_(packed_), 0};
        // An ended input may still leave output in the decompressor.
        if (in_.size == 0 && (ended_ || starved_)) return false;
        starved_ = in_.size == 0;
      }
      if (ended_) {
        broken_ = true;  // there are bytes after the frame
        break;
      }
      ZSTD_outBuffer out{content_.data(), content_.size(), 0};
      const std::size_t rest = ZSTD_decompressStream(zstd_.get(), &out, &in_);
      ended_ = rest == 0;
      broken_ = ZSTD_isError(rest) != 0 || out.pos > left_;
      if (broken_) break;
      left_ -= out.pos;
      at_ = 0;
      end_ = out.pos;
      if (end_ > 0) return true;
    }
    at_ = end_ = 0;
    return false;
  }

  const std::function<std::size_t(std::span<std::byte>)>& more_;
  const std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx*)> zstd_;
  std::uint64_t left_;  ///< content bytes not yet decompressed
  std::vector<std::byte> packed_, content_;
  ZSTD_inBuffer in_{nullptr, 0, 0};
  std::size_t at_ = 0, end_ = 0;  ///< range in content_
  bool ok_ = true, ended_ = false, broken_ = false, starved_ = false;
};

}  // namespace

const std::string& PartFile::object(std::uint64_t triangle) const {
  static const std::string none;
  const auto after = std::upper_bound(objects.begin(), objects.end(), triangle,
                                      [](std::uint64_t t, const Object& o) { return t < o.first; });
  return after == objects.begin() ? none : std::prev(after)->name;
}

std::vector<std::byte> encode_part(const PartFile& part) {
  Writer content;
  std::uint64_t first = 0;
  for (const PartFile::Object& object : part.objects) {
    content.number(object.first - std::exchange(first, object.first));
    content.text(object.name);
  }
  CurveKey key = 0;
  for (const Cell& cell : part.cells) {
    content.number((cell.key - std::exchange(key, cell.key)) >> part.cell_bits);
    content.number(cell.triangles);
  }
  if (content.bytes.size() > most_content) throw Error("the names of the objects take more than 4 GiB; leave some out");
  Header header{};
  std::memcpy(header.magic, magic_number, sizeof magic_number);
  header.triangles = part.triangles;
  header.objects = part.objects.size();
  header.cells = part.cells.size();
  header.cell_bits = static_cast<std::uint32_t>(part.cell_bits);
  header.content_bytes = content.bytes.size();
  std::vector<std::byte> bytes(sizeof header + ZSTD_compressBound(content.bytes.size()));
  std::memcpy(bytes.data(), &header, sizeof header);
  const std::size_t packed = ZSTD_compress(bytes.data() + sizeof header, bytes.size() - sizeof header,
                                           content.bytes.data(), content.bytes.size(), compression_level);
  if (ZSTD_isError(packed) != 0) throw Error(fmt::format("cannot compress a part file: {}", ZSTD_getErrorName(packed)));
  bytes.resize(sizeof header + packed);
  return bytes;
}

void visit_part(const std::function<std::size_t(std::span<std::byte>)>& more, const std::string& file,
                const PartVisitor& visitor) {
  const auto refuse = [&](const char* why) {
    throw Error(fmt::format("{} is damaged: {}; verify the store, and repair it from its scene", file, why));
  };
  Header header{};
  for (auto rest = std::as_writable_bytes(std::span(&header, 1)); !rest.empty();) {
    const std::size_t got = more(rest);
    if (got == 0) refuse("it is too short");
    rest = rest.subspan(got);
  }
  if (std::memcmp(header.magic, magic_number, sizeof magic_number) != 0) refuse("it is no part file");
  if (header.cell_bits > 127 || header.zero != 0 || header.content_bytes > most_content) {
    refuse("its header is not what it should be");
  }
  // Each object and each cell takes at least two bytes.
  if (header.objects > header.content_bytes / 2 || header.cells > std::min(header.content_bytes / 2, most_cells)) {
    refuse("its counts are out of range");
  }
  if (visitor.counts) {
    visitor.counts({header.triangles, header.objects, header.cells, static_cast<int>(header.cell_bits)});
  }
  Content content(more, header.content_bytes);
  std::uint64_t first = 0;
  std::string name;
  for (std::uint64_t i = 0; i < header.objects && content.ok(); ++i) {
    first += content.count();
    content.text(name);
    if (visitor.object && content.ok()) visitor.object(first, name);
  }
  CurveKey key = 0, sum = 0;
  for (std::uint64_t i = 0; i < header.cells && content.ok(); ++i) {
    key += content.number() << header.cell_bits;
    const std::uint64_t triangles = content.count();
    sum += triangles;
    if (visitor.cell && content.ok()) visitor.cell({key, triangles});
  }
  if (!content.complete() || sum != header.triangles) refuse("its content is not what its header says");
}

PartFile decode_part(std::span<const std::byte> bytes, const std::string& file) {
  PartFile part;
  PartVisitor visitor;
  visitor.counts = [&](const PartCounts& counts) {
    part.triangles = counts.triangles;
    part.cell_bits = counts.cell_bits;
  };
  visitor.object = [&](std::uint64_t first, std::string_view name) {
    part.objects.push_back({first, std::string(name)});
  };
  visitor.cell = [&](const Cell& cell) { part.cells.push_back(cell); };
  const auto more = [&](std::span<std::byte> out) {
    const std::size_t size = std::min(out.size(), bytes.size());
    std::memcpy(out.data(), bytes.data(), size);
    bytes = bytes.subspan(size);
    return size;
  };
  visit_part(more, file, visitor);
  return part;
}

}  // namespace roam::store
