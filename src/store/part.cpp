#include "store/part.h"

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "roam/error.h"

namespace roam::store {
namespace {

constexpr char kMagic[8] = {'R', 'O', 'A', 'M', 'P', 'A', 'R', 'T'};
constexpr int kLevel = 3;

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
  /// Seven bits a byte, low ones first; the last has the high bit clear.
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

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}

  CurveKey number() {
    CurveKey value = 0;
    for (int shift = 0; shift < 128; shift += 7) {
      if (rest_.empty()) break;
      const auto byte = static_cast<std::uint8_t>(rest_.front());
      rest_ = rest_.subspan(1);
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
  std::string text() {
    const std::uint64_t size = count();
    if (size > rest_.size()) {
      ok_ = false;
      return {};
    }
    std::string value(reinterpret_cast<const char*>(rest_.data()), static_cast<std::size_t>(size));
    rest_ = rest_.subspan(static_cast<std::size_t>(size));
    return value;
  }
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool complete() const { return ok_ && rest_.empty(); }

 private:
  std::span<const std::byte> rest_;
  bool ok_ = true;
};

/// Bytes. More than the names of a hundred million objects.
constexpr std::uint64_t kMostContent = 1ull << 32;

/// Of bytes that a frame may look back; encode_part's look back 2^21.
constexpr int kWindowLog = 23;

/// What a frame of `size` bytes holds; nothing where it is none. Takes memory as bytes come: what a header claims costs
/// nothing.
std::optional<std::vector<std::byte>> unpacked(std::span<const std::byte> packed, std::size_t size) {
  const std::unique_ptr<ZSTD_DCtx, std::size_t (*)(ZSTD_DCtx*)> context(ZSTD_createDCtx(), ZSTD_freeDCtx);
  if (!context) throw std::bad_alloc();
  ZSTD_DCtx_setParameter(context.get(), ZSTD_d_windowLogMax, kWindowLog);
  std::vector<std::byte> content;
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  for (;;) {
    const std::size_t had = content.size();
    // One more than there should be: where there are too many, that is seen.
    content.resize(std::min(size + 1, had + std::max(had, ZSTD_DStreamOutSize())));
    ZSTD_outBuffer out{content.data(), content.size(), had};
    const std::size_t rest = ZSTD_decompressStream(context.get(), &out, &in);
    content.resize(out.pos);
    const bool ends = rest == 0, broken = ZSTD_isError(rest) != 0, stuck = out.pos == had && in.pos == in.size;
    if (broken || content.size() > size) return std::nullopt;
    if (ends && in.pos == in.size && content.size() == size) return content;
    if (ends || stuck) return std::nullopt;
  }
}

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
  if (content.bytes.size() > kMostContent) throw Error("the names of the objects take more than 4 GiB; leave some out");
  Header header{};
  std::memcpy(header.magic, kMagic, sizeof kMagic);
  header.triangles = part.triangles;
  header.objects = part.objects.size();
  header.cells = part.cells.size();
  header.cell_bits = static_cast<std::uint32_t>(part.cell_bits);
  header.content_bytes = content.bytes.size();
  std::vector<std::byte> bytes(sizeof header + ZSTD_compressBound(content.bytes.size()));
  std::memcpy(bytes.data(), &header, sizeof header);
  const std::size_t packed = ZSTD_compress(bytes.data() + sizeof header, bytes.size() - sizeof header,
                                           content.bytes.data(), content.bytes.size(), kLevel);
  if (ZSTD_isError(packed) != 0) throw Error(fmt::format("cannot compress a part file: {}", ZSTD_getErrorName(packed)));
  bytes.resize(sizeof header + packed);
  return bytes;
}

PartFile decode_part(std::span<const std::byte> bytes, const std::string& file) {
  const auto refuse = [&](const char* why) {
    throw Error(fmt::format("{} is damaged: {}; verify the store, and repair it from its scene", file, why));
  };
  Header header{};
  if (bytes.size() < sizeof header) refuse("it is too short");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (std::memcmp(header.magic, kMagic, sizeof kMagic) != 0) refuse("it is no part file");
  const std::span<const std::byte> packed = bytes.subspan(sizeof header);
  if (header.cell_bits > 127 || header.zero != 0 || header.content_bytes > kMostContent) {
    refuse("its header is not what it should be");
  }
  const auto unpacked_content = unpacked(packed, static_cast<std::size_t>(header.content_bytes));
  if (!unpacked_content) refuse("it does not unpack");
  const std::vector<std::byte>& content = *unpacked_content;
  // Each takes two bytes at least.
  if (header.objects > content.size() / 2 || header.cells > content.size() / 2) refuse("its counts are out of range");

  PartFile part;
  part.triangles = header.triangles;
  part.cell_bits = static_cast<int>(header.cell_bits);
  Reader reader(content);
  std::uint64_t first = 0;
  for (std::uint64_t i = 0; i < header.objects && reader.ok(); ++i) {
    first += reader.count();
    part.objects.push_back({first, reader.text()});
  }
  CurveKey key = 0;
  CurveKey sum = 0;
  for (std::uint64_t i = 0; i < header.cells && reader.ok(); ++i) {
    key += reader.number() << part.cell_bits;
    part.cells.push_back({key, reader.count()});
    sum += part.cells.back().triangles;
  }
  if (!reader.complete() || sum != part.triangles) refuse("its content is not what its header says");
  return part;
}

}  // namespace roam::store
