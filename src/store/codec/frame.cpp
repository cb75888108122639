#include "store/codec/frame.h"

#include <zstd.h>

#include <cstring>
#include <memory>
#include <new>
#include <string>

#include "roam/error.h"

namespace roam::store {
namespace {

/// The fastest ordinary level. Level six takes three times as long and saves 1 % of a tile.
constexpr int compression_level = 1;
/// Bytes that the flush after one stream may add to ZSTD_compressBound of all streams together.
constexpr std::size_t flush_bytes = 64;

std::size_t checked(std::size_t result) {
  if (ZSTD_isError(result) != 0) throw Error(std::string("cannot compress a tile: ") + ZSTD_getErrorName(result));
  return result;
}

}  // namespace

bool read_number(std::span<const std::byte>& coded, int bits, std::uint64_t& number) {
  number = 0;
  for (int shift = 0; shift < bits && !coded.empty(); shift += 7) {
    const auto byte = std::to_integer<std::uint64_t>(coded.front());
    coded = coded.subspan(1);
    number |= (byte & 127U) << shift;
    if (byte < 128) return true;
  }
  return false;
}

void append_frame(std::vector<std::byte>& coded, std::span<const std::vector<std::byte>> streams) {
  // A new context each time: state from an earlier tile must not affect the bytes.
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> zstd(ZSTD_createCCtx(), ZSTD_freeCCtx);
  if (zstd == nullptr) throw std::bad_alloc();
  std::size_t total = 0;
  for (const auto& stream : streams) total += stream.size();
  checked(ZSTD_CCtx_setParameter(zstd.get(), ZSTD_c_compressionLevel, compression_level));
  checked(ZSTD_CCtx_setPledgedSrcSize(zstd.get(), total));
  const std::size_t begin = coded.size();
  coded.resize(begin + ZSTD_compressBound(total) + flush_bytes * streams.size());
  ZSTD_outBuffer out{coded.data() + begin, coded.size() - begin, 0};
  for (const auto& stream : streams) {
    // Flushing ends a block, and each block has its own codes.
    ZSTD_inBuffer in{stream.data(), stream.size(), 0};
    const ZSTD_EndDirective end = &stream == &streams.back() ? ZSTD_e_end : ZSTD_e_flush;
    if (checked(ZSTD_compressStream2(zstd.get(), &out, &in, end)) != 0) {
      throw Error("cannot compress a tile: it takes more room than was foreseen");
    }
  }
  coded.resize(begin + out.pos);
}

bool is_one_frame(std::span<const std::byte> coded) {
  // ZSTD_decompress would allocate for frames of older formats, and would continue with a second frame.
  static constexpr unsigned char magic[] = {0x28, 0xb5, 0x2f, 0xfd};
  return coded.size() > sizeof(magic) && std::memcmp(coded.data(), magic, sizeof(magic)) == 0 &&
         ZSTD_findFrameCompressedSize(coded.data(), coded.size()) == coded.size();
}

}  // namespace roam::store
