#include "store/part.h"

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

#include "store/codec/frame.h"

namespace roam::store {
namespace {

constexpr char part_magic[8] = {'R', 'O', 'A', 'M', 'P', 'A', 'R', 'T'};
constexpr int part_compression_level = 3;

struct PartHeader {
  char magic[8];
  std::uint64_t triangles;
  std::uint64_t objects;
  std::uint64_t cells;
  std::uint32_t cell_bits;
  std::uint32_t zero;
  std::uint64_t content_bytes;  ///< before compression
};
static_assert(sizeof(PartHeader) == 48);

/// Bytes. More than the names of a hundred million objects need.
constexpr std::uint64_t most_content = 1ull << 32;

/// Greatest number of content bytes for each byte of a part file. A frame of the small window keeps to it by itself: it
/// has a block of at least 4 bytes for each KiB.
constexpr std::uint64_t most_unpacked = 256;

/// Log2 of the window of a zstd frame in bytes, which the reader must keep. Large contents have the small window.
constexpr int small_window = 10, window_of_small_content = 21;
constexpr std::uint64_t small_content = 1U << 21;
constexpr int greatest_window(std::uint64_t content) {
  return content > small_content ? small_window : window_of_small_content;
}

/// Throws std::bad_alloc for null.
template <class Context>
Context* demanded(Context* context) {
  if (!context) throw std::bad_alloc();
  return context;
}

/// The numbers and texts of a part's content, decompressed piece by piece from a zstd frame.
class Content {
 public:
  Content(const std::function<std::size_t(std::span<std::byte>)>& more, std::uint64_t size,
          const std::function<bool()>& enough)
      : more_(more), enough_(enough), zstd_(demanded(ZSTD_createDCtx()), ZSTD_freeDCtx), left_(size) {
    ZSTD_DCtx_setParameter(zstd_.get(), ZSTD_d_windowLogMax, greatest_window(size));
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
  /// Reads a text and keeps at most its first longest_part_name bytes.
  void text(std::string& start) {
    start.clear();
    for (std::uint64_t size = count(); ok_ && size > 0;) {
      if (at_ == end_ && !unpack()) {
        ok_ = false;
        return;
      }
      const auto piece = static_cast<std::size_t>(std::min<std::uint64_t>(size, end_ - at_));
      const auto* first = reinterpret_cast<const char*>(content_.data() + at_);
      start.append(first, std::min(piece, longest_part_name - start.size()));
      at_ += piece;
      size -= piece;
    }
  }
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool stopped() const { return stopped_; }
  /// Whether all content was read, in one frame, with nothing after it.
  [[nodiscard]] bool complete() { return ok_ && at_ == end_ && !unpack() && !broken_ && ended_ && left_ == 0; }

 private:
  /// Decompresses more content. False at the end, and if that fails.
  bool unpack() {
    if (enough_ && left_ > 0) stopped_ = stopped_ || enough_();
    if (stopped_) return false;
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
  const std::function<bool()>& enough_;
  const std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx*)> zstd_;
  std::uint64_t left_;  ///< content bytes not yet decompressed
  std::vector<std::byte> packed_, content_;
  ZSTD_inBuffer in_{nullptr, 0, 0};
  std::size_t at_ = 0, end_ = 0;  ///< range in content_
  bool ok_ = true, ended_ = false, broken_ = false, starved_ = false, stopped_ = false;
};

/// A frame of the content at `place`. Returns its bytes. `window`: log2 of its window; 0: any.
std::size_t pack(std::span<const std::byte> content, std::span<std::byte> place, int window) {
  const std::unique_ptr<ZSTD_CCtx, std::size_t (*)(ZSTD_CCtx*)> zstd(demanded(ZSTD_createCCtx()), ZSTD_freeCCtx);
  ZSTD_CCtx_setParameter(zstd.get(), ZSTD_c_compressionLevel, part_compression_level);
  ZSTD_CCtx_setParameter(zstd.get(), ZSTD_c_windowLog, window);
  const std::size_t packed = ZSTD_compress2(zstd.get(), place.data(), place.size(), content.data(), content.size());
  if (ZSTD_isError(packed) != 0) throw Error(fmt::format("cannot compress a part file: {}", ZSTD_getErrorName(packed)));
  return packed;
}

}  // namespace

PartDamage::PartDamage(const std::string& file, const char* why)
    : Error(at(file, fmt::format("{} is damaged: {}; verify the store, and repair it from its scene", file, why))) {}

const std::string& PartFile::object(std::uint64_t triangle) const {
  static const std::string none;
  const auto after = std::upper_bound(objects.begin(), objects.end(), triangle,
                                      [](std::uint64_t t, const Object& o) { return t < o.first; });
  return after == objects.begin() ? none : std::prev(after)->name;
}

std::vector<std::byte> encode_part(const PartFile& part) {
  std::vector<std::byte> content;
  std::uint64_t first = 0;
  for (const PartFile::Object& object : part.objects) {
    append_number(content, object.first - std::exchange(first, object.first));
    append_number(content, object.name.size());
    const auto name = std::as_bytes(std::span(object.name));
    content.insert(content.end(), name.begin(), name.end());
  }
  CurveKey key = 0;
  for (const Cell& cell : part.cells) {
    append_number(content, (cell.key - std::exchange(key, cell.key)) >> part.cell_bits);
    append_number(content, cell.triangles);
  }
  if (content.size() > most_content) throw Error("the names of the objects take more than 4 GiB; leave some out");
  PartHeader header{};
  std::memcpy(header.magic, part_magic, sizeof part_magic);
  header.triangles = part.triangles;
  header.objects = part.objects.size();
  header.cells = part.cells.size();
  header.cell_bits = static_cast<std::uint32_t>(part.cell_bits);
  header.content_bytes = content.size();
  std::vector<std::byte> bytes(sizeof header + ZSTD_compressBound(content.size()));
  std::memcpy(bytes.data(), &header, sizeof header);
  const std::span place = std::span(bytes).subspan(sizeof header);
  std::size_t size = 0;
  if (content.size() <= small_content) size = sizeof header + pack(content, place, 0);
  if (content.size() > most_unpacked * size) size = sizeof header + pack(content, place, small_window);
  bytes.resize(size);
  return bytes;
}

void visit_part(const std::function<std::size_t(std::span<std::byte>)>& more, std::uint64_t bytes,
                const std::string& file, const PartVisitor& visitor) {
  const auto refuse = [&](const char* why) { throw PartDamage(file, why); };
  PartHeader header{};
  for (auto rest = std::as_writable_bytes(std::span(&header, 1)); !rest.empty();) {
    const std::size_t got = more(rest);
    if (got == 0) refuse("it is too short");
    rest = rest.subspan(got);
  }
  if (std::memcmp(header.magic, part_magic, sizeof part_magic) != 0) refuse("it is no part file");
  if (header.cell_bits > 127 || header.zero != 0 || header.content_bytes > most_content) {
    refuse("its header is not what it should be");
  }
  if (header.content_bytes / most_unpacked > bytes) refuse("it would unpack to far more than its size justifies");
  // Each object and each cell takes at least two bytes, and each object has a triangle.
  if (header.objects > std::min(header.content_bytes / 2, header.triangles) ||
      header.cells > std::min(header.content_bytes / 2, most_cells)) {
    refuse("its numbers of objects and cells are out of range");
  }
  if (visitor.counts) {
    visitor.counts({header.triangles, header.objects, header.cells, static_cast<int>(header.cell_bits)});
  }
  Content content(more, header.content_bytes, visitor.enough);
  std::uint64_t first = 0;
  std::string name;
  for (std::uint64_t i = 0; i < header.objects; ++i) {
    const std::uint64_t step = content.count();
    content.text(name);
    if (!content.ok()) break;
    if (step >= header.triangles - first || (step == 0 && i > 0)) refuse("its objects are in no order");
    first += step;
    if (visitor.object) visitor.object(first, name);
  }
  CurveKey key = 0, sum = 0;
  for (std::uint64_t i = 0; i < header.cells && content.ok(); ++i) {
    key += content.number() << header.cell_bits;
    const std::uint64_t triangles = content.count();
    sum += triangles;
    if (visitor.cell && content.ok()) visitor.cell({key, triangles});
  }
  if (content.stopped()) return;
  if (!content.complete() || sum != header.triangles) refuse("its content is not what its header says");
}

}  // namespace roam::store
